// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Contacts in float: how far forces in mixed and single precision are from double.
#include "contact/find_contacts.h"
#include "support/device.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/random_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lsdcd::test_precision {
namespace {

constexpr Real kFloatRoundoff = 0x1p-24;

EngineSettings with(EngineSettings settings, Precision precision)
{
  settings.precision = precision;
  return settings;
}

// A height over a plane takes three products and three sums of coordinates up to reach
// and 14 cells, normals rounded to floats: BrickGeometry::tolerance bounds it.
Real height_error(const Scene &scene)
{
  return BrickGeometry::tolerance(scene.grid.view());
}

// A sphere's force on a floor of many triangles: k (R - z) everywhere, straight up.
void expect_flat(Precision precision, Real half, const Vec3 &at)
{
  TriangleSoup soup = floor_mesh(40, half, 9);
  for (Vec3 &p : soup.corners) p += at;
  const Real k = 1e4, radius = 1;
  Scene scene(soup, radius, with(hooke(k), precision));
  Numbers random(3);
  for (int i = 0; i < 2000; i++) {
    const Real x = random.in(-0.7, 0.7) * half, y = random.in(-0.7, 0.7) * half;
    scene.add_sphere(at + Vec3{x, y, random.in(0.5, 0.999) * radius}, radius, 1);
  }
  scene.compute(1e-6);
  // The law in float rounds overlap, force and energy: three units.
  const Real law = precision == Precision::single_ ? 3 * kFloatRoundoff : 0;
  for (int i = 0; i < scene.n(); i++) {
    const Real overlap = radius - (scene.x(i).z - at.z), tolerance = k * height_error(scene);
    EXPECT_NEAR(scene.force(i).z, k * overlap, tolerance + law * k * overlap) << i;
    EXPECT_LE(std::hypot(scene.force(i).x, scene.force(i).y), 1e-15 * k) << i;
  }
  EXPECT_EQ(scene.engine->totals().contacts, scene.n());
}

TEST(mixed, floor_bears_the_same_everywhere)
{
  expect_flat(Precision::mixed, 20, {0, 0, 0});
}

TEST(single, floor_bears_the_same_everywhere)
{
  expect_flat(Precision::single_, 20, {0, 0, 0});
}

// Plain float coordinates would be off by 0.06 radii here.
TEST(mixed, does_not_lose_digits_a_million_radii_from_the_origin)
{
  expect_flat(Precision::mixed, 20, {1e6, -1e6, 1e6});
}

// A plane that is anchored at the corner of a face a thousand radii long would be off by
// 1e-4 radii.
TEST(mixed, does_not_lose_digits_on_faces_of_a_thousand_radii)
{
  TriangleSoup soup = floor_mesh(1, 1000, 0);
  for (Vec3 &p : soup.corners) p.z = 0.3 * p.x + 0.2 * p.y;    // or a zero would be exact
  const Real k = 1e4;
  Scene scene(soup, 1, with(hooke(k), Precision::mixed), 1);
  const Vec3 normal = (1 / std::sqrt(1.13)) * Vec3{-0.3, -0.2, 1};
  Numbers random(7);
  std::vector<Real> overlap;
  for (int i = 0; i < 500; i++) {
    const Real x = random.in(-900, 900), y = random.in(-900, 900);
    overlap.push_back(random.in(0.01, 0.5));
    scene.add_sphere(Vec3{x, y, 0.3 * x + 0.2 * y} + (1 - overlap[i]) * normal, 1, 1);
  }
  scene.compute(1e-6);
  for (int i = 0; i < scene.n(); i++)
    EXPECT_NEAR(norm(scene.force(i)), k * overlap[i], k * height_error(scene)) << i;
}

// The total of blended contacts moves with the root of a shift of their heights at most:
// it turns by no more than the fold between two normals, and by no more than the shift
// over that fold. Each of n contacts may shift.
Real force_error(const Scene &scene, Real k, Real radius, int n)
{
  const Real shift = 4 * height_error(scene);
  return 4 * n * k * (shift + std::sqrt(2 * shift * radius));
}

using Set = ContactSet<512>;

// Do two answers name the same features?
bool agree(const Set &a, const Set &b)
{
  bool all = a.n == b.n;
  for (int i = 0; i < a.n && all; i++)
    all =
        std::find(b.feature.data(), b.feature.data() + b.n, a.feature[i]) != b.feature.data() + b.n;
  return all;
}

// Deep in a steep fold a closest point leaves its face while it still bears, and the force jumps,
// in double as well; rounding then decides on which side of the jump a sphere is. Those
// few are counted, not compared.
TEST(mixed, forces_follow_those_of_double_on_meshes_of_all_kinds)
{
  long touching = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 80; seed++) {
    const RandomMesh made = random_mesh(seed);
    const WeldedMesh mesh = weld(made.soup, 0);
    if (norm(mesh.report.hi - mesh.report.lo) > 60 * made.cutoff) continue;
    const Real k = 1, length = 0.4 * made.cutoff;
    Scene exact(made.soup, made.cutoff, hooke(k), length, 0);
    Scene mixed(made.soup, made.cutoff, with(hooke(k), Precision::mixed), length, 0);
    Numbers random(seed);
    for (int i = 0; i < 500; i++) {
      const Vec3 q = random_centre(random, made.soup.corners.data(), int(made.soup.n_triangles()),
                                   mesh.report.lo, mesh.report.hi, made.cutoff);
      const Real radius = made.cutoff * random.in(0.3, 1);
      exact.add_sphere(q, radius, 1);
      mixed.add_sphere(q, radius, 1);
    }
    exact.compute(1e-6);
    mixed.compute(1e-6);
    touching += exact.engine->totals().contacts;
    for (int i = 0; i < exact.n(); i++) {
      // Where a centre is on the wall, its side is a matter of rounding.
      Real nearest = 2 * made.cutoff;
      Set set, in_floats;
      find_contacts(exact.grid.view(), exact.x(i), exact.radius(i), set);
      find_contacts(mixed.grid.view(), exact.x(i), exact.radius(i), in_floats);
      for (int c = 0; c < set.n; c++) nearest = std::fmin(nearest, set.distance[c]);
      if (nearest < 0.05 * made.cutoff) continue;
      const Real error = norm(mixed.force(i) - exact.force(i)),
                 bound = force_error(mixed, k, exact.radius(i), set.n + 1);
      for (int c = 0; c < in_floats.n; c++)    // springs are turned with them, step by step
        EXPECT_NEAR(norm(in_floats.normal[c]), 1, 4 * kRoundoff);
      if (error > bound && !agree(set, in_floats))
        apart++;
      else
        EXPECT_LE(error, bound) << "mesh " << seed << " (" << made.kind << "), sphere " << i;
    }
  }
  EXPECT_GT(touching, 5000);
  EXPECT_LT(apart, touching / 1000);
}

