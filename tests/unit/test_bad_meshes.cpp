// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Meshes as they should not be, against exact rational arithmetic (CGAL over GMP):
// no contact missed, none at a wrong distance, nothing that is not a number.
#include "contact/find_contacts.h"
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/pair_check.h"
#include "support/random.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>

namespace lsdcd {
namespace {

constexpr const char *kTheme = "Bad meshes, against exact arithmetic";
constexpr int kMost = 512;
using Exact = CGAL::Gmpq;
using Kernel = CGAL::Simple_cartesian<Exact>;

Kernel::Point_3 point(const Vec3 &p)
{
  return {Exact(p.x), Exact(p.y), Exact(p.z)};
}

// ---- the oracle ------------------------------------------------------------------------------

// Exact squared distance to a facet, or to what is left of one without an area.
Exact facet_distance_sq(const Vec3 *corner, const Kernel::Point_3 &q)
{
  const Kernel::Point_3 p[3] = {point(corner[0]), point(corner[1]), point(corner[2])};
  if (!CGAL::collinear(p[0], p[1], p[2]))
    return CGAL::squared_distance(q, Kernel::Triangle_3(p[0], p[1], p[2]));
  Exact least = CGAL::squared_distance(q, p[0]);
  for (int k = 0; k < 3; k++) {
    if (p[k] == p[(k + 1) % 3]) continue;
    const Exact d = CGAL::squared_distance(q, Kernel::Segment_3(p[k], p[(k + 1) % 3]));
    if (d < least) least = d;
  }
  return least;
}

// The distance to a soup: facets whose ball of corners may be the nearest are tried
// in exact arithmetic; the others are farther by a margin that covers rounding.
class Oracle {
 public:
  explicit Oracle(const TriangleSoup &soup) : soup_(soup)
  {
    for (std::size_t t = 0; t < soup.corners.size(); t += 3) {
      const Vec3 *p = soup.corners.data() + t;
      const Vec3 c = (1. / 3) * (p[0] + p[1] + p[2]);
      centre_.push_back(c);
      size_.push_back(std::max({norm(p[0] - c), norm(p[1] - c), norm(p[2] - c)}));
    }
  }

  Real distance(const Vec3 &q) const
  {
    Real bound = HUGE_VAL;
    for (const Vec3 &p : soup_.corners) bound = std::fmin(bound, norm(q - p));
    std::vector<std::pair<Real, std::size_t>> order;
    for (std::size_t t = 0; t < centre_.size(); t++) {
      const Real away = norm(q - centre_[t]), least = away - size_[t];
      if (least <= bound + 1e-9 * (away + bound)) order.push_back({least, t});
    }
    std::sort(order.begin(), order.end());
    const Kernel::Point_3 exact_q = point(q);
    bool any = false;
    Exact least = 0;
    Real so_far = HUGE_VAL;
    for (const auto &[lower, t] : order) {
      if (lower > so_far * (1 + 1e-9) + 1e-9 * size_[t]) continue;
      const Exact d = facet_distance_sq(soup_.corners.data() + 3 * t, exact_q);
      if (any && d >= least) continue;
      any = true;
      least = d;
      so_far = std::sqrt(CGAL::to_double(least));
    }
    return so_far;
  }

