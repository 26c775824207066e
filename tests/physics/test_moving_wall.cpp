// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A mesh that moves as a rigid body: Galilei's and Newton's answers.
#include "support/crowd.h"
#include "support/meshes.h"
#include "support/motions.h"
#include "support/named_laws.h"
#include "support/test_engine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lsdcd::test_moving_wall {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kMass = 2, kStep = 1e-4;

EngineSettings moving(EngineSettings s)
{
  s.moves = true;
  return s;
}

RigidMotion rotating(const Vec3 &point, const Vec3 &axis, Real period)
{
  return motion_of({turning(point, axis, period)});
}

// Spheres that cross a wall of random triangles, in one scene at rest and in one that is turned
// and drives past at constant velocity: all that a wall does is the same in its frame.
struct Twins {
  Twins(const EngineSettings &s, const Pose &at) : pose(at)
  {
    const Real cutoff = cutoff_of(s.law(), kRadius);
    rest = std::make_unique<Scene>(random_soup(600, 5), cutoff, s);
    driven = std::make_unique<Scene>(random_soup(600, 5), cutoff, moving(s));
    std::mt19937_64 random(3);
    std::uniform_real_distribution<Real> place(-0.3, 1.3), speed(-3, 3);
    const MeshReport &r = rest->mesh.report;
    for (int i = 0; i < 500; i++) {
      Vec3 x, v, omega;
      for (int d = 0; d < 3; d++) {
        x[d] = r.lo[d] + place(random) * (r.hi[d] - r.lo[d]);
        v[d] = speed(random);
        omega[d] = speed(random);
      }
      rest->add_sphere(x, kRadius, kMass, v, omega);
      driven->add_sphere(x, kRadius, kMass, pose.turn_to_box(v) + pose.velocity,
                         pose.turn_to_box(omega));
    }
  }

  void step()
  {
    for (int i = 0; i < rest->n(); i++) {
      rest->set_x(i, rest->x(i) + kStep * rest->v(i));
      driven->set_x(i, pose.to_box(rest->x(i)));
    }
    driven->engine->set_pose(pose);
    rest->compute(kStep, true, true);
    driven->compute(kStep, true, true);
    pose.shift += kStep * pose.velocity;
  }

  Pose pose;
  std::unique_ptr<Scene> rest, driven;
};

Pose some_pose()
{
  Pose pose = rotating({1, 2, 3}, {1, -1, 0.5}, 1).pose_at(0.137).still();
  pose.velocity = {3, -2, 1};
  return pose;
}

// Places of size 10 are rounded to 2e-15, which a stiffness of 1e5 to 1e6 (corners share their
// overlap, with angles as small as 1e-2) makes 1e-7 of forces of 1e4 at most.
TEST(moving_wall, turned_and_driven_at_constant_velocity_acts_as_at_rest)
{
  for (const NamedLaw &law : laws(kStiffness)) {
    Twins twins(law.settings, some_pose());
    for (int k = 0; k < 5; k++) twins.step();
    int touching = 0;
    for (int i = 0; i < twins.rest->n(); i++) {
      const Vec3 f = twins.rest->force(i), t = twins.rest->torque(i);
      touching += norm(f) > 0;
      EXPECT_LE(norm(twins.pose.turn_to_mesh(twins.driven->force(i)) - f), 1e-7) << law.name;
      EXPECT_LE(norm(twins.pose.turn_to_mesh(twins.driven->torque(i)) - t), 1e-7) << law.name;
      ASSERT_EQ(twins.driven->springs.count(i), twins.rest->springs.count(i)) << law.name;
    }
    EXPECT_GT(touching, 30) << law.name;
  }
}

// Totals about the box's origin and points of contact in the box's frame.
TEST(moving_wall, reports_in_the_frame_of_the_box)
{
  Twins twins(hooke(kStiffness, 50, 20, 0.4), some_pose());
  twins.step();
  Pose at = twins.pose;
  at.shift -= kStep * at.velocity;    // step() goes on to the next
  Vec3 force = {0, 0, 0}, torque = {0, 0, 0};
  const Scene &driven = *twins.driven;
  for (int i = 0; i < driven.n(); i++) {
    force -= driven.force(i);
    torque -= cross(driven.x(i), driven.force(i)) + driven.torque(i);
  }
  const WallTotals &totals = driven.engine->results().totals();
  // Sums of 1e2 forces of 1e4 at places of 10.
  EXPECT_LE(norm(totals.force - force), 1e-8);
  EXPECT_LE(norm(totals.torque - torque), 1e-7);
  ASSERT_EQ(driven.engine->results().n_touching(), twins.rest->engine->results().n_touching());
  for (int k = 0; k < driven.engine->results().n_touching(); k++) {
    const TouchingSphere &there = driven.engine->results().touching()[k],
                         &here = twins.rest->engine->results().touching()[k];
    EXPECT_LE(norm(there.point - at.to_box(here.point)), 1e-12);
    EXPECT_LE(norm(there.force - at.turn_to_box(here.force)), 1e-7);
  }
}

