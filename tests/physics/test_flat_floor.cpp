// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A triangulated plane is a plane: F = F(R - h), whatever lies under the sphere.
#include "support/laws.h"
#include "support/meshes.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace lsdcd::test_flat_floor {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kHalf = 4;

enum class Law { hooke, hertz };

EngineSettings engine_of(Law law)
{
  return law == Law::hooke ? hooke(kStiffness) : hertz_history(kStiffness, 0, 0, 0, 0);
}

Real plane_force(Law law, Real overlap)
{
  return law == Law::hooke ? kStiffness * overlap
                           : kStiffness * std::sqrt(kRadius * overlap) * overlap;
}

// Puts spheres over faces, edges and vertices of the soup, at all depths.
void put_spheres(Scene &scene, const TriangleSoup &soup, int n, unsigned seed, Real rim = kHalf)
{
  Random random(seed);
  for (int i = 0; scene.n() < n; i++) {
    const std::size_t t = 3 * (random() % soup.n_triangles());
    const Vec3 a = soup.corners[t], b = soup.corners[t + 1], c = soup.corners[t + 2];
    const Real u = uniform(random, 0, 1), v = uniform(random, 0, 1) * (1 - u);
    Vec3 q = a;
    if (i % 3 == 1) q = a + u * (b - a);
    if (i % 3 == 2) q = a + u * (b - a) + v * (c - a);
    if (random() % 4 == 0) q.x += std::pow(10., uniform(random, -16, -6));
    const Real depth = kRadius * std::pow(10., uniform(random, -3, -0.7));
    q.z = (random() % 2 ? 1 : -1) * (kRadius - depth);
    if (std::fabs(q.x) > rim || std::fabs(q.y) > rim) continue;
    scene.add_sphere(q, kRadius, 1);
  }
}

struct Deviation {
  Real force = 0, tangential = 0;    // largest, over the plane's force
  int most_contacts = 0, least_contacts = 1 << 20;
};

Deviation measure(Scene &scene, Law law)
{
  scene.compute(1e-4, true, true);
  Deviation d;
  for (int i = 0; i < scene.n(); i++) {
    const Vec3 f = scene.force(i), x = scene.x(i);
    const Real f0 = plane_force(law, kRadius - std::fabs(x.z));
    d.force = std::fmax(d.force, std::fabs((x.z > 0 ? f.z : -f.z) / f0 - 1));
    d.tangential = std::fmax(d.tangential, std::hypot(f.x, f.y) / f0);
  }
  EXPECT_EQ(scene.engine->results().n_touching(), scene.n());
  for (int k = 0; k < scene.engine->results().n_touching(); k++) {
    const int n = scene.engine->results().touching()[k].n_contacts;
    d.most_contacts = std::max(d.most_contacts, n);
    d.least_contacts = std::min(d.least_contacts, n);
  }
  return d;
}

// Normals and heights of a floor at z = 0 are exact; what is left are the few
// roundings of k (R - h), 1e-15, and of Hertz's root.
constexpr Real kExact = 1e-12;

void expect_plane(const TriangleSoup &soup, Real weld_tolerance = -1, Real force = kExact,
                  Real tangential = kExact, bool one_contact = true, Real rim = kHalf)
{
  for (Law law : {Law::hooke, Law::hertz}) {
    Scene scene(soup, kRadius, engine_of(law), 0, weld_tolerance);
    put_spheres(scene, soup, 3000, 1, rim);
    const Deviation d = measure(scene, law);
    EXPECT_LE(d.force, law == Law::hooke ? force : 1.5 * force);
    EXPECT_LE(d.tangential, tangential);
    EXPECT_GE(d.least_contacts, 1);
    if (one_contact) {
      EXPECT_EQ(d.most_contacts, 1);
    }
  }
}

// A floor turned by `tilt` about the y axis.
TriangleSoup tilted(TriangleSoup soup, Real tilt, Real height)
{
  for (Vec3 &p : soup.corners) p = {p.x, p.y, tilt * p.x + height};
  return soup;
}

TEST(flat_floor, of_2_triangles_is_a_plane)
{
  expect_plane(floor_mesh(1, kHalf));
}

TEST(flat_floor, of_200_triangles_is_a_plane)
{
  expect_plane(floor_mesh(10, kHalf));
}

TEST(flat_floor, of_200_jittered_triangles_of_mixed_winding_is_a_plane)
{
  for (unsigned seed : {1, 2, 3}) expect_plane(floor_mesh(10, kHalf, seed));
}

TEST(flat_floor, of_20000_jittered_triangles_of_mixed_winding_is_a_plane)
{
  expect_plane(floor_mesh(100, kHalf, 4));
}

TEST(flat_floor, with_t_junctions_is_a_plane)
{
  // Beside the junction its rim answers too, and bears nothing.
  expect_plane(split_floor(1, 7, 0, kHalf), -1, kExact, kExact, false, 0.7 * kHalf);
  expect_plane(turned(split_floor(3, 10, 0, kHalf), 0.3), -1, kExact, kExact, false, 0.7 * kHalf);
}

TEST(flat_floor, with_facets_given_twice_is_a_plane)
{
  TriangleSoup soup = floor_mesh(10, kHalf, 5), again = soup;
  for (std::size_t t = 0; t < again.n_triangles(); t++)
    if (t % 2) std::swap(again.corners[3 * t], again.corners[3 * t + 1]);
  append(soup, again);
  expect_plane(soup);
}

