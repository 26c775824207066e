// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The outputs that output.py adds.
#include "base/input_error.h"
#include "input/script_files.h"
#include "input/wall_command.h"
#include "output/mesh_fields.h"
#include "support/fake_host.h"
#include "support/meshes.h"
#include "support/temp_dir.h"
#include "wall/wall_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace lsdcd {
namespace {

// Loads of two steps: 3 on the second face in a step of 1, nothing in one of 3.
MeshLoads pressed()
{
  StepContact record = {};
  record.feature = feature_code(FeatureKind::face, 1);
  record.normal = 3;
  MeshLoads loads;
  loads.add(&record, 1, 1, 0);
  loads.add(nullptr, 0, 3, 0);
  return loads;
}

std::vector<double> normal_rms(const WeldedMesh &mesh, const MeshLoads &loads, bool with_wear)
{
  for (const FaceField &field : load_fields(mesh, loads, 1, with_wear))
    if (field.name == "normal_rms") return field.value;
  return {};
}

// A force of 3 in one of 4 units of time: sqrt(9/4).
TEST(recipe_output, of_a_triangle_is_the_root_mean_square)
{
  const WeldedMesh mesh = weld(floor_mesh(1, 1), -1);
  const std::vector<double> rms = {0, 1.5};
  EXPECT_EQ(normal_rms(mesh, pressed(), false), rms);
  EXPECT_EQ(normal_rms(mesh, pressed(), true), rms);
}

// Two such processes give sqrt(2 * 9/4).
TEST(recipe_output, of_a_triangle_adds_up_over_processes)
{
  const WeldedMesh mesh = weld(floor_mesh(1, 1), -1);
  MeshLoads all = pressed();
  const std::vector<double> rows = all.packed();
  all.add_packed(rows.data(), rows.size() / MeshLoads::kPackedLoad);
  EXPECT_DOUBLE_EQ(normal_rms(mesh, all, false)[1], std::sqrt(4.5));
}

std::vector<std::string> words(const std::string &files)
{
  std::vector<std::string> all = {"hooke", "1e4", "0", "0", "0", "0", "0", "mesh", "a.stl"};
  std::istringstream in(files);
  for (std::string word; in >> word;) all.push_back(word);
  return all;
}

TEST(recipe_output, is_written_in_its_steps_where_the_mesh_is)
{
  const TempDir dir;
  const WallSpec settings = parse_wall(words("mesh_off " + dir.path("w*.off") + " every 2")).wall;
  const WeldedMesh mesh = weld(floor_mesh(1, 1), -1);
  on_processes(1, [&](FakeHost &host) {
    WallFiles files(host, settings, 1);
    EXPECT_EQ(files.every(), 2);
    PosedMesh placed = {&mesh, {}};
    placed.pose.placed = true;
    placed.pose.shift = {0, 0, 8};
    for (int step = 1; step <= 3; step++) files.write_due(step, step, {placed}, nullptr);
  });
  EXPECT_FALSE(std::filesystem::exists(dir.path("w1.off")));
  EXPECT_FALSE(std::filesystem::exists(dir.path("w3.off")));
  std::ifstream file(dir.path("w2.off"));
  std::string head;
  std::size_t vertices = 0, faces = 0, edges = 0;
  file >> head >> vertices >> faces >> edges;
  EXPECT_EQ(head, "OFF");
  ASSERT_EQ(vertices, 4u);
  EXPECT_EQ(faces, 2u);
  for (const Vec3 &v : mesh.vertices) {
    Vec3 x;
    file >> x.x >> x.y >> x.z;
    EXPECT_EQ(x, (Vec3{v.x, v.y, v.z + 8}));
  }
}

TEST(recipe_output, is_told_before_the_run_where_it_cannot_be_written)
{
  const TempDir dir;
  const WallSpec settings =
      parse_wall(words("mesh_off " + dir.path("missing/w.off") + " every 2")).wall;
  on_processes(1, [&](FakeHost &host) {
    EXPECT_THROW(WallFiles(host, settings, 1).begin_run(0), InputError);
  });
}

TEST(recipe_output, has_a_file_of_its_own_for_each_mesh)
{
  EXPECT_EQ(files_of(parse_wall(words("mesh_off w.off every 2")).wall).back().what, "mesh_off");
  try {
    parse_wall(words("mesh_off w.off every 2 mesh b.stl mesh_off w.off every 2"));
    ADD_FAILURE() << "accepted";
  } catch (const InputError &e) {
    EXPECT_NE(std::string(e.what()).find("same file 'w.off'"), std::string::npos) << e.what();
  }
}

}    // namespace
}    // namespace lsdcd
