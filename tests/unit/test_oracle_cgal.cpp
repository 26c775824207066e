// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Contacts against CGAL's AABB tree over the bare triangles, in long double.
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
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
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
  StepGrid grid;
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
    StepGridSettings settings;
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

// ---- an independent definition of local minima --------------------------------------

struct WideVec {
  Wide x, y, z;
};
WideVec operator-(const WideVec &a, const WideVec &b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Wide dot(const WideVec &a, const WideVec &b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
WideVec along(const WideVec &a, Wide t, const WideVec &d)
{
  return {a.x + t * d.x, a.y + t * d.y, a.z + t * d.z};
}
WideVec wide(const Vec3 &a)
{
  return {a.x, a.y, a.z};
}
Wide length(const WideVec &a)
{
  return std::sqrt(dot(a, a));
}

// The closest point of a triangle: the closest point on its plane where that lies inside,
// else the nearest to it of the three sides' closest points.
WideVec closest(const WideVec (&p)[3], const WideVec &q)
{
  const WideVec u = p[1] - p[0], v = p[2] - p[0], w = q - p[0];
  const Wide uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const Wide det = uu * vv - uv * uv, s = (vv * wu - uv * wv) / det, t = (uu * wv - uv * wu) / det;
  const WideVec closest = along(along(p[0], s, u), t, v);
  if (s >= 0 && t >= 0 && s + t <= 1) return closest;
  WideVec best = p[0];
  Wide least = HUGE_VALL;
  for (int k = 0; k < 3; k++) {
    const WideVec e = p[(k + 1) % 3] - p[k];
    Wide at = dot(q - p[k], e) / dot(e, e);
    at = at < 0 ? 0 : (at > 1 ? 1 : at);
    const WideVec x = along(p[k], at, e);
    if (length(closest - x) < least) {    // in the plane: from q, offsets below 1e-10 are lost
      least = length(closest - x);
      best = x;
    }
  }
  return best;
}

struct Minimum {
  WideVec closest;
  int seen;    // in how many of the positions tried
};

// Faces within the radius by CGAL; the closest point on each. It is a local
// minimum of the wall if it is the closest point of every face that contains it.
// Position is only good to the tolerance, so the minima of q are those of its corners,
// a little way off: sure where every one has it, possible where one has.
class Minima {
 public:
  static constexpr int kCorners = 8;

  explicit Minima(const Case &c) : c_(c)
  {
    std::map<std::array<Real, 3>, int> number;
    for (std::size_t i = 0; i < c.soup.corners.size(); i++) {
      const Vec3 &p = c.soup.corners[i];
      const int v = number.insert({{p.x, p.y, p.z}, static_cast<int>(number.size())}).first->second;
      faces_at_.resize(number.size());
      faces_at_[v].push_back(i / 3);
      corner_.push_back(v);
    }
  }

  // A hundred times the tolerance, and closest points that far apart for faces of any angle.
  Real shift() const { return 2e-12 * c_.diagonal; }
  Real close() const { return 1e-10 * c_.diagonal; }

  // By the faces that hold the closest point.
  using Map = std::map<std::vector<std::size_t>, Minimum>;
  Map around(const Vec3 &q, Real radius) const
  {
    const Wide r = radius + 1e-6 * c_.diagonal;
    const Kernel::Iso_cuboid_3 box(q.x - r, q.y - r, q.z - r, q.x + r, q.y + r, q.z + r);
    std::vector<Primitive::Id> boxed;
    c_.tree->all_intersected_primitives(box, std::back_inserter(boxed));
    std::vector<std::size_t> near;
    for (const auto &id : boxed) {
      const std::size_t face = id - c_.triangles.begin();
      if (length(wide(q) - closest_on(face, q)) < r) near.push_back(face);
    }
    Map out;
    for (int k = 0; k < kCorners; k++) {
      const Real s = shift();
      add_minima(near, q + Vec3{k & 1 ? s : -s, k & 2 ? s : -s, k & 4 ? s : -s},
                 radius + (k & 1 ? s : -s), out);
    }
    return out;
  }

 private:
  void add_minima(const std::vector<std::size_t> &near, const Vec3 &q, Real radius, Map &out) const
  {
    std::vector<std::vector<std::size_t>> known;
    for (std::size_t face : near) {
      const WideVec closest = closest_on(face, q);
      if (length(wide(q) - closest) >= radius) continue;
      std::vector<std::size_t> holding = {face};
      if (!is_minimum(face, q, closest, holding)) continue;
      std::sort(holding.begin(), holding.end());
      if (std::find(known.begin(), known.end(), holding) != known.end()) continue;
      known.push_back(holding);
      out.insert({holding, {closest, 0}}).first->second.seen++;
    }
  }
  // Adds the other faces that hold the closest point; false at the first that has another.
  bool is_minimum(std::size_t face, const Vec3 &q, const WideVec &closest,
                  std::vector<std::size_t> &holding) const
  {
    for (int k = 0; k < 3; k++)
      for (std::size_t other : faces_at_[corner_[3 * face + k]]) {
        if (std::find(holding.begin(), holding.end(), other) != holding.end()) continue;
        if (!on_face(other, closest)) continue;
        if (length(closest_on(other, q) - closest) > round_off()) return false;
        holding.push_back(other);
      }
    return true;
  }
  // Long double leaves 1e-19 of the coordinates, times the aspect ratio.
  Wide round_off() const { return 1e-15L * c_.diagonal; }
  bool on_face(std::size_t face, const WideVec &x) const
  {
    WideVec p[3];
    corners(face, p);
    return length(closest(p, x) - x) <= round_off();
  }
  void corners(std::size_t face, WideVec (&p)[3]) const
  {
    for (int k = 0; k < 3; k++) p[k] = wide(c_.soup.corners[3 * face + k]);
  }
  WideVec closest_on(std::size_t face, const Vec3 &q) const
  {
    WideVec p[3];
    corners(face, p);
    return closest(p, wide(q));
  }
  const Case &c_;
  std::vector<int> corner_;                           // the point of each corner
  std::vector<std::vector<std::size_t>> faces_at_;    // those of a point
};

// Our contacts are the local minima: every sure one is there, nothing is that is
// not one, and none is there twice.
void expect_same_minima(const Case &c)
{
  const Minima minima(c);
  const GridView view = c.grid.view();
  long missing = 0, extra = 0, doubled = 0, unsure = 0, sure = 0;
  Vec3 where = {0, 0, 0};
  for_points(n_points(30000), 2, [&](Random &random) {
    const Vec3 q = c.query(random);
    const Minima::Map expected = minima.around(q, c.cutoff);
    ContactSet<kMost> set;
    find_contacts(view, q, c.cutoff, set);
    long not_there = 0, not_one = 0, twice = 0, n_sure = 0;
    const auto closest = [&](int k) { return wide(q - set.distance[k] * set.normal[k]); };
    for (const auto &m : expected) {
      if (m.second.seen < Minima::kCorners) continue;
      n_sure++;
      int ours = 0, possible = 0;
      for (int k = 0; k < set.n; k++)
        ours += length(closest(k) - m.second.closest) <= minima.close();
      for (const auto &o : expected)
        possible += length(o.second.closest - m.second.closest) <= 2 * minima.close();
      not_there += ours == 0;
      twice += ours > possible;
    }
    for (int k = 0; k < set.n; k++) {
      bool is_one = false;
      for (const auto &m : expected)
        is_one = is_one || length(closest(k) - m.second.closest) <= minima.close();
      not_one += !is_one;
    }
#pragma omp critical
    {
      missing += not_there;
      extra += not_one;
      doubled += twice;
      sure += n_sure;
      unsure += static_cast<long>(expected.size()) - n_sure;
      if (not_there || not_one || twice) where = q;
    }
  });
  std::printf("  %zu triangles: %ld minima, %ld more for a shift of 2e-12\n", c.soup.n_triangles(),
              sure, unsure);
  EXPECT_EQ(missing, 0) << where.x << " " << where.y << " " << where.z;
  EXPECT_EQ(extra, 0) << where.x << " " << where.y << " " << where.z;
  EXPECT_EQ(doubled, 0) << where.x << " " << where.y << " " << where.z;
  EXPECT_GT(sure, n_points(30000) / 10);
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
TEST(made, cylinder_and_box_have_a_contact_per_local_minimum)
{
  expect_same_minima(Case(cylinder_of(160), 0.1));
  expect_same_minima(Case(box_mesh({0, 0, 0}, {1, 2, 3}), 0.3));
}

// ---- real meshes --------------------------------------------------------------------

class RealMesh : public testing::TestWithParam<const char *> {};

TEST_P(RealMesh, has_the_distance_that_cgal_finds)
{
  expect_same_distance(Case(read_real_mesh(GetParam(), LSDCD_UNPACKED)));
}
TEST_P(RealMesh, has_a_contact_per_local_minimum)
{
  expect_same_minima(Case(read_real_mesh(GetParam(), LSDCD_UNPACKED), 0.02));
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
