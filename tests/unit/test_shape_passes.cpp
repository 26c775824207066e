// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Passes between the contacts of an ellipsoid against every chain of faces, with overlaps on edges in long double.
#include "contact/shape_passes.h"
#include "support/meshes.h"
#include "support/random.h"
#include "tree/triangle_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace lsdcd::test_shape_passes {
namespace {

using Long = long double;
using LongVec = Vec3Of<Long>;

// How deep a point is in an ellipsoid, both in its frame; 0 outside. The nearest point of the surface is h^2 y / (t + h^2), by the root t.
Long depth(const Vec3 &half, const LongVec &y)
{
  const auto of = [&](Long t) {
    Long sum = 0;
    for (int k = 0; k < 3; k++) {
      const Long part = half[k] * y[k] / (t + Long(half[k]) * half[k]);
      sum += part * part;
    }
    return sum;
  };
  if (!(of(0) < 1)) return 0;
  const Long least = std::min({half.x, half.y, half.z});
  Long low = -least * least, high = 0;
  for (int i = 0; i < 75; i++) {
    const Long t = (low + high) / 2;
    (of(t) > 1 ? low : high) = t;
  }
  Long square = 0;
  for (int k = 0; k < 3; k++) {
    const Long off = y[k] * high / (high + Long(half[k]) * half[k]);
    square += off * off;
  }
  return std::sqrt(square);
}

// The largest depth on a segment: the signed distance is convex on it.
Long depth_of_edge(const Vec3 &half, const LongVec &a, const LongVec &b)
{
  const auto at = [&](Long s) {
    const LongVec y = {a.x + s * (b.x - a.x), a.y + s * (b.y - a.y), a.z + s * (b.z - a.z)};
    return depth(half, y);
  };
  // From the middle of what is inside: outside the depth is flat.
  const auto gauge = [&](Long s) {
    Long sum = 0;
    for (int k = 0; k < 3; k++) {
      const Long u = (a[k] + s * (b[k] - a[k])) / half[k];
      sum += u * u;
    }
    return sum;
  };
  Long ab = 0, bb = 0;
  for (int k = 0; k < 3; k++) {
    const Long u = a[k] / half[k], w = (b[k] - a[k]) / half[k];
    ab += u * w, bb += w * w;
  }
  const Long middle = std::clamp<Long>(-ab / bb, 0, 1);
  if (!(gauge(middle) < 1)) return 0;
  const Long wide = std::sqrt(std::max<Long>(0, (1 - gauge(-ab / bb)) / bb));
  Long low = std::max<Long>(0, -ab / bb - wide), high = std::min<Long>(1, -ab / bb + wide);
  for (int i = 0; i < 80; i++) {
    const Long first = low + (high - low) / 3, second = high - (high - low) / 3;
    (at(first) < at(second) ? low : high) = at(first) < at(second) ? first : second;
  }
  return at((low + high) / 2);
}

// A mesh of few faces, some with an edge of three: a rough sheet, with a fin now and then.
TriangleSoup random_surface(Random &random)
{
  constexpr int kCells = 2;
  TriangleSoup soup;
  soup.source = "test";
  Vec3 at[kCells + 1][kCells + 1];
  std::normal_distribution<Real> normal;
  const Real rough = uniform(random, 0.05, 0.5);
  for (int i = 0; i <= kCells; i++)
    for (int j = 0; j <= kCells; j++)
      at[i][j] = {1.5 * (i - 1) + 0.2 * normal(random), 1.5 * (j - 1) + 0.2 * normal(random),
                  rough * normal(random)};
  for (int i = 0; i < kCells; i++)
    for (int j = 0; j < kCells; j++)
      for (const Vec3 &corner :
           {at[i][j], at[i + 1][j], at[i + 1][j + 1], at[i][j], at[i + 1][j + 1], at[i][j + 1]})
        soup.corners.push_back(corner);
  if (uniform(random, 0, 1) < 0.3)
    for (const Vec3 &corner : {at[1][1], at[2][1], at[1][1] + Vec3{0.7, 0.3, 1}})
      soup.corners.push_back(corner);
  return soup;
}

// Every chain of faces from those of one contact to those of another one.
class Chains {
 public:
  Chains(const TreeView &view, const PlacedGrain &grain, std::size_t n_edges) :
      view_(view), grain_(grain), depth_(n_edges, -1)
  {
  }
  Long highest(FeatureCode from, FeatureCode to)
  {
    target_.clear();
    each_face(view_, to, [&](int face) { target_.insert(face); });
    best_ = 0;
    each_face(view_, from, [&](int face) {
      passed_.clear();
      go(face, HUGE_VALL);
    });
    return best_;
  }