TEST(mixed, takes_nearest_lists_too)
{
  const TriangleSoup soup = cylinder_mesh(60, 8, 5, 10);
  Scene all(soup, 1, with(hooke(1e4), Precision::double_), 0.4, -1, 2);
  Scene nearest(soup, 1, with(hooke(1e4), Precision::mixed), 0.4, -1, 2);
  Numbers random(5);
  for (int i = 0; i < 4000; i++) {
    const Vec3 q = {random.in(-5, 5), random.in(-5, 5), random.in(0, 10)};
    const Real radius = random.in(0.2, 1);
    all.add_sphere(q, radius, 1);
    nearest.add_sphere(q, radius, 1);
  }
  all.compute(1e-6);
  nearest.compute(1e-6);
  EXPECT_GT(all.engine->totals().contacts, 500);
  for (int i = 0; i < all.n(); i++)
    EXPECT_LE(norm(nearest.force(i) - all.force(i)), force_error(all, 1e4, all.radius(i), 3)) << i;
}

// One step of a sliding spring, against the numbers of double.
TEST(single, laws_with_springs_follow_those_of_double)
{
  const TriangleSoup soup = floor_mesh(10, 5, 2);
  const EngineSettings law = hertz_history(1e5, 3e4, 50, 25, 0.5);
  Scene exact(soup, 1, law), single(soup, 1, with(law, Precision::single_));
  for (Scene *s : {&exact, &single})
    s->add_sphere({0.3, 0.2, 0.95}, 1, 2, {0.1, -0.2, -0.05}, {0.5, 0.1, 0.3});
  for (int i = 0; i < 10; i++)
    for (Scene *s : {&exact, &single}) s->compute(1e-3);
  const Real size = norm(exact.force(0));
  ASSERT_GT(size, 0);
  // Overlap 0.05 with the error of a height, to the power 3/2, and some 20 roundings.
  const Real tolerance = 1.5 * height_error(single) / 0.05 + 20 * kFloatRoundoff;
  EXPECT_LE(norm(single.force(0) - exact.force(0)), tolerance * size);
  EXPECT_LE(norm(single.torque(0) - exact.torque(0)), tolerance * norm(exact.torque(0)));
  EXPECT_NEAR(single.engine->totals().energy, exact.engine->totals().energy,
              2 * tolerance * exact.engine->totals().energy);
}

TEST(single, is_not_double)
{
  const EngineSettings law = hertz_history(1e5, 3e4, 50, 25, 0.5);
  Scene exact(floor_mesh(10, 5, 2), 1, law);
  Scene single(floor_mesh(10, 5, 2), 1, with(law, Precision::single_));
  for (Scene *s : {&exact, &single}) {
    s->add_sphere({0.3, 0.2, 0.9501}, 1, 2, {0.1, -0.2, -0.05});
    s->compute(1e-3);
  }
  EXPECT_GT(norm(single.force(0) - exact.force(0)), 0);
}

}    // namespace
}    // namespace lsdcd::test_precision
