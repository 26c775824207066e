// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rigid bodies of a wall whose program is not LAMMPS: gravity, sums over processes, saved states.
#include "base/input_error.h"
#include "support/meshes.h"
#include "support/motions.h"
#include "support/says.h"
#include "support/wall_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd::test_mesh_body {
namespace {

constexpr Real kStiffness = 1000, kDt = 1e-3, kRadius = 0.5, kSide = 2;

const Joint kAlongX = {JointKind::slider, {0, 0, 0}, {1, 0, 0}},
            kAlongZ = {JointKind::slider, {0, 0, 0}, {0, 0, 1}};

// A free cube about the origin, of density 1, and frictionless spheres.
WallSpec cube(const Joint &joint = Joint())
{
  WallSpec wall;
  wall.laws.front().law.k_normal = kStiffness;
  wall.device = Device::cpu;
  wall.meshes.resize(1);
  MeshSpec &mesh = wall.meshes.front();
  mesh.name = "cube";
  const Real half = kSide / 2;
  mesh.mesh = welded(box_mesh({-half, -half, -half}, {half, half, half}));
  mesh.body.present = true;
  mesh.body.density = 1;
  mesh.body.joint = joint;
  return wall;
}

struct Scene : WallScene {
  using WallScene::WallScene;

  const RigidBody &body() { return wall->body(0)->rigid(); }
};

// Light, and pressed by a motor: what pushes down on it pushes it into its stop. A hinge that is not above it has the other
// sense.
WallSpec cube_at_its_stop(JointKind kind, Real mass)
{
  const bool turns = kind == JointKind::hinge;
  WallSpec wall = cube({kind, {-3, 0, 0}, turns ? Vec3{0, 1, 0} : Vec3{0, 0, 1}});
  BodySpec &body = wall.meshes[0].body;
  body.density = mass / std::pow(kSide, 3);
  (turns ? body.drive.hi : body.drive.lo) = 0;
  body.drive.motor = turns ? 100 : -100;
  return wall;
}

std::string error_of_run(Scene &scene, Real dt)
{
  return lsdcd::error_of([&] {
    scene.dt = dt;
    scene.run(4);
  });
}

// Expects that this wall, with a sphere of a mass on top where that is above 0, runs below a timestep and not above it. The
// sphere stays: the test does not move it.
void expect_longest_timestep(const WallSpec &spec, Real mass, Real longest)
{
  for (const Real share : {0.99, 1.01}) {
    Scene scene(spec);
    if (mass > 0) {
      scene.add({0, 0, kSide / 2 + kRadius - 1e-6});
      scene.mass[0] = mass;
    }
    scene.set_up();
    const std::string error = error_of_run(scene, share * longest);
    EXPECT_EQ(error.empty(), share < 1) << error;
  }
}

// Velocity Verlet with a constant force is exact.
TEST(mesh_body, falls_by_the_acceleration_of_the_host_or_its_own)
{
  for (const bool own : {false, true}) {
    WallSpec spec = cube();
    spec.meshes[0].body.has_gravity = own;
    spec.meshes[0].body.gravity = {0, 0, -2};
    Scene scene(spec);
    scene.gravity[2] = -9.81;
    scene.set_up();
    EXPECT_EQ(scene.body().velocity().z, 0);    // the set-up of a run integrates nothing
    scene.run(100);
    const Real g = own ? 2 : 9.81;
    EXPECT_NEAR(scene.body().velocity().z, -g * 100 * kDt, 1e-13);
    EXPECT_NEAR(scene.body().centre().z, -0.5 * g * std::pow(100 * kDt, 2), 1e-14);
  }
}

// About a principal axis: omega = T t / I.
TEST(mesh_body, is_turned_by_its_moment)
{
  WallSpec spec = cube();
  spec.meshes[0].body.moment = {0, 3, 0};
  Scene scene(spec);
  scene.go(100);
  const Real inertia = std::pow(kSide, 3) * kSide * kSide / 6;
  EXPECT_NEAR(scene.body().omega().y, 3 * 100 * kDt / inertia, 1e-13);
}

// A unit of force of 1/ftm2v mass length / time^2.
TEST(mesh_body, takes_the_units_of_the_host)
{
  WallUnits units;
  units.velocity = 0.01;
  Scene scene(cube(), units);
  scene.gravity[2] = -9.81;    // force / mass
  scene.go(100);
  EXPECT_NEAR(scene.body().velocity().z, -0.0981 * 100 * kDt, 1e-15);
}

TEST(mesh_body, goes_on_from_where_it_was_in_another_joint)
{
  WallSpec spec = cube();
  spec.meshes[0].body.omega = {0, 0, 3};
  Scene first(spec);
  first.go(100);
  const Pose was = first.body().pose();
  Scene second(cube({JointKind::hinge, {0, 0, 0}, {0, 0, 1}}));
  second.restore(first);
  const Pose is = second.body().pose();
  EXPECT_LT(norm(is.row[0] - was.row[0]), 1e-15);
  EXPECT_NEAR(second.body().omega().z, 3, 1e-14);
  EXPECT_EQ(second.body().coordinate(), 0);
  ASSERT_EQ(second.host.warnings.size(), 1u);
  EXPECT_TRUE(has(second.host.warnings[0], "a different mass or joint"));
}

// Turned by 90 degrees about z: the slider along x of the box is along -y of the mesh.
TEST(mesh_body, gives_way_as_another_joint_of_a_restart_allows)
{
  WallSpec spec = cube();
  constexpr int kSteps = 1000;
  spec.meshes[0].body.omega = {0, 0, kPi / 2 / (kSteps * kDt)};
  Scene first(spec);
  first.go(kSteps);
  Scene second(cube(kAlongX));
  second.restore(first);
  const Mobility gives = second.wall->body(0)->mobility();
  EXPECT_NEAR(gives.along({1, 0, 0}, {0, -1, 0}), 1 / 8., 1e-12);
  EXPECT_NEAR(gives.along({1, 0, 0}, {1, 0, 0}), 0, 1e-12);
}

// A cube that has gone along x by 0.5 is followed by another one.
class moved_body : public testing::Test {
 protected:
  WallSpec spec = cube(kAlongX);
  std::unique_ptr<Scene> scene;

