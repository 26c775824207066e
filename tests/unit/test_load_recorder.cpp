// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Loads and wear of a wall's meshes over two processes.
#include "support/fake_host.h"
#include "wall/load_recorder.h"

#include <gtest/gtest.h>

namespace lsdcd::test_load_recorder {
namespace {

// A wall of two meshes that wear, by half a volume per work.
WallSpec wall()
{
  WallSpec settings;
  settings.meshes.resize(2);
  settings.wear.model = WearModel::archard;
  settings.wear.per_work = 0.5;
  return settings;
}

StepContact on_face(std::uint32_t face, std::uint32_t mesh, Real normal, Real wear_power)
{
  return {feature_code(FeatureKind::face, face), mesh, normal, 0, wear_power, {0, 0, -normal}, {}};
}

// A step of 2: the process presses face `rank` of mesh 0, and both press face 7 of mesh 1.
void add_step(LoadRecorder &loads, int rank)
{
  const std::vector<StepContact> contacts = {on_face(rank, 0, 3, 10), on_face(7, 1, 4, 100)};
  for (int mesh : {0, 1}) loads.add(mesh, contacts, 2, {});
}

TEST(LoadRecorder, gathers_loads_of_all_processes_on_the_first)
{
  on_processes(2, [](FakeHost &host) {
    const WallSpec settings = wall();
    LoadRecorder loads(host, settings);
    add_step(loads, host.rank());
    const std::vector<double> separate = loads.gathered(0).packed(),
                              common = loads.gathered(1).packed();
    if (host.rank() != 0) {
      EXPECT_TRUE(separate.empty());
      return;
    }
    // Rows of the two faces: feature, integral of the normal force, ...
    ASSERT_EQ(separate.size(), 2 * MeshLoads::kPackedLoad);
    EXPECT_EQ(separate[1], 3 * 2);
    EXPECT_EQ(separate[MeshLoads::kPackedLoad + 1], 3 * 2);
    // One row of the face that both have pressed.
    ASSERT_EQ(common.size(), MeshLoads::kPackedLoad);
    EXPECT_EQ(common[1], 2 * 4 * 2);
  });
}

TEST(LoadRecorder, wears_a_mesh_by_its_factor)
{
  on_processes(2, [](FakeHost &host) {
    WallSpec settings = wall();
    settings.meshes[1].wear_factor = 0.25;
    LoadRecorder loads(host, settings);
    add_step(loads, host.rank());
    // Two processes, half a volume per work, power times time.
    EXPECT_EQ(loads.worn(0), 2 * 0.5 * 10 * 2);
    EXPECT_EQ(loads.worn(1), 2 * 0.5 * 0.25 * 100 * 2);
  });
}

TEST(LoadRecorder, begins_an_average_of_one_mesh_and_keeps_its_wear)
{
  on_processes(2, [](FakeHost &host) {
    const WallSpec settings = wall();
    LoadRecorder loads(host, settings);
    add_step(loads, host.rank());
    loads.begin_average(0);
    EXPECT_EQ(loads.gathered(0).time(), 0);
    EXPECT_EQ(loads.worn(0), 20);
    EXPECT_EQ(loads.gathered(1).time(), 2);
  });
}

TEST(LoadRecorder, records_nothing_of_a_mesh_without_wear_and_mesh_fields)
{
  on_processes(2, [](FakeHost &host) {
    WallSpec settings = wall();
    settings.wear.model = WearModel::none;
    settings.meshes[1].fields.every = 10;
    LoadRecorder loads(host, settings);
    add_step(loads, host.rank());
    EXPECT_TRUE(loads.gathered(0).packed().empty());
    EXPECT_EQ(loads.gathered(0).time(), 0);
    EXPECT_EQ(loads.gathered(1).time(), 2);
  });
}

// Every process has the numbers of a restart file, which count once.
TEST(LoadRecorder, goes_on_from_what_a_restart_file_has)
{
  on_processes(2, [](FakeHost &host) {
    const WallSpec settings = wall();
    LoadRecorder loads(host, settings);
    loads.restore(0, 5, {0, 1, 2, 3, 70, 0, 0, 0});    // the fifth number is the volume worn off
    add_step(loads, host.rank());
    EXPECT_EQ(loads.worn(0), 70 + 20);
    EXPECT_EQ(loads.gathered(0).time(), 5 + 2);
  });
}

}    // namespace
}    // namespace lsdcd::test_load_recorder
