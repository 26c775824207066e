// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The corner rule against every subset of active contacts, tried in quad precision.
#include "base/quad.h"
#include "contact/corner.h"
#include "support/cover.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

namespace lsdcd::test_corner {
namespace {

constexpr Real kRadius = 1;

struct Contacts {
  std::vector<Vec3> normal;
  std::vector<Real> overlap;
  int n() const { return static_cast<int>(normal.size()); }
};

struct Solved {
  std::vector<Real> weight;
  Vec3 force;    // sum of l_i n_i
};

template <int kMost = 8>
Solved solve(const Contacts &c)
{
  ContactSet<kMost> set;
  for (int i = 0; i < c.n(); i++) set.add(i, c.normal[i], kRadius - c.overlap[i]);
  Solved out;
  out.weight.resize(c.n());
  CornerRule<kMost> rule;
  rule.solve(set, kRadius, out.weight.data());
  out.force = {0, 0, 0};
  for (int i = 0; i < c.n(); i++)
    out.force += (out.weight[i] * (kRadius - set.distance[i])) * c.normal[i];
  return out;
}

// ---- the oracle ----------------------------------------------------------------------

using Matrix = std::vector<std::vector<Quad>>;

Quad quad_dot(const Vec3 &a, const Vec3 &b)
{
  return Quad(a.x) * b.x + Quad(a.y) * b.y + Quad(a.z) * b.z;
}

Quad quad_root(Quad a)
{
  Quad r = std::sqrt(static_cast<long double>(a));
  return r > 0 ? (r + a / r) / 2 : r;
}

// Normals are unit to a rounding only, which would outweigh angles of 1e-8.
Matrix covers(const Contacts &c)
{
  Matrix g(c.n(), std::vector<Quad>(c.n()));
  for (int i = 0; i < c.n(); i++)
    for (int j = 0; j < c.n(); j++) {
      const Quad size = quad_root(quad_dot(c.normal[i], c.normal[i])) *
                        quad_root(quad_dot(c.normal[j], c.normal[j]));
      g[i][j] = i == j ? Quad(1) : cover_of(quad_dot(c.normal[i], c.normal[j]) / size);
    }
  return g;
}

std::vector<Quad> overlaps(const Contacts &c)
{
  std::vector<Quad> d;
  for (Real o : c.overlap) d.push_back(Quad(kRadius) - Quad(kRadius - o));
  return d;
}

// minimise 1/2 l'A l - b'l
struct Problem {
  Matrix a;
  std::vector<Quad> b;
  Quad s;
};

// With the last term's factor s.
Problem with_ridge(const Matrix &g, const std::vector<Quad> &d, Quad s)
{
  Problem p = {g, d, s};
  for (std::size_t i = 0; i < d.size(); i++) {
    Quad times = 0;
    for (std::size_t j = 0; j < d.size(); j++) times += g[i][j] * d[j] / d[i];
    p.a[i][i] += s * times / (d[i] * d[i]);
    p.b[i] += s / d[i];
  }
  return p;
}

bool is_positive_definite(Matrix a)
{
  const int n = static_cast<int>(a.size());
  for (int k = 0; k < n; k++) {
    if (!(a[k][k] > 0)) return false;
    for (int i = k + 1; i < n; i++) {
      const Quad f = a[i][k] / a[k][k];
      for (int j = k + 1; j < n; j++) a[i][j] -= f * a[k][j];
    }
  }
  return true;
}

Problem problem(const Contacts &c)
{
  // Contacts that share with no other take no part: they would not change the others' s.
  const Matrix g = covers(c);
  const std::vector<Quad> d = overlaps(c);
  Quad most = 0;
  int n_sharing = 0;
  for (int i = 0; i < c.n(); i++) {
    bool shares = false;
    for (int j = 0; j < c.n(); j++) shares = shares || (j != i && g[i][j] > 0);
    n_sharing += shares;
    if (shares && d[i] * d[i] > most) most = d[i] * d[i];
  }
  if (n_sharing == 2) return {g, d, 0};    // without the last term
  Quad low = Quad(1e-12) * most / 2, high = low;
  if (!is_positive_definite(with_ridge(g, d, low).a)) {
    high = most;
    for (int halving = 0; halving < 60; halving++) {
      const Quad middle = (low + high) / 2;
      (is_positive_definite(with_ridge(g, d, middle).a) ? high : low) = middle;
    }
  }
  return with_ridge(g, d, 2 * high);
}

Quad energy(const Problem &p, const std::vector<Quad> &l)
{
  Quad e = 0;
  for (std::size_t i = 0; i < l.size(); i++) {
    e -= p.b[i] * l[i];
    for (std::size_t j = 0; j < l.size(); j++) e += l[i] * p.a[i][j] * l[j] / 2;
  }
  return e;
}

// Solves g l = d on the subset; false if it is singular.
bool solve_subset(const Matrix &g, const std::vector<Quad> &d, unsigned subset,
                  std::vector<Quad> &l)
{
  std::vector<int> in;
  for (std::size_t i = 0; i < d.size(); i++)
    if (subset >> i & 1) in.push_back(static_cast<int>(i));
  const int m = static_cast<int>(in.size());
  Matrix a(m, std::vector<Quad>(m + 1));
  for (int i = 0; i < m; i++) {
    for (int j = 0; j < m; j++) a[i][j] = g[in[i]][in[j]];
    a[i][m] = d[in[i]];
  }
  for (int k = 0; k < m; k++) {
    int pivot = k;
    for (int i = k; i < m; i++)
      if (fabs(static_cast<double>(a[i][k])) > fabs(static_cast<double>(a[pivot][k]))) pivot = i;
    if (fabs(static_cast<double>(a[pivot][k])) < 1e-24) return false;
    std::swap(a[k], a[pivot]);
    for (int i = 0; i < m; i++) {
      if (i == k) continue;
      const Quad f = a[i][k] / a[k][k];
      for (int j = k; j <= m; j++) a[i][j] -= f * a[k][j];
    }
  }
  l.assign(d.size(), 0);
  for (int k = 0; k < m; k++) l[in[k]] = a[k][m] / a[k][k];
  return true;
}

struct Best {
  bool found = false;
  Quad energy = 0;
  Vec3 force = {0, 0, 0};
};

// The least energy among all subsets that give no negative l.
Best try_all(const Contacts &c)
{
  const Problem p = problem(c);
  Best best;
  std::vector<Quad> l;
  for (unsigned subset = 1; subset < 1u << c.n(); subset++) {
    if (!solve_subset(p.a, p.b, subset, l)) continue;
    bool allowed = true;
    for (Quad x : l) allowed = allowed && x >= 0;
    if (!allowed) continue;
    const Quad e = energy(p, l);
    if (best.found && e >= best.energy) continue;
    best.found = true;
    best.energy = e;
    best.force = {0, 0, 0};
    for (int i = 0; i < c.n(); i++) best.force += static_cast<Real>(l[i]) * c.normal[i];
  }
  return best;
}

Real largest_overlap(const Contacts &c)
{
  return *std::max_element(c.overlap.begin(), c.overlap.end());
}

// KKT: l >= 0, no contact left that would lower the energy, none kept that raises it.
// Round-off in a slope is a few roundings per contact. A slope up to kShare may be
// left: the energy is then above the least by kShare d^2 at most, and as it is
// strictly convex in the force, the force is off by sqrt(2 kShare) d.
constexpr Real kShare = 1e-14;
// Least s, over the largest d^2.
constexpr Real kLeast = 1e-12;

struct Off {
  Real slope = 0, force = 0;    // largest: over what is allowed; over the overlap
};

void check(const Contacts &c, Off &off)
{
  const Solved s = solve(c);
  const Problem p = problem(c);
  const std::vector<Quad> d = overlaps(c);
  const Real size = largest_overlap(c);
  std::vector<Quad> l(c.n());
  for (int i = 0; i < c.n(); i++) {
    ASSERT_GE(s.weight[i], 0);
    ASSERT_LE(s.weight[i], 1);
    l[i] = Quad(s.weight[i]) * d[i];
  }
  Real slope = 0;
  for (int i = 0; i < c.n(); i++) {
    Quad r = p.b[i];
    for (int j = 0; j < c.n(); j++) r -= p.a[i][j] * l[j];
    // A contact in use has to be at rest, except where its share is round-off.
    const Quad left = r > 0 ? r : -r * (l[i] < d[i] ? l[i] / d[i] : Quad(1));
    Quad allowed = kShare * std::max(p.b[i], Quad(size));
    // Where s is more than the least it is found to 2^-40 of the largest d^2, and taken twice. The slope
    // has the term s / d_i (1 - m_i w_i).
    if (p.s > 2 * kLeast * size * size)
      allowed += std::ldexp(size * size, -39) / d[i] * (1 + (p.a[i][i] - 1) * d[i] / p.s * l[i]);
    slope = std::fmax(slope, static_cast<Real>(left / allowed));
  }
  off.slope = std::fmax(off.slope, slope);
  const Best best = try_all(c);
  ASSERT_TRUE(best.found);
  off.force = std::fmax(off.force, norm(s.force - best.force) / size);
}

void expect_exact(const Off &off)
{
  std::printf("  slope %.2g of what is allowed, force %.2g of the overlap\n", off.slope, off.force);
  EXPECT_LE(off.slope, 1);
  EXPECT_LE(off.force, std::sqrt(2 * kShare));
}

// Contacts whose normals lie within `spread` of one direction.
Contacts cluster(Random &random, int n, Real spread, Real overlap_spread)
{
  Contacts c;
  const Vec3 axis = random_unit(random);
  const Real depth = std::pow(10., uniform(random, -4, -0.5));
  for (int i = 0; i < n; i++) {
    c.normal.push_back(unit(axis + spread * random_unit(random)));
    c.overlap.push_back(depth * (1 - overlap_spread * uniform(random, 0, 1)));
  }
  return c;
}

TEST(corner, random_contacts_are_solved_exactly)
{
  Random random(1);
  for (int n = 2; n <= 8; n++) {
    Off off;
    for (int k = 0; k < 200; k++) {
      Contacts c;
      for (int i = 0; i < n; i++) {
        c.normal.push_back(random_unit(random));
        c.overlap.push_back(uniform(random, 1e-4, 0.3));
      }
      check(c, off);
    }
    expect_exact(off);
  }
}

TEST(corner, contacts_of_a_bowl_are_solved_exactly)
{
  // More normals than dimensions, all within a cone: G is singular, and the one
  // that enters may have to take another's place.
  Random random(2);
  for (int n = 2; n <= 8; n++) {
    Off off;
    for (int k = 0; k < 200; k++) {
      const Real spread = std::pow(10., uniform(random, -1.5, -0.3));
      check(cluster(random, n, spread, spread * spread * uniform(random, 0, 2)), off);
    }
    expect_exact(off);
  }
}

TEST(corner, nearly_parallel_contacts_are_solved_exactly)
{
  Random random(3);
  for (Real spread : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 3e-7, 1e-7, 1e-8, 1e-9}) {
    Off off;
    for (int n = 2; n <= 7; n++)
      for (int k = 0; k < 60; k++)
        check(cluster(random, n, spread, k % 3 == 0 ? 0 : spread * spread * uniform(random, 0, 2)),
              off);
    expect_exact(off);
  }
}

TEST(corner, bundles_of_nearly_parallel_contacts_are_solved_exactly)
{
  Random random(4);
  Off off;
  for (int k = 0; k < 300; k++) {
    const Real spread = std::pow(10., uniform(random, -9, -1));
    Contacts c = cluster(random, 3, spread, spread);
    const Contacts other = cluster(random, 3, spread, spread);
    c.normal.insert(c.normal.end(), other.normal.begin(), other.normal.end());
    c.overlap.insert(c.overlap.end(), other.overlap.begin(), other.overlap.end());
    check(c, off);
  }
  expect_exact(off);
}

TEST(corner, right_angles_give_weights_of_exactly_one)
{
  // One wall, two, three, and the six of a box, at any overlaps; and corners that are sharper.
  const Contacts sharper = {{{1, 0, 0}, unit({-0.2, 1, 0}), unit({-0.3, -0.4, 1})},
                            {0.1, 0.02, 0.3}};
  for (Real w : solve(sharper).weight) EXPECT_EQ(w, 1);
  const Vec3 six[6] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  for (int n = 1; n <= 6; n++) {
    Contacts c;
    for (int i = 0; i < n; i++) {
      c.normal.push_back(six[i]);
      c.overlap.push_back(0.01 * (i + 1));
    }
    for (Real w : solve(c).weight) EXPECT_EQ(w, 1);
  }
}

TEST(corner, parallel_duplicates_share_a_weight_of_one)
{
  Random random(5);
  for (int n = 2; n <= 8; n++)
    for (int k = 0; k < 100; k++) {
      const Vec3 axis = random_unit(random);
      const Contacts c = {std::vector<Vec3>(n, axis), std::vector<Real>(n, 0.01)};
      Real sum = 0;
      for (Real w : solve(c).weight) sum += w;
      // Overlap is the radius minus a distance: its last bit, times n.
      EXPECT_NEAR(sum, 1, n * kRoundoff);
    }
}

TEST(corner, duplicates_within_a_corner_change_no_force)
{
  Random random(6);
  for (int k = 0; k < 1000; k++) {
    const Contacts once = {
        {random_unit(random), random_unit(random), random_unit(random)},
        {uniform(random, 0.01, 0.1), uniform(random, 0.01, 0.1), uniform(random, 0.01, 0.1)}};
    Contacts twice = once;
    for (int i = 0; i < 3; i++) {
      twice.normal.push_back(once.normal[i]);
      twice.overlap.push_back(once.overlap[i]);
    }
    // Both are exact to a slope of kShare.
    EXPECT_LE(norm(solve(once).force - solve(twice).force), 0.1 * std::sqrt(2 * kShare));
  }
}

TEST(corner, deeper_of_parallel_contacts_takes_it_all)
{
  const Contacts c = {{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, {0.02, 0.03, 0.01}};
  const Solved s = solve(c);
  EXPECT_EQ(s.weight[0], 0);
  // It is covered 1 + 2/3 + 1/3 times, which pulls its weight to 1/2 by kLeast.
  EXPECT_NEAR(s.weight[1], 1, 2 * kLeast);
  EXPECT_EQ(s.weight[2], 0);
}

TEST(corner, concave_edge_has_the_weights_of_the_closed_form)
{
  // Equal overlaps d at an angle a: l = d / (1 + cover) each.
  for (Real degrees : {1e-6, 1e-3, 1., 30., 60., 89.}) {
    const Real a = degrees * kPi / 180;
    const Contacts c = {{{0, 0, 1}, {std::sin(a), 0, std::cos(a)}}, {0.1, 0.1}};
    const Solved s = solve(c);
    // The two slopes are differences of equal overlaps: u d, good to roundings
    // of the normals, kRoundoff, over a^2/2; what they share is not affected.
    const Real each = 1 / (1 + cover_of(std::cos(a))),
               rounding = 8 * kRoundoff / (a * a) + 8 * kRoundoff;
    EXPECT_NEAR(s.weight[0] + s.weight[1], 2 * each, 16 * kRoundoff);
    EXPECT_NEAR(s.weight[0], each, rounding);
    // With the cosine itself for the cover.
    EXPECT_NEAR(each, 1 / (1 + std::cos(a)), kLessCovered);
  }
}

// Moves the contacts of one set into another's and watches the force.
TEST(corner, force_follows_overlaps_and_normals_without_a_jump)
{
  Random random(7);
  for (int k = 0; k < 300; k++) {
    const int n = 3 + static_cast<int>(random() % 5);
    const Real spread = std::pow(10., uniform(random, -7, 0)),
               share = uniform(random, 0, 2) * spread * spread;
    const Vec3 axis = random_unit(random);
    Contacts a, b;
    for (int i = 0; i < n; i++) {
      a.normal.push_back(unit(axis + 0.5 * spread * random_unit(random)));
      b.normal.push_back(unit(axis + 0.5 * spread * random_unit(random)));
      a.overlap.push_back(0.1 * (1 - share * uniform(random, 0, 1)));
      b.overlap.push_back(0.1 * (1 - share * uniform(random, 0, 1)));
    }
    constexpr int kSteps = 400;
    Vec3 last = {0, 0, 0};
    for (int t = 0; t <= kSteps; t++) {
      const Real s = Real(t) / kSteps;
      Contacts c;
      Real moved = 0;
      for (int i = 0; i < n; i++) {
        c.normal.push_back(unit((1 - s) * a.normal[i] + s * b.normal[i]));
        c.overlap.push_back((1 - s) * a.overlap[i] + s * b.overlap[i]);
        moved = std::fmax(moved, norm(a.normal[i] - b.normal[i]));
      }
      const Vec3 f = solve(c).force;
      // All normals within a cone: the force is where they say to within its
      // angle, and follows them as fast as the cone is narrow: overlaps change by
      // share, normals by spread, the direction by their ratio.
      const Real step = 0.1 * (8 * spread + 4 * share / spread) / kSteps * 4;
      if (t > 0) {
        ASSERT_LE(norm(f - last), step + 2 * 0.1 * std::sqrt(2 * kShare)) << n << " " << spread;
      }
      last = f;
    }
  }
}

// Every other trial is a fine bowl, whose overlaps differ by the square of its angle.
TEST(corner, sixty_four_contacts_reach_the_minimum)
{
  Random random(9);
  for (int k = 0; k < 4; k++) {
    Contacts c;
    if (k % 2)
      c = cluster(random, 64, 0.02, 0.02 * 0.02);
    else
      for (int i = 0; i < 64; i++) {
        c.normal.push_back(random_unit(random));
        c.overlap.push_back(uniform(random, 1e-3, 0.3));
      }
    const Real largest = largest_overlap(c);
    const Solved s = solve<64>(c);
    const Problem p = problem(c);
    const std::vector<Quad> d = overlaps(c);
    for (int i = 0; i < 64; i++) {
      ASSERT_GE(s.weight[i], 0);
      Quad r = p.b[i];
      for (int j = 0; j < 64; j++) r -= p.a[i][j] * Quad(s.weight[j]) * d[j];
      if (s.weight[i] > 0 && r < 0) r = -r;
      // 64 roundings of terms up to the largest; s is halved to 2^-40 of the largest d^2.
      ASSERT_LE(static_cast<Real>(r),
                3e-13 * largest + 64 * largest * largest * std::pow(2., -39) / c.overlap[i])
          << k << ", contact " << i;
    }
  }
}

// ---- continuity ----------------------------------------------------------------------

// `n` planes of a cone around z, all tilted by `degrees`, with overlaps as they come.
Contacts cone(int n, Real degrees, const std::vector<Real> &overlap)
{
  Contacts c;
  const Real tilt = degrees * kPi / 180;
  for (int i = 0; i < n; i++) {
    const Real a = 2 * kPi * i / n;
    c.normal.push_back(
        {std::sin(tilt) * std::cos(a), std::sin(tilt) * std::sin(a), std::cos(tilt)});
    c.overlap.push_back(overlap[i]);
  }
  return c;
}

// The force of Hertz contacts, for the stiffness 1.
Vec3 hertz_force(const Contacts &c)
{
  const Solved s = solve<16>(c);
  Vec3 f = {0, 0, 0};
  for (int i = 0; i < c.n(); i++) f += s.weight[i] * std::pow(c.overlap[i], 1.5) * c.normal[i];
  return f;
}

TEST(corner, plane_that_passes_through_the_point_of_three_others_changes_no_force_at_once)
{
  // Overlaps of four planes through one point add up to 0 with the signs + - + -. An offset of 1e-12
  // past that point turns this sum's sign; before, the planes that bore the sphere then changed at once.
  for (Real degrees : {27., 45.}) {
    const std::vector<Real> at = {0.02, 0.015, 0.01, 0.015};
    std::vector<Real> less = at, more = at;
    less[0] -= 1e-12;
    more[0] += 1e-12;
    // |dl| <= |dd| / the least eigenvalue of the covers, that of + - + -.
    const Quad sine = std::sin(degrees * kPi / 180), sine_sq = sine * sine;
    const Quad least = 1 - 2 * cover_of(1 - sine_sq) + cover_of(1 - 2 * sine_sq);
    ASSERT_GT(least, 0);
    const Real moved = 2e-12 / static_cast<Real>(least);
    const Vec3 a = hertz_force(cone(4, degrees, less)), b = hertz_force(cone(4, degrees, more));
    EXPECT_LE(norm(a - b), 2 * moved * std::sqrt(0.02)) << degrees;
    EXPECT_LE(norm(a - b), 1e-4 * norm(a)) << degrees;
  }
}

TEST(corner, contact_that_begins_changes_no_weight_of_others_at_once)
{
  // Random walls, one of which begins to overlap: by d times a number that the others' weights follow.
  Random random(11);
  for (int k = 0; k < 2000; k++) {
    const int n = 2 + static_cast<int>(random() % 6);
    Contacts before;
    for (int i = 0; i < n; i++) {
      before.normal.push_back(random_unit(random));
      before.overlap.push_back(uniform(random, 0.01, 0.03));
    }
    Contacts after = before;
    after.normal.push_back(random_unit(random));
    after.overlap.push_back(1e-11);
    ASSERT_LE(norm(solve(after).force - solve(before).force), 1e-8) << k;
  }
}

}    // namespace
}    // namespace lsdcd::test_corner
