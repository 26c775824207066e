// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rigid bodies among grains on the tested device and on the CPU: one source, and sums in one order, so the same bits.
// The CPU computes from the arrays of the test; the device gets candidates packed, or has spheres in its memory.
#include "base/input_error.h"
#include "support/meshes.h"
#include "support/says.h"
#include "support/test_engine.h"
#include "support/wall_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace lsdcd::test_body_on_device {
namespace {

constexpr Real kStiffness = 1e4, kRadius = 0.1;

WallBackend tested()
{
  WallBackend b;
  b.make_engine = make_test_engine;
  return b;
}

MeshSpec mesh_of(const char *name, const TriangleSoup &soup)
{
  MeshSpec mesh;
  mesh.name = name;
  mesh.mesh = welded(soup);
  return mesh;
}

// No damping: the set-up of a run computes the forces that the last step had, so that a restart has the same bits.
WallSpec wall_of(std::vector<MeshSpec> meshes)
{
  WallSpec wall;
  ContactLaw &law = wall.laws.front().law;
  law = classic_law(NormalModel::hooke, true);
  law.k_normal = kStiffness;
  law.k_tangent = 0.3 * kStiffness;
  law.mu = 0.4;
  wall.device = Device::cpu;
  wall.meshes = std::move(meshes);
  return wall;
}

// Makes a body of some density.
MeshSpec body_of(const char *name, const TriangleSoup &soup)
{
  MeshSpec body = mesh_of(name, soup);
  body.body.present = true;
  body.body.density = 20;
  return body;
}

WallSpec over_floor(const MeshSpec &body)
{
  return wall_of({mesh_of("floor", floor_mesh(6, 2)), body});
}

// A flap that hangs on a hinge with a spring over a floor; it gives way to grains that fall on both.
WallSpec flap_over_floor()
{
  MeshSpec flap = body_of("flap", box_mesh({-0.6, -0.05, 0.15}, {0.6, 0.05, 1.2}));
  flap.body.joint = {JointKind::hinge, {0, 0, 1.2}, {1, 0, 0}};
  flap.body.drive.stiffness = 5;
  flap.body.drive.damping = 0.1;
  flap.body.drive.lo = -1;
  flap.body.drive.hi = 1;
  flap.body.omega = {0.8, 0, 0};
  return over_floor(flap);
}

// A plate that grains press down against a spring; it slides along a slope.
WallSpec plate_on_slider()
{
  MeshSpec plate = body_of("plate", box_mesh({-1.5, -1.5, 0.4}, {1.5, 1.5, 0.6}));
  plate.body.joint = {JointKind::slider, {0, 0, 0}, {0.6, 0, 0.8}};
  plate.body.drive.stiffness = 5000;
  plate.body.drive.damping = 50;
  plate.body.drive.lo = -0.2;
  plate.body.drive.hi = 0.2;
  return over_floor(plate);
}

// A free cube with a coat, which slides over a floor and turns among grains.
WallSpec coated_cube_on_floor()
{
  MeshSpec cube = body_of("cube", box_mesh({-0.3, -0.3, 0.06}, {0.3, 0.3, 0.66}));
  cube.body.velocity = {0.3, 0.1, 0};
  cube.body.omega = {0.1, 0, 0.4};
  cube.body.coat = {true, 0.15, 0.06};
  return over_floor(cube);
}

// A free box with grains inside.
WallSpec free_box()
{
  MeshSpec box = mesh_of("box", box_mesh({-0.9, -0.9, 0}, {0.9, 0.9, 1.4}));
  box.body.present = true;
  box.body.density = 1;
  box.body.has_gravity = true;    // none: it would fall as grains do
  box.body.omega = {0.2, 0.1, -0.3};
  return wall_of({box});
}

struct Scene : WallScene {
  Scene(FakeHost &host, const WallSpec &spec, const WallBackend &backend, Real time_step = 5e-4) :
      WallScene(host, spec, WallUnits(), time_step, backend)
  {
    gravity[2] = -9.81;
    look_every = 20;    // no grain goes 0.05 in so many steps
    std::mt19937_64 random(7);
    std::uniform_real_distribution<Real> part(-1, 1);
    int n = 0;
    for (int i = -3; i <= 3; i++)
      for (int j = -3; j <= 3; j++) {
        const Vec3 at = {0.22 * i + 0.005 * part(random), 0.25 * j + 0.005 * part(random),
                         0.9 + 0.2 * part(random)},
                   speed = {0.5 * part(random), 0.5 * part(random), 0};
        if (std::fabs(at.x) < 0.42 && std::fabs(at.y) < 0.42) continue;    // there may be a cube
        if (n++ % host.processes() != host.rank()) continue;
        add(at, kRadius);
        v.back() = speed;
        mass.back() = 0.05;
      }
  }

  // Grains do not feel each other.
  void go(int steps)
  {
    for (int k = 0; k < steps; k++) {
      move_spheres();
      for (const Vec3 &f : force) n_pushed += norm_sq(f) > 0;
    }
  }

