// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files that a run writes of a wall's meshes, on two processes, of which the first has the meshes.
#include "base/atomic_file.h"
#include "base/input_error.h"
#include "mesh/triangle_soup.h"
#include "support/fake_host.h"
#include "support/meshes.h"
#include "support/says.h"
#include "support/temp_dir.h"
#include "wall/wall_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sys/stat.h>

namespace lsdcd::test_wall_files {
namespace {

// A wall of one mesh, a square of two faces.
struct Wall {
  WallSpec settings;
  WeldedMesh mesh = weld(floor_mesh(1, 1), -1);

  Wall() : settings() { settings.meshes.resize(1); }
  MeshSpec &files() { return settings.meshes[0]; }
};

// One process of it, with loads of steps of 1.
struct Process {
  FakeHost &host;
  LoadRecorder loads;
  EnergyRecorder energies;
  WallFiles files;
  std::vector<PosedMesh> placed;

  Process(FakeHost &host_, const Wall &wall) :
      host(host_), loads(host, wall.settings), energies(host, wall.settings),
      files(host, wall.settings, 1), placed{{host.rank() == 0 ? &wall.mesh : nullptr, {}}}
  {
  }

  void step(std::int64_t number)
  {
    loads.add({0}, nullptr, 1);
    files.write_due(number, static_cast<double>(number), placed, &loads, energies);
  }
  void steps(std::int64_t first, std::int64_t last)
  {
    for (std::int64_t i = first; i <= last; i++) step(i);
  }
};


TEST(WallFiles, that_cannot_be_written_are_warned_of_once_a_run)
{
  TempDir dir;
  Wall wall;
  wall.files().stl = {dir.path("later/wall.stl"), 1};
  on_processes(2, [&](FakeHost &host) {
    Process process(host, wall);
    const auto run = [&] {
      host.broadcast(nullptr, 0, 0);    // both are here
      if (host.rank() == 0) std::filesystem::create_directory(dir.path("later"));
      process.files.begin_run(0);
      if (host.rank() == 0) std::filesystem::remove_all(dir.path("later"));
      process.steps(1, 3);
    };
    run();
    EXPECT_EQ(host.warnings.size(), 1);
    run();
    ASSERT_EQ(host.warnings.size(), 2);
    EXPECT_NE(host.warnings[1].find("there is no mesh_stl of this step"), std::string::npos);
  });
}

TEST(WallFiles, that_cannot_be_made_are_refused_before_a_run_on_all_processes)
{
  TempDir dir;
  Wall one, two;
  one.files().fields = {dir.path("missing/wall.vtp"), 1};
  two.settings.meshes.resize(2);
  two.settings.meshes[1].name = "lid.stl";
  two.settings.meshes[1].stl = {dir.path("missing/lid.stl"), 1};
  on_processes(2, [&](FakeHost &host) {
    for (const Wall *wall : {&one, &two}) {
      const std::string error = error_of([&] { WallFiles(host, wall->settings, 1).begin_run(0); });
      EXPECT_TRUE(has(error, "missing"));
      EXPECT_TRUE(
          begins(error, wall == &one ? "in 'mesh_fields', " : "mesh 2 'lid.stl': in 'mesh_stl', "));
    }
  });
}


TEST(WallFiles, that_would_replace_what_the_wall_reads_or_writes_are_refused_on_all_processes)
{
  TempDir dir;
  Wall mesh, table, list;
  mesh.settings.meshes.resize(2);
  mesh.files().file = dir.path("wall.stl");
  mesh.settings.meshes[1].stl = {dir.path("no/../wall.stl"), 1};
  MotionTerm term;
  term.table_file = dir.path("shake.csv");
  table.files().motion.add(term);
  table.files().spectrum = {dir.path("shake.csv"), 1};
  list.files().fields = {dir.path("a_*.vtp"), 1};
  list.files().file = dir.path("a_series.pvd");
  on_processes(2, [&](FakeHost &host) {
    const auto error = [&](const Wall &wall) {
      return error_of([&] { WallFiles(host, wall.settings, 1).begin_run(0); });
    };
    EXPECT_TRUE(says(error(mesh), {"in 'mesh_stl', ", "wall.stl', the mesh file that ",
                                   " reads: name another file"}));
    EXPECT_TRUE(says(error(table), {"in 'impact_spectrum', ", "the motion table file that "}));
    EXPECT_TRUE(
        says(error(list), {"in 'list of mesh_fields', ", "a_series.pvd' is the mesh file"}));
  });
}

TEST(WallFiles, that_are_pipes_are_refused_and_stay)
{
  const TempDir dir;
  const std::string pipe = dir.path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(fails_with("pipe' is not a regular file", [&] { write_whole_file(pipe, "text"); }));
  struct stat there;
  ASSERT_EQ(stat(pipe.c_str(), &there), 0);
  EXPECT_TRUE(S_ISFIFO(there.st_mode));
}

// An engine that has added up the same row each time it is asked.
struct OneRow : FeatureEngine<Load> {
  void add(int, const FeatureCounts &, Real) override {}
  std::vector<RowOfFeature<Load>> take(int) override { return {{3, {1, 2, 4, 5, {6, 7, 8}}}}; }
};

TEST(WallFiles, take_what_an_engine_has_added_up)
{
  FakeHost host;
  Wall wall;
  wall.settings.wear = {WearModel::archard, 10};
  wall.settings.meshes[0].wear_factor = 3;
  LoadRecorder loads(host, wall.settings);
  OneRow first, second;
  loads.set_engine(&first);
  const auto has = [&](Real times, Real worn) {
    const std::vector<Real> row = {3,          times,     2 * times, 4 * times,
                                   150 * worn, 6 * times, 7 * times, 8 * times};
    EXPECT_EQ(loads.gathered(0).packed(), row);
  };
  has(1, 1);
  EXPECT_EQ(loads.worn(0), 300);    // twice 5 of work, times 3 and 10
  has(3, 3);
  loads.set_engine(&second);    // takes what the first one has, and then the second
  has(5, 5);
  loads.set_engine(nullptr);
  has(6, 6);
  loads.begin_average(0);
  has(0, 6);
  loads.set_engine(&first);
  loads.restore(0, 1, {3, 1, 2, 4, 150, 6, 7, 8});
  loads.set_engine(nullptr);
  has(2, 2);
}

TEST(WallFiles, need_no_loads_of_a_mesh_without_wear_and_mesh_fields)
{
  FakeHost host;
  Wall wall;
  wall.settings.meshes.resize(2);
  wall.settings.meshes[1].fields.every = 10;
  LoadRecorder loads(host, wall.settings);
  std::vector<StepContact> contacts(2);
  contacts[1].mesh = 1;
  for (const int mesh : {0, 1}) loads.add({mesh}, &contacts, 2);
  EXPECT_TRUE(loads.gathered(0).packed().empty());
  EXPECT_EQ(loads.time(0), 0);
  EXPECT_EQ(loads.gathered(1).packed().size(), 1u * FeatureRows<Load>::kPacked);
  EXPECT_EQ(loads.time(1), 2);
}

TEST(WallFiles, keep_wear_and_forget_stress_when_an_average_begins)
{
  FakeHost host;
  Wall wall;
  wall.settings.wear = {WearModel::archard, 1};
  LoadRecorder loads(host, wall.settings);
  const StepContact contact = {feature_code(FeatureKind::face, 0), 0, 6, 2, 5, {-2, 0, -6}, {}};
  const std::vector<StepContact> one = {contact};
  loads.add({0}, &one, 1);
  loads.begin_average(0);
  EXPECT_EQ(loads.time(0), 0);
  EXPECT_EQ(loads.worn(0), 5);
  loads.add({0}, &one, 0.5);
  loads.add({0}, nullptr, 0.25);    // a step that left nothing has its time
  EXPECT_EQ(loads.time(0), 0.75);
  const Load face = loads.gathered(0).of_faces(wall.mesh)[0];
  EXPECT_EQ(face.normal, 3);
  EXPECT_EQ(face.force, (Vec3{-1, 0, -3}));
  EXPECT_EQ(face.worn, 7.5);
}

}    // namespace
}    // namespace lsdcd::test_wall_files