 private:
  const TriangleSoup &soup_;
  std::vector<Vec3> centre_;
  std::vector<Real> size_;
};

// ---- the comparison ---------------------------------------------------------------------------

bool is_finite(const Vec3 &a)
{
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// Centres anywhere within the cutoff of a facet, on it, on its edges and corners, and
// 1e-12 .. 1 radius beside them.
Vec3 centre(const TriangleSoup &soup, Random &random, Real radius)
{
  const Vec3 *p = soup.corners.data() + 3 * (random() % soup.n_triangles());
  const std::size_t k = random() % 3;
  const Real u = uniform(random, 0, 1), v = uniform(random, 0, 1 - u);
  Vec3 q = p[k];
  if (random() % 3) q += u * (p[(k + 1) % 3] - p[k]);
  if (random() % 3 == 0) q += v * (p[(k + 2) % 3] - p[k]);
  if (random() % 8 == 0) return q;
  return q + log_uniform(random, 1e-12, 1) * radius * random_unit(random);
}

void expect_exact(const char *id, const std::string &what, const TriangleSoup &soup, Real radius,
                  int n = 300, unsigned seed = 1, Real length = 0)
{
  Scene scene(soup, radius, hooke(1), length, 0);
  const Oracle oracle(soup);
  const GridView view = scene.grid.view();
  const Real room = pair_tolerance(scene.mesh.report, scene.grid);
  Random random(seed);
  Real largest = 0;
  long missed = 0, false_ones = 0, bad = 0, touching = 0;
  for (int i = 0; i < n; i++) {
    const Vec3 q = centre(soup, random, radius);
    scene.add_sphere(q, radius, 1);
    const Real d = oracle.distance(q);
    ContactSet<kMost> set;
    find_contacts(view, q, radius, set);
    Real nearest = HUGE_VAL;
    for (int k = 0; k < set.n; k++) {
      bad += !is_finite(set.normal[k]) || !(std::fabs(norm(set.normal[k]) - 1) < 1e-14) ||
             !(set.distance[k] >= 0);
      nearest = std::fmin(nearest, set.distance[k]);
    }
    bad += set.overflow;
    missed += set.n == 0 && d < radius - room;
    false_ones += set.n > 0 && d > radius + room;
    touching += set.n > 0;
    if (set.n > 0 && !(std::fabs(nearest - d) <= largest)) largest = std::fabs(nearest - d);
  }
  scene.compute(1e-4);
  for (int i = 0; i < n; i++) bad += !is_finite(scene.force(i)) || !is_finite(scene.torque(i));
  EXPECT_EQ(scene.engine->results().totals().contacts > 0, touching > 0);
  EXPECT_EQ(bad, 0) << what << ": a contact or force that is no number";
  EXPECT_EQ(false_ones, 0) << what;
  EXPECT_GT(touching, n / 4) << what;
  expect_answer({kTheme, id, what + ": missed contacts"}, 0, missed, 0, "lists are complete");
  expect_at_most({kTheme, id, what + ": |d - exact| / R"}, largest / radius, room / radius,
                 "1.5 tolerances, 8 eps (size + R), and half the height of facets without a face");
}

// ---- slivers ------------------------------------------------------------------------------------

// A bent ribbon of slivers that share their long sides, `aspect` times longer than wide.
TriangleSoup ribbon(Real aspect, int n, Random &random)
{
  TriangleSoup soup;
  soup.source = "ribbon";
  const Real wide = 1 / aspect;
  std::vector<Vec3> left, right;
  Vec3 at = {0, 0, 0};
  for (int i = 0; i <= n; i++) {
    left.push_back(at);
    right.push_back(at + Vec3{0.1 * uniform(random, -1, 1) * wide, 1, 0.2});
    at += wide * Vec3{1, 0, uniform(random, -0.5, 0.5)};
  }
  for (int i = 0; i < n; i++) {
    soup.corners.insert(soup.corners.end(), {left[i], left[i + 1], right[i]});
    soup.corners.insert(soup.corners.end(), {right[i], left[i + 1], right[i + 1]});
  }
  return soup;
}

TEST(sliver, meshes_of_aspect_1e2_to_1e8_are_exact)
{
  Random random(1);
  for (Real aspect : {1e2, 1e4, 1e6, 1e8}) {
    char what[60];
    std::snprintf(what, sizeof what, "a ribbon of slivers %g : 1", aspect);
    expect_exact("1", what, ribbon(aspect, 20, random), 0.3);
    // The radius of the size of their width: the ribbon is long then.
    if (aspect <= 1e4)
      expect_exact("1", std::string(what) + ", R = 3 widths", ribbon(aspect, 20, random),
                   3 / aspect);
    TriangleSoup soup;
    soup.source = "needles";
    for (int i = 0; i < 40; i++) {
      const Vec3 a = {uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)};
      const Vec3 b = a + random_unit(random);
      const Vec3 c = a + uniform(random, -0.2, 1.2) * (b - a) + (1 / aspect) * random_unit(random);
      soup.corners.insert(soup.corners.end(), {a, b, c});
    }
    std::snprintf(what, sizeof what, "needles %g : 1 in all directions", aspect);
    expect_exact("2", what, soup, 0.3);
  }
}

TEST(sliver, tips_end_where_they_do)
{
  // Past the tip of a needle its two long sides are within rounding of each other.
  Random random(10);
  Real largest = 0;
  for (int i = 0; i < 200; i++) {
    const Vec3 tip = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
    const Vec3 axis = random_unit(random);
    const Vec3 end = tip - uniform(random, 0.5, 1) * axis;
    const Vec3 third = tip - uniform(random, 0.1, 1) * axis +
                       log_uniform(random, 1e-9, 1e-2) * random_unit(random);
    TriangleSoup soup;
    soup.source = "needle";
    soup.corners = {tip, end, third};
    std::rotate(soup.corners.begin(), soup.corners.begin() + i % 3, soup.corners.end());
    Scene scene(soup, 0.3, hooke(1), 0, 0);
    const Oracle oracle(soup);
    const Real room = pair_tolerance(scene.mesh.report, scene.grid);
    for (int k = 0; k < 10; k++) {
      const Vec3 q = tip + log_uniform(random, 0.1, 1e4) * scene.grid.tolerance * axis;
      ContactSet<kMost> set;
      find_contacts(scene.grid.view(), q, 0.3, set);
      Real nearest = HUGE_VAL;
      for (int c = 0; c < set.n; c++) nearest = std::fmin(nearest, set.distance[c]);
      const Real off = std::fabs(nearest - oracle.distance(q)) / room;
      if (!(off <= largest)) largest = off;
    }
  }
  expect_at_most({kTheme, "2", "past the tips of needles: |d - exact| / tolerance"}, largest, 1,
                 "1.5 tolerances, 8 eps (size + R)");
}

// ---- facets without an area ------------------------------------------------------------------------

TEST(zero_area, facets_leave_their_edges_and_points)
{
  Random random(2);
  TriangleSoup soup = floor_mesh(4, 1, 3);
  const auto add = [&](const Vec3 &a, const Vec3 &b, const Vec3 &c) {
    soup.corners.insert(soup.corners.end(), {a, b, c});
  };
  const std::size_t n = soup.corners.size();
  for (int i = 0; i < 10; i++) {
    // In the sheet: an edge given again as a facet, a corner as another.
    const Vec3 a = soup.corners[random() % n], b = soup.corners[random() % n];
    add(a, b, b);
    add(a, a, a);
    // Alone in space: two corners equal, three on a line, three in one point. The
    // corners are eighths, so that the line is exact.
    const auto eighth = [&] { return Real(static_cast<int>(random() % 17) - 8) / 8; };
    const Vec3 p = {eighth(), eighth(), 1 + eighth()}, d = {eighth(), eighth(), 0.125};
    add(p, p + d, p);
    add(p, p + d, p + 0.5 * d);
    add(p + 2 * d, p, p - d);
    add(p + 3 * d, p + 3 * d, p + 3 * d);
  }
  expect_exact("3", "a sheet with and facets of two or three equal corners, or on a line", soup,
               0.3, 600);
}

TEST(zero_area, facets_off_the_line_by_rounding_are_covered_by_their_edges)
{
  Random random(4);
  TriangleSoup soup;
  soup.source = "nearly lines";
  for (int i = 0; i < 30; i++) {
    const Vec3 a = {uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)};
    const Vec3 b = a + random_unit(random);
    const Real height = log_uniform(random, 1e-17, 1e-9);
    const Vec3 c = a + uniform(random, -0.2, 1.2) * (b - a) + height * random_unit(random);
    soup.corners.insert(soup.corners.end(), {a, b, c});
  }
  expect_exact("4", "facets 1e-17 to 1e-9 high", soup, 0.3, 600);
}

// ---- sizes -------------------------------------------------------------------------------------------

TEST(sizes, of_facets_from_1e_6_to_1e6_radii_are_exact)
{
  Random random(5);
  const Real radius = 1;
  for (Real size : {1e-6, 1e-3, 1e6}) {
    TriangleSoup soup;
    soup.source = "facets of one size";
    const int n = size < 1 ? 40 : 4;
    for (int i = 0; i < n; i++) {
      const Vec3 at = std::fmax(size, 3.) *
                      Vec3{uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)};
      for (int k = 0; k < 3; k++) soup.corners.push_back(at + size * random_unit(random));
    }
    char what[60];
    std::snprintf(what, sizeof what, "facets of %g R", size);
    // The cell that the grid chooses by itself would fill the memory budget and take a minute,
    // because the faces have 4e12 R^2.
    expect_exact("5", what, soup, radius, 300, 1, size < 1 ? 0 : 1e4);
  }
}

