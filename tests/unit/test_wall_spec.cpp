// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall's data that no parser has read: what a wall cannot be made of is refused.
#include "base/input_error.h"
#include "support/fake_host.h"
#include "wall/wall.h"

#include <gtest/gtest.h>

#include <cmath>
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
    wall = good();
    wall.meshes[0].body.motor_input = input;
    expect_error(wall, "mesh 1: the motor of its body" + number + text);
    wall = good();
    wall.meshes[0].body.load_input[2] = input;
    expect_error(wall, "mesh 1: the load of its body" + number + text);
    wall = good();
    wall.meshes[0].body.moment_input[1] = input;
    expect_error(wall, "mesh 1: the moment of its body" + number + text);
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

// The sentences of the words of a script (test_body_words).
TEST(wall_spec, a_body_that_there_cannot_be_is_refused)
{
  const struct {
    void (*spoil)(BodySpec &);
    const char *text;
  } cases[] = {
      {[](BodySpec &b) { b.density = -1; }, "the density is -1, not a number of 0 or more"},
      {[](BodySpec &b) { b.density = 0; }, "a mass of 0 is not above 0"},
      {[](BodySpec &b) {
         b.density = 0, b.mass = {1, {0, 0, 0}, {1, 1, 3, 0, 0, 0}};
       },
       "no body has the principal moments of inertia"},
      {[](BodySpec &b) { b.joint.kind = static_cast<JointKind>(9); }, "no joint of kind 9"},
      {[](BodySpec &b) {
         b.joint.axis = {0, 0, 0};
       },
       "a direction must not be 0 0 0"},
      {[](BodySpec &b) {
         b.joint.axis = {0, 0, 2};
       },
       "direction 0 0 2 is not of length 1"},
      {[](BodySpec &b) { b.joint.kind = JointKind::ball, b.drive.stiffness = 1; },
       "spring works only with a joint hinge or slider"},
      {[](BodySpec &b) { b.joint.kind = JointKind::free, b.drive.lo = -1; },
       "limits works only with"},
      {[](BodySpec &b) { b.joint.kind = JointKind::planar, b.motor_input = 0; },
       "motor works only with"},
      {[](BodySpec &b) { b.drive.damping = -1; }, "the damping is -1, not a number of 0 or more"},
      {[](BodySpec &b) { b.drive.lo = 1, b.drive.hi = 0; }, "the limits 1 0 are reversed"},
      {[](BodySpec &b) { b.drive.lo = 1, b.drive.hi = 2; }, "the limits 1 2 do not contain 0"},
      {[](BodySpec &b) { b.load.y = NAN; }, "the load is 0 nan 0, which is not finite"},
  };
  WallSpec wall = good();
  BodySpec &body = wall.meshes[1].body;
  body.present = true;
  body.density = 1;
  body.joint.kind = JointKind::hinge;
  EXPECT_EQ(refusal_of(wall), "");
  for (const auto &c : cases) {
    WallSpec spoilt = wall;
    c.spoil(spoilt.meshes[1].body);
    expect_error(spoilt, c.text);
    expect_error(spoilt, "mesh 'blade': in its body, ");
  }
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
