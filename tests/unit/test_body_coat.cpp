// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Bodies that touch bodies and walls by their coats: closed forms, momentum, energy, processes, saved states.
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
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace lsdcd::test_body_coat {
namespace {

constexpr Real kStiffness = 1000, kSide = 2, kRadius = 0.1, kGravity = 10;

TriangleSoup cube_soup()
{
  const Real half = kSide / 2;
  return box_mesh({-half, -half, -half}, {half, half, half});
}

// A point of its own at each of 6 corners, 1 from the middle.
TriangleSoup octahedron()
{
  TriangleSoup soup;
  soup.source = "octahedron";
  for (const Real z : {1., -1.})
    for (int k = 0; k < 4; k++) {
      const Vec3 a = {k % 2 ? 0 : 1. - k, k % 2 ? 2. - k : 0, 0}, b = {-a.y, a.x, 0};
      for (const Vec3 &x : {z > 0 ? a : b, z > 0 ? b : a, Vec3{0, 0, z}}) soup.corners.push_back(x);
    }
  return soup;
}

// A cube of density 1 whose points are 1 apart: 13 on a face, which are its corners, the middles of its edges and of
// itself, and of the four squares between.
MeshSpec cube(const Vec3 &at, const Vec3 &velocity = {0, 0, 0})
{
  MeshSpec mesh;
  mesh.name = "cube";
  mesh.mesh = welded(cube_soup());
  mesh.placement.move(at);
  mesh.body.present = true;
  mesh.body.density = 1;
  mesh.body.velocity = velocity;
  mesh.body.coat = {true, 1, kRadius};
  return mesh;
}
constexpr int kPointsOfFace = 13;
constexpr Real kMass = kSide * kSide * kSide;

// An octahedron of this mass, whose 6 points are its corners.
MeshSpec octahedron_of(Real mass, const Vec3 &at, const Vec3 &velocity = {0, 0, 0})
{
  MeshSpec mesh = cube(at, velocity);
  mesh.mesh = welded(octahedron());
  mesh.body.coat.spacing = 5;
  mesh.body.density = 0;
  mesh.body.mass = {mass, at, {mass, mass, mass, 0, 0, 0}};
  return mesh;
}

MeshSpec floor_at_0(Real half = 10)
{
  MeshSpec mesh;
  mesh.name = "floor";
  mesh.mesh = welded(floor_mesh(4, half));
  return mesh;
}

WallSpec wall_of(std::vector<MeshSpec> meshes)
{
  WallSpec wall;
  wall.laws.front().law.k_normal = kStiffness;
  wall.device = Device::cpu;
  wall.meshes = std::move(meshes);
  return wall;
}

struct Scene : WallScene {
  using WallScene::WallScene;

  const RigidBody &body(int mesh) { return wall->body(mesh)->rigid(); }
  // Kinetic, of the height and of contacts.
  Real energy(int mesh)
  {
    const RigidBody &b = body(mesh);
    return b.kinetic_energy() -
           b.mass().mass * dot(Vec3{gravity[0], gravity[1], gravity[2]}, b.centre()) +
           wall->totals().of_all().energy;
  }
};

std::ptrdiff_t n_warnings(const FakeHost &host, const std::string &text)
{
  return std::count_if(host.warnings.begin(), host.warnings.end(),
                       [&](const std::string &w) { return w.find(text) != std::string::npos; });
}

Vec3 momentum_of(Scene &scene, const std::vector<int> &meshes)
{
  Vec3 sum = {0, 0, 0};
  for (const int m : meshes) sum += scene.body(m).mass().mass * scene.body(m).velocity();
  return sum;
}

Vec3 angular_momentum_of(Scene &scene, const std::vector<int> &meshes)
{
  Vec3 sum = {0, 0, 0};
  for (const int m : meshes) {
    const RigidBody &b = scene.body(m);
    sum += b.angular_momentum() + b.mass().mass * cross(b.centre(), b.velocity());
  }
  return sum;
}

ContactLaw with_restitution(Real e, Real stiffness = kStiffness)
{
  ContactLaw law = granular_law(NormalModel::hooke);
  law.k_normal = stiffness;
  law.damping = DampingModel::stiffness;
  law.eta = restitution_damping(NormalModel::hooke, e);
  return law;
}

ContactLaw frictional()
{
  ContactLaw law = classic_law(NormalModel::hooke, true);
  law.k_normal = kStiffness;
  law.k_tangent = 0.3 * kStiffness;
  law.eta = 2;
  law.mu = 0.4;
  return law;
}

}    // namespace

// A servo's plate presses it onto the floor: its gain is stable with the damping of the body, which no sphere has. What is
// left of the way falls off by e in 500 steps or less.
TEST(body_coat, is_pressed_steadily_by_a_servo)
{
  const Real push = 50;
  for (const bool turns : {false, true}) {
    MeshSpec plate = floor_at_0(1.5);
    plate.placement.move({0, 0, kSide + 2 * kRadius + 0.001});
    Servo &servo = plate.motion.servo();
    servo.present = true;
    servo.turns = turns;
    servo.axis = turns ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    servo.point = {-5, 0, kSide + 2 * kRadius};
    servo.target = turns ? 5 * push : -push;
    servo.max_speed = turns ? 0.1 : 0.5;
    WallSpec spec = wall_of({floor_at_0(), plate, cube({0, 0, kSide / 2 + kRadius})});
    spec.laws.front().law.eta = 30;
    spec.meshes[2].body.joint = {JointKind::slider, {0, 0, 0}, {0, 0, 1}};
    Scene scene(spec);
    scene.gravity[2] = -kGravity;
    scene.go(3000);
    EXPECT_NEAR(scene.wall->servo_push(1), servo.target, 1e-2 * std::fabs(servo.target)) << turns;
    if (!turns) {
      EXPECT_NEAR(scene.wall->totals().mesh(0).force.z, -kMass * kGravity - push, 1e-2 * push);
    }
  }
}

// N springs of stiffness k, which is that of the mesh under it, bear M g: the centre is half a side and a radius above the
// floor, less M g / (N k).
TEST(body_coat, a_cube_comes_to_rest_level_at_the_height_that_its_weight_asks_for)
{
  MeshSpec below = floor_at_0(), soft = floor_at_0();
  below.placement.move({0, 0, -3});
  soft.laws.resize(1);
  soft.laws[0].law.k_normal = kStiffness / 2;
  soft.laws[0].law.eta = 10;
  Scene scene(wall_of({below, soft, cube({0.3, 0.2, kSide / 2 + kRadius + 0.01})}));
  scene.gravity[2] = -kGravity;
  scene.go(6000);
  const RigidBody &b = scene.body(2);
  const Real sinks = kMass * kGravity / (kPointsOfFace * kStiffness / 2);
  EXPECT_NEAR(b.centre().z, kSide / 2 + kRadius - sinks, 1e-9);
  EXPECT_LT(norm(rotate(b.turn(), {0, 0, 1}) - Vec3{0, 0, 1}), 1e-12);
  EXPECT_LT(norm(b.velocity()), 1e-8);
  EXPECT_NEAR(scene.wall->totals().mesh(1).force.z, -kMass * kGravity, 1e-5);
  EXPECT_NEAR(scene.wall->totals().mesh(2).force.z, kMass * kGravity, 1e-5);
}

// Its points are closer to its own faces than their radius.
TEST(body_coat, does_not_feel_the_mesh_that_it_is_of)
{
  WallSpec spec = wall_of({floor_at_0(), cube({0, 0, 20})});
  spec.meshes[1].body.omega = {0, 0, 1};
  Scene scene(spec);
  scene.go(100);
  EXPECT_EQ(norm(scene.body(1).velocity()), 0);
  EXPECT_NEAR(scene.body(1).omega().z, 1, 1e-14);
}

// Momentum and angular momentum of bodies and spheres, less the impulse and the moment of gravity and of the fixed floor. A
// kick of half a step by each force is exact, so that what is missing is rounding: 1e-16 of what is given in a step.
// LSDCD_QUICK: 2000 steps.
TEST(body_coat, bodies_and_spheres_have_the_momentum_that_gravity_and_the_floor_give)
{
  const int steps = std::getenv("LSDCD_QUICK") ? 2000 : 100000;
  for (const int processes : {1, 2, 4})
    on_processes(processes, [&](FakeHost &host) {
      WallSpec spec = wall_of({floor_at_0(), cube({0, 0, kSide / 2 + kRadius + 0.05}, {0.3, 0, 0}),
                               cube({0.3, 0.5, 1.5 * kSide + 3 * kRadius}, {0, 0, -1})});
      spec.laws.front().law = frictional();
      spec.laws.front().law.k_normal *= 100;
      spec.meshes[1].body.coat.spacing = spec.meshes[2].body.coat.spacing = 2;
      Scene scene(host, spec);
      scene.gravity[2] = -kGravity;
      for (int i = host.rank(); i < 4; i += processes) {
        scene.add({1.45 + 0.1 * i, 0.4 * i - 0.6, 0.4 + 0.1 * i}, 0.3);
        scene.v.back() = {-1, 0.1 * i, 0};
      }
      const std::vector<int> bodies = {1, 2};
      const Vec3 g = {0, 0, -kGravity};
      const auto of_all = [&](const std::function<void(int, Vec3 &, Vec3 &)> &of_sphere, Vec3 p,
                              Vec3 l, Real *sums) {
        Vec3 mine = {0, 0, 0}, turning = {0, 0, 0};
        for (std::size_t i = 0; i < scene.x.size(); i++)
          of_sphere(static_cast<int>(i), mine, turning);
        for (int k = 0; k < 3; k++) {
          sums[k] = mine[k];
          sums[3 + k] = turning[k];
        }
        host.sum(sums, 6);
        for (int k = 0; k < 3; k++) {
          sums[k] += p[k];
          sums[3 + k] += l[k];
        }
      };
      const auto momentum = [&](Real *sums) {
        const auto of_sphere = [&](int i, Vec3 &p, Vec3 &l) {
          p += scene.mass[i] * scene.v[i];
          l += scene.mass[i] * cross(scene.x[i], scene.v[i]) +
               0.4 * scene.mass[i] * scene.radius[i] * scene.radius[i] * scene.omega[i];
        };
        of_all(of_sphere, momentum_of(scene, bodies), angular_momentum_of(scene, bodies), sums);
      };
      const auto forces = [&](Real *sums) {
        const auto of_sphere = [&](int i, Vec3 &p, Vec3 &l) {
          p += scene.mass[i] * g;
          l += scene.mass[i] * cross(scene.x[i], g);
        };
        const MeshTotals &floor = scene.wall->totals().mesh(0);
        Vec3 p = -floor.force, l = -floor.torque_at_origin;
        for (const int b : bodies) {
          p += kMass * g;
          l += kMass * cross(scene.body(b).centre(), g);
        }
        of_all(of_sphere, p, l, sums);
      };
      scene.set_up();
      Real missing[6], now[6], given = 0;
      momentum(missing);
      for (int n = 0; n <= steps; n++) {
        forces(now);
        const Real part = (n == 0 || n == steps ? 0.5 : 1) * scene.dt;
        for (int k = 0; k < 6; k++) {
          missing[k] += part * now[k];
          given += part * std::fabs(now[k]);
        }
        given += part * norm(scene.wall->totals().mesh(0).force);
        if (n == steps) break;
        scene.move_spheres();
      }
      momentum(now);
      const Real rounding = std::max(1e-12, steps * 1.2e-16) * given;
      for (int k = 0; k < 6; k++) EXPECT_NEAR(missing[k], now[k], rounding) << k;
      EXPECT_GT(given, 100);
    });
}

// Frictionless and elastic. In leapfrog a spring of angular frequency w keeps an energy that differs by a part (w dt)^2 / 8
// of what it swings with, and each opening of a contact leaves a part of that order behind.
TEST(body_coat, a_cube_dropped_on_an_edge_keeps_its_energy)
{
  Real worst[2];
  for (int k = 0; k < 2; k++) {
    WallSpec spec = wall_of({floor_at_0(30), cube({0, 0, 0})});
    Placement placement;
    placement.rotate({0, 1, 0}, 40);
    placement.move({0, 0, std::sqrt(2.) + 0.3});
    spec.meshes[1].placement = placement;
    const Real stiffness = 100 * kStiffness;
    spec.laws.front().law.k_normal = stiffness;
    Scene scene(spec);
    scene.dt = k == 0 ? 2e-4 : 1e-4;
    scene.gravity[2] = -kGravity;
    scene.set_up();
    const Real begins = scene.energy(1);
    Real off = 0;
    for (int i = 0; i < (k == 0 ? 200 : 400); i++) {
      scene.run(50);
      off = std::max(off, std::fabs(scene.energy(1) - begins));
    }
    EXPECT_GT(std::fabs(scene.body(1).omega().y), 0.1);    // it was tipped over
    worst[k] = off / begins;
  }
  const Real w_dt_sq = kPointsOfFace * 100 * kStiffness / kMass * 4e-8;
  EXPECT_LT(worst[0], w_dt_sq / 8);
  EXPECT_LT(worst[1], worst[0]);
}

// A corner of one body on the middle of a face of the other: the mass that damping sees is 1 / (1/M + 1/m). A
// contact lasts 314 steps at least; the force is cut off where it would attract, which loses as little.
TEST(body_coat, two_bodies_have_the_restitution_that_is_set_whatever_their_masses)
{
  const Real e = 0.6;
  for (const Real mass : {1e-3, 1., 1e3}) {
    WallSpec spec = wall_of(
        {cube({0, 0, -kSide / 2}), octahedron_of(mass, {0, 0, 1 + kRadius + 0.001}, {0, 0, -1})});
    spec.laws.front().law = with_restitution(e);
    spec.meshes[0].body.coat = CoatSpec();
    Scene scene(spec);
    const Real reduced = 1 / (1 / mass + 1 / kMass);
    scene.dt = 0.01 * std::sqrt(reduced / kStiffness);
    scene.go(static_cast<int>(0.002 / scene.dt) + 1000);
    const Real v = scene.body(1).velocity().z, big_v = scene.body(0).velocity().z;
    EXPECT_NEAR(big_v - v, -e, 0.02) << mass;
    EXPECT_NEAR(big_v, -(1 + e) * mass / (mass + kMass), 0.02 * mass / (mass + kMass)) << mass;
  }
}

// N points of a face, or of both faces where both bodies have a coat, move one mass, 1/(1/M + 1/m), on N springs. A
// contact lasts 48 steps at least, pi sqrt(m'/(N k)), and its end, where the force would attract, is cut off.
TEST(body_coat, has_the_restitution_that_is_set_however_many_points_touch)
{
  const Real e = 0.6;
  struct Row {
    bool free, both;
    Real tilt;    // degrees; 45: it lands on the 5 points of an edge
  };
  for (const Row &row :
       {Row{false, false, 0}, Row{true, false, 0}, Row{true, true, 0}, Row{false, false, 45}}) {
    MeshSpec upper = cube({0, 0, 0}, {0, 0, -1});
    upper.placement = Placement();
    upper.placement.rotate({0, 1, 0}, row.tilt);
    const Real half = row.tilt > 0 ? std::sqrt(2.) : 1;
    upper.placement.move({0, 0, half + kRadius + 0.0005});
    WallSpec spec = wall_of({row.free ? cube({0, 0, -kSide / 2}) : floor_at_0(), upper});
    if (!row.both) spec.meshes[0].body.coat = CoatSpec();
    spec.meshes[0].body.density = 3;
    spec.laws.front().law = with_restitution(e, 100 * kStiffness);
    Scene scene(spec);
    scene.dt = 1e-4;
    scene.go(1500);
    const Real below = row.free ? scene.body(0).velocity().z : 0;
    EXPECT_NEAR(scene.body(1).velocity().z - below, e, 0.02) << row.free << row.both << row.tilt;
  }
}

// One spring k and damper c = eta m' between masses M and m, whose reduced mass is m', or M and a wall: the rates k / m' and
// c / m' = eta, and a step below 4 / (eta + sqrt(eta^2 + 4 k / m')).
TEST(body_coat, a_timestep_at_which_its_contacts_would_be_unstable_is_refused)
{
  struct Row {
    bool free;
    Real eta, share;
  };
  std::vector<Row> rows;
  for (const bool free : {true, false})
    for (const Real eta : {0., 20.})
      for (const Real share : {0.99, 1.01}) rows.push_back({free, eta, share});
  for (const auto &[free, eta, share] : rows) {
    MeshSpec under = cube({0, 0, -kSide / 2});
    under.body.coat = CoatSpec();
    under.body.present = free;
    WallSpec spec = wall_of({under, octahedron_of(1, {0, 0, 1 + kRadius - 1e-6})});
    spec.laws.front().law.eta = eta;
    BodySpec &body = spec.meshes[1].body;
    body.load = {0, 0, -1};    // it stays in contact
    body.joint = {JointKind::slider, {0, 0, 0}, {0, 0, 1}};
    spec.meshes[0].body.joint = body.joint;
    Scene scene(spec);
    const Real rate = kStiffness * (1 + (free ? 1 / kMass : 0));
    scene.dt = share * 4 / (eta + std::sqrt(eta * eta + 4 * rate));
    scene.set_up();
    const std::string error = error_of([&] { scene.run(2); });
    EXPECT_EQ(error.empty(), share < 1) << error;
    if (share > 1) {
      EXPECT_TRUE(has(error, "is not below"));
    }
  }
}

// A cube on N points that stick: only their springs of friction, k each, act along its slider.
TEST(body_coat, a_timestep_at_which_its_sliding_would_be_unstable_is_refused)
{
  for (const Real share : {0.99, 1.01}) {
    WallSpec spec = wall_of({floor_at_0(), cube({0.3, 0.2, kSide / 2 + kRadius - 1e-6})});
    ContactLaw &law = spec.laws.front().law;
    law = classic_law(NormalModel::hooke, true);
    law.k_normal = law.k_tangent = kStiffness;
    law.mu = 0.5;
    spec.meshes[1].body.joint = {JointKind::slider, {0, 0, 0}, {1, 0, 0}};
    Scene scene(spec);
    scene.dt = share * 2 * std::sqrt(kMass / (kPointsOfFace * kStiffness));
    scene.set_up();
    const std::string error = error_of([&] { scene.run(2); });
    EXPECT_EQ(error.empty(), share < 1) << error;
  }
}

// It comes to rest by M v^2 / 2 = N k d^2 / 2 after 0.6 of the radius.
TEST(body_coat, warns_once_where_it_is_pressed_in_deep)
{
  const Real speed = 0.6 * kRadius * std::sqrt(kPointsOfFace * kStiffness / kMass);
  FakeHost host;
  Scene scene(host,
              wall_of({floor_at_0(), cube({0, 0, kSide / 2 + kRadius + 0.001}, {0, 0, -speed})}));
  scene.go(100);
  EXPECT_EQ(n_warnings(host, "is pressed in by"), 1);
}

// As two boxes of a drawing touch.
TEST(body_coat, says_how_far_to_lift_a_body_that_begins_in_another_mesh)
{
  FakeHost host;
  Scene flush(host, wall_of({floor_at_0(), cube({0, 0, kSide / 2})})),
      deep(host, wall_of({floor_at_0(), cube({0, 0, kSide / 2 + 0.4 * kRadius})}));
  EXPECT_TRUE(has(error_of([&] { flush.set_up(); }),
                  "begins with a point that is pressed into mesh 'floor' by 1 of that: other "
                  "meshes feel the body 0.1 outside of its surface, so place it 0.1 farther"));
  deep.set_up();
  EXPECT_EQ(n_warnings(host, "so place it 0.06 farther"), 1);
}

// From a place before the floor, whatever the part of a step after which a point is there.
TEST(body_coat, does_not_pass_a_mesh_between_two_steps)
{
  for (const bool turns : {false, true})
    for (const Real way : {0.25, 1.5, 30.})    // radii in a step
      for (const Real begins : {0.1, 0.35, 0.6}) {
        WallSpec spec = wall_of({floor_at_0(3), cube({0, 0, 0})});
        BodySpec &body = spec.meshes[1].body;
        const Real gap = kRadius * (1 + way * begins), speed = way * kRadius / 1e-3;
        if (turns) {    // about an axis 10 beside it, at the height of the floor
          body.joint = {JointKind::hinge, {10, 0, 0}, {0, 1, 0}};
          body.omega = {0, -speed / 9, 0};    // of its nearest points; the others go faster
        } else {
          body.velocity = {0, 0, -speed};
        }
        spec.meshes[1].placement.move({0, 0, kSide / 2 + gap});
        Scene scene(spec);
        scene.set_up();
        const std::string error = error_of([&] { scene.run(8); });
        EXPECT_TRUE(has(error, "through")) << turns << way << begins << error;
      }
}

// It flies beside the floor and over it, as far in a step.
TEST(body_coat, goes_as_fast_as_it_likes_where_nothing_is_on_its_way)
{
  WallSpec spec = wall_of({floor_at_0(), cube({11.5, 0, 1}, {0, 0, -4000}),
                           cube({-9, 0, kSide / 2 + 1.5 * kRadius}, {500, 0, 0})});
  Scene scene(spec);
  scene.set_up();
  EXPECT_EQ(error_of([&] { scene.run(20); }), "");
  EXPECT_EQ(scene.body(1).velocity(), (Vec3{0, 0, -4000}));
  EXPECT_EQ(scene.body(2).velocity(), (Vec3{500, 0, 0}));
}

// A floor that has gone as far as its coat's arm is long: the mobility is that at the point where the contact is now.
TEST(body_coat, has_the_restitution_that_is_set_on_a_mesh_that_has_moved)
{
  const Real e = 0.6, drop = 0.3;
  WallSpec spec = wall_of({floor_at_0(), octahedron_of(1, {0, 0, 1 + kRadius + drop}, {0, 0, -1})});
  spec.laws.front().law = with_restitution(e);
  spec.meshes[0].motion.add(linear({10, 0, 0}));
  Scene scene(spec);
  scene.dt = 0.01 / std::sqrt(kStiffness);
  scene.go(static_cast<int>(drop / scene.dt) + 1000);
  EXPECT_NEAR(scene.body(1).velocity().z, e, 0.02);
}

// One point of a body on a hinge, into which a plate comes down. What pushes it into its stop is damped with the mass of the
// body, as where joints hold it, and what pushes it off with I / arm^2.
TEST(body_coat, does_not_give_way_to_a_mesh_that_pushes_it_into_its_stop)
{
  const Real speed = 0.2, arm = 0.5, overlap = 0.01, eta = 3;
  for (const bool off : {false, true}) {
    MeshSpec plate = floor_at_0(), body = cube({0, 0, 0});
    plate.placement.move({0, 0, 1 + kRadius - overlap});
    plate.motion.add(linear({0, 0, -speed}));
    body.mesh = welded(octahedron());
    body.body.coat.spacing = 5;
    body.body.joint = {JointKind::hinge, {-arm, 0, 0}, {0, 1, 0}};
    (off ? body.body.drive.lo : body.body.drive.hi) = 0;
    WallSpec spec = wall_of({plate, body});
    spec.laws.front().law.eta = eta;
    Scene scene(spec);
    scene.set_up();
    const MassProperties &p = scene.body(1).mass();
    const Real mass = off ? (p.inertia.yy + p.mass * arm * arm) / (arm * arm) : p.mass;
    EXPECT_NEAR(scene.wall->totals().mesh(0).force.z, kStiffness * overlap + eta * mass * speed,
                1e-6);    // of a point as heavy as 1e9
  }
}

// It falls on a light lid that lies on its stop, as on a mesh at rest; of a point as heavy as 1e9 bodies.
TEST(body_coat, is_thrown_back_by_a_body_at_its_stop_as_by_a_mesh_at_rest)
{
  Real after[2];
  for (const bool at_rest : {false, true}) {
    MeshSpec lid = cube({0, 0, -kSide / 2}), falls = cube({0, 0, 1 + kRadius + 0.001}, {0, 0, -1});
    lid.body.coat = CoatSpec();
    lid.body.density = 0.01;
    lid.body.joint = {JointKind::slider, {0, 0, 0}, {0, 0, 1}};
    lid.body.drive.lo = 0;
    lid.body.drive.motor = -100;
    if (at_rest) lid.body = BodySpec();
    falls.mesh = welded(octahedron());
    falls.body.coat.spacing = 5;
    WallSpec spec = wall_of({lid, falls});
    spec.laws.front().law.eta = 10;
    Scene scene(spec);
    scene.go(300);
    after[at_rest] = scene.body(1).velocity().z;
  }
  EXPECT_GT(after[1], 0.3);
  EXPECT_NEAR(after[0], after[1], 1e-8);
}

// Both turn about one axis: no point moves along the floor, at the same time. Velocities of two times half a step apart
// differ by dt/2 w^2 r, which the springs of friction would add up.
TEST(body_coat, feels_no_friction_on_a_mesh_that_turns_as_it_does)
{
  const Real speed = 3;
  WallSpec spec = wall_of({floor_at_0(), cube({1.5, 0.5, kSide / 2 + kRadius - 0.005})});
  ContactLaw &law = spec.laws.front().law;
  law = classic_law(NormalModel::hooke, true);
  law.k_normal = law.k_tangent = kStiffness;
  law.mu = 0.5;
  spec.meshes[0].motion.add(turning({0, 0, 0}, {0, 0, 1}, 2 * kPi / speed));
  BodySpec &body = spec.meshes[1].body;
  body.joint = {JointKind::hinge, {0, 0, 0}, {0, 0, 1}};
  body.omega = {0, 0, speed};
  Scene scene(spec);
  scene.go(100);
  const Vec3 force = scene.wall->totals().mesh(0).force;
  const Real pressed = kPointsOfFace * kStiffness * 0.005;
  EXPECT_NEAR(force.z, -pressed, 1e-9);
  EXPECT_LT(std::hypot(force.x, force.y), 1e-9 * pressed);
}

// The joint holds it along the normal, where n.K n is 0. Dampers of N points, gamma M / N each, stop its slide.
TEST(body_coat, slides_on_its_joint_against_dampers_that_take_its_mass)
{
  WallSpec spec = wall_of({floor_at_0(), cube({0, 0, kSide / 2 + kRadius - 0.005}, {0.1, 0, 0})});
  ContactLaw &law = spec.laws.front().law;
  law = classic_law(NormalModel::hooke, false);
  law.k_normal = kStiffness;
  law.eta = 20;
  law.gamma_tangent = 0.65;
  law.mu = 10;
  spec.meshes[1].body.joint = {JointKind::slider, {0, 0, 0}, {1, 0, 0}};
  Scene scene(spec);
  scene.go(1000);
  // Leapfrog with a damper that lags is off by half a step of its rate, 3e-4, times the time.
  const Real rate = law.gamma_tangent;
  EXPECT_NEAR(scene.body(1).velocity().x / 0.1, std::exp(-rate * 1000 * scene.dt), 1e-3);
}

// A crawler: the belt of its own surface drives it to minus the belt's speed, by mu g until there. So does that of a
// surface that turns, about the axis of its hinge. A belt below carries it along.
TEST(body_coat, is_driven_by_its_own_belt_and_carried_along_by_that_of_another_mesh)
{
  const Real mu = 0.2, speed = 0.5;
  const struct {
    int mesh;
    bool turns;
  } belts[] = {{1, false}, {1, true}, {0, false}};
  for (const auto &[mesh, turns] : belts) {
    const int sign = mesh == 1 ? -1 : 1;
    WallSpec spec = wall_of({floor_at_0(), cube({0, 0, kSide / 2 + kRadius - 0.005})});
    spec.laws.front().law = frictional();
    spec.laws.front().law.mu = mu;
    spec.laws.front().law.gamma_tangent = 20;
    SurfaceMotion &belt = spec.meshes[mesh].surface;
    (turns ? belt.angular.z : belt.velocity.x) = speed;
    BodySpec &body = spec.meshes[1].body;
    body.joint = {turns ? JointKind::hinge : JointKind::slider, {0, 0, 0}, {0, 0, 1}};
    if (!turns) body.joint.axis = {1, 0, 0};
    Scene scene(spec);
    scene.set_up();
    const auto at = [&, turns = turns] {
      return turns ? scene.body(1).omega().z : scene.body(1).velocity().x;
    };
    const Real pressed = kPointsOfFace * kStiffness * 0.005;
    scene.run(100);
    // Springs of friction need mu F / (kt v) of the time to give way, 2 % of it.
    if (!turns) {
      EXPECT_NEAR(at(), sign * mu * pressed / kMass * 0.1, 0.1 * mu * pressed / kMass * 0.1);
    }
    scene.run(3000);
    EXPECT_NEAR(at(), sign * speed, 0.02 * speed) << mesh << turns;
  }
}

// Grids are those of the box of spheres, where no coat is. The floor at rest, one that glides along itself, and one
// beside the plane of two dimensions.
TEST(body_coat, lies_on_what_is_outside_of_the_box)
{
  for (const int kind : {0, 1, 2}) {
    WallSpec spec = wall_of({floor_at_0(), cube({0, 0, kSide / 2 + kRadius}, {0, 20, 0})});
    spec.laws.front().law.eta = 10;
    if (kind == 1) spec.meshes[0].motion.add(linear({0.5, 0, 0}));
    Scene scene(spec);
    scene.gravity[2] = -kGravity;
    PeriodicBox &box = scene.host.simulation;
    const Real half = kind == 2 ? 0.1 : 3;
    box.corner = {-3, -half, -3};
    box.edge[1] = {0, 2 * half, 0};
    for (const int k : {0, 2}) box.edge[k] = k == 0 ? Vec3{6, 0, 0} : Vec3{0, 0, 6};
    scene.go(400);
    const RigidBody &b = scene.body(1);
    EXPECT_NEAR(b.centre().y, 8, 1e-9) << kind;
    EXPECT_NEAR(b.centre().z, kSide / 2 + kRadius, 0.01) << kind;
    EXPECT_LT(norm(rotate(b.turn(), {0, 0, 1}) - Vec3{0, 0, 1}), 1e-9) << kind;
  }
}

// The floor goes over a periodic face, and the cube is on what comes in at the other side: on images, whose numbers are
// others where a larger sphere asks for more of them. Saved springs are on what the images are of. The points of a coat are
// spheres, also of a wall whose grains may be none.
TEST(body_coat, keeps_its_springs_on_images_whose_numbers_change)
{
  FakeHost host, other;
  for (FakeHost *h : {&host, &other}) {
    h->simulation = wide_box();
    h->simulation.periodic[0] = true;
  }
  MeshSpec across = floor_at_0();
  across.placement.move({50, 0, 0});
  WallSpec spec = wall_of({across, cube({-45, 0, kSide / 2 + kRadius - 0.005}, {1, 0.3, 0})});
  spec.shapes = true;
  spec.laws.front().law = frictional();
  spec.laws.front().law.eta = 0;
  Scene whole(host, spec), second(other, spec);
  whole.gravity[2] = second.gravity[2] = -kGravity;
  whole.look_every = second.look_every = 1;
  whole.go(100);
  whole.add({20, 30, 30}, 3);
  whole.run(200);
  EXPECT_GT(whole.wall->save().meshes[1].coat.size(), 20u);
  second.restore(whole);
  whole.run(300);
  second.go(300);
  EXPECT_LT(norm(whole.body(1).velocity()), 0.9);    // friction acts
  EXPECT_TRUE(is_same_pose(whole.body(1).pose(), second.body(1).pose()));
  for (const FakeHost *h : {&host, &other})
    for (const std::string &warning : h->warnings) EXPECT_FALSE(has(warning, "springs"));
}

TEST(body_coat, begins_without_springs_where_the_saved_ones_are_of_another_coat)
{
  WallSpec spec = wall_of({floor_at_0(), cube({0, 0, kSide / 2 + kRadius - 0.005})});
  spec.laws.front().law = frictional();
  Scene first(spec);
  first.go(2);
  spec.meshes[1].body.coat.spacing = 0.5;
  Scene second(spec);
  second.restore(first);
  ASSERT_EQ(second.host.warnings.size(), 1u);
  EXPECT_TRUE(has(second.host.warnings[0], "the springs of its coat start from zero"));
}

TEST(body_coat, loses_springs_on_a_mesh_that_is_another_one)
{
  WallSpec spec = wall_of({floor_at_0(), cube({0, 0, kSide / 2 + kRadius - 0.005})});
  spec.laws.front().law = frictional();
  Scene first(spec);
  first.go(2);
  spec.meshes[0] = floor_at_0(12);
  Scene second(spec);
  second.restore(first);
  second.set_up();
  EXPECT_EQ(n_warnings(second.host, "points of its coat lose their springs"), 1);
}

TEST(body_coat, has_the_same_bits_on_any_number_of_processes)
{
  std::vector<Pose> poses;
  std::mutex lock;
  WallSpec spec = wall_of({floor_at_0(), cube({0, 0, kSide / 2 + kRadius + 0.02}, {1, 0, 0}),
                           cube({0.3, 0.5, 1.5 * kSide + 3 * kRadius}, {0, 0, -1})});
  spec.laws.front().law = frictional();
  for (const int n : {1, 2, 4})
    on_processes(n, [&](FakeHost &host) {
      Scene scene(host, spec);
      scene.gravity[2] = -kGravity;
      scene.go(400);
      const Pose lower = scene.body(1).pose(), upper = scene.body(2).pose();
      const std::lock_guard<std::mutex> hold(lock);
      poses.push_back(lower);
      poses.push_back(upper);
    });
  ASSERT_EQ(poses.size(), 14u);
  for (std::size_t i = 2; i < poses.size(); i++)
    EXPECT_TRUE(is_same_pose(poses[i % 2], poses[i])) << i;
}

TEST(body_coat, tells_its_points_and_its_errors_in_the_log)
{
  WallSpec spec = wall_of({floor_at_0(), cube({0, 0, 5})});
  spec.meshes[1].body.coat = {true, 0, 0};
  Scene scene(spec);
  std::string all;
  for (const std::string &line : scene.host.lines) all += line;
  // A diagonal of 2 sqrt(3) over 30, and 0.75 of that; 0.75 - sqrt(0.75^2 - 1/3) of it.
  EXPECT_TRUE(has(all, "points at most 0.11547 apart, of radius 0.0866025: other meshes feel the "
                       "body 0.0866025 outside of "
                       "its surface; their edges and corners sink up to 0.0313"));
}

}    // namespace lsdcd::test_body_coat