TEST(sizes, of_facets_may_differ_by_1e6)
{
  // Facets of 1e-6 .. 1 radii in one sheet, and of 1 .. 1e6 radii around it.
  Random random(6);
  TriangleSoup soup;
  soup.source = "facets of all sizes";
  for (int i = 0; i < 60; i++) {
    const Vec3 at = {uniform(random, 0, 2), uniform(random, 0, 2), uniform(random, 0, 2)};
    const Real size = log_uniform(random, 1e-6, i % 2 ? 1e2 : 1);
    for (int k = 0; k < 3; k++) soup.corners.push_back(at + size * random_unit(random));
  }
  expect_exact("6", "facets of 1e-6 R to 100 R in one soup", soup, 1);
}

TEST(sizes, of_a_box_from_1e_60_to_1e60_are_exact)
{
  for (Real size : {1e-60, 1e-9, 1., 1e9, 1e60}) {
    char what[60];
    std::snprintf(what, sizeof what, "a box %g in size", size);
    expect_exact("7", what, box_mesh({0, 0, 0}, size * Vec3{1, 2, 3}), 0.4 * size);
  }
}

TEST(place, a_million_radii_from_the_origin_is_exact)
{
  for (Real away : {1e6, 1e9}) {
    const Vec3 at = away * Vec3{1, -0.7, 0.3};
    TriangleSoup soup = cylinder_mesh(12, 3, 2, 3);
    for (Vec3 &p : soup.corners) p += at;
    char what[60];
    std::snprintf(what, sizeof what, "a cylinder %g R from the origin", away);
    expect_exact("8", what, soup, 1, 600);
    expect_exact("8", std::string(what) + ", fine cells", soup, 1, 600, 2, 0.1);
  }
}

