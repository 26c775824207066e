// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rigid bodies of a wall whose program is not LAMMPS: gravity, sums over processes, saved states.
#include "base/input_error.h"
#include "support/fake_host.h"
#include "support/grains.h"
#include "support/meshes.h"
#include "wall/wall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd::test_mesh_body {
namespace {

constexpr Real kStiffness = 1000, kDt = 1e-3, kRadius = 0.5, kSide = 2;

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
  mesh.mesh =
      std::make_shared<WeldedMesh>(weld(box_mesh({-half, -half, -half}, {half, half, half}), -1));
  mesh.body.present = true;
  mesh.body.density = 1;
  mesh.body.joint = joint;
  return wall;
}

struct Scene : Grains {
  FakeHost &host;
  std::unique_ptr<Wall> wall;
  Real gravity[3] = {0, 0, 0};
  std::int64_t now = 0;

  Scene(FakeHost &host, const WallSpec &spec, const WallUnits &units = WallUnits()) : host(host)
  {
    host.simulation = wide_box();
    wall = std::make_unique<Wall>(host, spec, units, WallBackend(), "", StepClock{0, 0, 0, kDt});
  }

  void step(Step::Kind kind, Real dt = kDt)
  {
    for (Vec3 &f : force) f = {0, 0, 0};
    wall->history().grow(static_cast<int>(x.size()));
    StepInput input;
    input.step = {now, dt, kind};
    input.look = input.new_spheres = kind == Step::setup;
    input.drift.kind = SphereDrift::watched;
    input.drift.distance = 0.05;
    input.gravity = gravity;
    wall->begin(spheres(), input);
    wall->launch(spheres());
    wall->finish(spheres());
  }
  void set_up()
  {
    wall->begin_run(now, false);
    step(Step::setup);
  }
  void run(int n, Real dt = kDt)
  {
    for (int i = 0; i < n; i++) {
      now++;
      step(Step::step, dt);
    }
  }
  const RigidBody &body() { return wall->body(0)->body(); }
};

std::string error_of_run(Scene &scene, Real dt)
{
  try {
    scene.run(4, dt);
  } catch (const InputError &e) {
    return e.what();
  }
  return "";
}

}    // namespace

// Velocity Verlet with a constant force is exact.
TEST(mesh_body, falls_by_the_acceleration_of_the_host)
{
  FakeHost host;
  Scene scene(host, cube());
  scene.gravity[2] = -9.81;
  scene.set_up();
  EXPECT_EQ(scene.body().velocity().z, 0);    // the set-up of a run integrates nothing
  scene.run(100);
  EXPECT_NEAR(scene.body().velocity().z, -9.81 * 100 * kDt, 1e-13);
  EXPECT_NEAR(scene.body().centre().z, -0.5 * 9.81 * std::pow(100 * kDt, 2), 1e-14);
}

// A unit of force of 1/ftm2v mass length / time^2.
TEST(mesh_body, takes_the_units_of_the_host)
{
  FakeHost host;
  WallUnits units;
  units.velocity = 0.01;
  Scene scene(host, cube(), units);
  scene.gravity[2] = -9.81;    // force / mass
  scene.set_up();
  scene.run(100);
  EXPECT_NEAR(scene.body().velocity().z, -0.0981 * 100 * kDt, 1e-15);
}

// Each of two processes has a sphere that presses on a face: both push the body, as both processes know.
TEST(mesh_body, feels_the_spheres_of_all_processes)
{
  on_processes(2, [](FakeHost &host) {
    Scene scene(host, cube());
    scene.add({0, 0, kSide / 2 + kRadius - 0.01});
    if (host.rank() == 1) scene.x[0] = {0, kSide / 2 + kRadius - 0.02, 0};
    scene.set_up();
    scene.run(1);
    const Real step =
        kDt * kStiffness / std::pow(kSide, 3);    // velocity by a unit overlap in a step
    // The second half of the step is by an overlap that the first has changed, by a millionth.
    EXPECT_NEAR(scene.body().velocity().z, -0.01 * step, 1e-5 * step);
    EXPECT_NEAR(scene.body().velocity().y, -0.02 * step, 1e-5 * step);
  });
}

TEST(mesh_body, goes_on_from_a_saved_state_to_the_last_bit)
{
  const Joint joints[] = {Joint(), {JointKind::hinge, {0.3, 0, 0}, {0, 0.6, 0.8}}};
  for (const Joint &joint : joints) {
    WallSpec spec = cube(joint);
    spec.meshes[0].body.load = {0.1, 0.2, 0.3};
    spec.meshes[0].body.moment = {1, 2, -1};
    FakeHost host, other;
    Scene whole(host, spec), second(other, spec);
    whole.set_up();
    whole.run(10);
    const WallState saved = WallState::from(whole.wall->save().blocks());
    whole.run(10);
    second.now = 10;
    second.wall->restore(saved, {10, kDt});
    second.set_up();
    second.run(10);
    const Pose a = whole.body().pose(), b = second.body().pose();
    EXPECT_TRUE(a.shift == b.shift && a.velocity == b.velocity && a.angular == b.angular &&
                a.row[0] == b.row[0]);
    EXPECT_TRUE(other.warnings.empty());
  }
}

TEST(mesh_body, goes_on_from_where_it_was_in_another_joint)
{
  FakeHost host, other;
  WallSpec spec = cube();
  spec.meshes[0].body.omega = {0, 0, 3};
  Scene first(host, spec);
  first.set_up();
  first.run(100);
  const Pose was = first.body().pose();
  Scene second(other, cube({JointKind::hinge, {0, 0, 0}, {0, 0, 1}}));
  second.wall->restore(first.wall->save(), {100, kDt});
  const Pose is = second.body().pose();
  EXPECT_LT(norm(is.row[0] - was.row[0]), 1e-15);
  EXPECT_NEAR(second.body().omega().z, 3, 1e-14);
  EXPECT_EQ(second.body().coordinate(), 0);
  ASSERT_EQ(other.warnings.size(), 1u);
  EXPECT_NE(other.warnings[0].find("another mass or joint"), std::string::npos);
}

// One contact of stiffness k, with the body of mass 8 and the sphere of mass 1 on it.
TEST(mesh_body, refuses_a_timestep_at_which_sphere_and_body_would_be_unstable)
{
  const Real longest = 2 / std::sqrt(kStiffness * (1 + 1 / 8.));
  for (const Real share : {0.99, 1.01}) {
    FakeHost host;
    Scene scene(host, cube());
    scene.add({0, 0, kSide / 2 + kRadius - 1e-6});    // it stays: the test does not move it
    scene.set_up();
    const std::string error = error_of_run(scene, share * longest);
    EXPECT_EQ(error.empty(), share < 1) << error;
  }
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

}    // namespace lsdcd::test_mesh_body
