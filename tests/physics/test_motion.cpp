// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How restitution converges, springs over seams and shallow corners, sides of a wall, billiards: against
// closed forms.
#include "support/laws.h"
#include "support/meshes.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace lsdcd::test_motion {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kMass = 2;
const Vec3 kNoGravity = {0, 0, 0};

// ---- bouncing --------------------------------------------------------------------------

// F = k overlap - m gamma v is a damped oscillator while they touch: it takes
// tc = pi / sqrt(k/m - gamma^2/4), and leaves exp(-gamma tc / 2) of the speed.
constexpr Real kGamma = 80;

Real contact_time()
{
  return kPi / std::sqrt(kStiffness / kMass - kGamma * kGamma / 4);
}

// Throws a sphere at point p of the wall along -n; its speed afterwards over before.
Real restitution(const TriangleSoup &soup, const Vec3 &p, const Vec3 &n, int steps_per_contact)
{
  Scene scene(soup, kRadius, hooke(kStiffness, kGamma));
  const Real dt = contact_time() / steps_per_contact, speed = 0.3;
  // Its first contact falls in the middle of a step.
  scene.add_sphere(p + (kRadius + 10.5 * dt * speed) * n, kRadius, kMass, -speed * n);
  scene.compute(dt);
  for (int i = 0; i < steps_per_contact + 40; i++) scene.step(dt, kNoGravity);
  EXPECT_EQ(scene.force(0), (Vec3{0, 0, 0})) << "still in contact";
  EXPECT_LE(norm(scene.v(0) - dot(scene.v(0), n) * n), 1e-12 * speed) << "pushed aside";
  return dot(scene.v(0), n) / speed;
}

TEST(bounce, converges_with_the_time_step)
{
  const Real e = std::exp(-kGamma * contact_time() / 2);
  const TriangleSoup soup = floor_mesh(4, 2);
  const Real coarse = std::fabs(restitution(soup, {0, 0, 0}, {0, 0, 1}, 500) - e);
  const Real fine = std::fabs(restitution(soup, {0, 0, 0}, {0, 0, 1}, 5000) - e);
  EXPECT_LE(fine, 0.2 * coarse);
}

// ---- springs over seams of a plane -----------------------------------------------------------

// Slides a sphere at constant velocity and watches its spring from step to step.
void expect_smooth_slide(const TriangleSoup &soup, const EngineSettings &law, const Vec3 &from,
                         const Vec3 &v, int n_steps)
{
  Scene scene(soup, kRadius, law);
  const Real dt = 1e-3, overlap = 0.02;
  const Real scale = law.law().is(NormalModel::hertz) ? std::sqrt(overlap * kRadius) : 1;
  scene.add_sphere(from, kRadius, kMass, v);
  Vec3 last = {0, 0, 0};
  for (int i = 1; i <= n_steps; i++) {
    const Vec3 x = from + (i * dt) * v;
    scene.set_x(0, x);
    scene.compute(dt);
    ASSERT_EQ(scene.springs.count(0), 1);
    const Vec3 h = scene.springs.of(0)->shear, path = (i * dt) * v;
    // Sums of i steps of v dt: a rounding of the spring's length each.
    ASSERT_LE(norm(h - last - dt * v), 1e-10 * norm(h)) << "at step " << i;
    ASSERT_LE(norm(h - path), 1e-10 * norm(path));
    const Vec3 f = scene.force(0), expected = (-scale * law.law().k_tangent) * path;
    // Overlaps round by 2e-14 of themselves here.
    ASSERT_LE(std::hypot(f.x - expected.x, f.y - expected.y), 1e-10 * norm(expected));
    last = h;
  }
}

TEST(spring, crosses_the_seams_of_a_plane_without_a_jump)
{
  const Real z = kRadius - 0.02;
  for (const EngineSettings &law :
       {hooke_history(kStiffness, 3e4, 0, 0, 1e6), hertz_history(kStiffness, 3e4, 0, 0, 1e6)}) {
    // Across jittered seams, along a line of edges, along diagonals through nodes.
    expect_smooth_slide(floor_mesh(40, 2, 5), law, {-1.4, -0.9, z}, {0.9, 0.63, 0}, 3000);
    expect_smooth_slide(floor_mesh(8, 2), law, {-1.4, 0, z}, {1, 0, 0}, 2800);
    expect_smooth_slide(floor_mesh(8, 2), law, {-1.4, -1.4, z}, {1, 1, 0}, 2800);
    expect_smooth_slide(floor_mesh(8, 2), law, {-1.5, -1.5, z}, {1, 1, 0}, 2800);
    expect_smooth_slide(floor_mesh(8, 2), law, {-1.4, 0, -z}, {1, 0.5, 0}, 2800);
  }
}

