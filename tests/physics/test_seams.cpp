// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A sphere swept over the seams of a plane, in one depth and at all depths: every force, of hooke and of hertz, is the
// plane's to the bits that its height has, however the plane is cut.
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace lsdcd::test_seams {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kHalf = 4;
constexpr Real kOverlap = 1e-3 * kRadius, kHeight = kRadius - kOverlap;
constexpr int kPositions = 100000;

EngineSettings engine_of(bool hertz)
{
  return hertz ? hertz_history(kStiffness, 0, 0, 0, 0) : hooke(kStiffness);
}

Real plane_force(bool hertz, Real overlap)
{
  return kStiffness * overlap * (hertz ? std::sqrt(kRadius * overlap) : 1);
}

// Exactly over vertices, along edges, over diagonals' and edges' middles, over
// faces, at 1e-17 .. 1e-6 beside each, and along a straight line across it all; never beyond
// the rim, from where a sphere leans over the plane's border.
Vec3 position(const TriangleSoup &soup, Random &random, int i, Real rim)
{
  if (i % 4 == 3) {
    const Real t = -1 + 2. * i / kPositions;
    return {rim * t, 0.37 * rim * t + 0.01, 0};
  }
  const std::size_t t = 3 * (random() % soup.n_triangles()), k = random() % 3;
  const Vec3 a = soup.corners[t + k], b = soup.corners[t + (k + 1) % 3],
             c = soup.corners[t + (k + 2) % 3];
  Vec3 q = a;
  const Real u = uniform(random, 0, 1);
  switch (random() % 4) {
    case 0:
      break;
    case 1:
      q = 0.5 * (a + b);
      break;
    case 2:
      q = a + u * (b - a);
      break;
    default:
      q = a + u * (b - a) + uniform(random, 0, 1 - u) * (c - a);
  }
  if (random() % 2) {
    q.x += std::pow(10., uniform(random, -17, -6)) * (random() % 2 ? 1 : -1);
    q.y += std::pow(10., uniform(random, -17, -6)) * (random() % 2 ? 1 : -1);
  }
  return std::fabs(q.x) > rim || std::fabs(q.y) > rim ? Vec3{0, 0, 0} : q;
}

struct Deviation {
  Real force = 0, tangential = 0;    // largest, over the plane's force
  int most_contacts = 0;
};

// All in one depth, or as many as 3000 in depths of 1e-3 to 0.2 radii.
Deviation sweep(const TriangleSoup &soup, bool hertz, Real weld_tolerance, Real rim,
                bool at_all_depths)
{
  const int n = at_all_depths ? 3000 : kPositions;
  Scene scene(soup, kRadius, engine_of(hertz), 0, weld_tolerance);
  Random random(1);
  for (int i = 0; i < n; i++) {
    Vec3 q = position(soup, random, i, rim);
    const Real height =
        at_all_depths ? kRadius * (1 - std::pow(10., uniform(random, -3, -0.7))) : kHeight;
    q.z = i % 2 ? height : -height;
    scene.add_sphere(q, kRadius, 1);
  }
  scene.compute(1e-4, true, true);
  EXPECT_EQ(scene.engine->results().n_touching(), n) << "a sphere fell through";
  Deviation d;
  for (int i = 0; i < n; i++) {
    const Vec3 f = scene.force(i), x = scene.x(i);
    const Real f0 = plane_force(hertz, kRadius - std::fabs(x.z));
    const Real along = x.z > 0 ? f.z : -f.z;
    // Written so that a NaN is the largest of all.
    if (!(std::fabs(along / f0 - 1) <= d.force)) d.force = std::fabs(along / f0 - 1);
    if (!(std::hypot(f.x, f.y) / f0 <= d.tangential)) d.tangential = std::hypot(f.x, f.y) / f0;
  }
  for (int k = 0; k < scene.engine->results().n_touching(); k++)
    d.most_contacts = std::max(d.most_contacts, scene.engine->results().touching()[k].n_contacts);
  return d;
}

constexpr const char *kTheme = "Seams of a plane";
constexpr Real kExact = 1e-12;
constexpr const char *kRounding =
    "normals and heights of a floor at z = 0 are exact; left are roundings of k (R - h)";

struct Bound {
  Real force = kExact, tangential = kExact;
  const char *derivation = kRounding;
  bool one_contact = false;    // wherever the sphere is
};

const Bound kOneContact = {kExact, kExact, kRounding, true};

void expect_plane(const char *id, const std::string &what, const TriangleSoup &soup,
                  const Bound &bound = {}, Real weld_tolerance = -1, Real rim = kHalf)
{
  Deviation worst;
  for (const bool hertz : {false, true})
    for (const bool at_all_depths : {false, true}) {
      const Deviation d = sweep(soup, hertz, weld_tolerance, rim, at_all_depths);
      // Hertz's force goes with the overlap to the power of 3/2.
      const Real share = hertz ? 1 / (1.5 * (1 + bound.force)) : 1;
      if (bound.one_contact) {
        EXPECT_EQ(d.most_contacts, 1) << what;
      }
      if (at_all_depths) {
        // The least height is 0.8 radii: so much more does the rim of a gap lean, and is farther.
        EXPECT_LE(share * d.force, bound.force / 0.64) << what;
        EXPECT_LE(d.tangential, bound.tangential / 0.8) << what;
        continue;
      }
      if (!(share * d.force <= worst.force)) worst.force = share * d.force;
      if (!(d.tangential <= worst.tangential)) worst.tangential = d.tangential;
    }
  expect_at_most({kTheme, id, what + ": |F/F0 - 1|"}, worst.force, bound.force, bound.derivation);
  expect_at_most({kTheme, id, what + ": |Ft|/F0"}, worst.tangential, bound.tangential,
                 bound.derivation);
}

// ---- how the plane is cut --------------------------------------------------------------

TEST(seams, are_not_felt_however_the_plane_is_cut)
{
  expect_plane("1", "2 triangles", floor_mesh(1, kHalf), kOneContact);
  expect_plane("2", "200 triangles", floor_mesh(10, kHalf), kOneContact);
  expect_plane("2", "200 triangles, jittered, shuffled, mixed winding", floor_mesh(10, kHalf, 1),
               kOneContact);
  expect_plane("5", "T-junctions along x = 0", split_floor(1, 7, 0, kHalf), {}, -1, 0.9 * kHalf);
  // Turned, the junctions lie off the line by roundings: gaps of 1e-15.
  expect_plane("5", "T-junctions off their line by rounding",
               turned(split_floor(3, 10, 0, kHalf), 0.3), {}, -1, 0.6 * kHalf);
  // Each file has its own triangles and order; their common line is no common edge.
  TriangleSoup left = floor_mesh(7, kHalf, 4), right = floor_mesh(12, kHalf, 5);
  for (Vec3 &p : left.corners) p.x -= kHalf;
  for (Vec3 &p : right.corners) p.x += kHalf;
  append(left, right);
  expect_plane("6", "two halves of other triangles, joined along x = 0", left, {}, -1, 0.9 * kHalf);
}
TEST(seams, of_20000_triangles_are_not_felt_LONG)
{
  expect_plane("3", "20 000 triangles", floor_mesh(100, kHalf), kOneContact);
  expect_plane("3", "20 000 triangles, jittered, shuffled, mixed winding",
               floor_mesh(100, kHalf, 2), kOneContact);
}
TEST(seams, of_200000_triangles_are_not_felt_LONG)
{
  expect_plane("4", "199 712 triangles, jittered, shuffled, mixed winding",
               floor_mesh(316, kHalf, 3));
}

TEST(seams, of_duplicated_facets_are_not_felt)
{
  TriangleSoup soup = floor_mesh(10, kHalf, 6), again = soup;
  for (std::size_t t = 0; t < again.n_triangles(); t++)
    if (t % 2) std::swap(again.corners[3 * t], again.corners[3 * t + 1]);
  append(soup, again);
  expect_plane("7", "every facet twice, half of them turned", soup, kOneContact);
  append(soup, floor_mesh(13, kHalf, 7));
  expect_plane("7", "and a second plane of other triangles on it", soup, kOneContact);
}

// In one depth and in others, where no coordinate is exact: turned about two axes and moved off, so that vertices are off the
// plane by roundings of the size of their coordinates.
TEST(seams, of_a_plane_that_leans_in_space_are_not_felt)
{
  const TriangleSoup flat = floor_mesh(10, kHalf, 14);
  const Vec3 n = {0.36, 0.48, 0.8}, u = {0.8, -0.6, 0}, v = cross(n, u), at = {3, 5, 7};
  TriangleSoup soup = flat;
  for (Vec3 &p : soup.corners) p = at + p.x * u + p.y * v;
  Scene scene(soup, kRadius, hooke(kStiffness));
  Random random(2);
  std::vector<Real> wanted;
  for (int i = 0; i < 3000; i++) {
    const Vec3 x = position(flat, random, i, 0.9 * kHalf);
    const Real overlap = kRadius * std::pow(10., uniform(random, -3, -0.7)), side = i % 2 ? 1 : -1;
    wanted.push_back(side * kStiffness * overlap);
    scene.add_sphere(at + x.x * u + x.y * v + side * (kRadius - overlap) * n, kRadius, 1);
  }
  scene.compute(1e-4, true, true);
  // Coordinates up to 13 round by 1e-15; a facet of height 0.1 turns that into a
  // lean of 2e-14 and a closest point on it into 1e-14 of height.
  const Real tolerance = kStiffness * 4e-14;
  for (int i = 0; i < scene.n(); i++)
    ASSERT_LE(norm(scene.force(i) - wanted[i] * n), tolerance) << i;
  EXPECT_EQ(scene.engine->results().totals().contacts, scene.n());
}

TEST(seams, take_the_opposite_of_the_forces_they_exert)
{
  const TriangleSoup soup = floor_mesh(10, kHalf, 15);
  Scene scene(soup, kRadius, hooke(kStiffness));
  Random random(3);
  for (int i = 0; i < 1000; i++) {
    const Vec3 x = position(soup, random, i, kHalf);
    scene.add_sphere({x.x, x.y, i % 2 ? kHeight : -0.8 * kHeight}, kRadius, 1);
  }
  scene.compute(1e-4);
  Vec3 sum = {0, 0, 0}, moment = {0, 0, 0};
  Real size = 0;
  for (int i = 0; i < scene.n(); i++) {
    sum += scene.force(i);
    size += norm(scene.force(i));
    moment += cross({scene.x(i).x, scene.x(i).y, 0}, scene.force(i));
  }
  // A thousand roundings.
  EXPECT_LE(norm(scene.engine->results().totals().force + sum), 1e-13 * size);
  EXPECT_LE(norm(scene.engine->results().totals().torque + moment), 1e-13 * size * kHalf);
}

// ---- where the mesh itself deviates ------------------------------------------------------

constexpr Real kGap = 1e-7;

// Every corner of every facet moved on its own, by up to half a gap in the plane and
// `lift` across it: vertices up to a gap apart.
TriangleSoup shaken(TriangleSoup soup, Real lift, unsigned seed)
{
  Random random(seed);
  for (Vec3 &p : soup.corners) {
    const Real a = uniform(random, 0, 2 * kPi), r = 0.5 * kGap * uniform(random, 0, 1);
    p += Vec3{r * std::cos(a), r * std::sin(a), lift * uniform(random, -0.5, 0.5)};
  }
  return soup;
}

TEST(seams, of_vertices_1e_7_apart_are_not_felt_once_welded_nor_where_halves_overlap)
{
  expect_plane("8", "vertices 1e-7 apart in the plane, welded",
               shaken(floor_mesh(10, kHalf, 8), 0, 1), {}, -1, 0.9 * kHalf);
  expect_plane("10", "two halves that overlap by 1e-7, not welded", split_floor(4, 9, -kGap, kHalf),
               {}, 0, 0.9 * kHalf);
}

TEST(seams, of_vertices_1e_7_apart_are_felt_as_far_as_the_gaps_reach)
{
  // Over a gap its rims answer: up to a gap aside, so that they lean by gap / h and
  // lie gap^2 / 2h below the plane's distance.
  const Real lean = kGap / kHeight;
  expect_plane("9", "vertices 1e-7 apart in the plane, not welded",
               shaken(floor_mesh(10, kHalf, 9), 0, 2),
               {lean * lean + kGap * kGap / (2 * kHeight) / kOverlap, lean,
                "over a gap g the rims lean by g/h, g^2/2h farther away"},
               0);
  expect_plane("9", "a gap of 1e-7 between two halves, not welded", split_floor(4, 9, kGap, kHalf),
               {lean * lean + kGap * kGap / (2 * kHeight) / kOverlap, lean,
                "over a gap g the rims lean by g/h, g^2/2h farther away"},
               0);
}

TEST(seams, of_vertices_lifted_by_1e_7_shift_the_force_by_their_lift_over_the_overlap)
{
  // Heights differ by up to a gap, so overlaps by gap / overlap of themselves.
  // Facets lean by up to gap over their height. Where facets of several heights
  // meet, their rims rise over the lowest by up to a gap, and one that is g higher
  // answers at sqrt(2 g h) aside: it leans by sqrt(2 g / h).
  const Real g = kGap, share = g / kOverlap, lean = std::sqrt(2 * g / kHeight);
  expect_plane("11", "vertices 1e-7 apart in height, not welded",
               shaken(floor_mesh(10, kHalf, 10), g, 3),
               {share + lean * lean, lean,
                "heights differ by g: g / overlap; a rim g higher leans by sqrt(2g/h)"},
               0);
  // Welded, facets share their vertices and lean by g over the least height of one.
  const TriangleSoup soup = shaken(floor_mesh(10, kHalf, 10), g, 3);
  const Real slope = g / weld(soup, -1).report.smallest_height;
  expect_plane("11", "vertices 1e-7 apart in height, welded", soup,
               {share, 2 * slope, "heights differ by g: g / overlap; facets lean by g / height"});
}

TEST(seams, of_sheets_1e_7_apart_are_not_felt_from_above)
{
  TriangleSoup soup = floor_mesh(10, kHalf, 11), lower = floor_mesh(7, kHalf, 12);
  for (Vec3 &p : lower.corners) p.z = -kGap;
  append(soup, lower);
  // From below the lower sheet is nearer by the gap.
  expect_plane("12", "a second sheet 1e-7 below, seen from both sides", soup,
               {kGap / kOverlap * (1 + 1e-6), kExact, "sheets g apart: g / overlap"}, 0,
               0.9 * kHalf);
}

TEST(seams, of_sheets_that_cross_at_1e_7_shift_the_force_by_their_distance)
{
  TriangleSoup soup = floor_mesh(10, kHalf, 13);
  const Real slopes[3] = {1e-7, -1e-7, 3e-8};
  for (int k = 0; k < 3; k++) {
    TriangleSoup sheet = floor_mesh(7 + k, kHalf, 14 + k);
    for (Vec3 &p : sheet.corners) p.z = slopes[k] * p.x + 1e-8 * k;
    append(soup, sheet);
  }
  expect_plane("13", "four sheets that cross within 4e-7", soup,
               {(1e-7 * kHalf + 2e-8) / kOverlap * (1 + 1e-6), 1.01e-7,
                "sheets g apart and leaning by s: g / overlap, s"},
               0, 0.9 * kHalf);
}

}    // namespace
}    // namespace lsdcd::test_seams
