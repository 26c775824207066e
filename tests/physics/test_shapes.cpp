// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Grains that are no spheres, moved by forces of a wall: closed forms, and what must not depend on the mesh.
#include "base/input_error.h"
#include "shape/superellipsoid.h"
#include "support/cut_surface.h"
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/shape_scene.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace lsdcd::test_shapes {
namespace {

constexpr Real kStiff = 1e5;    // weight 1 sinks by 1e-5
const EngineSettings kRough = hooke_history(kStiff, kStiff, 200, 100, 0.5);

// ---- balls ---------------------------------------------------------------------------------

Real wear_power_of(WallEngine &engine)
{
  Real sum = 0;
  for (const StepContact &c : engine.results().contacts()) sum += c.wear_power;
  return sum;
}

// One grain and one sphere that are moved alike through a mesh.
struct Pair {
  ShapeScene grain;
  Scene sphere;

  Pair(const TriangleSoup &soup, Real r, const EngineSettings &law) :
      grain(soup, r, for_shapes(law)), sphere(soup, r, law)
  {
    grain.add({0, 0, 0}, {r, r, r});
    sphere.add_sphere({0, 0, 0}, r, 1);
  }
  Real overlap_ratio(const Vec3 &x)
  {
    sphere.set_x(0, x);
    sphere.set_v(0, {0, 0, 0});
    sphere.compute(kDt, false);
    return sphere.engine->results().totals().largest_overlap_ratio;
  }
  // Returns how far forces and torques differ.
  Real differ(const Vec3 &x, const Vec3 &v, const Vec3 &omega)
  {
    grain.x[0] = x;
    grain.v[0] = v;
    grain.spin(0, omega);
    sphere.set_x(0, x);
    sphere.set_v(0, v);
    sphere.set_omega(0, omega);
    grain.compute(kDt);
    sphere.compute(kDt);
    return norm(grain.force[0] - sphere.force(0)) + norm(grain.torque[0] - sphere.torque(0));
  }
  Real wear_differs()
  {
    return std::fabs(wear_power_of(*grain.engine) - wear_power_of(*sphere.engine));
  }
  static constexpr Real kDt = 1e-3;
};

TEST(shapes, of_equal_axes_have_the_forces_of_spheres)
{
  constexpr Real kRadius = 0.5;
  std::vector<TriangleSoup> meshes = {floor_mesh(6, 1.2, 3),
                                      mesh_with_junction(true),
                                      mesh_with_junction(false),
                                      box_mesh({-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}),
                                      box_mesh({-0.1, -0.2, -1}, {0.1, 0.2, 0}),
                                      cone_mesh(12, 0.6, 0.4),
                                      cylinder_mesh(24, 3, 0.7, 2),
                                      faces_all_round(7)};
  for (Real degrees : {30., 90., 150., 179.9, 180.1, 210., 270., 330.})
    meshes.push_back(hinge_mesh(degrees, 1.5));
  std::vector<EngineSettings> laws = {hooke(1e3, 2, 1, 0.4), hooke_history(1e3, 600, 2, 1, 0.4),
                                      hertz_history(1e3, 600, 2, 1, 0.4)};
  laws.push_back(granular(NormalModel::hertz, 1e3));
  laws.back().law().damping = DampingModel::viscoelastic;
  laws.back().law().eta = 0.2;
  laws.back().law().tangential = TangentialModel::linear_history;
  laws.back().law().k_tangent = 600;
  laws.back().law().xgammat = 0.5;
  laws.back().law().mu = 0.4;
  for (std::size_t k = 0; k < laws.size(); k++) {
    laws[k].contacts = true;
    laws[k].wear = k % 2 ? WearModel::archard : WearModel::finnie;
  }
  std::mt19937_64 random(7);
  std::uniform_real_distribution<Real> in(-1, 1);
  int touched = 0, wore = 0;
  for (std::size_t m = 0; m < meshes.size(); m++) {
    for (const EngineSettings &law : laws) {
      Pair pair(meshes[m], kRadius, law);
      Vec3 x = {0, 0, 0}, v = {0, 0, 0};
      Real worst = 0;
      for (int k = 0; k < 120; k++) {
        // A new place now and then, and steps from there. Contacts of grains fade where they end at a fold; to rounding a ball has
        // the forces of a sphere where it overlaps by a twentieth of its radius at most, as they bear nothing there by then.
        if (k % 12 == 0) {
          x = {0.8 * in(random), 0.8 * in(random), 0.8 * in(random)};
          v = 0.02 * Vec3{in(random), in(random), in(random)};
          for (int i = 0; i < 200 && pair.overlap_ratio(x) > 0.04; i++)
            x += 0.03 * kRadius * unit(pair.sphere.force(0));
          if (pair.overlap_ratio(x) > 0.04) x = {50, 50, 50};
          pair.grain.springs.clear(0);
          pair.sphere.springs.clear(0);
        }
        x += 0.02 * v;
        worst = std::fmax(worst, pair.differ(x, v, 3 * Vec3{in(random), in(random), in(random)}));
        worst = std::fmax(worst, pair.wear_differs());
        touched += norm_sq(pair.sphere.force(0)) > 0;
        wore += wear_power_of(*pair.sphere.engine) > 0;
      }
      // Forces are to 1e3; feet and normals are right to some 1e-15 of the radius, and a normal over an edge that is
      // almost in the surface by that over the overlap.
      EXPECT_LE(worst, 1e-9) << "mesh " << m << ", law " << &law - laws.data();
    }
  }
  EXPECT_GT(touched, 2000);
  EXPECT_GT(wore, 1000);
}

// ---- on a plane ----------------------------------------------------------------------------

// Period of small rocking about y, of an ellipsoid of half-axes 3, 2, 1 along x, y, z on a plane: by the times at which it
// is upright.
Real rocking_period(const EngineSettings &law, Real amplitude, Real dt)
{
  constexpr Real kGravity = 9.81e-3;    // mm/ms^2
  const Real sunk = kGravity / law.law().k_normal;
  ShapeScene scene(floor_mesh(1, 8), 3, for_shapes(law));
  const int i = scene.add({0, 0, 0}, {3, 2, 1});
  scene.shapes[i].turn = rotation_about({0, 1, 0}, amplitude);
  scene.x[i] = {0, 0, std::hypot(3 * std::sin(amplitude), std::cos(amplitude)) - sunk};
  scene.keep_candidates(dt);
  std::vector<Real> turns;
  Real was = 0;
  for (int k = 0; turns.size() < 3; k++) {
    scene.step(dt, {0, 0, -kGravity});
    const Real now = scene.shapes[i].turn.v.y;
    if (was * now < 0) turns.push_back(k + was / (was - now));
    if (k > 1000000) return 0;
    was = now;
  }
  return (turns[2] - turns[0]) * dt;
}

TEST(shapes, rock_on_a_plane_with_the_period_of_their_curvature)
{
  constexpr Real kStiffness = 9.81e-3 / 1e-5, kAmplitude = 1e-3;
  const Real dt = 0.02 / std::sqrt(kStiffness);
  // Upright is seen to 1e-3 of a step; the spring along the plane, which begins without a load, shakes it by 1e-5 of a period.
  // T = 2 pi sqrt((I + m c^2)/(m g (a^2/c - c))) where it rolls, without m c^2 where it slides.
  EXPECT_NEAR(rocking_period(hooke_history(kStiffness, kStiffness, 0, 0, 1e3), kAmplitude, dt),
              38.8473, 38.8473e-4);
  EXPECT_NEAR(rocking_period(hooke(kStiffness), kAmplitude, dt), 31.7187, 31.7187e-4);
}

// An ellipsoid of half-axes 2, 1, 1 and mass 1 that comes down with speed 1, its long axis at 45 degrees to a plane.
struct Impact {
  Real contact, centre, spin;    // velocities after it, of the touching point and upwards
};
Impact impact(const EngineSettings &law, Real dt)
{
  ShapeScene scene(floor_mesh(1, 8), 2, for_shapes(law));
  const int i = scene.add({0, 0, 0}, {2, 1, 1});
  scene.shapes[i].turn = rotation_about({0, 1, 0}, kPi / 4);
  const Real height = std::sqrt(2.5);
  scene.x[i] = {0, 0, height + 1e-6};
  scene.v[i] = {0, 0, -1};
  scene.compute(dt, false);
  bool touched = false;
  for (int k = 0; k < 100000; k++) {
    scene.step(dt);
    const bool touches = norm_sq(scene.force[i]) > 0;
    if (touched && !touches) break;
    touched |= touches;
  }
  const Vec3 w = scene.omega_of(i);
  return {scene.v[i].z + 0.948683 * std::fabs(w.y), scene.v[i].z, std::fabs(w.y)};
}

TEST(shapes, leave_an_eccentric_impact_as_the_mobility_of_the_point_has_it)
{
  constexpr Real kStiffness = 1e8;
  const Real dt = 0.005 / std::sqrt(kStiffness);
  const Impact elastic = impact(hooke(kStiffness), dt);
  EXPECT_NEAR(elastic.centre, 0.052632, 5e-5);
  EXPECT_NEAR(elastic.spin, 0.998614, 1e-5);
  // A damping by m that returns 0.8 of a sphere.
  EngineSettings damped = granular(NormalModel::hooke, kStiffness);
  const Real l = std::log(0.8);
  damped.law().damping = DampingModel::mass_velocity;
  damped.law().eta = -2 * std::sqrt(kStiffness) * l / std::sqrt(kPi * kPi + l * l);
  const Impact lossy = impact(damped, dt);
  EXPECT_NEAR(lossy.contact, 0.734708, 2e-3);
  EXPECT_NEAR(lossy.centre, -0.0870, 1e-3);
  EXPECT_NEAR(lossy.spin, 0.8662, 1e-3);
}

// ---- beside an own integration -----------------------------------------------------------------

// An ellipsoid of mass 1 over the plane z = 0 under gravity, by its equations of motion and no code of ours: k overlap less a damping
// upwards, friction of at most mu times it against the way of the touching point, the rotation as a matrix whose rows are its axes.
struct OwnEllipsoid {
  using Long = long double;
  struct State {
    Long at[18];    // x, v, three axes, angular momentum
  };
  Long half[3], stiffness, damping, rub, mu, gravity;

  static void cross(const Long *a, const Long *b, Long *c)
  {
    for (int k = 0; k < 3; k++)
      c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
  }
  static Long dot(const Long *a, const Long *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  State rate(const State &s) const
  {
    const Long *x = s.at, *v = s.at + 3, *axis = s.at + 6, *l = s.at + 15;
    Long height = 0, arm[3] = {0, 0, 0}, omega[3] = {0, 0, 0}, force[3] = {0, 0, 0}, point[3];
    for (int k = 0; k < 3; k++) height += half[k] * half[k] * axis[3 * k + 2] * axis[3 * k + 2];
    height = std::sqrt(height);
    for (int k = 0; k < 3; k++) {
      const Long squares =
          half[(k + 1) % 3] * half[(k + 1) % 3] + half[(k + 2) % 3] * half[(k + 2) % 3];
      for (int j = 0; j < 3; j++) {
        arm[j] -= half[k] * half[k] * axis[3 * k + 2] / height * axis[3 * k + j];
        omega[j] += dot(axis + 3 * k, l) / (squares / 5) * axis[3 * k + j];
      }
    }
    cross(omega, arm, point);
    for (int j = 0; j < 3; j++) point[j] += v[j];
    if (x[2] < height) {
      force[2] = stiffness * (height - x[2]) - damping * point[2];
      const Long speed = std::sqrt(point[0] * point[0] + point[1] * point[1]);
      const Long friction = std::min(mu * std::fabs(force[2]), rub * speed);
      for (int j = 0; j < 2; j++) force[j] = speed > 0 ? -friction * point[j] / speed : 0;
    }
    State r;
    cross(arm, force, r.at + 15);
    for (int k = 0; k < 3; k++) {
      cross(omega, axis + 3 * k, r.at + 6 + 3 * k);
      r.at[k] = v[k];
      r.at[3 + k] = force[k] - (k == 2 ? gravity : 0);
    }
    return r;
  }
  static State sum(const State &a, Long f, const State &b)
  {
    State s;
    for (int k = 0; k < 18; k++) s.at[k] = a.at[k] + f * b.at[k];
    return s;
  }
  // By the classical method of Runge and Kutta.
  State step(const State &s, Long dt) const
  {
    const State a = rate(s), b = rate(sum(s, dt / 2, a)), c = rate(sum(s, dt / 2, b)),
                d = rate(sum(s, dt, c));
    return sum(sum(sum(sum(s, dt / 6, a), dt / 3, b), dt / 3, c), dt / 6, d);
  }
};

TEST(shapes, slide_and_roll_on_a_plane_as_their_equations_of_motion_have_it)
{
  constexpr Real kStiffness = 1e4, kRub = 20, kDamp = 20, kMu = 0.1;
  const Vec3 half = {1.05, 0.95, 0.9};
  Real off[2];
  for (int fine : {0, 1}) {
    const int n_steps = 10000 << fine;
    const Real dt = 4.0 / n_steps;
    ShapeScene scene(floor_mesh(7, 8, 5), 1.5, for_shapes(hooke(kStiffness, kDamp, kRub, kMu)));
    // From where it lies as deep as its weight, so that it never leaves the plane: it slides for about 1, and then rolls.
    const Quaternion turn = rotation_about({0.6, 0, 0.8}, 0.9);
    const Vec3 down = rotate(inverse(turn), {0, 0, -1});
    scene.add({-2, 0.1, support(make_superellipsoid(half, 2, 2), down).height - 1 / kStiffness},
              half);
    scene.shapes[0].turn = turn;
    scene.v[0] = {0.4, 0.1, 0};
    OwnEllipsoid own = {{half.x, half.y, half.z}, kStiffness, kDamp, kRub, kMu, 1};
    OwnEllipsoid::State s;
    for (int k = 0; k < 3; k++) {
      Vec3 axis = {0, 0, 0};
      axis[k] = 1;
      axis = rotate(scene.shapes[0].turn, axis);
      s.at[k] = scene.x[0][k];
      s.at[3 + k] = scene.v[0][k];
      for (int j = 0; j < 3; j++) s.at[6 + 3 * k + j] = axis[j];
      s.at[15 + k] = scene.momentum[0][k];
    }
    scene.keep_candidates(dt);
    for (int k = 0; k < n_steps; k++) {
      scene.step(dt, {0, 0, -1});
      s = own.step(s, dt);
    }
    off[fine] = 0;
    for (int k = 0; k < 3; k++)
      off[fine] = std::fmax(off[fine], std::fabs(scene.x[0][k] - Real(s.at[k])) +
                                           std::fabs(scene.momentum[0][k] - Real(s.at[15 + k])));
    EXPECT_GT(norm(scene.omega_of(0)), 0.05);    // it rolls
  }
  // Damping takes the velocity of half a step before, in which friction changes it by kMu dt/2 = 2e-5 at most: so far a damped
  // motion is behind, and a momentum by 2/5 of that. They part by the step.
  EXPECT_LE(off[0], 3e-5);
  EXPECT_LE(off[1], off[0] / 1.8);
}

// ---- rails -----------------------------------------------------------------------------------

// A ridge along y at x, with its edge at z = 0.
TriangleSoup ridge(Real x)
{
  TriangleSoup soup;
  soup.source = "ridge";
  const Vec3 a = {x, -3, 0}, b = {x, 3, 0}, l = {x - 0.5, -3, -1}, m = {x - 0.5, 3, -1},
             r = {x + 0.5, -3, -1}, q = {x + 0.5, 3, -1};
  soup.corners = {l, m, a, m, b, a, a, b, r, b, q, r};
  return soup;
}

TEST(shapes, a_block_on_two_rails_rests_with_half_its_weight_on_each)
{
  TriangleSoup rails = ridge(-3);
  append(rails, ridge(3));
  constexpr Real kStiffness = 1e4, kGravity = 1;
  ShapeScene scene(rails, 5.4, for_shapes(hooke_history(kStiffness, kStiffness, 40, 20, 0.5)));
  const int i = scene.add({0, 0, 1 - 0.5 * kGravity / kStiffness}, {5, 1, 1}, 8, 8);
  scene.shapes[i].turn = rotation_about({0, 1, 0}, 1e-4);    // one end is three overlaps deeper
  const Real dt = 0.05 / std::sqrt(kStiffness);
  scene.compute(dt, false);
  Real worst = 0;
  for (int k = 0; k < 4000; k++) {
    scene.step(dt, {0, 0, -kGravity});
    if (k < 3000) continue;
    // The difference of the two is the torque about y over the arm.
    worst = std::fmax(worst, std::fabs(scene.torque[i].y / 3 / kGravity));
    worst = std::fmax(worst, std::fabs(scene.force[i].z / kGravity - 1));
    EXPECT_EQ(scene.engine->results().totals().contacts, 2);
  }
  EXPECT_LE(worst, 1e-3);
}

// ---- rest --------------------------------------------------------------------------------------

// The largest kinetic energy over weight times overlap, way over the overlap, and force less the weight, after a while.
struct Rest {
  Real kinetic = 0, creep = 0, force = 0;
};
Rest rest(ShapeScene &scene, int settle, int stay)
{
  const Real dt = 0.03 / std::sqrt(kStiff), sunk = 1 / kStiff;
  Rest most;
  Vec3 from = {0, 0, 0};
  scene.keep_candidates(dt);
  for (int k = 0; k < settle + stay; k++) {
    scene.step(dt, {0, 0, -1});
    if (k == settle) from = scene.x[0];
    if (k < settle) continue;
    const Real kinetic = scene.energy(0) - scene.engine->results().totals().energy;
    most.kinetic = std::fmax(most.kinetic, kinetic / sunk);
    most.creep = std::fmax(most.creep, norm(scene.x[0] - from) / sunk);
    most.force = std::fmax(most.force, norm(scene.force[0] - Vec3{0, 0, 1}));
  }
  return most;
}

void expect_rest_on_a_plane(int n_steps)
{
  for (Real n : {2., 4., 8., 20.}) {
    ShapeScene scene(floor_mesh(1, 8), 4, for_shapes(kRough));
    scene.add({0, 0, 0.7}, {1.2, 1, 0.7}, n, n);
    // A grain of a flat side flickers: 1e-3 and 3e-3 for n of 8 and 20.
    const Rest most = rest(scene, 3000, n_steps);
    EXPECT_LE(most.kinetic, 0.05) << n;
    EXPECT_LE(most.creep, 1) << n;
  }
}

TEST(shapes, rest_on_a_plane)
{
  expect_rest_on_a_plane(10000);
}
TEST(shapes, rest_on_a_plane_for_100000_steps_RELEASE)
{
  expect_rest_on_a_plane(100000);
}

// Two sides that meet in a line along y at x = 0 and rise from it, `degrees` from one plane.
TriangleSoup shallow_fold(Real degrees)
{
  TriangleSoup soup;
  soup.source = "fold";
  const Real h = 8 * std::tan(degrees / 360 * kPi);
  const Vec3 a = {-8, -8, h}, b = {0, -8, 0}, c = {8, -8, h}, d = {-8, 8, h}, e = {0, 8, 0},
             f = {8, 8, h};
  soup.corners = {a, b, e, a, e, d, b, c, f, b, f, e};
  return soup;
}

TEST(shapes, rods_rest_across_a_fold_and_along_it)
{
  for (Real n : {2., 8.})
    for (Real degrees : {1., 10., 30.})
      for (Real aside : {0., 0.3, kPi / 2}) {
        ShapeScene scene(shallow_fold(degrees), 5.4, for_shapes(kRough));
        scene.add({0, 0, 0}, {5, 1, 1}, n, n);
        scene.shapes[0].turn = rotation_about({0, 0, 1}, aside);
        // Where it touches both sides.
        const Real rise = degrees / 360 * kPi;
        const Vec3 down =
            rotate(inverse(scene.shapes[0].turn), {std::sin(rise), 0, -std::cos(rise)});
        scene.x[0].z = support(make_superellipsoid({5, 1, 1}, n, n), down).height / std::cos(rise);
        const Rest most = rest(scene, 3500, 500);
        EXPECT_LE(most.kinetic, 0.05) << n << ", " << degrees << ", " << aside;
        EXPECT_LE(most.creep, 1) << n << ", " << degrees << ", " << aside;
        EXPECT_LE(most.force, 0.02) << n << ", " << degrees << ", " << aside;
      }
}

// A rod of half-axes a, b, b across a drum of radius R touches it at two places, where it is a circle that holds the rod's
// ellipse: the centre is c below the drum's axis, c^2 = (R^2 - a^2)(a^2 - b^2)/a^2.
TEST(shapes, a_rod_across_a_drum_rests_on_both_ends_where_the_circle_has_them)
{
  constexpr Real kRadius = 2, a = 1.5, b = 0.3;
  const Real c = std::sqrt((kRadius * kRadius - a * a) * (a * a - b * b)) / a;
  for (int along : {1, 6}) {
    constexpr int kSides = 1024;
    ShapeScene scene(cylinder_mesh(kSides, along, kRadius, 3), 1.6, for_shapes(kRough));
    const int i = scene.add({0, -c, 1.4}, {a, b, b});
    const Real dt = 0.03 / std::sqrt(kStiff);
    scene.keep_candidates(dt);
    Real worst = 0;
    for (int k = 0; k < 4000; k++) {
      scene.step(dt, {0, -1, 0});
      if (k < 3500) continue;
      EXPECT_EQ(scene.engine->results().totals().contacts, 2);
      // Half the weight each: the arm is what the touching points are apart.
      worst = std::fmax(worst, std::fabs(scene.torque[i].z) / a);
      worst = std::fmax(worst, std::fabs(scene.force[i].y - 1));
    }
    EXPECT_LE(worst, 1e-3) << along;
    // The sides are up to R (1 - cos(pi/n)) = 9e-6 nearer, and it sinks by 1e-5 of a weight of 1/2 over the cosine.
    EXPECT_NEAR(scene.x[i].y, -c, 3e-5) << along;
    EXPECT_NEAR(scene.x[i].x, 0, 1e-5) << along;
  }
}

// ---- the mesh is not felt --------------------------------------------------------------------

// Grains that slide and roll over a plane that is tilted against the axes, so that each triangle has another rounding. The paths on
// two meshes part by rounding, which each bounce makes larger, as does the path on the same mesh from 2e-15 beside.
void expect_alike_however_the_plane_is_cut(int n_steps)
{
  constexpr Real kStiffness = 1e4;
  const Real dt = 0.02 / std::sqrt(kStiffness);
  for (Real n : {2., 4., 8.}) {
    std::vector<std::unique_ptr<ShapeScene>> scenes;
    for (int pieces : {1, 1, 43}) {
      scenes.push_back(std::make_unique<ShapeScene>(
          cut(fold(0), pieces), 4, for_shapes(hooke_history(kStiffness, kStiffness, 5, 2, 0.3))));
      ShapeScene &scene = *scenes.back();
      scene.add(placed({-2, 0.1, 1.1}), {1.2, 0.8, 0.6}, n, n);
      scene.shapes[0].turn = kTurn * rotation_about({0.6, 0, 0.8}, 0.9);
      scene.v[0] = rotate(kTurn, {0.6, 0.1, 0});
      scene.spin(0, rotate(kTurn, {0.3, 1, 0.4}));
      scene.keep_candidates(dt);
    }
    scenes[1]->x[0].x += 2e-15;
    const Vec3 begin = scenes[0]->x[0], gravity = rotate(kTurn, {0.05, 0, -1});
    const auto apart = [&](int k) { return norm(scenes[0]->x[0] - scenes[k]->x[0]); };
    Real least = 1e-14;    // roundings of the first few steps
    for (int k = 0; k < n_steps; k++) {
      for (auto &scene : scenes) scene->step(dt, gravity);
      if (k % 1000 != 999) continue;
      least = std::fmax(least, apart(1));
      EXPECT_LE(apart(2), 100 * least) << n << " " << k;
    }
    EXPECT_GT(norm(scenes[0]->x[0] - begin), 0.6) << n;    // over several triangles
  }
}
TEST(shapes, roll_alike_over_a_plane_that_is_cut_otherwise)
{
  expect_alike_however_the_plane_is_cut(6000);
}
TEST(shapes, roll_alike_over_a_plane_that_is_cut_otherwise_for_100000_steps_RELEASE)
{
  expect_alike_however_the_plane_is_cut(100000);
}

// Grains that come down on a surface until they overlap it by a fifth of their least radius of curvature at most, with velocities.
// Returns one scene for each number of pieces of a triangle.
std::vector<std::unique_ptr<ShapeScene>> scenes_at(const std::vector<Vec3> &surface,
                                                   Real most_exponent, Corner corner,
                                                   const std::vector<int> &all_pieces)
{
  constexpr int kGrains = 60;
  constexpr Real kCutoff = 0.75, kDown = 0.02;
  std::vector<std::unique_ptr<ShapeScene>> scenes;
  EngineSettings settings = for_shapes(kRough);
  settings.corner = corner;
  for (int pieces : all_pieces)
    scenes.push_back(std::make_unique<ShapeScene>(cut(surface, pieces), kCutoff, settings));
  Random random(5);
  const Vec3 down = rotate(kTurn, {0, 0, -1});
  std::vector<Real> rho;
  for (int k = 0; k < kGrains; k++) {
    const Vec3 at = placed(uniform(random, {-1, -1, 4}, {1, 1, 4})),
               half = uniform(random, {0.1, 0.1, 0.1}, {0.4, 0.4, 0.4});
    const Real n1 = uniform(random, 2, most_exponent), n2 = uniform(random, 2, most_exponent);
    const Quaternion turn = rotation_about(random_unit(random), uniform(random, 0, 3));
    const Vec3 v = 0.01 * random_unit(random);
    rho.push_back(make_superellipsoid(half, n1, n2).rho);
    for (auto &scene : scenes) {
      const int i = scene->add(at, half, n1, n2);
      scene->shapes[i].turn = turn;
      scene->v[i] = v;
    }
  }
  // Steps down to the first contact, halves to where it begins.
  ShapeScene &first = *scenes[0];
  std::vector<Real> step(kGrains, kDown);
  for (int k = 0; k < 400; k++) {
    first.compute(1e-9, false);
    for (int i = 0; i < kGrains; i++) {
      const bool touches = norm(first.force[i]) > 0;
      if (touches || step[i] < kDown) step[i] = std::fmax(step[i] / 2, 1e-3 * rho[i]);
      first.x[i] += (touches ? -step[i] : step[i]) * down;
    }
  }
  for (int i = 0; i < kGrains; i++) first.x[i] += 0.2 * rho[i] * down;
  for (auto &scene : scenes) {
    scene->x = first.x;
    scene->compute(1e-4);
  }
  return scenes;
}
// Of 4, 4, 48 and 5 triangles, of some hundred and of 2e5. An overlap and a normal are exact to some roundings of coordinates of 1 to
// 10, 1e-15, over overlaps of 1e-4 at least. Where forces of a corner add, a contact that is found twice counts twice.
TEST(shapes, have_the_same_forces_on_surfaces_of_200000_triangles_RELEASE)
{
  struct Surface {
    std::vector<Vec3> corners;
    int most_pieces;
  };
  for (const Surface &surface : {Surface{fold(0), 224}, Surface{fold(60), 224},
                                 Surface{drum(24), 65}, Surface{bowl(5), 200}})
    for (Real most_exponent : {2., 8.})
      for (Corner corner : {Corner::blend, Corner::sum}) {
        const auto scenes =
            scenes_at(surface.corners, most_exponent, corner, {1, 7, surface.most_pieces});
        int n_touching = 0;
        for (std::size_t i = 0; i < scenes[0]->x.size(); i++) {
          const Vec3 force = scenes[0]->force[i], torque = scenes[0]->torque[i];
          const Real most = 1e-10 * norm(force);
          if (norm(force) > 0) n_touching++;
          for (std::size_t k : {1, 2}) {
            EXPECT_LE(norm(scenes[k]->force[i] - force), most) << k << " " << i;
            EXPECT_LE(norm(scenes[k]->torque[i] - torque), most) << k << " " << i;
          }
        }
        EXPECT_GE(n_touching, 55);
      }
}

// A grain that goes and turns through a mesh, and what it has at a place of its path.
struct Path {
  struct Pushed {
    Vec3 force, torque;
    Real overlap;    // the largest
    int contacts;

    Real differs(const Pushed &other) const
    {
      return norm(force - other.force) + norm(torque - other.torque);
    }
  };
  ShapeScene &scene;
  Vec3 from, way, axis;
  Quaternion turn;

  // s: how far it has turned, an angle.
  Pushed at(Real s) const
  {
    scene.x[0] = from + s * way;
    scene.shapes[0].turn = normalised(rotation_about((1 / norm(axis)) * axis, s) * turn);
    scene.compute(1e-3);
    const auto &totals = scene.engine->results().totals();
    const Vec3 &half = scene.shapes[0].half;
    return {scene.force[0], scene.torque[0],
            totals.largest_overlap_ratio * std::min({half.x, half.y, half.z}),
            static_cast<int>(totals.contacts)};
  }
  // Halves a step where it differs more, down to 1e-9, and returns the ends of that.
  std::pair<Pushed, Pushed> bisect(Real low, Real high) const
  {
    Pushed at_low = at(low), at_high = at(high);
    while (high - low > 1e-9) {
      const Real middle = 0.5 * (low + high);
      const Pushed here = at(middle);
      const bool first = here.differs(at_low) > here.differs(at_high);
      (first ? high : low) = middle;
      (first ? at_high : at_low) = here;
    }
    return {at_low, at_high};
  }
};
constexpr Real kShortest = 5e-10;    // a step of bisect() is this to twice this

// Cones are funnels from below.
std::vector<TriangleSoup> folds_and_corners()
{
  std::vector<TriangleSoup> meshes = {cone_mesh(9, 1.5, 1.2),
                                      box_mesh({-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}),
                                      box_mesh({-0.5, -0.6, -2}, {0.5, 0.6, 0})};
  for (Real degrees : {20., 60., 120., -40., -100.}) meshes.push_back(hinge_mesh(degrees, 3));
  return meshes;
}

TEST(shapes, keep_the_force_continuous_over_folds_and_corners)
{
  std::mt19937_64 random(11);
  std::uniform_real_distribution<Real> in(-1, 1);
  const auto vector = [&] { return Vec3{in(random), in(random), in(random)}; };
  const Vec3 half = {1.2, 0.7, 0.6};
  // Stiffness 1, arms up to 1.2, and the corner rule's turn of the force: slopes seen are up to 2.3.
  constexpr Real kStep = 4e-4, kSlope = 5;
  int compared = 0, bisected = 0;
  for (const TriangleSoup &mesh : folds_and_corners()) {
    ShapeScene scene(mesh, 1.2, for_shapes(hooke(1)));
    scene.add({0, 0, 0}, half);
    for (int k = 0; k < 6; k++) {
      const Vec3 from = 0.8 * vector();
      const Path path = {scene, from, vector(), vector(), normalised({in(random), vector()})};
      Path::Pushed was = path.at(0);
      Real worst = 0, worst_fine = 0;
      for (int i = 1; i < 1000; i++) {
        const Path::Pushed now = path.at(i * kStep);
        // Up to half of the least radius of curvature.
        if (now.overlap < 0.5 * 0.3 && was.overlap < 0.5 * 0.3) {
          worst = std::fmax(worst, now.differs(was));
          compared += norm_sq(now.force) > 0;
          if (now.contacts != was.contacts || (i % 40 == 0 && now.contacts > 0)) {
            const auto [low, high] = path.bisect((i - 1) * kStep, i * kStep);
            worst_fine = std::fmax(worst_fine, high.differs(low));
            bisected++;
          }
        }
        was = now;
      }
      EXPECT_LE(worst, kSlope * kStep);
      EXPECT_LE(worst_fine, kSlope * 2 * kShortest + 1e-14);
    }
  }
  EXPECT_GT(compared, 4000);
  EXPECT_GT(bisected, 100);
}

// The torque of a flat side, and with it the corner rule, has no slope: the point runs over the side as the root of the tilt.
TEST(shapes, of_flat_sides_keep_the_overlap_continuous_over_folds_and_corners)
{
  std::mt19937_64 random(12);
  std::uniform_real_distribution<Real> in(-1, 1);
  const auto vector = [&] { return Vec3{in(random), in(random), in(random)}; };
  const Vec3 half = {1.2, 0.7, 0.6};
  // That of the way, sqrt(3), and of the turning, 1.4.
  constexpr Real kStep = 2e-4, kSlope = 3.2;
  int compared = 0, bisected = 0;
  const std::vector<TriangleSoup> meshes = folds_and_corners();
  for (std::size_t m = 0; m < meshes.size(); m++)
    for (Real n : {4., 8.}) {
      ShapeScene scene(meshes[m], 2, for_shapes(hooke(1)));
      const int i = scene.add({0, 0, 0}, half, n, n);
      const Real rho = make_superellipsoid(half, n, n).rho;
      for (int k = 0; k < 5; k++) {
        // From far away, or from the middle of a box, until it touches.
        const Vec3 towards = unit(vector());
        Path path = {scene, {0, 0, 0}, vector(), vector(), normalised({in(random), vector()})};
        bool touches = false;
        for (Real s = 0; s < 4 && !touches; s += 0.1 * rho) {
          path.from = (m == 1 ? s : s - 4) * towards;
          touches = path.at(0).contacts > 0;
        }
        Path::Pushed was = path.at(0);
        for (int j = 1; j < 60 && touches; j++) {
          const Path::Pushed now = path.at(j * kStep);
          if (now.overlap < 0.5 * rho && was.overlap < 0.5 * rho) {
            EXPECT_LE(std::fabs(now.overlap - was.overlap), kSlope * kStep) << n << " " << m;
            compared += scene.force[i].x != 0;
            if (now.contacts != was.contacts || j % 20 == 0) {
              const auto [low, high] = path.bisect((j - 1) * kStep, j * kStep);
              EXPECT_LE(std::fabs(high.overlap - low.overlap), kSlope * 2 * kShortest + 1e-14)
                  << n << " " << m;
              // The force has no slope either where contacts share it, but goes on without a jump.
              EXPECT_LE(std::fabs(norm(high.force) - norm(low.force)), 0.1 * high.overlap + 1e-9)
                  << n << " " << m;
              bisected++;
            }
          }
          was = now;
        }
      }
    }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(bisected, 100);
}

// ---- energy ------------------------------------------------------------------------------------

// The mass that damping sees is that of all of a rigid body, and the moments of inertia are the grain's own.
TEST(shapes, share_a_corner_alike_in_a_body_of_any_mass)
{
  Vec3 force[2], torque[2];
  for (int k = 0; k < 2; k++) {
    ShapeScene scene(hinge_mesh(40, 3), 3, for_shapes(hooke(kStiff)));
    const int i = scene.add({0, 0, 0}, {2, 1, 0.6});
    scene.shapes[i].turn = rotation_about({0.6, 0, 0.8}, 0.7);
    scene.mass[i] = k ? 100 : 1;
    // Down the bisector of the fold, and a little farther than where it touches both sides.
    const Vec3 up = {std::cos(110 * kPi / 180), 0, std::sin(110 * kPi / 180)};
    Real height = 3;
    for (int left = 20; left > 0 && height > 0; height -= 1e-3) {
      scene.x[i] = height * up + Vec3{0, 0.2, 0};
      scene.compute(1e-6);
      if (scene.engine->results().totals().contacts == 2) left--;
    }
    EXPECT_EQ(scene.engine->results().totals().contacts, 2) << k;
    force[k] = scene.force[i];
    torque[k] = scene.torque[i];
  }
  EXPECT_EQ(norm(force[1] - force[0]), 0);
  EXPECT_EQ(norm(torque[1] - torque[0]), 0);
}

// Grains that become larger than candidates were chosen for, within the reach of the grid and past it.
TEST(shapes, that_grow_after_the_choice_are_an_error_at_the_next_look)
{
  for (const Real half : {1., 1.2, 2.}) {
    ShapeScene scene(floor_mesh(1, 8), 1.5, for_shapes(hooke(kStiff)));
    const int i = scene.add({0, 0, 0.9}, {1, 0.6, 0.6});
    scene.compute(1e-6);
    scene.shapes[i].half.x = scene.radius[i] = half;
    scene.step_as_chosen(1e-6);
    if (half == 1)
      EXPECT_NO_THROW(scene.engine->read_diagnostics());
    else
      EXPECT_THROW(scene.engine->read_diagnostics(), InputError) << half;
  }
}

// The least mass with which a point of a grain of mass 1 moves along its normal: 1/m_e = 1 + t.I^-1 t, t = r x n. By all normals
// of a fine net.
Real least_mass_of_a_contact(const Vec3 &half, Real n)
{
  const Superellipsoid s = make_superellipsoid(half, n, n);
  const Vec3 inertia = inertia_over_mass(s);
  constexpr int kNet = 200;
  Real most = 1;
  for (int i = 0; i <= kNet; i++)
    for (int j = 0; j <= kNet; j++) {
      const Real up = kPi / 2 * i / kNet, round = kPi / 2 * j / kNet;
      const Vec3 normal = {std::cos(up) * std::cos(round), std::cos(up) * std::sin(round),
                           std::sin(up)};
      const Vec3 t = cross(support(s, normal).point, normal);
      most = std::fmax(most,
                       1 + t.x * t.x / inertia.x + t.y * t.y / inertia.y + t.z * t.z / inertia.z);
    }
  return 1 / most;
}

// How the energy of a grain in a closed box changes, over what it was: at most, and from the first tenth of the steps to the last.
struct EnergyChange {
  Real most = 0, trend = 0, each = 0;    // each: root mean square from one flight to the next
  int bounces = 0;
  Real overlap = 0;    // mean of the deepest of each bounce, over the least half-axis
};
EnergyChange energy_change(const EngineSettings &law, const Vec3 &half, Real n, Real dt,
                           int n_steps)
{
  ShapeScene scene(box_mesh({-1.6, -1.7, -1.8}, {1.6, 1.7, 1.8}), 2.5, for_shapes(law));
  scene.add({0.1, 0.2, 0.3}, half, n, n);
  scene.v[0] = {1.1, 0.9, -0.7};
  scene.spin(0, {0.3, -0.5, 0.8});
  scene.compute(dt, false);
  const Real begin = scene.energy(0);
  EnergyChange change;
  Real first = 0, last = 0, square = 0, flight = begin, deepest = 0;
  int n_first = 0, n_last = 0;
  bool touched = false;
  for (int k = 0; k < n_steps; k++) {
    scene.step(dt);
    const Real energy = scene.energy(0);
    change.most = std::fmax(change.most, std::fabs(energy / begin - 1));
    // Flights alone: in a contact the energy of velocity Verlet swings by the square of the step.
    const bool touches = scene.engine->results().totals().contacts > 0;
    deepest = std::fmax(deepest, scene.engine->results().totals().largest_overlap_ratio);
    if (touched && !touches) {
      change.bounces++;
      change.overlap += deepest;
      deepest = 0;
      square += (energy / flight - 1) * (energy / flight - 1);
      flight = energy;
    }
    touched = touches;
    if (touches) continue;
    if (k < n_steps / 10) first += energy, n_first++;
    if (k >= n_steps - n_steps / 10) last += energy, n_last++;
  }
  change.overlap /= change.bounces;
  change.each = std::sqrt(square / change.bounces);
  change.trend = last / n_last / (first / n_first) - 1;
  return change;
}

// By the least sqrt(mass / stiffness) of a contact.
EnergyChange energy_change_of_hooke(const Vec3 &half, Real n, Real part, int n_steps)
{
  constexpr Real kStiffness = 1e4;
  const Real dt = part * std::sqrt(least_mass_of_a_contact(half, n) / kStiffness);
  return energy_change(hooke(kStiffness), half, n, dt, n_steps);
}

// Velocity Verlet meets the kink of the force where a contact begins and ends at any phase of a step, so that each bounce
// leaves another energy, by the square of the step, and the energy goes as at random.
void expect_the_energy_of_balls(int n_steps)
{
  const EnergyChange ball = energy_change_of_hooke({1, 1, 1}, 2, 0.05, n_steps);
  for (const Vec3 &half : {Vec3{1.2, 0.9, 0.8}, Vec3{1.4, 0.7, 0.7}, Vec3{1.5, 0.5, 0.3}}) {
    const EnergyChange coarse = energy_change_of_hooke(half, 2, 0.05, n_steps),
                       fine = energy_change_of_hooke(half, 2, 0.025, n_steps);
    EXPECT_LE(coarse.each, 2 * ball.each) << half.x;
    EXPECT_LE(fine.each, coarse.each / 2) << half.x;
    for (const EnergyChange &c : {coarse, fine}) {
      const Real at_random = c.each * std::sqrt(Real(c.bounces));
      EXPECT_LE(std::fabs(c.trend), 3 * at_random) << half.x;
      EXPECT_LE(c.most, 4 * at_random) << half.x;
    }
  }
}
TEST(shapes, keep_their_energy_as_balls_do)
{
  expect_the_energy_of_balls(20000);
}
TEST(shapes, keep_their_energy_as_balls_do_for_1000000_steps_RELEASE)
{
  expect_the_energy_of_balls(1000000);
}

// Hertz's contact radius follows the curvature, and two contacts of a flat side share a force by their arms: neither is quite
// conservative. The page fix_wall_lsdcd has these figures.
TEST(shapes, change_the_energy_of_a_bounce_as_the_page_has_it_for_300000_steps_RELEASE)
{
  constexpr Real kStiffness = 1e4;
  const Real dt = 0.02 / std::sqrt(kStiffness);
  const struct {
    EngineSettings law;
    Real n, overlap, each;
  } rows[] = {{hooke(kStiffness), 2, 0.015, 3e-5},
              {hooke(kStiffness), 4, 0.015, 4e-5},
              {hooke(kStiffness), 8, 0.015, 3e-4},
              {hertz_history(4 * kStiffness, 0, 0, 0, 0), 2, 0.03, 3e-3},
              {hertz_history(4 * kStiffness, 0, 0, 0, 0), 4, 0.03, 7e-3},
              {hertz_history(4 * kStiffness, 0, 0, 0, 0), 8, 0.03, 7e-3}};
  for (const auto &row : rows) {
    const EnergyChange c = energy_change(row.law, {1.2, 0.6, 0.6}, row.n, dt, 300000);
    EXPECT_NEAR(c.overlap, row.overlap, 0.2 * row.overlap) << row.n;
    // 70 to 140 bounces, of which few are the large ones.
    EXPECT_NEAR(c.each, row.each, 0.4 * row.each) << row.n;
  }
}

}    // namespace
}    // namespace lsdcd::test_shapes
