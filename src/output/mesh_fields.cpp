// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "output/mesh_fields.h"

#include "base/atomic_file.h"
#include "output/vtk_array.h"

#include <cstdint>

namespace lsdcd {

namespace {

Real face_area(const WeldedMesh &mesh, std::size_t face)
{
  const auto &f = mesh.faces[face];
  const Vec3 &a = mesh.vertices[f[0]];
  return Real(0.5) * norm(cross(mesh.vertices[f[1]] - a, mesh.vertices[f[2]] - a));
}

}    // namespace

std::vector<FaceField> load_fields(const WeldedMesh &mesh, const FeatureRows<Load> &loads,
                                   Real time, double pressure_unit, bool with_wear,
                                   const Pose &pose)
{
  std::vector<FaceField> fields = {{"normal_stress", {}}, {"shear_stress", {}}, {"contacts", {}}};
  if (with_wear) fields.insert(fields.end(), {{"worn_volume", {}}, {"worn_depth", {}}});
  const std::vector<Load> faces = loads.of_faces(mesh);
  FaceField force = {"force", {}, 3};
  const Real per_time = time > 0 ? 1 / time : Real(0);
  for (std::size_t f = 0; f < faces.size(); f++) {
    const Load &l = faces[f];
    const Real area = face_area(mesh, f), stress = pressure_unit * per_time / area;
    const double row[] = {stress * l.normal, stress * l.shear, per_time * l.contacts, l.worn,
                          l.worn / area};
    for (std::size_t k = 0; k < fields.size(); k++) fields[k].value.push_back(row[k]);
    const Vec3 push = per_time * pose.turn_to_box(l.force);
    force.value.insert(force.value.end(), {push.x, push.y, push.z});
  }
  fields.push_back(force);
  return fields;
}

std::vector<FaceField> energy_fields(const WeldedMesh &mesh, const FeatureRows<PlaceEnergy> &places,
                                     bool with_energy, bool with_impacts)
{
  std::vector<FaceField> fields;
  const std::vector<PlaceEnergy> faces = places.of_faces(mesh);
  const auto add = [&](const char *name, Real PlaceEnergy::*member) {
    FaceField &field = fields.emplace_back();
    field.name = name;
    for (const PlaceEnergy &p : faces) field.value.push_back(p.*member);
  };
  if (with_energy) add("dissipated_energy", &PlaceEnergy::dissipated);
  if (!with_impacts) return fields;
  add("impacts", &PlaceEnergy::impacts);
  add("impact_energy", &PlaceEnergy::impact_energy);
  add("impact_speed", &PlaceEnergy::impact_speed);
  return fields;
}

void write_mesh_fields(const std::string &path, const WeldedMesh &mesh,
                       const std::vector<FaceField> &fields, long long step, double time,
                       const Pose &pose)
{
  std::vector<double> points;
  for (const Vec3 &x : mesh.vertices) {
    const Vec3 p = pose.to_box(x);
    points.insert(points.end(), {p.x, p.y, p.z});
  }
  std::vector<std::int32_t> corners, ends;
  for (const auto &f : mesh.faces) {
    corners.insert(corners.end(), f.begin(), f.end());
    ends.push_back(static_cast<std::int32_t>(corners.size()));
  }
  const std::string n_points = std::to_string(mesh.vertices.size());
  const std::string n_faces = std::to_string(mesh.faces.size());

  std::string text = std::string(kVtkHead) + "<FieldData>\n";
  text += data_array<double>("Float64", "TimeValue", {time}, " NumberOfTuples=\"1\"");
  text += data_array<std::int64_t>("Int64", "step", {step}, " NumberOfTuples=\"1\"");
  text += "</FieldData>\n<Piece NumberOfPoints=\"" + n_points + "\" NumberOfPolys=\"" + n_faces +
          "\">\n<CellData>\n";
  for (const FaceField &f : fields)
    text += data_array("Float64", f.name, f.value,
                       " NumberOfComponents=\"" + std::to_string(f.n_components) + "\"");
  text += "</CellData>\n<Points>\n";
  text += data_array("Float64", "points", points, " NumberOfComponents=\"3\"");
  text += "</Points>\n<Polys>\n";
  text += data_array("Int32", "connectivity", corners);
  text += data_array("Int32", "offsets", ends);
  text += std::string("</Polys>\n") + kVtkEnd;

  write_whole_file(path, text);
}

}    // namespace lsdcd