// A drum round z that turns: V = w x c at the point of contact, of half a step ago as the sphere's
// velocity is; its normal part pushes.
TEST(moving_wall, a_turning_drum_drags_and_pushes_with_the_velocity_at_the_contact)
{
  const Real gamma_n = 7, gamma_t = 3, w = 4;
  const RigidMotion motion = rotating({0, 0, 0}, {0, 0, 1}, 2 * kPi / w);
  Scene drum(cylinder_mesh(12, 1, 2, 4), kRadius, moving(hooke(kStiffness, gamma_n, gamma_t, 1e6)));
  const Real apothem = 2 * std::cos(kPi / 12), beside = 0.1, overlap = 0.01;
  const Vec3 n = {std::cos(kPi / 12), std::sin(kPi / 12), 0}, t = {-n.y, n.x, 0};
  const Vec3 closest = apothem * n + beside * t + Vec3{0, 0, 2.2};
  const Vec3 v = {0.3, -0.2, 0.1}, omega = {1, 2, 3};
  drum.add_sphere({0, 0, 0}, kRadius, kMass, v, omega);
  for (const Real time : {0.0, 0.3, 1.1}) {
    const Pose pose = motion.pose_at(time);
    const Vec3 normal = pose.turn_to_box(n), at = pose.to_box(closest);
    drum.set_x(0, at + (kRadius - overlap) * normal);
    drum.engine->set_pose(pose);
    drum.compute(kStep);
    const Vec3 turning = cross({0, 0, w}, at);
    const Vec3 slip = v - (turning - kStep / 2 * cross({0, 0, w}, turning));
    const Real v_normal = dot(slip, normal);
    const Vec3 along = slip - v_normal * normal - kRadius * cross(omega, normal);
    const Vec3 expected =
        (kStiffness * overlap - kMass * gamma_n * v_normal) * normal - (kMass * gamma_t) * along;
    EXPECT_LE(norm(drum.force(0) - expected), 1e-9);
    EXPECT_LE(norm(drum.torque(0) + kRadius * cross(normal, -(kMass * gamma_t) * along)), 1e-9);
  }
}

// A sphere that turns with the wall slips by w x n times the overlap, as the law takes the whole radius for
// the arm of a spin: without friction there is not even that.
TEST(moving_wall, without_friction_a_turning_drum_only_pushes)
{
  const RigidMotion motion = rotating({0, 0, 0}, {0, 0, 1}, 0.3);
  Scene drum(cylinder_mesh(40, 3, 2, 4), kRadius, moving(hooke_history(kStiffness, 3e4, 0, 40, 0)));
  drum.add_sphere({0, 0, 2}, kRadius, kMass);
  for (int k = 0; k < 200; k++) {
    const Real a = 0.03 * k;
    drum.set_x(0, {1.52 * std::cos(a), 1.52 * std::sin(a), 2});
    drum.engine->set_pose(motion.pose_at(1e-3 * k));
    drum.compute(1e-3);
    EXPECT_GT(norm(drum.force(0)), 0);
    EXPECT_EQ(norm(drum.torque(0)), 0);
  }
}

// A spring is kept in the frame of the wall: stretched once, it turns with it.
TEST(moving_wall, springs_turn_with_it)
{
  const RigidMotion motion = rotating({0, 0, 0}, {0, 0, 1}, 4);
  Scene scene(floor_mesh(4, 2), kRadius, moving(hooke_history(kStiffness, 3e4, 0, 0, 1e6)));
  scene.add_sphere({0, 0, kRadius - 0.01}, kRadius, kMass, {2, 0, 0});
  scene.engine->set_pose(Pose());
  scene.compute(kStep);
  const Vec3 before = scene.force(0);
  EXPECT_NEAR(before.x, -3e4 * 2 * kStep, 1e-12);
  // It stays at the axis, where the wall does not move, and a quarter turn passes at once.
  scene.set_v(0, {0, 0, 0});
  scene.engine->set_pose(motion.pose_at(1));
  scene.compute(kStep);
  EXPECT_LE(norm(scene.force(0) - Vec3{0, before.x, before.z}), 1e-9);
}

