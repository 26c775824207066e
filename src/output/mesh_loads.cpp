// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "output/mesh_loads.h"

#include <numeric>

namespace lsdcd {

void MeshLoads::add(const StepContact *records, int n, Real dt, Real per_work,
                    const MeshFeaturesView &wall, std::uint32_t mesh)
{
  time_ += dt;
  for (int i = 0; i < n; i++) {
    const StepContact &r = records[i];
    if (r.mesh != mesh) continue;
    Load &to = loads_.at(own_feature(wall, r.feature));
    to.normal += r.normal * dt;
    to.shear += r.shear * dt;
    to.contacts += dt;
    to.worn += per_work * r.wear_power * dt;
    to.force += dt * r.force;
  }
}

void MeshLoads::begin_average()
{
  time_ = 0;
  for (Load &l : loads_.rows()) {
    const Real worn = l.worn;
    l = Load();
    l.worn = worn;
  }
}

Real MeshLoads::worn() const
{
  return std::accumulate(loads_.rows().begin(), loads_.rows().end(), Real(0),
                         [](Real sum, const Load &l) { return sum + l.worn; });
}

std::vector<double> MeshLoads::packed() const
{
  std::vector<double> rows;
  rows.reserve(loads_.rows().size() * kPacked);
  loads_.in_order([&](FeatureCode feature, const Load &l) {
    rows.insert(rows.end(), {static_cast<double>(feature), l.normal, l.shear, l.contacts, l.worn,
                             l.force.x, l.force.y, l.force.z});
  });
  return rows;
}

void MeshLoads::add_packed(const std::vector<double> &rows)
{
  for (std::size_t k = 0; k + kPacked <= rows.size(); k += kPacked) {
    const double *const r = rows.data() + k;
    Load &to = loads_.at(static_cast<FeatureCode>(r[0]));
    to.normal += r[1];
    to.shear += r[2];
    to.contacts += r[3];
    to.worn += r[4];
    to.force += {r[5], r[6], r[7]};
  }
}

std::vector<Load> MeshLoads::of_faces(const WeldedMesh &mesh) const
{
  std::vector<Load> faces(mesh.faces.size());
  loads_.on_faces(mesh, [&](int f, const Load &l, Real part) {
    faces[f].normal += part * l.normal;
    faces[f].shear += part * l.shear;
    faces[f].contacts += part * l.contacts;
    faces[f].worn += part * l.worn;
    faces[f].force += part * l.force;
  });
  return faces;
}

}    // namespace lsdcd