// ---- topology ------------------------------------------------------------------------------------------

TEST(topology, open_shells_are_exact)
{
  TriangleSoup tube = cylinder_mesh(12, 3, 1, 2), open = {};
  open.source = "tube";
  for (std::size_t t = 0; t < tube.corners.size(); t += 3) {
    bool is_lid = false;
    for (int k = 0; k < 3; k++)
      is_lid = is_lid || (tube.corners[t + k].x == 0 && tube.corners[t + k].y == 0);
    if (!is_lid)
      open.corners.insert(open.corners.end(), tube.corners.begin() + t,
                          tube.corners.begin() + t + 3);
  }
  expect_exact("9", "a tube without lids", open, 0.3, 600);
}

TEST(topology, moebius_strips_are_exact)
{
  for (int n : {5, 40}) {
    const auto at = [n](int i, Real w) {
      const Real a = 2 * kPi * i / n;
      const Real r = 1 + w * std::cos(a / 2);
      return Vec3{r * std::cos(a), r * std::sin(a), w * std::sin(a / 2)};
    };
    TriangleSoup soup;
    soup.source = "Moebius strip";
    for (int i = 0; i < n; i++) {
      // The last quad meets the first turned over, with its very corners.
      const bool last = i == n - 1;
      const Vec3 a = at(i, -0.3), b = at(i, 0.3), c = last ? at(0, -0.3) : at(i + 1, 0.3),
                 d = last ? at(0, 0.3) : at(i + 1, -0.3);
      soup.corners.insert(soup.corners.end(), {a, b, c, a, c, d});
    }
    expect_exact("10", "a Moebius strip of " + std::to_string(2 * n) + " facets", soup, 0.2, 600);
  }
}