// A sphere that does not turn, held by friction at a radius of 1 on a turntable of 2000 steps a turn,
// which the motion of the mesh or that of its surface turns.
struct Turntable {
  static constexpr int kSteps = 2000;
  static constexpr Real kOmega = 2 * kPi, kDt = 1.0 / kSteps;

  explicit Turntable(bool mesh_turns) :
      mesh_turns(mesh_turns), scene(floor_mesh(4, 2), kRadius, settings(mesh_turns)),
      motion(rotating({0, 0, 0}, {0, 0, 1}, 1))
  {
    scene.add_sphere({1, 0, kRadius - 20 / kStiffness}, kRadius, kMass, {0, kOmega, 0});
    scene.more_forces = [](Scene &s, Real) { s.add_force(0, {0, 0, 0}, -s.torque(0)); };
    place();
    scene.compute(kDt, false);
  }
  static EngineSettings settings(bool mesh_turns)
  {
    EngineSettings s = hooke_history(kStiffness, 3e4, 50, 25, 1e6);
    if (mesh_turns) return moving(s);
    s.surface.angular = {0, 0, kOmega};
    return s;
  }
  void place()
  {
    if (mesh_turns) scene.engine->set_pose(motion.pose_at(Time(n) / kSteps));
  }
  void turns(int many)
  {
    for (int k = 0; k < many * kSteps; k++) {
      n++;
      place();
      scene.step(kDt, {0, 0, -10});
    }
  }
  Real radius() const { return std::hypot(scene.x(0).x, scene.x(0).y); }

  bool mesh_turns;
  Scene scene;
  RigidMotion motion;
  int n = 0;
};

// Velocities of half a step apart would draw it in by pi omega dt = 1e-2 a turn. The rest is of the order of (omega dt)^2 = 1e-5, of
// which a turn can make 2 pi times as much. Springs turn with a surface that turns as they do with a mesh: else the sphere lags behind
// by 2 pi m omega^2/kt = 0.017 a turn. Both differ by rounding and by (omega dt)^3 = 3e-8 a step.
TEST(moving_wall, what_it_carries_keeps_its_radius_whether_the_mesh_turns_or_its_surface)
{
  Turntable mesh(true), surface(false);
  for (Turntable *table : {&mesh, &surface}) table->turns(5);    // the swinging has died out
  EXPECT_LE(norm(mesh.scene.x(0) - surface.scene.x(0)), 1e-4);
  for (Turntable *table : {&mesh, &surface}) {
    const Real before = table->radius();
    table->turns(5);
    EXPECT_NEAR(table->radius(), before, 5 * 2 * kPi * 1e-5) << table->mesh_turns;
  }
}

// Friction of a sphere that is held is opposite to its sliding but for that: a spring of length h, at a distance r of the axis,
// lags by asin(h / r). In a step it turns by 1e-3.
TEST(moving_wall, friction_on_a_turntable_lags_by_the_length_of_its_spring)
{
  const Real r = 0.1, h = 0.014, stiffness = 1000, overlap = 0.01, mu = 0.4;
  EngineSettings s = hooke_history(stiffness, mu * stiffness * overlap / h, 0, 0, mu);
  s.surface.angular = {0, 0, 2};
  Scene scene(floor_mesh(4, 2), kRadius, s);
  scene.add_sphere({r, 0, kRadius - overlap}, kRadius, kMass);
  for (int n = 0; n < 2000; n++) scene.compute(5e-4);
  EXPECT_NEAR(std::atan2(-scene.force(0).x, scene.force(0).y), std::asin(h / r), 1e-3);
  EXPECT_NEAR(std::hypot(scene.force(0).x, scene.force(0).y), mu * stiffness * overlap, 1e-9);
}

// On a turntable, and on a wall whose surface turns: the same spring as under a sphere that spins the other way on one at rest.
TEST(moving_wall, rolling_and_twisting_are_relative_to_it)
{
  EngineSettings law;
  law.law() = everything(NormalModel::hooke);
  law.law().heat = HeatModel::none;
  const Real w = 1.7;
  const auto torque_of = [&](const EngineSettings &settings, Real spin) {
    Scene scene(floor_mesh(4, 2), kRadius, settings);
    scene.add_sphere({0, 0, kRadius - 0.01}, kRadius, kMass, {0, 0, 0}, {0, 0, spin});
    if (settings.moves)
      scene.engine->set_pose(rotating({0, 0, 0}, {0, 0, 1}, 2 * kPi / w).pose_at(0));
    scene.compute(kStep);
    return scene.torque(0);
  };
  const Vec3 wanted = torque_of(law, -w);
  EXPECT_GT(norm(wanted), 0);
  EngineSettings belt = law;
  belt.surface.angular = {0, 0, w};
  for (const EngineSettings &turns : {moving(law), belt}) {
    EXPECT_LE(norm(torque_of(turns, 0) - wanted), 1e-12 * norm(wanted)) << turns.moves;
    EXPECT_LE(norm(torque_of(turns, w)), 1e-12) << turns.moves;    // it turns with the wall
  }
}

