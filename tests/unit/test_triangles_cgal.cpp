// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Do two triangles meet: against CGAL's exact kernel, which knows triangles, segments and points
// apart. LSDCD_QUICK=1 tries a tenth.
#include "geometry/triangles_meet.h"
#include "support/random.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace lsdcd {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Flat = Kernel::Triangle_3;

Point point(const Vec3 &x)
{
  return Point(x.x, x.y, x.z);
}

// A triangle as CGAL wants it: of as many corners as it has dimensions.
struct Exact {
  int n;
  Point p[3];

  explicit Exact(const Triangle &t) : n(3), p{point(t[0]), point(t[1]), point(t[2])}
  {
    if (!CGAL::collinear(p[0], p[1], p[2])) return;
    n = p[0] == p[1] && p[1] == p[2] ? 1 : 2;
    // The two farthest apart, in the order of coordinates.
    if (p[1] < p[0]) std::swap(p[0], p[1]);
    if (p[2] < p[0]) std::swap(p[0], p[2]);
    if (p[1] < p[2]) std::swap(p[1], p[2]);
  }
  Segment segment() const { return Segment(p[0], p[1]); }
  Flat triangle() const { return Flat(p[0], p[1], p[2]); }
};

bool expected(const Triangle &s, const Triangle &t)
{
  Exact a(s), b(t);
  if (a.n < b.n) std::swap(a, b);
  if (a.n == 3 && b.n == 3) return CGAL::do_intersect(a.triangle(), b.triangle());
  if (a.n == 3 && b.n == 2) return CGAL::do_intersect(a.triangle(), b.segment());
  if (a.n == 3) return a.triangle().has_on(b.p[0]);
  if (a.n == 2 && b.n == 2) return CGAL::do_intersect(a.segment(), b.segment());
  if (a.n == 2) return a.segment().has_on(b.p[0]);
  return a.p[0] == b.p[0];
}

Vec3 anywhere(Random &random)
{
  return uniform(random, Vec3{-1, -1, -1}, Vec3{1, 1, 1});
}
// A point of few numbers, so that much coincides, lies in one plane or on one line.
Vec3 whole(Random &random, int n)
{
  return {Real(random() % n), Real(random() % n), Real(random() % n)};
}

struct Pair {
  Triangle a, b;
};

// A point of a triangle: a corner, on a side or inside, as far as rounding lets it.
Vec3 point_of(Random &random, const Triangle &t)
{
  if (random() % 3 == 0) return t[random() % 3];
  const Real u = random() % 4 ? uniform(random, 0, 1) : 0.5,
             v = random() % 2 ? 0 : uniform(random, 0, 1 - u);
  return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

Pair random_pair(Random &random)
{
  Pair p;
  const auto fill = [&](const auto &make) {
    for (Vec3 &x : p.a.corner) x = make();
    for (Vec3 &x : p.b.corner) x = make();
  };
  const int kind = random() % 7;
  if (kind == 0)
    fill([&] { return anywhere(random); });
  else if (kind == 1)
    fill([&] { return whole(random, 3); });
  else if (kind == 2)
    fill([&] { return whole(random, 6); });
  else if (kind == 3)    // one plane
    fill([&] {
      const Vec3 x = whole(random, 8);
      return Vec3{x.x, x.y, x.x + 2 * x.y};
    });
  else if (kind == 4)    // one line
    fill([&] { return Real(random() % 9) * Vec3{1, -2, 3}; });
  else {    // touching, or nearly
    fill([&] { return anywhere(random); });
    const Vec3 to = point_of(random, p.a), by = to - point_of(random, p.b);
    for (Vec3 &x : p.b.corner) x += by;
    if (random() % 2) p.b.corner[random() % 3] = to;
    if (random() % 2) p.b.corner[random() % 3] = point_of(random, p.a);
    if (random() % 2) {
      const Vec3 off = std::pow(10., uniform(random, -17, -6)) * anywhere(random);
      for (Vec3 &x : p.b.corner) x += off;
    }
  }
  if (random() % 10 == 0) p.a.corner[1] = p.a[0];
  if (random() % 10 == 0) p.b.corner[2] = 0.5 * (p.b[0] + p.b[1]);
  if (random() % 40 == 0) p.b.corner[2] = p.b.corner[1] = p.b[0];
  // The pair scaled, or one of the two.
  const Real scale = random() % 2 ? 1 : std::pow(10., uniform(random, -60, 60));
  const bool both = random() % 8 > 0;
  for (Vec3 &x : p.a.corner) x = scale * x;
  if (both)
    for (Vec3 &x : p.b.corner) x = scale * x;
  return p;
}

TEST(triangles_cgal, meet_as_in_exact_numbers)
{
  const char *quick = std::getenv("LSDCD_QUICK");
  const long n = quick && *quick == '1' ? 100000 : 1000000, kBlock = 1000;
  long met = 0, wrong = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : met, wrong)
  for (long block = 0; block < n / kBlock; block++) {
    Random random(block);
    for (long i = 0; i < kBlock; i++) {
      const Pair p = random_pair(random);
      const bool is = expected(p.a, p.b);
      met += is;
      wrong += triangles_meet(p.a, p.b) != is;
      wrong += triangles_meet(p.b, p.a) != is;
    }
  }
  std::printf("  %ld pairs, %ld of them meet\n", n, met);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(met, n / 4);
  EXPECT_LT(met, 3 * n / 4);
}

}    // namespace
}    // namespace lsdcd
