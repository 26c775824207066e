// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall's data that no parser has read: what a wall cannot be made of is refused.
#include "base/input_error.h"
#include "support/fake_host.h"
#include "wall/wall.h"

#include <gtest/gtest.h>

#include <string>

namespace lsdcd::test_wall_spec {
namespace {

WallSpec good()
{
  WallSpec wall;
  wall.meshes.resize(2);
  wall.meshes[1].name = "blade";
  wall.inputs = {"height"};
  return wall;
}

// The text of the error; empty: there is none.
std::string refusal_of(const WallSpec &wall)
{
  try {
    check_spec(wall);
  } catch (const InputError &e) {
    return e.what();
  }
  return "";
}

void expect_error(const WallSpec &wall, const std::string &text)
{
  const std::string error = refusal_of(wall);
  EXPECT_NE(error.find(text), std::string::npos) << error;
}

TEST(wall_spec, a_wall_of_two_meshes_is_taken)
{
  EXPECT_EQ(refusal_of(good()), "");
}

TEST(wall_spec, a_wall_without_a_mesh_is_refused)
{
  expect_error(WallSpec(), "the wall has no mesh; give it 1 to 32 meshes");
}

TEST(wall_spec, more_meshes_than_a_wall_can_have_are_refused)
{
  WallSpec wall = good();
  wall.meshes.resize(kMaxMeshes);
  EXPECT_EQ(refusal_of(wall), "");
  wall.meshes.resize(kMaxMeshes + 1);
  expect_error(wall, "the wall has 33 meshes; it can have 1 to 32");
}

TEST(wall_spec, a_wall_without_a_law_of_all_types_is_refused)
{
  WallSpec wall = good();
  wall.laws[0].first_type = 2;
  expect_error(wall, "the wall's first law is not of all types");
  wall.laws.clear();
  expect_error(wall, "the wall's first law is not of all types");
}

TEST(wall_spec, an_input_that_is_not_there_is_refused)
{
  const std::string text = "but the wall has 1 inputs";
  for (const int input : {1, -2}) {
    const std::string number = " has input " + std::to_string(input) + ", ";
    WallSpec wall = good();
    MotionTerm term;
    term.input[5] = input;
    wall.meshes[1].motion.add(term);
    expect_error(wall, "mesh 'blade': its motion" + number + text);
    wall = good();
    wall.meshes[0].motion.servo().target_input = input;
    expect_error(wall, "mesh 1: its servo" + number + text);
    wall = good();
    wall.meshes[0].surface_input[0] = input;
    expect_error(wall, "mesh 1: its surface" + number + text);
    wall = good();
    wall.meshes[0].temperature_input = input;
    expect_error(wall, "mesh 1: its temperature" + number + text);
  }
  WallSpec wall = good();
  wall.meshes[0].surface_input[0] = 0;
  EXPECT_EQ(refusal_of(wall), "");
}

TEST(wall_spec, heat_and_temperatures_need_each_other)
{
  WallSpec wall = good();
  wall.meshes[0].has_temperature = true;
  expect_error(wall, "mesh 1 has a temperature, but the law has no sub-model heat");
  wall.laws[0].law.heat = HeatModel::radius;
  expect_error(wall, "mesh 'blade' has no temperature, which the sub-model heat needs");
  wall.meshes[1].has_temperature = true;
  EXPECT_EQ(refusal_of(wall), "");
}

TEST(wall_spec, a_wall_is_not_made_of_what_is_refused)
{
  on_processes(1, [](FakeHost &host) {
    const WallSpec none;
    EXPECT_THROW(Wall(host, none, WallUnits(), WallBackend(), "", StepClock()), InputError);
  });
}

}    // namespace
}    // namespace lsdcd::test_wall_spec
