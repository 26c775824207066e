// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Where a mesh is in each step: by its clock, by inputs, after changes and restarts.
#include "base/input_error.h"
#include "support/fake_host.h"
#include "support/motions.h"
#include "support/says.h"
#include "support/temp_dir.h"
#include "wall/move/mesh_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace lsdcd::test_mesh_motion {
namespace {

// A wall of one mesh, of one process, that began at step 100 with a dt of 0.5.
struct Wall {
  WallSpec settings;
  FakeHost host;
  std::map<std::string, Real> values;    // of inputs

  Wall() : settings() { settings.meshes.resize(1); }
  MeshSpec &mesh() { return settings.meshes[0]; }
  Servo &servo() { return mesh().motion.servo(); }
  int input(const std::string &name) { return number_of_input(settings.inputs, name); }
  std::vector<Real> inputs() const
  {
    std::vector<Real> all;
    for (const std::string &name : settings.inputs) all.push_back(values.at(name));
    return all;
  }
  // Displacement in x by variable `x`; its velocity by `vx`, or by differences.
  void by_variable(bool with_velocity)
  {
    MotionTerm term;
    term.kind = MotionKind::variable;
    term.input[0] = input("x");
    if (with_velocity) term.input[3] = input("vx");
    mesh().motion.add(term);
  }
  void servo_along_z(Real lo = -10, Real hi = 10)
  {
    servo().present = true;
    servo().lo = lo;
    servo().hi = hi;
  }
};

constexpr std::int64_t kFirst = 100;
constexpr Real kDt = 0.5;

Step step(int n)
{
  return {kFirst + n, kDt};
}

void run(MeshMotion &motion, const Wall &wall, int first, int last)
{
  for (int n = first; n <= last; n++) {
    motion.advance(step(n), wall.inputs());
    motion.place();
  }
}

Vec3 where(const MeshMotion &motion)
{
  return motion.pose().to_box({0, 0, 0});
}

// A mesh that goes along x by 1 a step.
struct WallAlongX : Wall {
  WallAlongX() { mesh().motion.add(linear({2, 0, 0})); }
};
class AlongX : public testing::Test {
 protected:
  WallAlongX wall;
  MeshMotion motion{wall.host, wall.settings, 0, step(0)};
};

// A mesh that its servo has moved by 5.
struct WallWithServo : Wall {
  WallWithServo() { servo_along_z(); }
};
class ServoAtFive : public testing::Test {
 protected:
  ServoAtFive() { wall.servo().position = 5; }