TEST(topology, self_intersections_are_exact)
{
  TriangleSoup soup = box_mesh({0, 0, 0}, {1, 1, 1});
  append(soup, box_mesh({0.5, 0.5, -0.5}, {1.5, 0.8, 0.5}));
  append(soup, cylinder_mesh(7, 1, 0.6, 0.9));
  expect_exact("11", "two boxes and a cylinder through each other", soup, 0.3, 600);
  Random random(7);
  TriangleSoup tangle;
  tangle.source = "tangle";
  std::vector<Vec3> nodes;
  for (int i = 0; i < 12; i++)
    nodes.push_back({uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)});
  // Few nodes, many facets: edges of many faces, vertices of many fans.
  for (int i = 0; i < 60; i++)
    for (int k = 0; k < 3; k++) tangle.corners.push_back(nodes[random() % nodes.size()]);
  expect_exact("12", "60 facets between 12 nodes", tangle, 0.3, 600);
}

// ---- centres on the wall -----------------------------------------------------------------------------------

TEST(centre_on_the_wall, has_a_unit_normal_and_a_finite_force)
{
  TriangleSoup soup = box_mesh({0, 0, 0}, {1, 1, 1});
  TriangleSoup sheet = floor_mesh(2, 3);
  for (Vec3 &p : sheet.corners) p.z = 0.5;
  append(soup, sheet);
  Scene scene(soup, 0.3, hooke(1), 0, 0);
  const GridView view = scene.grid.view();
  std::vector<Vec3> at;
  for (Real x : {0., 0.25, 0.5, 1.})
    for (Real y : {0., 0.25, 0.5, 1.})
      for (Real z : {0., 0.25, 0.5, 1.}) {
        at.push_back({x, y, z});
        // So near that squares of distances leave the range of Real.
        for (Real off : {1e-16, 1e-100, 1.5e-162, 1e-200, 5e-324})
          for (int s = 0; s < 8; s++)
            at.push_back(
                {s & 1 ? x + off : x - off, s & 2 ? y + off : y - off, s & 4 ? z + off : z - off});
      }
  Real largest = 0;
  for (const Vec3 &q : at) {
    ContactSet<kMost> set;
    find_contacts(view, q, 0.3, set);
    for (int k = 0; k < set.n; k++) {
      const Real off = std::fabs(norm(set.normal[k]) - 1);
      if (!(off <= largest)) largest = off;
    }
    scene.add_sphere(q, 0.3, 1);
  }
  scene.compute(1e-4);
  for (int i = 0; i < scene.n(); i++)
    EXPECT_TRUE(is_finite(scene.force(i))) << at[i].x << " " << at[i].y << " " << at[i].z;
  expect_at_most({kTheme, "13", "centres on faces, edges, vertices: ||n| - 1|"}, largest, 1e-15,
                 "roundings of a unit vector");
}