 private:
  void go(int face, Long least)
  {
    if (target_.count(face)) best_ = std::max(best_, least);
    passed_.insert(face);
    const TreePrimitive &p = view_.primitives[view_.face_primitive[face]];
    for (const std::uint32_t edge : p.edge)
      for (int k = view_.edge_first[edge]; k < view_.edge_first[edge + 1]; k++) {
        const int next = view_.edge_face[k];
        if (!passed_.count(next) && depth_of(edge) > 0) go(next, std::min(least, depth_of(edge)));
      }
    passed_.erase(face);
  }
  Long depth_of(std::uint32_t edge)
  {
    Long &known = depth_[edge];
    const int *ends = view_.edges + 2 * edge;
    if (known < 0) known = depth_of_edge(grain_.shape.half, own(ends[0]), own(ends[1]));
    return known;
  }

  LongVec own(int vertex) const { return vec_cast<Long>(grain_.own_point(view_.vertices[vertex])); }

  const TreeView &view_;
  const PlacedGrain &grain_;
  std::vector<Long> depth_;
  std::set<int> target_, passed_;
  Long best_ = 0;
};

}    // namespace

TEST(shape_passes, are_the_highest_of_all_chains_of_faces)
{
  int n_passes = 0, n_apart = 0, n_several = 0;
  Long worst = 0;
  for (unsigned seed = 0; n_passes < 1800; seed++) {
    Random random(seed);
    const WeldedMesh mesh = weld(random_surface(random), -1);
    const TriangleTable names(mesh);
    const TriangleTree tree(mesh, names);
    ShapeSearch search(tree);
    ShapePasses passes(tree);
    PlacedGrain grain;
    grain.shape = make_superellipsoid(uniform(random, {0.5, 0.5, 0.5}, {1.6, 1.6, 1.6}), 2, 2);
    rows_of(rotation_about(random_unit(random), uniform(random, 0, kPi)), grain.row);
    grain.centre = uniform(random, {-0.8, -0.8, 0.2}, {0.8, 0.8, 1.2});
    std::vector<FoundGrainContact> found;
    search.contacts(grain, found);
    std::vector<PassEnd> ends;
    Real deepest = 0;
    for (const FoundGrainContact &c : found) {
      deepest = std::fmax(deepest, -c.distance);
      ends.push_back({c.feature, -c.distance, grain.to_own(-c.normal),
                      grain.to_own(c.of_grain - grain.centre)});
    }
    if (found.size() < 2 || deepest > grain.shape.rho) continue;
    n_several += found.size() > 2;
    Chains chains(tree.view(), grain, mesh.edges.size());
    passes.begin(grain, ends);
    // Of one grain it is asked for passes above several depths, in turn, also above one that is less than the last.
    const Real above = uniform(random, 0, 0.9) * deepest;
    for (const Real least : {seed % 2 ? 0 : above, above, Real(0)})
      for (std::size_t i = 0; i < ends.size(); i++) {
        const std::vector<Real> pass = passes.find(i, least);
        for (std::size_t j = 0; j < ends.size(); j++) {
          if (j == i) continue;
          Long highest =
              std::min<Long>(chains.highest(ends[i].feature, ends[j].feature), ends[i].overlap);
          if (!(highest > least)) highest = 0;
          n_passes += highest > 0;
          n_apart += highest == 0;
          worst = std::max(worst, std::fabs(pass[j] - highest));
        }
      }
  }
  // The nearest points of edges are at 1e-16 of sizes of 1.6, in frames that are turned.
  EXPECT_LE(worst, 1e-14L);
  EXPECT_GT(n_apart, 180);
  EXPECT_GT(n_several, 30);
}

}    // namespace lsdcd::test_shape_passes