TEST(flat_floor, laid_twice_with_other_triangles_is_a_plane)
{
  TriangleSoup soup = floor_mesh(10, kHalf, 6);
  append(soup, floor_mesh(13, kHalf, 7));
  expect_plane(soup);
}

TEST(flat_floor, with_a_seam_1e_7_apart_is_a_plane_when_welded)
{
  // The weld, 1e-6 of the diagonal, closes the seam: facets change, the plane not.
  expect_plane(split_floor(4, 4, 1e-7, kHalf));
}

TEST(flat_floor, with_a_seam_1e_7_apart_is_a_plane_when_not_welded)
{
  // Over the gap both rims answer. They lie (gap/2)^2/2h below the plane's
  // distance, 1e-14 / 2.5e-3 of the least overlap here, and lean by gap/h.
  const Real gap = 1e-7, least_height = 0.4 * kRadius, least_overlap = 1e-3 * kRadius;
  const Real lean = gap / least_height;
  expect_plane(split_floor(4, 4, gap, kHalf), 0, lean * lean + gap * gap / least_overlap, lean,
               false);
}

TEST(flat_floor, with_halves_that_overlap_by_1e_7_is_a_plane)
{
  // As beside a T-junction.
  expect_plane(split_floor(4, 9, -1e-7, kHalf), 0, kExact, kExact, false);
}

TEST(flat_floor, on_a_sheet_1e_7_below_is_a_plane)
{
  // The lower sheet is parallel and adds nothing to what lies on top; from below
  // it is on top, 1e-7 nearer.
  TriangleSoup soup = floor_mesh(10, kHalf, 8);
  append(soup, tilted(floor_mesh(7, kHalf, 9), 0, -1e-7));
  expect_plane(soup, 0, 1e-7 / (1e-3 * kRadius) * (1 + 1e-6), kExact, false);
}

TEST(flat_floor, with_near_duplicate_sheets_deviates_by_their_distance_over_the_overlap)
{
  // Sheets that lean by up to 1e-7 cross each other: between them 1e-7 times the
  // half width at most, and the force leans no more than the sheets do.
  const Real lean = 1e-7, apart = lean * kHalf, least_overlap = 1e-3 * kRadius;
  TriangleSoup soup = floor_mesh(10, kHalf, 10);
  append(soup, tilted(floor_mesh(9, kHalf, 11), lean, 0));
  expect_plane(soup, 0, 1.01 * apart / least_overlap, 1.01 * lean, false);
  append(soup, tilted(floor_mesh(7, kHalf, 12), -lean, 0));
  append(soup, tilted(floor_mesh(8, kHalf, 13), lean / 3, lean / 10));
  expect_plane(soup, 0, 1.2 * apart / least_overlap, 1.01 * lean, false);
}

TEST(flat_floor, that_leans_in_space_is_a_plane)
{
  // Turned about two axes and moved off, so that no coordinate is exact: vertices
  // are off the plane by roundings of the size of their coordinates.
  const TriangleSoup flat = floor_mesh(10, kHalf, 14);
  const Vec3 n = {0.36, 0.48, 0.8}, u = {0.8, -0.6, 0}, v = cross(n, u), at = {3, 5, 7};
  TriangleSoup soup = flat;
  for (Vec3 &p : soup.corners) p = at + p.x * u + p.y * v;
  Scene level(flat, kRadius, hooke(kStiffness)), scene(soup, kRadius, hooke(kStiffness));
  put_spheres(level, flat, 3000, 2);
  for (int i = 0; i < level.n(); i++) {
    const Vec3 x = level.x(i);
    scene.add_sphere(at + x.x * u + x.y * v + x.z * n, kRadius, 1);
  }
  level.compute(1e-4);
  scene.compute(1e-4, true, true);
  // Coordinates up to 13 round by 1e-15; a facet of height 0.1 turns that into a
  // lean of 2e-14 and a closest point on it into 1e-14 of height.
  const Real tolerance = kStiffness * 4e-14;
  for (int i = 0; i < level.n(); i++)
    ASSERT_LE(norm(scene.force(i) - level.force(i).z * n), tolerance);
  EXPECT_EQ(scene.engine->results().totals().contacts, scene.n());
}

TEST(flat_floor, takes_the_opposite_of_the_forces_it_exerts)
{
  Scene scene(floor_mesh(10, kHalf, 15), kRadius, hooke(kStiffness));
  put_spheres(scene, floor_mesh(10, kHalf, 15), 1000, 3);
  scene.compute(1e-4);
  Vec3 sum = {0, 0, 0}, moment = {0, 0, 0};
  Real size = 0;
  for (int i = 0; i < scene.n(); i++) {
    sum += scene.force(i);
    size += norm(scene.force(i));
    const Vec3 closest = {scene.x(i).x, scene.x(i).y, 0};
    moment += cross(closest, scene.force(i));
  }
  // A thousand roundings.
  EXPECT_LE(norm(scene.engine->results().totals().force + sum), 1e-13 * size);
  EXPECT_LE(norm(scene.engine->results().totals().torque + moment), 1e-13 * size * kHalf);
}

}    // namespace
}    // namespace lsdcd::test_flat_floor