TEST(spring, crosses_t_junctions_without_a_jump)
{
  TriangleSoup soup = floor_mesh(4, 1);
  for (Vec3 &p : soup.corners) p.x -= 1;
  TriangleSoup other = floor_mesh(7, 1);
  for (Vec3 &p : other.corners) p.x += 1;
  append(soup, other);
  Scene scene(soup, kRadius, hooke_history(kStiffness, 3e4, 0, 0, 1e6));
  const Real dt = 1e-3;
  const Vec3 v = {1, 0.3, 0}, from = {-0.5, -0.2, kRadius - 0.02};
  scene.add_sphere(from, kRadius, kMass, v);
  for (int i = 1; i <= 1000; i++) {
    scene.set_x(0, from + (i * dt) * v);
    scene.compute(dt);
    const Vec3 f = scene.force(0), expected = (-3e4 * i * dt) * v;
    // Next to the junction both rims may share the force: they lean by 2e-8 at most.
    ASSERT_LE(std::hypot(f.x - expected.x, f.y - expected.y),
              1e-10 * norm(expected) + 2 * std::sqrt(kRoundoff) * kStiffness * 0.02)
        << i;
  }
}

// ---- springs over a shallow corner ---------------------------------------------------------------

// Rolls a sphere into a concave hinge and up its other side at a constant overlap,
// with a stretched spring. Returns the tangential force along the path, over that
// of the spring, at n places.
std::vector<Real> roll_over_hinge(Real degrees, int n, Real overlap)
{
  const Real a = degrees * kPi / 180, kt = 3e4, h0 = 1e-3, dt = 1e-3;
  Scene scene(hinge_mesh(degrees, 3), kRadius, hooke_history(kStiffness, kt, 0, 0, 0.5));
  const Real z = kRadius - overlap, turn = -z * std::tan(a / 2), half = 0.4;
  const Vec3 along = {std::cos(a), 0, std::sin(a)};
  // First a slide sideways that stretches the spring: mu k overlap is far from kt h0.
  const Vec3 start = {turn - half, 0, z};
  const int i = scene.add_sphere(start, kRadius, kMass, {0, h0 / dt, 0});
  scene.compute(dt);
  // Then it rolls without slip: v at the centre, omega so that the contact rests.
  const Real step = 2 * half / n, v = step / dt;
  scene.set_omega(i, {0, v / kRadius, 0});
  std::vector<Real> out;
  for (int k = 1; k <= n; k++) {
    const Real s = k * step - half;
    scene.set_x(i, s < 0 ? Vec3{turn + s, 0, z} : Vec3{turn, 0, z} + s * along);
    scene.set_v(i, s < 0 ? Vec3{v, 0, 0} : v * along);
    scene.compute(dt);
    out.push_back(-scene.force(i).y / (kt * h0));
  }
  return out;
}

// In the corner the weights add up to 2 / (1 + cos a), and what a contact is born with is cos a of its
// neighbour's.
void expect_kept(const std::vector<Real> &parts, Real degrees)
{
  const Real a = degrees * kPi / 180;
  const auto [least, most] = std::minmax_element(parts.begin(), parts.end());
  std::printf("  %g degrees: %.6f to %.6f of the spring\n", degrees, *least, *most);
  EXPECT_GE(*least, 1 - a * a) << degrees;
  EXPECT_LE(*most, 1 + a * a) << degrees;
}

TEST(spring, is_kept_by_a_sphere_that_rolls_over_a_shallow_seam)
{
  for (Real degrees : {1e-4, 0.1, 1., 5., 15.})
    expect_kept(roll_over_hinge(degrees, 4000, 0.02), degrees);
}