// A belt on a machine that moves: the surface's velocity is in the frame of the mesh.
TEST(moving_wall, a_moving_surface_moves_with_it)
{
  EngineSettings s = hooke(kStiffness, 0, 3, 1e6);
  const SurfaceMotion belt = {{1.5, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  s.surface = belt;
  Scene scene(floor_mesh(4, 2), kRadius, moving(s));
  Pose pose = rotating({0, 0, 0}, {0, 0, 1}, 4).pose_at(1).still();
  pose.velocity = {0.25, 0, 0};
  scene.add_sphere({0, 0, kRadius - 0.01}, kRadius, kMass);
  scene.engine->set_pose(pose);
  scene.compute(kStep);
  EXPECT_LE(norm(scene.force(0) - Vec3{kMass * 3 * 0.25, kMass * 3 * 1.5, kStiffness * 0.01}),
            1e-9);
}

// Spheres in a turning wall over many steps of one choice: what is near, and what its lists hold.
TEST(moving_wall, a_choice_holds_while_nothing_goes_farther_than_its_margin)
{
  const TriangleSoup soup = random_soup(600, 5);
  const WeldedMesh mesh = weld(soup, -1);
  StepGridSettings g;
  g.cutoff = kRadius;
  const FlatOf<StepGrid> flat(build_grid(mesh, g));
  const EngineSettings law = moving(hooke(kStiffness, 50, 20, 0.4));
  const auto kept = make_test_engine(law), fresh = make_test_engine(law);
  kept->set_grid(flat.view());
  fresh->set_grid(flat.view());
  const int n = 800;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<Real> place(-0.2, 1.2);
  SphereArrays of[] = {{n, kRadius}, {n, kRadius}};
  for (SphereArrays &a : of) a.mass.assign(n, kMass);
  for (int i = 0; i < 3 * n; i++) {
    const Real lo = mesh.report.lo[i % 3], hi = mesh.report.hi[i % 3];
    of[0].x[i] = of[1].x[i] = lo + place(random) * (hi - lo);
  }
  const RigidMotion motion = rotating({0.5, 0.5, 0.5}, {1, 2, -1}, 1);
  const Box bounds = {mesh.report.lo - kRadius * Vec3{1, 1, 1},
                      mesh.report.hi + kRadius * Vec3{1, 1, 1}};
  const Real margin = 0.3;
  int steps = 0, near = 0;
  const auto spheres = [&](int which) {
    of[which].clear_forces();
    return of[which].spheres();
  };
  const Pose first = motion.pose_at(0.2);
  kept->set_pose(first);
  kept->choose(spheres(0), margin, true);
  StepSettings step;
  step.dt = kStep;
  bool moved = false;
  for (Real time = 0.2; !moved; time += 1e-4) {
    const Pose pose = motion.pose_at(time);
    if (farthest_between(first, pose, bounds) > margin) break;
    kept->set_pose(pose);
    fresh->set_pose(pose);
    const Spheres a = spheres(0), b = spheres(1);
    // No sphere goes farther, in the frame of the mesh, than a point of its bounds.
    moved = kept->has_moved(a);
    EXPECT_FALSE(moved && steps < 2);
    fresh->choose(b, 0);
    kept->step(a, step);
    fresh->step(b, step);
    if (moved) break;
    EXPECT_EQ(of[0].force, of[1].force) << "at " << time;
    near += fresh->n_candidates();
    steps++;
  }
  EXPECT_GT(steps, 5);
  EXPECT_GT(near, 100 * steps);
  // Spheres at rest have moved once the wall has.
  kept->set_pose(motion.pose_at(0.7));
  EXPECT_TRUE(kept->has_moved(spheres(0)));
  kept->set_pose(first);
  EXPECT_FALSE(kept->has_moved(spheres(0)));
}

}    // namespace
}    // namespace lsdcd::test_moving_wall