  // All that moves, number by number.
  std::vector<Real> state()
  {
    std::vector<Real> all;
    const auto put = [&](const Vec3 &a) { all.insert(all.end(), {a.x, a.y, a.z}); };
    for (const std::vector<Vec3> *numbers : {&x, &v, &omega})
      for (const Vec3 &a : *numbers) put(a);
    for (const MeshPart &m : wall->meshes()) {
      const StepTotals &totals = wall->totals();
      put(totals.mesh(m.index).force);
      put(totals.mesh(m.index).torque);
      all.push_back(totals.mesh(m.index).energy);
      const BodyMover *body = wall->body(m.index);
      if (!body) continue;
      const RigidBody &b = body->rigid();
      put(b.centre());
      put(b.velocity());
      put(b.omega());
      put(b.turn().v);
      all.push_back(b.turn().w);
      put(body->reaction().force);
    }
    return all;
  }

  long n_pushed = 0;
};

bool same_bits(const std::vector<Real> &a, const std::vector<Real> &b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Real)) == 0;
}

// Runs the scene on the tested device and on the CPU, on this process.
void expect_same_bits(FakeHost &host, const WallSpec &spec, int steps)
{
  SCOPED_TRACE(spec.meshes.back().name);
  Scene cpu(host, spec, WallBackend()), device(host, spec, tested());
  const RigidBody &body = cpu.wall->body(spec.meshes.size() - 1)->rigid();
  const Pose begins = body.pose();
  const Vec3 from = body.centre();
  cpu.set_up();
  device.set_up();
  for (int k = 0; k < steps; k += 100) {
    cpu.go(100);
    device.go(100);
    const std::vector<Real> a = cpu.state(), b = device.state();
    ASSERT_TRUE(same_bits(a, b)) << "by step " << k + 100;
  }
  EXPECT_GT(cpu.n_pushed, steps / 10);    // spheres times steps
  const Pose ends = body.pose();
  const Real turned = norm(ends.row[0] - begins.row[0]) + norm(ends.row[1] - begins.row[1]);
  EXPECT_GT(turned + norm(body.centre() - from), 0.01);
}

}    // namespace

TEST(body_on_device, has_the_bits_of_the_cpu)
{
  FakeHost host;
  expect_same_bits(host, flap_over_floor(), 3000);
  expect_same_bits(host, plate_on_slider(), 2000);
  expect_same_bits(host, coated_cube_on_floor(), 2000);
  for (const int processes : {1, 2})
    on_processes(processes, [](FakeHost &host) { expect_same_bits(host, free_box(), 2000); });
}

TEST(body_on_device, goes_on_in_mid_swing_with_the_same_bits)
{
  for (const WallSpec &spec :
       {flap_over_floor(), plate_on_slider(), coated_cube_on_floor(), free_box()}) {
    FakeHost host, other;
    Scene whole(host, spec, WallBackend()), first(host, spec, tested()),
        second(other, spec, tested());
    whole.set_up();
    first.set_up();
    whole.go(700);
    first.go(700);
    second.restore_with_spheres(first);
    second.set_up();
    whole.go(700);
    second.go(700);
    EXPECT_TRUE(same_bits(whole.state(), second.state())) << spec.meshes.back().name;
    for (const std::string &warning : other.warnings) EXPECT_FALSE(has(warning, "springs"));
  }
}

// The bounds of the step's limit do not decide here, so that the contacts themselves are summed: the numbers of the error
// are those of the CPU.
TEST(body_on_device, refuses_the_timesteps_that_the_cpu_refuses)
{
  constexpr Real kPressed = 1e-6, kGrains = 40;
  WallSpec spec = free_box();
  spec.meshes[0].body.omega = {0, 0, 0};
  spec.meshes[0].body.load = {0, 0, kGrains * kStiffness * kPressed};    // it bears the grains
  const auto error_with = [&](const WallBackend &backend, Real time_step) -> std::string {
    FakeHost host;
    Scene scene(host, spec, backend, time_step);
    EXPECT_EQ(scene.x.size(), kGrains);
    for (Vec3 &at : scene.x) at.z = kRadius - kPressed;
    scene.set_up();
    return lsdcd::error_of([&] {
      scene.run(4);    // grains stay where they are
    });
  };
  // By bisection of what the CPU says: the limit to 1e-3.
  Real below = 1e-4, above = 1e-2;
  ASSERT_EQ(error_with(WallBackend(), below), "");
  ASSERT_NE(error_with(WallBackend(), above), "");
  while (above / below > 1.001) {
    const Real middle = std::sqrt(below * above);
    (error_with(WallBackend(), middle).empty() ? below : above) = middle;
  }
  EXPECT_EQ(error_with(tested(), below), "");
  const std::string error = error_with(tested(), above);
  EXPECT_TRUE(has(error, "is not below"));
  EXPECT_EQ(error, error_with(WallBackend(), above));
}

}    // namespace lsdcd::test_body_on_device