TEST(spring, is_kept_where_the_next_wall_is_first_touched_lightly)
{
  // At overlaps below R a^2 / 2 the next wall is first touched with no overlap, and
  // bears nothing until it is as deep as this one: the spring waits for that.
  for (Real degrees : {5., 15.}) expect_kept(roll_over_hinge(degrees, 20000, 0.001), degrees);
}

TEST(spring, force_is_continuous_over_a_shallow_seam)
{
  for (Real degrees : {1., 5., 15., 30.}) {
    const auto largest = [&](int n) {
      Real largest = 0;
      const std::vector<Real> f = roll_over_hinge(degrees, n, 0.02);
      for (std::size_t k = 1; k < f.size(); k++)
        largest = std::fmax(largest, std::fabs(f[k] - f[k - 1]));
      return largest;
    };
    // A spring that one contact hands to the next may change by the cosine.
    const Real a = degrees * kPi / 180;
    EXPECT_LE(largest(40000), 0.2 * largest(4000) + a * a) << degrees;
  }
}

TEST(spring, of_one_wall_is_not_given_to_the_other_of_a_right_angle)
{
  Scene scene(box_mesh({0, 0, 0}, {4, 4, 4}), kRadius, hooke_history(kStiffness, 3e4, 0, 0, 1e6));
  const Real dt = 1e-3, at = kRadius - 0.01;
  scene.add_sphere({2, 2, at}, kRadius, kMass, {0, 1, 0});
  for (int i = 0; i < 5; i++) scene.compute(dt);    // stretched along y on the floor
  scene.set_v(0, {0, 0, 0});
  const Real on_floor = scene.force(0).y;
  EXPECT_NEAR(on_floor, -3e4 * 5 * dt, 1e-9);
  scene.set_x(0, {at, 2, at});
  scene.compute(dt);
  ASSERT_EQ(scene.springs.count(0), 2);
  EXPECT_NEAR(scene.force(0).y, on_floor, 1e-9);
}

// ---- sides ---------------------------------------------------------------------------------------

EngineSettings sided(Side side)
{
  EngineSettings s = hooke(kStiffness);
  s.side = side;
  return s;
}

Vec3 force_at(Scene &scene, const Vec3 &x)
{
  if (scene.n() == 0) scene.add_sphere(x, kRadius, kMass);
  scene.set_x(0, x);
  scene.compute(1e-4, true, true);
  return scene.force(0);
}

constexpr Real kClose = 1e-12 * kStiffness;

TEST(side_out, pushes_a_crossed_centre_back_out)
{
  Scene scene(box_mesh({0, 0, 0}, {4, 4, 4}), kRadius, sided(Side::out));
  for (Real deep : {-0.4, -0.01, 0., 0.01, 0.2, 0.49}) {
    const Vec3 f = force_at(scene, {2.1, 1.7, 4 - deep});
    EXPECT_LE(norm(f - Vec3{0, 0, kStiffness * (kRadius + deep)}), kClose) << deep;
  }
}

TEST(side_in, pushes_a_crossed_centre_back_in)
{
  Scene scene(box_mesh({0, 0, 0}, {4, 4, 4}), kRadius, sided(Side::in));
  for (Real deep : {-0.4, -0.01, 0., 0.01, 0.2, 0.49}) {
    const Vec3 f = force_at(scene, {2.1, 1.7, 4 + deep});
    EXPECT_LE(norm(f - Vec3{0, 0, -kStiffness * (kRadius + deep)}), kClose) << deep;
  }
}

TEST(side_in, pushes_back_in_past_an_edge_and_a_corner)
{
  Scene scene(box_mesh({0, 0, 0}, {4, 4, 4}), kRadius, sided(Side::in));
  const Vec3 e = force_at(scene, {4.03, 2, 4.04});
  EXPECT_LE(norm(e + kStiffness * (kRadius + 0.05) * Vec3{0.6, 0, 0.8}), 10 * kClose);
  const Vec3 c = force_at(scene, {4.02, 4.03, 4.06});
  EXPECT_LE(norm(c + kStiffness * (kRadius + 0.07) * Vec3{2. / 7, 3. / 7, 6. / 7}), 10 * kClose);
}