  void SetUp() override
  {
    spec.meshes[0].body.velocity = {1, 0, 0};
    scene = std::make_unique<Scene>(spec);
    scene->go(500);
  }
};

// Only a step says that no saved state gives it another place.
TEST_F(moved_body, begins_outside_of_its_limits_only_with_a_saved_state)
{
  spec.meshes[0].body.drive.lo = 0.4;
  Scene second(spec), alone(spec);
  second.restore(*scene);
  second.go(1);
  scene->run(1);
  EXPECT_EQ(second.body().centre(), scene->body().centre());
  EXPECT_TRUE(
      fails_with("do not contain 0, which is where the body begins", [&] { alone.set_up(); }));
}

TEST_F(moved_body, begins_outside_of_its_limits_no_more_where_a_second_state_has_no_place_for_it)
{
  WallSpec rests = spec;
  rests.meshes[0].body = BodySpec();
  Scene without(rests);
  without.set_up();
  spec.meshes[0].body.drive.lo = 0.4;
  Scene second(spec);
  second.wall->keep_made();
  second.restore(*scene);
  second.restore(without);
  EXPECT_THROW(second.set_up(), InputError);
}

// Broadcasts that a host of one process was asked for.
struct CountingHost : FakeHost {
  int broadcasts = 0;

  void broadcast(void *, std::size_t, int, Receivers) override { broadcasts++; }
};

TEST(mesh_body, takes_a_state_without_one_of_its_own_where_no_other_may_follow)
{
  CountingHost other;
  const WallSpec spec = cube(kAlongX);
  Scene first(spec), second(other, spec);
  first.set_up();
  const int before = other.broadcasts;
  second.restore(first);
  EXPECT_EQ(other.broadcasts, before);
  EXPECT_THROW(second.restore(first), std::logic_error);
}

// A change that takes it out of its limits is refused, and so is one that takes it out of the plane.
TEST(mesh_body, keeps_what_it_was_where_a_change_is_refused)
{
  Scene scene(cube(kAlongX));
  scene.host.simulation.dimension = 2;
  scene.go(10);
  const BodySpec was = scene.wall->meshes()[0].spec.body;
  BodySpec leaves = was, outside = was;
  leaves.joint.axis = {0, 0, 1};
  outside.drive.lo = 1;
  for (const BodySpec &to : {leaves, outside}) {
    EXPECT_THROW(scene.wall->set_body(0, to), InputError);
    EXPECT_TRUE(scene.wall->meshes()[0].spec.body.joint == was.joint);
    EXPECT_EQ(scene.wall->meshes()[0].spec.body.drive.lo, was.drive.lo);
  }
}

// A mass that another machine has rounded otherwise is the same.
TEST_F(moved_body, keeps_its_coordinate_after_a_restart_with_another_mass)
{
  for (const Real factor : {1 + 1e-15, 2.}) {
    WallSpec other = spec;
    other.meshes[0].body.density *= factor;
    Scene second(other);
    second.restore(*scene);
    EXPECT_EQ(second.body().coordinate(), scene->body().coordinate());
    EXPECT_EQ(second.host.warnings.size(), factor == 2.);
    other.meshes[0].body.drive.hi = 0.4;
    Scene third(other);
    EXPECT_THROW(third.restore(*scene), InputError);
  }
}

// Its mesh has no motion before and after: only the state says where it was.
TEST_F(moved_body, leaves_its_mesh_where_it_was_where_it_is_none_after_a_restart)
{
  spec.meshes[0].body = BodySpec();
  Scene second(spec);
  second.restore(*scene);
  EXPECT_NEAR(second.wall->meshes()[0].pose().to_box({0, 0, 0}).x, 0.5, 1e-14);
  ASSERT_EQ(second.host.warnings.size(), 1u);
  EXPECT_TRUE(has(second.host.warnings[0], "has a body for this mesh"));
}

// Nodes are where the program has them: the place of a body or a motion would move them once more, and the sphere over the
// left end of the top would find nothing there.
TEST(mesh_body, does_not_move_nodes_after_a_restart)
{
  for (const bool by_motion : {false, true}) {
    WallSpec moved = cube(), spec = cube();
    moved.meshes[0].body.velocity = {1, 0, 0};
    if (by_motion) {
      moved.meshes[0].body = BodySpec();
      moved.meshes[0].motion.add(linear({1, 0, 0}));
    }
    Scene first(moved);
    first.go(500);
    spec.meshes[0].body = BodySpec();
    spec.meshes[0].has_nodes = true;
    Scene second(spec);
    second.add({-0.8, 0.1, kSide / 2 + kRadius - 0.01});
    second.restore(first);
    second.set_up();
    EXPECT_NEAR(second.force[0].z, 0.01 * kStiffness, 1e-10);
    ASSERT_GE(second.host.warnings.size(), 1u);
    EXPECT_TRUE(has(second.host.warnings[0], "now its nodes do"));
  }
}

// Limits of hinges that look like degrees; ten turns, and an angle below one turn, do not.
TEST(mesh_body, asks_whether_limits_are_degrees_where_they_look_like_those)
{
  const struct {
    Real lo, hi;
    bool asks;
  } cases[] = {{-45, 90, true},
               {0, 360, true},
               {-22.5, 22.5, true},
               {0, 62.83, false},
               {-20 * kPi, 20 * kPi, false},
               {-1, 2, false},
               {-HUGE_VAL, 90, false}};
  for (const auto &c : cases) {
    WallSpec spec = cube({JointKind::hinge, {0, 0, 0}, {0, 0, 1}});
    spec.meshes[0].body.drive.lo = c.lo;
    spec.meshes[0].body.drive.hi = c.hi;
    Scene scene(spec);
    EXPECT_EQ(scene.host.warnings.size(), c.asks) << c.lo << " " << c.hi;
    BodySpec to = spec.meshes[0].body;
    to.load = {0, 0, 1};    // the same limits: asked once
    scene.wall->set_body(0, to);
    EXPECT_EQ(scene.host.warnings.size(), c.asks) << c.lo << " " << c.hi;
    to.drive.lo = -180;
    to.drive.hi = 180;
    scene.wall->set_body(0, to);
    ASSERT_EQ(scene.host.warnings.size(), c.asks + 1u);
    EXPECT_TRUE(has(scene.host.warnings.back(), "write -3.14159 3.14159"));
  }
}

// Images of a mesh are those of its file: a body that went along the periodic edge before a hinge held it there has others. A
// large sphere reaches it through the face, where it had no force.
TEST(mesh_body, has_no_images_where_it_was_moved_along_the_edge_before_its_joint)
{
  FakeHost host;
  host.simulation = wide_box();
  PeriodicBox &box = host.simulation;
  box.corner.z = -4;
  box.edge[2].z = 8;
  box.periodic[2] = true;
  WallSpec spec = cube();
  spec.meshes[0].body.velocity = {0, 0, 20};
  Scene scene(host, spec);
  scene.add({0, 0, -3.6}, kRadius);
  scene.go(100);    // it reaches from 1 to 3, and 1 from the face
  BodySpec to = scene.wall->spec().meshes[0].body;
  to.joint = {JointKind::hinge, {0, 0, 0}, {0, 0, 1}};
  scene.wall->set_body(0, to);
  scene.set_up();
  EXPECT_NEAR(scene.body().centre().z, 2, 1e-12);
  scene.radius[0] = 1.5;
  EXPECT_TRUE(fails_with("reaches the periodic face in z", [&] { scene.set_up(); }));
}

// One contact of stiffness k, with the body of mass 8 and the sphere of mass 1 on it.
TEST(mesh_body, refuses_a_timestep_at_which_sphere_and_body_would_be_unstable)
{
  expect_longest_timestep(cube(), 1, 2 / std::sqrt(kStiffness * (1 + 1 / 8.)));
}

// Leapfrog on a spring K of mass M is stable below 2 sqrt(M / K).
TEST(mesh_body, refuses_a_timestep_at_which_its_spring_would_be_unstable)
{
  WallSpec spec = cube(kAlongZ);
  spec.meshes[0].body.drive.stiffness = 1e4;
  expect_longest_timestep(spec, 0, 2 * std::sqrt(8 / 1e4));
}

// A heavy sphere that sticks to a body which slides: only the spring of friction, k, acts along the slider.
TEST(mesh_body, refuses_a_timestep_at_which_its_sliding_would_be_unstable)
{
  WallSpec spec = cube(kAlongX);
  spec.laws.front().law = classic_law(NormalModel::hooke, true);
  spec.laws.front().law.k_normal = spec.laws.front().law.k_tangent = kStiffness;
  spec.laws.front().law.mu = 0.5;
  expect_longest_timestep(spec, 1e9, 2 * std::sqrt(8 / kStiffness));
}

// Beside grains that may be no spheres there is a bound alone: it warns, and never takes a good run for an unstable one.
TEST(mesh_body, warns_once_of_a_timestep_that_contacts_of_ellipsoids_may_make_unstable)
{
  const Real longest = 2 / std::sqrt(kStiffness * (1 + 1 / 8.));
  for (const Real share : {0.5, 1.01}) {
    WallSpec spec = cube();
    spec.shapes = true;
    Scene scene(spec);
    scene.add({0, 0, kSide / 2 + kRadius - 1e-6});
    scene.set_up();
    scene.host.warnings.clear();
    EXPECT_EQ(error_of_run(scene, share * longest), "");
    const std::ptrdiff_t warned = std::count_if(
        scene.host.warnings.begin(), scene.host.warnings.end(), [](const std::string &w) {
          return w.find("may be too long for the body") != std::string::npos;
        });
    EXPECT_EQ(warned, share > 1) << share;
  }
}

// A stop bears it, as a mesh at rest does. Without the stop, on the sphere alone, it would be unstable from 9e-4 on.
TEST(mesh_body, takes_any_timestep_of_a_mesh_at_rest_while_it_is_pressed_into_its_stop)
{
  for (const JointKind kind : {JointKind::slider, JointKind::hinge})
    for (const bool pressed : {true, false}) {
      const Real overlap = 1e-5, push = kStiffness * overlap;
      WallSpec spec = cube_at_its_stop(kind, 2e-4);
      JointDrive &drive = spec.meshes[0].body.drive;
      if (!pressed) drive = JointDrive();
      if (!pressed) drive.motor = kind == JointKind::hinge ? -3.2 * push : push;
      Scene scene(spec);
      scene.add({0.2, 0, kSide / 2 + kRadius - overlap});
      scene.set_up();
      EXPECT_EQ(error_of_run(scene, 1e-3).empty(), pressed);
    }
}

// The damper takes the mass of the sphere, 1, or that of both, 8/9.
TEST(mesh_body, gives_way_at_its_stop_to_what_pushes_it_off)
{
  for (const bool off : {false, true}) {
    WallSpec spec = cube(kAlongZ);
    JointDrive &drive = spec.meshes[0].body.drive;
    (off ? drive.hi : drive.lo) = 0;
    spec.laws.front().law.eta = 5;
    Scene scene(spec);
    scene.add({0, 0, kSide / 2 + kRadius - 0.01});
    scene.v[0] = {0, 0, -2};
    scene.set_up();
    EXPECT_NEAR(scene.force[0].z, kStiffness * 0.01 + (off ? 8. / 9 : 1) * 5 * 2, 1e-12);
  }
}

// It leaves its stop for what pulls it, and not for what had pressed it on, between two runs or after a saved state.
TEST(mesh_body, rests_at_the_stop_to_which_a_motor_has_pressed_it)
{
  const JointDrive into = {0, 0, 0, 0, 0.1, 800}, nothing = {0, 0, 0, 0, 1, 0};
  WallSpec spec = cube(kAlongZ);
  spec.meshes[0].body.drive = into;
  Scene scene(spec);
  scene.go(100);    // 0.1 takes 45 steps
  EXPECT_EQ(scene.body().coordinate(), 0.1);
  EXPECT_EQ(scene.wall->body(0)->spring_and_kinetic_energy(), 0);
  EXPECT_NEAR(scene.wall->body(0)->stop_force(), -800, 1e-12);

  WallSpec of_other = spec;
  of_other.meshes[0].body.drive = nothing;
  Scene after(of_other);
  after.restore(scene);
  BodySpec to = scene.wall->spec().meshes[0].body;
  to.drive = nothing;
  scene.wall->set_body(0, to);
  for (Scene *s : {&scene, &after}) {
    s->go(100);
    EXPECT_EQ(s->body().coordinate(), 0.1);
    EXPECT_EQ(s->wall->body(0)->stop_force(), 0);
  }
  to.drive.motor = -8;
  scene.wall->set_body(0, to);
  scene.go(100);
  EXPECT_NEAR(scene.body().coordinate(), 0.1 - 0.5 * std::pow(100 * kDt, 2), 1e-14);
}

// Limits that have come to where it is take its velocity at once, so that spheres see none in the set-up of the next run.
TEST(mesh_body, is_at_rest_from_limits_that_it_meets_on)
{
  WallSpec spec = cube(kAlongZ);
  spec.meshes[0].body.velocity = {0, 0, 1};
  Scene scene(spec);
  scene.go(100);
  BodySpec to = scene.wall->spec().meshes[0].body;
  to.drive.lo = 0;
  to.drive.hi = scene.body().coordinate();
  scene.wall->set_body(0, to);
  EXPECT_EQ(scene.body().rate(), 0);
  spec.meshes[0].body.drive = {0, 0, 0, -1, 0, 0};
  EXPECT_EQ(Scene(scene.host, spec).body().rate(), 0);
}

// - F.V - T.w with all of the whole step, T about the centre, on two processes; and the same in the set-up of the next
// run, where nothing has moved.
TEST(mesh_body, has_the_power_of_force_and_velocity_in_the_same_step)
{
  for (const Joint &joint : {Joint(), Joint{JointKind::hinge, {0.3, 0, 0}, {0, 0.6, 0.8}}})
    on_processes(2, [&](FakeHost &host) {
      WallSpec spec = cube(joint);
      spec.meshes.push_back(spec.meshes[0]);    // a mesh at rest, that has none
      spec.meshes[1].body = BodySpec();
      spec.meshes[1].placement.move({9, 0, 0});
      Scene scene(host, spec);
      scene.add({0.4, host.rank() ? 0.3 : -0.6, kSide / 2 + kRadius - 0.01});
      scene.v[0] = {0, 0, -0.5};
      scene.set_up();
      Real most = 0;
      const auto expected = [&] {
        const RigidBody &b = scene.body();
        const MeshTotals &on = scene.wall->totals().mesh(0);
        return -dot(on.force, b.velocity()) -
               dot(on.torque_at_origin - cross(b.centre(), on.force), b.omega());
      };
      for (int n = 0; n < 40; n++) {
        scene.move_spheres();
        const Real power = scene.wall->totals().of_all().power;
        most = std::max(most, std::fabs(power));
        ASSERT_NEAR(power, expected(), 1e-12) << n;
      }
      EXPECT_GT(most, 0.02);
      const Real power = scene.wall->totals().mesh(0).power;
      scene.set_up();
      EXPECT_EQ(scene.wall->totals().mesh(0).power, power);
    });
}

TEST(mesh_body, takes_no_motion_beside_it)
{
  FakeHost host;
  WallSpec spec = cube();
  spec.meshes[0].motion.add(MotionTerm());
  EXPECT_THROW(Scene(host, spec), InputError);
  Scene scene(host, cube());
  EXPECT_THROW(scene.wall->set_motion(0, RigidMotion(), {0, kDt}), InputError);
  EXPECT_THROW(scene.wall->set_servo(0, Servo()), InputError);
  EXPECT_THROW(scene.wall->set_pose(0, Pose()), InputError);
}

TEST(mesh_body, takes_another_load_and_motor_from_where_it_is)
{
  WallSpec spec = cube(kAlongZ);
  spec.meshes[0].body.load = {0, 0, 4};
  Scene scene(spec);
  scene.go(100);
  const Real speed = scene.body().rate(), at = scene.body().coordinate();
  EXPECT_NEAR(speed, 4 / 8. * 100 * kDt, 1e-14);
  BodySpec to = scene.wall->spec().meshes[0].body;
  to.load = {0, 0, -8};
  to.drive.motor = 2;
  scene.wall->set_body(0, to);
  EXPECT_EQ(scene.body().rate(), speed);
  EXPECT_EQ(scene.body().coordinate(), at);
  scene.go(100);
  EXPECT_NEAR(scene.body().rate(), speed - 6 / 8. * 100 * kDt, 1e-14);
}

// The rest of a spring is a coordinate, which goes on while the joint stays.
TEST(mesh_body, takes_another_spring_and_keeps_its_coordinate)
{
  WallSpec spec = cube(kAlongZ);
  spec.meshes[0].body.velocity = {0, 0, 1};
  Scene scene(spec);
  scene.go(500);
  BodySpec to = scene.wall->spec().meshes[0].body;
  to.drive.stiffness = 32;    // 2 / s
  to.drive.rest = 0.5;
  scene.wall->set_body(0, to);
  EXPECT_NEAR(scene.body().coordinate(), 0.5, 1e-14);
  scene.go(500);
  EXPECT_NEAR(scene.body().coordinate(), 0.5 + 0.5 * std::sin(1.), 1e-6);
}

TEST(mesh_body, is_not_changed_to_what_no_body_is)
{
  WallSpec spec = cube(kAlongZ);
  spec.meshes[0].body.velocity = {0, 0, 1};
  spec.meshes.push_back(spec.meshes[0]);
  spec.meshes[1].name = "rest";
  spec.meshes[1].body = BodySpec();
  spec.meshes[1].placement.move({9, 0, 0});
  Scene scene(spec);
  scene.go(500);
  BodySpec to = scene.wall->spec().meshes[0].body;
  to.drive.lo = 0.6;
  to.drive.hi = 1;
  EXPECT_THROW(scene.wall->set_body(0, to), InputError);
  to.drive.lo = 0.4;
  scene.wall->set_body(0, to);    // where it is, though not where it began
  EXPECT_THROW(scene.wall->set_body(1, to), InputError);
  to.joint.kind = JointKind::free;
  EXPECT_THROW(scene.wall->set_body(0, to), InputError);
  EXPECT_EQ(scene.body().joint().kind, JointKind::slider);
}

// A sphere flies to and fro in a free box, elastic and frictionless. While a spring of angular frequency w is pressed,
// leapfrog keeps an energy that differs by a part p = (w dt)^2 / 8 from the true one, at most; each contact that opens
// leaves up to that behind, with a sign that its phase decides. So n contacts make a random walk of steps within +-p, whose
// variance is n p^2 / 3: three times its root is sqrt(3 n) p. LSDCD_QUICK: a hundredth of the steps.
TEST(mesh_body, contacts_that_open_and_close_keep_the_energy)
{
  WallSpec spec = cube();
  Scene scene(spec);
  constexpr Real kSmall = 0.3, kMassOfBox = kSide * kSide * kSide;
  scene.add({0.05, -0.1, 0.1}, kSmall);
  scene.v[0] = {0.7, 0.43, 1.01};
  scene.set_up();
  const auto energy = [&] {
    return 0.5 * scene.mass[0] * norm_sq(scene.v[0]) +
           scene.wall->body(0)->spring_and_kinetic_energy() + scene.wall->totals().of_all().energy;
  };
  const Real begins = energy(), part = kStiffness * (1 + 1 / kMassOfBox) * kDt * kDt / 8;
  const int steps = std::getenv("LSDCD_QUICK") ? 20000 : 2000000;
  Real off = 0, moved = 0;
  int n_opened = 0;
  bool touches = false;
  for (int i = 0; i < steps; i++) {
    scene.v[0] += 0.5 * kDt / scene.mass[0] * scene.force[0];
    scene.x[0] += kDt * scene.v[0];
    scene.run(1);
    const bool touched = touches;
    touches = norm_sq(scene.force[0]) > 0;
    n_opened += touched && !touches;
    scene.v[0] += 0.5 * kDt / scene.mass[0] * scene.force[0];
    if (i % 100 != 0) continue;
    off = std::max(off, std::fabs(energy() / begins - 1));
    moved = std::max(moved, norm(scene.body().velocity()));
  }
  EXPECT_GT(moved, 0.1);
  EXPECT_GT(n_opened, steps / 1000);
  EXPECT_LT(off, std::sqrt(3. * (n_opened + 1)) * part);
}

// The mass that damping sees of a sphere of mass 1 and a body of mass 8 in units of the host, where a force is not
// mass length / time^2.
TEST(mesh_body, damps_with_the_mass_of_both_in_the_units_of_the_host)
{
  WallUnits units;
  units.velocity = 0.01;
  WallSpec spec = cube();
  spec.laws.front().law.eta = 5;
  Scene scene(spec, units);
  scene.add({0, 0, kSide / 2 + kRadius - 0.01});
  scene.v[0] = {0, 0, -2};
  scene.set_up();
  EXPECT_NEAR(scene.force[0].z, kStiffness * 0.01 + 8. / 9 * 5 * 2, 1e-9);
}

}    // namespace
}    // namespace lsdcd::test_mesh_body
