// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Springs over T-junctions and shallow corners, sides of a wall, a billiard: against closed forms.
#include "support/laws.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace lsdcd::test_motion {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kMass = 2;

// ---- springs over T-junctions of a plane (seams: test_slide) -------------------------------------

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

TEST(spring, force_is_continuous_over_a_shallow_seam_CPU)
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

// Whichever way the facets are wound.
TEST(side, pushes_a_crossed_centre_back)
{
  const TriangleSoup box = box_mesh({0, 0, 0}, {4, 4, 4});
  TriangleSoup other = box;
  for (std::size_t t = 0; t < box.n_triangles(); t++)
    std::swap(other.corners[3 * t], other.corners[3 * t + 1]);
  for (const TriangleSoup &soup : {box, other})
    for (const Side side : {Side::out, Side::in}) {
      const Real up = side == Side::out ? 1 : -1;
      Scene scene(soup, kRadius, sided(side));
      for (Real deep : {-0.4, -0.01, 0., 0.01, 0.2, 0.49}) {
        const Vec3 f = force_at(scene, {2.1, 1.7, 4 - up * deep});
        EXPECT_LE(norm(f - Vec3{0, 0, up * kStiffness * (kRadius + deep)}), kClose) << deep;
      }
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

// ---- energy ---------------------------------------------------------------------------------------

// In free flight; test_energy has a box.
TEST(billiard, in_a_drum_of_flat_facets_keeps_its_energy_CPU)
{
  constexpr int kSteps = 200000;
  const Real w = kPi / 100, dt = w / std::sqrt(kStiffness / kMass);
  const Vec3 v = {7, 4, 5.5};
  Scene scene(cylinder_mesh(24, 2, 2, 3), kRadius, hooke(kStiffness));
  scene.add_sphere({0.2, 0.1, 1.1}, kRadius, kMass, v);
  scene.compute(dt);
  Real drift = 0;
  int touched = 0;
  for (int i = 0; i < kSteps; i++) {
    scene.step(dt, {0, 0, 0});
    touched += norm_sq(scene.force(0)) > 0;
    if (norm_sq(scene.force(0)) == 0)
      drift = std::fmax(drift, std::fabs(norm_sq(scene.v(0)) / norm_sq(v) - 1));
  }
  EXPECT_GT(touched, kSteps / 100);
  // Velocity Verlet: entering and leaving within a step costs (omega dt)^2 / 8 a
  // bounce at most, of either sign; 2000 bounces add up as their root.
  EXPECT_LE(drift, 50 * w * w);
}

}    // namespace
}    // namespace lsdcd::test_motion