TEST(side, does_not_hang_on_the_winding)
{
  TriangleSoup soup = box_mesh({0, 0, 0}, {4, 4, 4});
  for (std::size_t t = 0; t < soup.n_triangles(); t++)
    std::swap(soup.corners[3 * t], soup.corners[3 * t + 1]);
  Scene out(soup, kRadius, sided(Side::out)), in(soup, kRadius, sided(Side::in));
  EXPECT_LE(norm(force_at(out, {2, 2, 3.9}) - Vec3{0, 0, kStiffness * (kRadius + 0.1)}), kClose);
  EXPECT_LE(norm(force_at(in, {2, 2, 4.1}) + Vec3{0, 0, kStiffness * (kRadius + 0.1)}), kClose);
}

TEST(side_in, agrees_with_both_for_a_centre_that_has_not_crossed)
{
  Scene in(box_mesh({0, 0, 0}, {4, 4, 4}), kRadius, sided(Side::in));
  Scene both(box_mesh({0, 0, 0}, {4, 4, 4}), kRadius, sided(Side::both));
  for (const Vec3 &x :
       {Vec3{0.4, 2, 2}, Vec3{0.4, 0.3, 2}, Vec3{0.4, 0.3, 0.2}, Vec3{3.7, 3.6, 0.1}})
    EXPECT_EQ(force_at(in, x), force_at(both, x));
}

TEST(side_out, ignores_the_far_face_of_a_thin_plate)
{
  const Real t = 1e-3 * kRadius;
  Scene scene(box_mesh({-2, -2, -t}, {2, 2, 0}), kRadius, sided(Side::out));
  for (Real deep : {-0.4 * kRadius, -1e-3, 0., 0.3 * t, 0.49 * t}) {
    const Vec3 f = force_at(scene, {0.3, 0.2, -deep});
    EXPECT_LE(norm(f - Vec3{0, 0, kStiffness * (kRadius + deep)}), kClose) << deep;
    EXPECT_EQ(scene.engine->results().touching()[0].n_contacts, 1);
  }
}

TEST(side_both, lets_a_crossed_centre_through)
{
  Scene scene(floor_mesh(3, 2, 1), kRadius, sided(Side::both));
  EXPECT_GT(force_at(scene, {0.1, 0.2, 0.01}).z, 0);
  EXPECT_LT(force_at(scene, {0.1, 0.2, -0.01}).z, 0);
}

// ---- energy ---------------------------------------------------------------------------------------

// The largest drift of kinetic energy, in free flight, over n steps.
Real energy_drift(const TriangleSoup &soup, const Vec3 &x, const Vec3 &v, Real dt, int n)
{
  Scene scene(soup, kRadius, hooke(kStiffness));
  scene.add_sphere(x, kRadius, kMass, v);
  scene.compute(dt);
  Real drift = 0;
  int touched = 0;
  for (int i = 0; i < n; i++) {
    scene.step(dt, kNoGravity);
    touched += norm_sq(scene.force(0)) > 0;
    const Real e = 0.5 * kMass * norm_sq(scene.v(0)) + scene.engine->results().totals().energy;
    if (norm_sq(scene.force(0)) == 0)
      drift = std::fmax(drift, std::fabs(e / (0.5 * kMass * norm_sq(v)) - 1));
  }
  EXPECT_GT(touched, n / 100);
  return drift;
}

TEST(billiard, in_a_box_keeps_its_energy)
{
  // Velocity Verlet: entering and leaving within a step costs (omega dt)^2 / 8 a
  // bounce at most, of either sign; 2000 bounces add up as their root.
  const Real tc = kPi * std::sqrt(kMass / kStiffness), dt = tc / 100, w = kPi / 100;
  const Real drift =
      energy_drift(box_mesh({0, 0, 0}, {3, 2, 2.5}), {1, 0.9, 1.1}, {7, 4, 5.5}, dt, 200000);
  EXPECT_LE(drift, 50 * w * w);
}

TEST(billiard, in_a_drum_of_flat_facets_keeps_its_energy)
{
  const Real tc = kPi * std::sqrt(kMass / kStiffness), dt = tc / 100, w = kPi / 100;
  const Real drift =
      energy_drift(cylinder_mesh(24, 2, 2, 3), {0.2, 0.1, 1.1}, {7, 4, 5.5}, dt, 200000);
  EXPECT_LE(drift, 50 * w * w);
}

}    // namespace
}    // namespace lsdcd::test_motion