TEST(centre_on_the_wall, has_a_unit_normal_at_any_distance_from_a_bare_edge_and_point)
{
  // No face is there to answer; below 1e-154 squares of distances are no numbers.
  TriangleSoup soup;
  soup.source = "a line and a point";
  soup.corners = {{0, 0, -1}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  Scene scene(soup, 0.3, hooke(1), 0, 0);
  Real largest = 0;
  for (int e = 0; e >= -323; e--)
    for (Real z : {-0.5, 0., 1.})
      for (Real digits : {1., 1.5, 7.}) {
        const Real off = 0.01 * digits * std::pow(10., e);
        ContactSet<kMost> set;
        find_contacts(scene.grid.view(), {off, -off, z * off}, 0.3, set);
        ASSERT_GE(set.n, 1) << off;
        for (int k = 0; k < set.n; k++) {
          const Real length = std::fabs(norm(set.normal[k]) - 1);
          if (!(length <= largest)) largest = length;
        }
      }
  expect_at_most({kTheme, "13", "centres 1e-325 to 0.1 from a line and a point: ||n| - 1|"},
                 largest, 1e-15, "roundings of a unit vector");
}

// ---- a vertex of very many facets ---------------------------------------------------------------------------

TriangleSoup fan(int n, Real height, Real bumps)
{
  Random random(8);
  std::vector<Vec3> rim;
  for (int i = 0; i < n; i++) {
    const Real a = 2 * kPi * i / n;
    rim.push_back(
        {2 * std::cos(a), 2 * std::sin(a), -height * (1 + bumps * uniform(random, 0, 1))});
  }
  TriangleSoup soup;
  soup.source = "fan";
  for (int i = 0; i < n; i++)
    soup.corners.insert(soup.corners.end(), {{0, 0, 0}, rim[i], rim[(i + 1) % n]});
  return soup;
}

TEST(vertex, of_1e5_facets_is_exact)
{
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto since = [&](auto start) {
    return std::chrono::duration<double>(now() - start).count();
  };
  for (Real height : {1., 0.}) {
    const TriangleSoup soup = fan(100000, height, 0);
    auto start = now();
    Scene scene(soup, 0.3, hooke(1), 0, 0);
    const double build = since(start);
    start = now();
    const char *shape = height > 0 ? "a cone" : "a disc";
    // The tip and round it: the nearest point is known.
    Random random(9);
    std::vector<Real> expected;
    for (int i = 0; i < 200; i++) {
      const Real overlap = log_uniform(random, 1e-3, 0.1), h = 0.3 - overlap;
      const Real lean = height > 0 ? uniform(random, 0, 0.9 * std::atan2(height, 2)) : 0;
      const Real b = uniform(random, 0, 2 * kPi);
      const Real aside = height > 0 ? 0 : log_uniform(random, 1e-12, 1);
      scene.add_sphere({h * std::sin(lean) * std::cos(b) + aside * std::cos(b),
                        h * std::sin(lean) * std::sin(b) + aside * std::sin(b), h * std::cos(lean)},
                       0.3, 1);
      expected.push_back(overlap);
    }
    scene.compute(1e-4, true, true);
    const double step = since(start);
    Real largest = 0;
    int most = 0;
    for (int i = 0; i < scene.n(); i++) {
      const Real off = std::fabs(norm(scene.force(i)) - expected[i]);
      if (!(off <= largest)) largest = off;
      if (i < scene.engine->results().n_touching())
        most = std::max(most, scene.engine->results().touching()[i].n_contacts);
    }
    std::printf("  %s of 1e5 facets: built in %.2f s, longest list %zu, %.3g ms a sphere\n", shape,
                build, scene.grid.report.lists.longest, 1e3 * step / scene.n());
    EXPECT_EQ(scene.engine->results().n_touching(), scene.n());
    expect_at_most({kTheme, "14", std::string(shape) + " of 1e5 facets: |F - k d| / k R"},
                   largest / 0.3, scene.grid.tolerance / 0.3 + 16 * kRoundoff,
                   "tolerance and roundings");
    expect_answer({kTheme, "14", std::string(shape) + " of 1e5 facets: most contacts"}, 1, most, 0,
                  "one local minimum");
  }
}

TEST(vertex, of_many_bumpy_facets_is_exact)
{
  expect_exact("15", "a bumpy fan of 1000 facets", fan(1000, 0.5, 0.5), 0.3, 40);
}

}    // namespace
}    // namespace lsdcd
