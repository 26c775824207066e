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
#include <utility>

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
  WallFiles files;
  std::vector<PosedMesh> placed;
  bool rerun = false;

  Process(FakeHost &host_, const Wall &wall) :
      host(host_), loads(host, wall.settings),
      files(host, wall.settings, 1), placed{{host.rank() == 0 ? &wall.mesh : nullptr, {}}}
  {
  }

  void step(std::int64_t number)
  {
    loads.add(0, {}, 1, {});
    files.write_due(number, static_cast<double>(number), placed, rerun ? nullptr : &loads);
  }
  void steps(std::int64_t first, std::int64_t last)
  {
    for (std::int64_t i = first; i <= last; i++) step(i);
  }
};

bool exists(const std::string &path)
{
  return std::filesystem::exists(path);
}

TEST(WallFiles, are_due_in_multiples_of_the_common_divisor)
{
  on_processes(1, [](FakeHost &host) {
    Wall wall;
    EXPECT_EQ(WallFiles(host, wall.settings, 1).every(), 0);
    wall.settings.meshes.resize(2);
    wall.settings.meshes[0].stl.every = 12;
    wall.settings.meshes[1].fields.every = 20;
    EXPECT_EQ(WallFiles(host, wall.settings, 1).every(), 4);
  });
}

TEST(WallFiles, are_written_in_due_steps_only)
{
  TempDir dir;
  Wall wall;
  wall.files().stl = {dir.path("wall*.stl"), 2};
  wall.files().fields = {dir.path("wall*.vtp"), 3};
  on_processes(2, [&](FakeHost &host) { Process(host, wall).steps(1, 4); });
  for (int step = 1; step <= 4; step++) {
    EXPECT_EQ(exists(dir.path("wall" + std::to_string(step) + ".stl")), step % 2 == 0) << step;
    EXPECT_EQ(exists(dir.path("wall" + std::to_string(step) + ".vtp")), step == 3) << step;
  }
}

TEST(WallFiles, show_the_mesh_where_it_is)
{
  TempDir dir;
  Wall wall;
  wall.files().stl = {dir.path("wall.stl"), 1};
  on_processes(2, [&](FakeHost &host) {
    Process process(host, wall);
    process.placed[0].pose.placed = true;
    process.placed[0].pose.shift = {0, 0, 8};
    process.step(1);
  });
  for (const Vec3 &corner : read_stl(dir.path("wall.stl")).corners) EXPECT_EQ(corner.z, 8);
}

// A run of four steps, where a file is due in the third.
TEST(WallFiles, begin_a_new_average_with_each_file_that_is_written)
{
  TempDir dir;
  for (const auto &[file, time] : {std::pair("wall.vtp", 1), std::pair("missing/wall.vtp", 4)}) {
    Wall wall;
    wall.files().fields = {dir.path(file), 3};
    on_processes(2, [&, time = time](FakeHost &host) {
      Process process(host, wall);
      process.steps(1, 4);
      EXPECT_EQ(process.loads.gathered(0).time(), time);
    });
  }
}

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

TEST(WallFiles, leave_nothing_behind_before_a_run)
{
  TempDir dir;
  Wall wall;
  wall.files().stl = {dir.path("wall.stl"), 1};
  on_processes(2, [&](FakeHost &host) { Process(host, wall).files.begin_run(0); });
  EXPECT_FALSE(exists(dir.path("wall.stl")));
}

TEST(WallFiles, are_without_mesh_fields_where_loads_are_not_known)
{
  TempDir dir;
  Wall wall;
  wall.files().stl = {dir.path("wall.stl"), 1};
  wall.files().fields = {dir.path("wall.vtp"), 1};
  on_processes(2, [&](FakeHost &host) {
    Process process(host, wall);
    process.rerun = true;
    process.step(1);
  });
  EXPECT_TRUE(exists(dir.path("wall.stl")));
  EXPECT_FALSE(exists(dir.path("wall.vtp")));
}

int files_listed(const std::string &path)
{
  std::ifstream in(path);
  int n = 0;
  for (std::string line; std::getline(in, line);) n += line.find("<DataSet") != std::string::npos;
  return n;
}

TEST(WallFiles, go_on_with_the_list_of_an_earlier_run_where_that_is_asked_for)
{
  TempDir dir;
  Wall wall;
  wall.files().fields = {dir.path("wall*.vtp"), 1};
  const auto run = [&](std::int64_t first, std::int64_t last, bool continues) {
    on_processes(2, [&](FakeHost &host) {
      Process process(host, wall);
      if (continues) process.files.continue_lists();
      process.steps(first, last);
    });
    return files_listed(dir.path("wallseries.pvd"));
  };
  EXPECT_EQ(run(1, 2, false), 2);
  EXPECT_EQ(run(3, 5, true), 5);
  EXPECT_EQ(run(6, 6, false), 1);
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

TEST(WallFiles, need_no_loads_of_a_mesh_without_wear_and_mesh_fields)
{
  FakeHost host;
  Wall wall;
  wall.settings.meshes.resize(2);
  wall.settings.meshes[1].fields.every = 10;
  LoadRecorder loads(host, wall.settings);
  StepContact contact = {};
  for (contact.mesh = 0; contact.mesh < 2; contact.mesh++)
    loads.add(contact.mesh, {contact}, 2, {});
  EXPECT_TRUE(loads.gathered(0).packed().empty());
  EXPECT_EQ(loads.gathered(0).time(), 0);
  EXPECT_EQ(loads.gathered(1).time(), 2);
}

}    // namespace
}    // namespace lsdcd::test_wall_files
