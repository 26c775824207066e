// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A servo's velocity from the load of the last step, on two processes.
#include "support/fake_host.h"
#include "wall/move/servo_controller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lsdcd::test_servo_controller {
namespace {

constexpr Real kDt = 0.01;

// A servo along z that shall push with 100 upwards, of a wall with springs of 1e4 and no damping.
WallSpec wall()
{
  WallSpec settings;
  settings.meshes.resize(1);
  settings.laws[0].law.k_normal = 1e4;
  Servo &s = settings.meshes[0].motion.servo();
  s.present = true;
  s.target = 100;
  s.max_speed = 1e6;
  return settings;
}

// Spheres that press a mesh down with this force, each with a radius of 0.5 and a mass of 1. Extents of the mesh are a
// cube of 2 about the origin.
ServoLoad pressed(Real force, Real contacts)
{
  ServoLoad load;
  load.force = {0, 0, -force};
  load.contacts = contacts;
  load.radius = 0.5;
  load.mass = 1;
  load.extents = {{-1, -1, -1}, {1, 1, 1}};
  return load;
}

struct Moved {
  Real velocity, position;
  std::vector<std::string> warnings, lines;
};

// Returns how it moves after a step with this load.
Moved after(WallSpec settings, const ServoLoad &load)
{
  FakeHost host;
  const LawTable laws = law_table(settings);
  ServoController controller(host, settings, laws, 0);
  controller.advance(load, Pose(), kDt, 7);
  const Servo &s = settings.meshes[0].motion.servo();
  return {s.velocity, s.position, host.warnings, host.lines};
}

// The gain is a quarter of what is stable: 1/(2 k dt) of one contact, which it takes none for, too.
TEST(ServoController, moves_by_what_is_missing_of_its_push_and_slower_the_more_contacts_there_are)
{
  for (const int contacts : {0, 1, 8}) {
    const Moved moved = after(wall(), pressed(60, contacts));
    EXPECT_NEAR(moved.velocity, (100 - 60) / (2 * std::max(1, contacts) * 1e4 * kDt), 1e-13);
    EXPECT_NEAR(moved.position, moved.velocity * kDt, 1e-15);
  }
}

// A flat side is as stiff as its hertz contact is wide, which is no more than the sphere around the grain.
TEST(ServoController, takes_the_flattest_side_of_grains_that_are_no_spheres)
{
  WallSpec spec = wall();
  spec.laws[0].law = classic_law(NormalModel::hertz, false);
  spec.laws[0].law.k_normal = 1e4;
  spec.laws[0].law.for_shapes = spec.shapes = true;
  spec.meshes[0].motion.servo().max_speed = 1;
  ServoLoad load = pressed(60, 1);
  load.overlap = 1e-3;
  EXPECT_NEAR(after(spec, load).velocity, 40 / (2 * 1.5 * 1e4 * load.radius * kDt), 1e-12);
}

// A torque by the arm squared: the farthest corner of the mesh, which wear may have moved, and a sphere's radius is
// sqrt(2) (half + 0.5) from the axis.
TEST(ServoController, counts_the_arm_of_contacts_where_it_turns)
{
  WallSpec settings = wall();
  settings.meshes[0].motion.servo().turns = true;
  ServoLoad load = pressed(0, 1);
  load.torque = {0, 0, -60};
  for (const Real half : {1., 2.}) {
    load.extents = {{-half, -half, -half}, {half, half, half}};
    EXPECT_NEAR(after(settings, load).velocity, 40 / (2 * 2 * std::pow(half + 0.5, 2) * 1e4 * kDt),
                1e-14);
  }
}

TEST(ServoController, logs_the_gain_that_it_has_chosen_once_there_are_contacts)
{
  EXPECT_TRUE(after(wall(), pressed(60, 0)).lines.empty());
  // 1/(2 k dt) of eight contacts.
  EXPECT_EQ(after(wall(), pressed(60, 8)).lines,
            std::vector<std::string>{"the servo's gain is 0.000625 with 8 contacts at the timestep "
                                     "0.01, and smaller with more contacts"});
  WallSpec brief = wall();
  brief.brief = true;
  EXPECT_TRUE(after(brief, pressed(60, 8)).lines.empty());
}

TEST(ServoController, does_not_warn_of_a_gain_before_there_are_contacts)
{
  WallSpec settings = wall();
  settings.meshes[0].motion.servo().max_gain = 1;
  EXPECT_TRUE(after(settings, pressed(0, 0)).warnings.empty());
}

}    // namespace
}    // namespace lsdcd::test_servo_controller
