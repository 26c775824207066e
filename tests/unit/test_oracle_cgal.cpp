// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Nearest contacts against CGAL's AABB tree over the bare triangles, in long double. That there is one contact for each local
// minimum is in test_properties.
// Its own program: CGAL takes long to compile. LSDCD_QUICK=1 tries a tenth.
#include "contact/find_contacts.h"
#include "grid/triangle_grid.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/real_mesh.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>

namespace lsdcd {
namespace {

constexpr int kMost = 512;
using Wide = long double;
using Kernel = CGAL::Simple_cartesian<Wide>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

long n_points(long full)
{
  const char *quick = std::getenv("LSDCD_QUICK");
  return quick && *quick == '1' ? full / 10 : full;
}

// A mesh on both sides of the comparison.
struct Case {
  TriangleSoup soup;
  Triangles triangles;
  std::unique_ptr<Tree> tree;
  TriangleGrid grid;
  Vec3 lo, hi;
  Real diagonal, cutoff;

  explicit Case(TriangleSoup given, Real cutoff_share = 0.05) : soup(std::move(given))
  {
    lo = hi = soup.corners[0];
    for (const Vec3 &p : soup.corners)
      for (int k = 0; k < 3; k++) lo[k] = std::fmin(lo[k], p[k]), hi[k] = std::fmax(hi[k], p[k]);
    diagonal = norm(hi - lo);
    cutoff = cutoff_share * diagonal;
    const auto point = [](const Vec3 &p) { return Kernel::Point_3(p.x, p.y, p.z); };
    for (std::size_t t = 0; t < soup.corners.size(); t += 3)
      triangles.emplace_back(point(soup.corners[t]), point(soup.corners[t + 1]),
                             point(soup.corners[t + 2]));
    tree = std::make_unique<Tree>(triangles.begin(), triangles.end());
    tree->build();
    tree->accelerate_distance_queries();
    GridSettings settings;
    settings.cutoff = cutoff;
    grid = build_grid(weld(soup, 0), settings);    // exact: the same wall, not one welded
  }

  // Every second point anywhere within the cutoff, the others near edges and vertices.
  Vec3 query(Random &random) const
  {
    if (random() % 2)
      return {uniform(random, lo.x - cutoff, hi.x + cutoff),
              uniform(random, lo.y - cutoff, hi.y + cutoff),
              uniform(random, lo.z - cutoff, hi.z + cutoff)};
    const std::size_t t = 3 * (random() % soup.n_triangles()), k = random() % 3;
    const Vec3 a = soup.corners[t + k], b = soup.corners[t + (k + 1) % 3];
    const Vec3 p = random() % 2 ? a : a + uniform(random, 0, 1) * (b - a);
    const Real away = diagonal * std::pow(10., uniform(random, -12, -3));
    const Vec3 d = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
    return p + away * d;
  }
};

// Calls f(random, i) for n points in blocks with a seed each, whatever the threads.
template <class F>
void for_points(long n, unsigned seed, F f)
{
  constexpr long kBlock = 1000;
#pragma omp parallel for schedule(dynamic)
  for (long b = 0; b < n / kBlock; b++) {
    Random random(seed * 1000003ul + b);
    for (long i = 0; i < kBlock; i++) f(random);
  }
}

// The tolerance asked for: 1e-13 of the diagonal. CGAL's projection onto a
// triangle loses its aspect ratio times 1e-19, far less for meshes below 1e4.
void expect_same_distance(const Case &c)
{
  const Real tolerance = 1e-13 * c.diagonal;
  const GridView view = c.grid.view();
  long missed = 0, wrong = 0, false_ones = 0, touching = 0;
  Real largest = 0;
  Vec3 worst = {0, 0, 0};
  for_points(n_points(200000), 1, [&](Random &random) {
    const Vec3 q = c.query(random);
    const Wide d_sq = c.tree->squared_distance(Kernel::Point_3(q.x, q.y, q.z));
    const Wide d = std::sqrt(d_sq);
    ContactSet<kMost> set;
    find_contacts(view, q, c.cutoff, set);
    Real nearest = HUGE_VAL;
    for (int k = 0; k < set.n; k++) nearest = std::fmin(nearest, set.distance[k]);
    const bool miss = set.n == 0 && d < c.cutoff - tolerance;
    const bool extra = set.n > 0 && d > c.cutoff + tolerance;
    const Real error = set.n > 0 && !extra ? static_cast<Real>(std::fabs(nearest - d)) : 0;
#pragma omp critical
    {
      missed += miss;
      false_ones += extra;
      wrong += error > tolerance;
      touching += set.n > 0;
      if (error > largest || miss || extra) {
        largest = std::fmax(largest, error);
        worst = q;
      }
    }
  });
  std::printf("  %zu triangles: %ld contacts, largest error %.2g of the diagonal\n",
              c.soup.n_triangles(), touching, largest / c.diagonal);
  EXPECT_EQ(missed, 0) << worst.x << " " << worst.y << " " << worst.z;
  EXPECT_EQ(false_ones, 0) << worst.x << " " << worst.y << " " << worst.z;
  EXPECT_EQ(wrong, 0) << largest << " at " << worst.x << " " << worst.y << " " << worst.z;
  EXPECT_GT(touching, n_points(200000) / 10);
}

// ---- made meshes -------------------------------------------------------------------

TriangleSoup cylinder_of(int n_triangles)
{
  // 2 n m + 2 n triangles; segments along as long as those round.
  if (n_triangles == 160) return cylinder_mesh(20, 3, 5, 10);
  if (n_triangles == 10000) return cylinder_mesh(100, 49, 5, 10);
  return cylinder_mesh(250, 199, 5, 10);
}

TEST(made, cylinders_have_the_distance_that_cgal_finds)
{
  for (const int n : {160, 10000, 100000}) expect_same_distance(Case(cylinder_of(n)));
}

// ---- real meshes --------------------------------------------------------------------

class RealMesh : public testing::TestWithParam<const char *> {};

TEST_P(RealMesh, has_the_distance_that_cgal_finds)
{
  expect_same_distance(Case(read_real_mesh(GetParam(), LSDCD_UNPACKED)));
}
INSTANTIATE_TEST_SUITE_P(real, RealMesh, testing::Values("lion", "elephant", "fandisk"));

}    // namespace
}    // namespace lsdcd

int main(int argc, char **argv)
{
  testing::InitGoogleTest(&argc, argv);
  if (testing::GTEST_FLAG(filter) == "real/*" && !lsdcd::has_real_meshes()) {
    std::printf("skipped: %s is missing; install libcgal-demo\n", lsdcd::kRealMeshes);
    return 77;
  }
  return RUN_ALL_TESTS();
}
