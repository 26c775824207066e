// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Loads and wear of the parts of a wall, and their file.
#include "base/atomic_file.h"
#include "output/file_series.h"
#include "output/mesh_fields.h"
#include "support/comma_locale.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

namespace lsdcd::test_mesh_loads {
namespace {

StepContact on(FeatureKind kind, std::uint32_t index, Real normal, Real shear, Real wear)
{
  return {feature_code(kind, index), 0, normal, shear, wear, {-shear, 0, -normal}, {0, 0, 0}};
}

TEST(loads, are_integrals_over_time)
{
  FeatureRows<Load> loads;
  const StepContact first[] = {on(FeatureKind::face, 1, 2, 1, 8)};
  const StepContact second[] = {on(FeatureKind::face, 1, 4, 3, 16),
                                on(FeatureKind::face, 0, -1, 0, 0)};
  loads.add(first, 1, LoadOf{0.5, 0.25});
  loads.add(second, 2, LoadOf{0.25, 0.25});
  const std::vector<Load> faces = loads.of_faces(weld(floor_mesh(1, 1), -1));
  EXPECT_EQ(faces[1].normal, 2);
  EXPECT_EQ(faces[1].shear, 1.25);
  EXPECT_EQ(faces[1].contacts, 0.75);
  EXPECT_EQ(faces[1].worn, 2);
  EXPECT_EQ(faces[1].force, (Vec3{-1.25, 0, -2}));
  EXPECT_EQ(faces[0].normal, -0.25);
  EXPECT_EQ(loads.total().worn, 2);
}

TEST(loads, of_edges_and_vertices_are_shared_evenly_by_their_faces)
{
  const WeldedMesh mesh = weld(box_mesh({0, 0, 0}, {1, 1, 1}), -1);
  for (std::size_t e = 0; e < mesh.edges.size(); e++) {
    FeatureRows<Load> loads;
    const StepContact r = on(FeatureKind::edge, static_cast<std::uint32_t>(e), 6, 2, 0);
    loads.add(&r, 1, LoadOf{1, 0});
    Real sum = 0;
    const std::vector<Load> faces = loads.of_faces(mesh);
    for (std::size_t f = 0; f < faces.size(); f++) {
      const auto &edges = mesh.face_edges[f];
      const bool has = std::count(edges.begin(), edges.end(), static_cast<int>(e)) > 0;
      EXPECT_EQ(faces[f].normal, has ? 3 : 0);
      sum += faces[f].shear;
    }
    EXPECT_EQ(sum, 2);
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); v++) {
    FeatureRows<Load> loads;
    const StepContact r = on(FeatureKind::vertex, static_cast<std::uint32_t>(v), 0, 0, 60);
    loads.add(&r, 1, LoadOf{1, 1});
    int n_around = 0;
    for (const auto &f : mesh.faces)
      n_around += std::count(f.begin(), f.end(), static_cast<int>(v));
    const std::vector<Load> faces = loads.of_faces(mesh);
    for (std::size_t f = 0; f < faces.size(); f++) {
      const bool has = std::count(mesh.faces[f].begin(), mesh.faces[f].end(), static_cast<int>(v));
      EXPECT_NEAR(faces[f].worn, has ? 60.0 / n_around : 0, 1e-14 * 60);
    }
  }
}

TEST(loads, packed_and_added_up_are_those_of_all)
{
  FeatureRows<Load> one, two, sum;
  const StepContact a[] = {on(FeatureKind::face, 7, 1, 2, 3), on(FeatureKind::vertex, 3, 4, 5, 6)};
  const StepContact b[] = {on(FeatureKind::vertex, 3, 7, 8, 9), on(FeatureKind::edge, 3, 1, 1, 1)};
  one.add(a, 2, LoadOf{0.5, 1});
  two.add(b, 2, LoadOf{0.5, 1});
  for (const FeatureRows<Load> *part : {&one, &two}) sum.add_packed(part->packed());
  one.add(b, 2, LoadOf{0.5, 1});
  EXPECT_EQ(sum.packed(), one.packed());
  EXPECT_EQ(sum.packed().size(), 3u * FeatureRows<Load>::kPacked);
}

// The text between > and < of the array with that name, decoded.
template <class T>
std::vector<T> array_in(const std::string &xml, const std::string &name)
{
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t at = xml.find('>', xml.find("Name=\"" + name + "\"")) + 1;
  std::string bytes;
  unsigned bits = 0, held = 0;
  for (std::size_t i = at; xml[i] != '<' && xml[i] != '='; i++) {
    held = held << 6 | static_cast<unsigned>(letters.find(xml[i]));
    if ((bits += 6) >= 8) bytes += static_cast<char>(held >> (bits -= 8));
  }
  std::uint64_t n;
  std::memcpy(&n, bytes.data(), 8);
  EXPECT_EQ(n, bytes.size() - 8);
  std::vector<T> values(n / sizeof(T));
  std::memcpy(values.data(), bytes.data() + 8, n);
  return values;
}

TEST(mesh_fields, are_written_whole_and_exact)
{
  const TempDir dir;
  const std::string path = dir.path("fields.vtp");
  const WeldedMesh mesh = weld(floor_mesh(3, 1, 4), -1);
  FeatureRows<Load> loads;
  const StepContact r = on(FeatureKind::face, 5, 6, 2, 5);
  loads.add(&r, 1, LoadOf{0.1, 1});
  write_mesh_fields(path, mesh, load_fields(mesh, loads, 0.2, 1000, true), 77, 0.25);

  const std::string xml = content(path);
  EXPECT_NE(xml.find("NumberOfPolys=\"18\""), std::string::npos);
  EXPECT_EQ(xml.substr(xml.size() - 11), "</VTKFile>\n");
  const auto points = array_in<double>(xml, "points");
  const auto corners = array_in<std::int32_t>(xml, "connectivity");
  ASSERT_EQ(corners.size(), 54u);
  ASSERT_EQ(points.size(), 3 * mesh.vertices.size());
  EXPECT_EQ(array_in<std::int32_t>(xml, "offsets")[17], 54);
  EXPECT_EQ(array_in<std::int64_t>(xml, "step")[0], 77);
  EXPECT_EQ(array_in<double>(xml, "TimeValue")[0], 0.25);
  // The area from what is in the file, by Heron's formula.
  Real side[3];
  for (int k = 0; k < 3; k++) {
    const double *p = &points[3 * corners[15 + k]], *q = &points[3 * corners[15 + (k + 1) % 3]];
    side[k] = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }
  const Real s = (side[0] + side[1] + side[2]) / 2;
  const Real area = std::sqrt(s * (s - side[0]) * (s - side[1]) * (s - side[2]));
  EXPECT_NEAR(array_in<double>(xml, "normal_stress")[5], 3000 / area, 1e-12 * 3000 / area);
  EXPECT_NEAR(array_in<double>(xml, "shear_stress")[5], 1000 / area, 1e-12 * 1000 / area);
  EXPECT_NEAR(array_in<double>(xml, "contacts")[5], 0.5, 1e-15);
  EXPECT_NEAR(array_in<double>(xml, "worn_volume")[5], 0.5, 1e-15);
  EXPECT_NEAR(array_in<double>(xml, "worn_depth")[5], 0.5 / area, 1e-12 / area);
  EXPECT_EQ(array_in<double>(xml, "normal_stress")[4], 0);
}

void expect_series()
{
  const TempDir dir;
  const std::string name = dir.path("a&<\"b_*.vtp");
  FileSeries first(name);
  EXPECT_EQ(first.path(), dir.path("a&<\"b_series.pvd"));
  for (const int step : {1, 2, 3}) first.add(step, 0.1 * step);
  first.write();
  FileSeries next(name);
  EXPECT_EQ(next.begin(true), "");
  next.add(2, 0.25);    // of this step there is another file now, and step 3 is to come
  next.write();
  EXPECT_EQ(
      content(next.path()),
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n"
      "<DataSet timestep=\"0.10000000000000001\" part=\"0\" file=\"a&amp;&lt;&quot;b_1.vtp\"/>\n"
      "<DataSet timestep=\"0.25\" part=\"0\" file=\"a&amp;&lt;&quot;b_2.vtp\"/>\n"
      "</Collection>\n</VTKFile>\n");
}

TEST(file_series, lists_files_with_times_and_reads_its_own_list)
{
  expect_series();
}

// Each is the list of an earlier run that something has damaged: it is kept beside the new one, which has the entries that are whole.
TEST(file_series, keeps_a_damaged_list_beside_the_one_that_goes_on)
{
  const TempDir dir;
  const std::string
      name = dir.path("f_*.vtp"),
      begin =
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n",
      end = "</Collection>\n</VTKFile>\n";
  const auto entry = [](const std::string &time, const std::string &file) {
    return "<DataSet timestep=\"" + time + "\" part=\"0\" file=\"" + file + "\"/>\n";
  };
  const std::string one = entry("1", "f_1.vtp"), two = entry("2", "f_2.vtp"),
                    last = entry("3", "f_3.vtp");
  const std::string damaged[] = {begin + one,
                                 begin + one + two.substr(0, 20),
                                 begin + one + entry("2", std::string("f\0_2.vtp", 8)) + end,
                                 begin + one + entry("2", "f_<2.vtp") + end,
                                 begin + one + entry("2", "f_&2.vtp") + end,
                                 begin + one + entry("2", "f_\xff.vtp") + end,
                                 begin + one + entry("1e400", "f_2.vtp") + end,
                                 begin + one + entry("2", "f_2.vtp\"/><DataSet file=\"x") + end,
                                 "my notes\n" + one};
  for (std::size_t k = 0; k < std::size(damaged); k++) {
    FileSeries series(name);
    write_whole_file(series.path(), damaged[k]);
    const std::string kept = series.path() + ".old" + (k > 0 ? std::to_string(k + 1) : "");
    const std::string told = series.begin(true);
    EXPECT_NE(told.find("is kept as '" + kept + "': the new one has 1 file of it"), told.npos)
        << k << ": " << told;
    series.add(3, 3);
    series.write();
    EXPECT_EQ(content(kept), damaged[k]) << k;
    EXPECT_EQ(content(series.path()), begin + one + last + end) << k;
  }
}

TEST(file_series, replaces_its_own_list_and_no_file_of_another_program)
{
  const TempDir dir;
  FileSeries own(dir.path("f_*.vtp"));
  own.add(1, 1);
  own.write();
  FileSeries anew(dir.path("f_*.vtp"));
  EXPECT_EQ(anew.begin(false), "");
  anew.write();
  EXPECT_EQ(content(anew.path()).find("f_1.vtp"), std::string::npos);
  write_whole_file(anew.path(), "my notes\n");
  EXPECT_NE(FileSeries(dir.path("f_*.vtp")).begin(false), "");
  EXPECT_EQ(content(anew.path() + ".old"), "my notes\n");
}

// ParaView reads a list with points alone, and so does a run that goes on in another locale.
TEST(file_series, has_times_with_a_point_in_any_locale)
{
  const CommaLocale commas;
  if (!commas.works()) GTEST_SKIP() << "this C library takes no locale of ours";
  expect_series();
}

}    // namespace
}    // namespace lsdcd::test_mesh_loads