  WallWithServo wall;
  MeshMotion motion{wall.host, wall.settings, 0, step(0)};
};

TEST(MeshMotion, tells_how_much_time_has_passed)
{
  Wall wall;
  MeshMotion motion(wall.host, wall.settings, 0, step(0));
  EXPECT_EQ(motion.advance(step(1), {}), kDt);
  EXPECT_EQ(motion.advance({kFirst + 1, kDt, Step::setup}, {}), 0);
}

TEST_F(AlongX, knows_where_it_will_be)
{
  run(motion, wall, 1, 1);
  EXPECT_EQ(motion.pose_in(4).shift, (Vec3{1 + 8, 0, 0}));
}

TEST(MeshMotion, takes_differences_for_velocities_that_no_variable_gives)
{
  Wall wall;
  wall.by_variable(false);
  MeshMotion motion(wall.host, wall.settings, 0, step(0));
  wall.values = {{"x", 7}};
  run(motion, wall, 1, 1);
  wall.values = {{"x", 8}};
  run(motion, wall, 2, 2);
  EXPECT_EQ(motion.pose().velocity, (Vec3{1 / kDt, 0, 0}));
}

// The run before has left a velocity, and a setup passes no time.
TEST(MeshMotion, keeps_the_velocity_where_no_time_passes)
{
  Wall wall;
  wall.by_variable(false);
  MeshMotion motion(wall.host, wall.settings, 0, step(0));
  wall.values = {{"x", 7}};
  run(motion, wall, 1, 1);
  motion.advance({kFirst + 1, kDt, Step::setup}, wall.inputs());
  motion.place();
  EXPECT_EQ(motion.pose().velocity, (Vec3{7 / kDt, 0, 0}));
}

// A turn about z by variable `w`, in radians per time; its angle is added up.
struct WallThatTurns : Wall {
  WallThatTurns()
  {
    MotionTerm term;
    term.kind = MotionKind::variable_turn;
    term.input[3] = input("w");
    mesh().motion.add(term);
  }
  Real angle() { return mesh().motion.terms()[0].displacement.x; }
};

// Speeds 2 t from a setup at t = 0 on: the angle t^2 by the mean of speeds, to the last bit.
void speed_up(WallThatTurns &wall, MeshMotion &motion, int first, int last)
{
  for (int n = first; n <= last; n++) {
    wall.values = {{"w", 2 * kDt * n}};
    run(motion, wall, n, n);
  }
}

TEST(MeshMotion, adds_up_velocities_to_a_place_that_no_variable_gives)
{
  WallThatTurns wall;
  MeshMotion motion(wall.host, wall.settings, 0, step(0));
  speed_up(wall, motion, 1, 6);
  EXPECT_EQ(wall.angle(), 9);
  EXPECT_EQ(motion.pose().angular, (Vec3{0, 0, 6}));
  EXPECT_EQ(motion.pose().row[1].x, std::sin(9.0));
}

TEST(MeshMotion, adds_up_displacements_likewise)
{
  Wall wall;
  MotionTerm term;
  term.kind = MotionKind::variable;
  term.input[4] = wall.input("v");
  wall.mesh().motion.add(term);
  wall.values = {{"v", 3}};
  MeshMotion motion(wall.host, wall.settings, 0, step(0));
  motion.advance({kFirst, kDt, Step::setup}, wall.inputs());
  run(motion, wall, 1, 4);
  EXPECT_EQ(where(motion), (Vec3{0, 6, 0}));
  EXPECT_EQ(motion.pose().velocity, (Vec3{0, 3, 0}));
}

TEST(MeshMotion, adds_nothing_up_where_no_time_passes)
{
  WallThatTurns wall;
  MeshMotion motion(wall.host, wall.settings, 0, step(0));
  speed_up(wall, motion, 1, 2);
  motion.advance({kFirst + 2, kDt, Step::setup}, wall.inputs());
  EXPECT_EQ(wall.angle(), 1);
}

// Tables

void follow(Wall &wall, const std::string &file)
{
  MotionTerm term;
  term.kind = MotionKind::table;
  term.table_file = file;
  wall.mesh().motion.add(term);
}

TEST(MeshMotion, reads_a_table_on_the_first_process_alone)
{
  const TempDir folder;
  const std::string file = folder.write("arm.txt", "0 0 0 0\n2 8 0 0\n4 16 0 0\n");
  on_processes(3, [&](FakeHost &host) {
    Wall wall;
    follow(wall, host.rank() == 0 ? file : "not/there");
    MeshMotion motion(host, wall.settings, 0, step(0));
    run(motion, wall, 1, 3);
    EXPECT_EQ(where(motion), (Vec3{6, 0, 0}));
    EXPECT_EQ(motion.pose().velocity, (Vec3{4, 0, 0}));
  });
}

TEST(MeshMotion, refuses_a_wrong_table_on_all_processes)
{
  const TempDir folder;
  const std::string file = folder.write("arm.txt", "0 0 0 0\n0 8 0 0\n");
  on_processes(3, [&](FakeHost &host) {
    Wall wall;
    follow(wall, file);
    EXPECT_TRUE(fails_with("arm.txt' line 2",
                           [&] { const MeshMotion motion(host, wall.settings, 0, step(0)); }));
  });
}

TEST(MeshMotion, keeps_its_motion_where_the_table_of_another_is_wrong)
{
  WallAlongX wall;
  MeshMotion motion(wall.host, wall.settings, 0, step(0));
  Wall other;
  follow(other, "not/there");
  EXPECT_THROW(motion.set(other.mesh().motion, step(0)), InputError);
  run(motion, wall, 1, 1);
  EXPECT_EQ(where(motion), (Vec3{1, 0, 0}));
}

TEST(MeshMotion, gives_variables_to_the_surface_and_the_servo)
{
  Wall wall;
  wall.servo_along_z();
  wall.servo().target_input = wall.input("load");
  wall.mesh().surface_input[1] = wall.input("belt");
  wall.mesh().surface_input[5] = wall.input("spin");
  wall.values = {{"load", 5}, {"belt", 6}, {"spin", 7}};
  MeshMotion motion(wall.host, wall.settings, 0, step(0));
  run(motion, wall, 1, 1);
  EXPECT_EQ(wall.servo().target, 5);
  EXPECT_EQ(motion.surface_motion().velocity, (Vec3{0, 6, 0}));
  EXPECT_EQ(motion.surface_motion().angular, (Vec3{0, 0, 7}));
}

// Another motion

TEST_F(ServoAtFive, keeps_what_a_servo_has_added_to_another_motion)
{
  run(motion, wall, 1, 1);
  motion.set(motion_of({linear({0, 3, 0})}), step(1));
  EXPECT_EQ(where(motion), (Vec3{0, 0, 5}));
  EXPECT_EQ(wall.servo().position, 5);
}

// Another servo

TEST_F(ServoAtFive, stops_a_servo_where_it_is)
{
  wall.servo().velocity = 1;
  motion.set(Servo());
  EXPECT_TRUE(wall.servo().holds);
  EXPECT_EQ(where(motion), (Vec3{0, 0, 5}));
  EXPECT_EQ(motion.pose().velocity, (Vec3{0, 0, 0}));
}

Servo servo_along(const Vec3 &axis, Real lo, Real hi)
{
  Servo to;
  to.present = true;
  to.axis = axis;
  to.lo = lo;
  to.hi = hi;
  return to;
}

TEST_F(ServoAtFive, goes_on_along_the_line_of_a_servo)
{
  motion.set(servo_along({0, 0, 1}, 0, 6));
  EXPECT_EQ(wall.servo().position, 5);
  EXPECT_EQ(wall.servo().hi, 6);
}

// The position that limits count from stays, whichever of the two is stopped first.
TEST_F(ServoAtFive, goes_on_along_its_line_after_servo_and_motion_were_stopped)
{
  motion.set(Servo());
  motion.set(RigidMotion(), step(0));
  EXPECT_EQ(where(motion), (Vec3{0, 0, 5}));
  motion.set(servo_along({0, 0, 1}, 0, 6));
  EXPECT_EQ(wall.servo().position, 5);
  EXPECT_EQ(where(motion), (Vec3{0, 0, 5}));
}

// Terms that come act where the servo has the mesh: a turn that it holds does not turn them.
TEST_F(ServoAtFive, that_holds_is_left_behind_by_another_motion)
{
  motion.set(Servo());
  motion.set(motion_of({linear({0, 3, 0})}), step(0));
  EXPECT_EQ(wall.servo().position, 0);
  EXPECT_EQ(where(motion), (Vec3{0, 0, 5}));
}

TEST_F(ServoAtFive, refuses_limits_that_a_servo_is_past)
{
  EXPECT_THROW(motion.set(servo_along({0, 0, 1}, 0, 4)), InputError);
  EXPECT_EQ(wall.servo().hi, 10);    // it is as it was
}

TEST_F(ServoAtFive, begins_along_another_line_from_where_it_is)
{
  run(motion, wall, 1, 1);
  motion.set(servo_along({1, 0, 0}, -1, 1));
  EXPECT_EQ(wall.servo().position, 0);
  EXPECT_EQ(where(motion), (Vec3{0, 0, 5}));
}

TEST(MeshMotion, refuses_another_line_while_a_motion_moves_it)
{
  Wall wall;
  wall.mesh().motion.add(linear({2, 0, 0}));
  wall.servo_along_z();
  MeshMotion motion(wall.host, wall.settings, 0, step(0));
  EXPECT_THROW(motion.set(servo_along({1, 0, 0}, -1, 1)), InputError);
}

TEST_F(AlongX, refuses_a_first_servo_without_talk_of_another)
{
  EXPECT_TRUE(begins(error_of([&] {
                       motion.set(servo_along({1, 0, 0}, -1, 1));
                     }),
                     "a servo cannot begin while the motion 'linear"));
}

// rerun

// restart files

// Where a wall is at step 5 that has read what `before` wrote at step 3.
Vec3 where_it_goes_on(Wall &before, Wall &after)
{
  MeshMotion first(before.host, before.settings, 0, step(0));
  run(first, before, 1, 3);
  MeshMotion second(after.host, after.settings, 0, step(3));
  second.restore(first.state(), step(3));
  run(second, after, 4, 5);
  return where(second);
}

TEST(MeshMotion, begins_another_motion_after_a_restart_from_where_it_was)
{
  Wall before, after;
  before.mesh().motion.add(linear({2, 0, 0}));
  after.mesh().motion.add(linear({0, 3, 0}));
  EXPECT_EQ(where_it_goes_on(before, after), (Vec3{3, 3, 0}));
  ASSERT_EQ(after.host.warnings.size(), 1);
  EXPECT_TRUE(has(after.host.warnings[0], "the phase is lost"));
}

// As the program of a library puts a mesh, by poses, where neither before nor after a motion moves it.
TEST(MeshMotion, rests_after_a_restart_where_poses_had_it)
{
  Wall before, after;
  before.mesh().motion.begin_posed();
  Pose pose;
  pose.placed = true;
  pose.shift = {3, 0, 0};
  before.mesh().motion.set_pose(pose);
  EXPECT_EQ(where_it_goes_on(before, after), (Vec3{3, 0, 0}));
}

TEST(MeshMotion, has_the_pose_after_a_restart_that_it_got_since_its_last_step)
{
  Wall before, after;
  before.mesh().motion.begin_posed();
  after.mesh().motion.begin_posed();
  MeshMotion first(before.host, before.settings, 0, step(0)),
      second(after.host, after.settings, 0, step(3));
  run(first, before, 1, 3);
  Pose pose;
  pose.placed = true;
  pose.shift = {3, 0, 0};
  before.mesh().motion.set_pose(pose);
  second.restore(first.state(), step(3));
  EXPECT_EQ(where(second), where(first));    // in the last step
  second.place();
  EXPECT_EQ(where(second), (Vec3{3, 0, 0}));
}

TEST(MeshMotion, that_was_stopped_stays_so_after_a_restart)
{
  Wall before, after;
  before.mesh().motion.add(linear({2, 0, 0}));
  after.mesh().motion.add(linear({2, 0, 0}));
  MeshMotion first(before.host, before.settings, 0, step(0));
  run(first, before, 1, 3);
  first.set(RigidMotion(), step(3));
  MeshMotion second(after.host, after.settings, 0, step(3));
  second.restore(first.state(), step(3));
  run(second, after, 4, 5);
  EXPECT_EQ(where(second), (Vec3{3, 0, 0}));
  ASSERT_EQ(after.host.warnings.size(), 1);
  EXPECT_TRUE(has(after.host.warnings[0], "was stopped when the saved state was written"));
}

TEST(MeshMotion, is_where_a_servo_had_it_that_is_not_there_after_a_restart)
{
  Wall before, after;
  before.servo_along_z();
  before.servo().position = 5;
  EXPECT_EQ(where_it_goes_on(before, after), (Vec3{0, 0, 5}));
  ASSERT_EQ(after.host.warnings.size(), 1);
  EXPECT_TRUE(has(after.host.warnings[0], "no other servo takes over its position and speed"));
}

TEST(MeshMotion, has_the_values_of_variables_after_a_restart)
{
  Wall before, after;
  before.by_variable(false);
  after.by_variable(false);
  before.values = {{"x", 7}};
  MeshMotion first(before.host, before.settings, 0, step(0));
  run(first, before, 1, 1);
  MeshMotion second(after.host, after.settings, 0, step(1));
  second.restore(first.state(), step(1));
  EXPECT_EQ(where(second), (Vec3{7, 0, 0}));
  EXPECT_EQ(second.pose().velocity, (Vec3{7 / kDt, 0, 0}));
}

// A line of the log

// The bounds' corners go at 8 in the steep part, which is short.
TEST(MeshMotion, tells_the_rows_of_a_table_and_its_speed)
{
  const TempDir folder;
  Wall wall;
  follow(wall, folder.write("arm.txt", "0 0 0 0\n1 1 0 0\n1.001 1.008 0 0\n9 2 0 0\n"));
  wall.mesh().motion.terms()[0].table_options.linear = true;
  const MeshMotion motion(wall.host, wall.settings, 0, step(0));
  EXPECT_EQ(motion.text({{0, 0, 0}, {1, 1, 1}}),
            "table " + folder.path("arm.txt") +
                " linear; 4 rows from 0 to 9; corners of its bounds move at up to 8");
}

}    // namespace
}    // namespace lsdcd::test_mesh_motion
