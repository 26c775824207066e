// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The search of a tree for the nearest triangle by a thread, or by threads that share it: each takes some of
// the eight boxes of a node, of the eight triangles of a leaf.
#pragma once

#include "backend/bits.h"
#include "backend/warp.h"
#include "tree/tree_view.h"

namespace lsdcd {

// A node or leaf that waits. `far` grows with its distance, and is rounded down.
struct TreeWaiting {
  float far;
  std::uint32_t child;
};

// How far boxes and triangles are at least, in float. Boxes are compared by the square of the distance.
class TreeBoundsFloat {
 public:
  using Type = float;

  LSDCD_FN explicit TreeBoundsFloat(const Vec3 &at) :
      at_(at), at_float_(vec_cast<float>(at)),
      rounding_(kBoxRounding * fmax(fabs(at_float_.x), fmax(fabs(at_float_.y), fabs(at_float_.z))))
  {
  }
  // The distance of what has been found.
  LSDCD_FN void set_most(Real most)
  {
    most_ = static_cast<float>(fmin(most, Real(kTreeHuge))) * kWiden;
    most_sq_ = (most_ + rounding_) * (most_ + rounding_) * kWiden;
  }
  LSDCD_FN float box(const TreeNode &node, unsigned k) const
  {
    float sum = 0;
    for (int a = 0; a < 3; a++) {
      const float out =
          fmax(0.0f, fmax(node.lo[a][k] - at_float_[a], at_float_[a] - node.hi[a][k]));
      sum += out * out;
    }
    return sum;
  }
  LSDCD_FN bool is_within(float far) const { return far <= most_sq_; }
  LSDCD_FN static float rounded_down(float far) { return far; }

  // A bit for each triangle of a leaf that may be nearest.
  template <unsigned kSize>
  LSDCD_FN unsigned candidates_in(const TreeLeaf &leaf, const TreeSides &sides,
                                  const Warp<kSize> &warp) const
  {
    const Vec3Of<float> d =
        vec_cast<float>(at_ - Vec3{leaf.origin[0], leaf.origin[1], leaf.origin[2]});
    const float rounding = kPlaneRounding * (fabs(d.x) + fabs(d.y) + fabs(d.z) + leaf.size),
                limit = (most_ + rounding) * (most_ + rounding) * kWiden;
    unsigned candidates = 0, beside = 0;
    for (unsigned k = warp.rank(), at = 0; k < kTreeWidth; k += kSize, at += kSize) {
      float past = 0;
      for (int s = 0; s < 3; s++)
        past = fmax(past, -(leaf.side[s][0][k] * d.x + leaf.side[s][1][k] * d.y +
                            leaf.side[s][2][k] * d.z + leaf.side_offset[s][k]));
      const float height = leaf.normal[0][k] * d.x + leaf.normal[1][k] * d.y +
                           leaf.normal[2][k] * d.z + leaf.offset[k];
      candidates |= warp.vote(height * height + past * past <= limit) << at;
      beside |= warp.vote(past > rounding) << at;
    }
    // Past a corner the planes give less than the distance. Beside a triangle its sides are nearest.
    beside &= candidates;
    if ((candidates & (candidates - 1)) == 0 || beside == 0) return candidates;
    for (unsigned k = warp.rank(), at = 0; k < kTreeWidth; k += kSize, at += kSize) {
      float least = kTreeHuge * kTreeHuge;
      for (int s = 0; s < 3; s++) {
        const auto &from = sides.corner[s], &to = sides.corner[s == 2 ? 0 : s + 1];
        const Vec3Of<float> a = {from[0][k], from[1][k], from[2][k]},
                            along = Vec3Of<float>{to[0][k], to[1][k], to[2][k]} - a, p = d - a;
        const float t = fmin(1.0f, fmax(0.0f, dot(p, along) * sides.over_square[s][k]));
        least = fmin(least, norm_sq(p - t * along));
      }
      candidates &= ~(beside & warp.vote(!(least <= limit)) << at);
    }
    return candidates;
  }

 private:
  Vec3 at_;
  Vec3Of<float> at_float_;
  float rounding_, most_ = 0, most_sq_ = 0;
};

// How far boxes and triangles are at least, in double and without planes, for points so far away that float would leave
// too many. Boxes are compared by the distance.
class TreeBoundsDouble {
 public:
  using Type = Real;

  LSDCD_FN explicit TreeBoundsDouble(const Vec3 &at) :
      at_(at), rounding_(64 * kRoundoff * fmax(fabs(at.x), fmax(fabs(at.y), fabs(at.z))))
  {
  }
  LSDCD_FN void set_most(Real most) { most_ = most + rounding_; }
  LSDCD_FN Real box(const TreeNode &node, unsigned k) const
  {
    Vec3 out;
    for (int a = 0; a < 3; a++)
      out[a] = fmax(Real(0), fmax(node.lo[a][k] - at_[a], at_[a] - node.hi[a][k]));
    return node.lo[0][k] == kNoBox ? HUGE_VAL : norm(out);
  }
  LSDCD_FN bool is_within(Real far) const { return far <= most_; }
  LSDCD_FN static float rounded_down(Real far)
  {
    return static_cast<float>(fmin(far, Real(kNoBox))) * (1 - 2.4e-7f);
  }
  template <unsigned kSize>
  LSDCD_FN unsigned candidates_in(const TreeLeaf &, const TreeSides &, const Warp<kSize> &) const
  {
    return (1u << kTreeWidth) - 1;
  }

 private:
  Vec3 at_;
  Real rounding_, most_ = 0;
};

// Replaces `best` by the primitive that is_before() all others. All threads of `warp` have the same q, `best`
// and `stack`, which has room for kTreeStack.
template <class Bounds, unsigned kSize>
LSDCD_FN void search_tree(const TreeView &tree, const Warp<kSize> &warp, const Vec3 &q,
                          TreeWaiting *stack, TreeAnswer &best)
{
  using T = typename Bounds::Type;
  constexpr unsigned kEach = kTreeWidth / kSize;
  static_assert(kEach * kSize == kTreeWidth, "as many for each thread");
  const unsigned rank = warp.rank();
  Bounds bounds(tree.scaled(q));
  bounds.set_most(best.distance * tree.inv_scale);
  unsigned n = 0;
  std::uint32_t child = tree.root;
  for (;;) {
    if (child & kTreeLeaf) {
      const std::uint32_t leaf = child & ~kTreeLeaf, start = leaf * kTreeWidth;
      unsigned candidates = bounds.candidates_in(tree.leaves[leaf], tree.sides[leaf], warp);
      if (start + kTreeWidth > tree.n_primitives)
        candidates &= (1u << (tree.n_primitives - start)) - 1;
      if (candidates != 0) {
        for (unsigned k = rank; k < kTreeWidth; k += kSize)
          if (candidates >> k & 1u && start + k != best.primitive) tree.attempt(start + k, q, best);
        for (unsigned apart = 1; apart < kSize; apart *= 2) {
          const TreeAnswer other = {warp.of_other(best.distance, apart),
                                    warp.of_other(best.feature, apart),
                                    warp.of_other(best.primitive, apart)};
          if (tree.is_before(other, best)) best = other;
        }
        bounds.set_most(best.distance * tree.inv_scale);
      }
    } else {
      const TreeNode &node = tree.nodes[child];
      T far[kEach], least = HUGE_VAL;
      unsigned candidates = 0;
      for (unsigned j = 0; j < kEach; j++) {
        far[j] = bounds.box(node, j * kSize + rank);
        candidates |= warp.vote(bounds.is_within(far[j])) << j * kSize;
        least = fmin(least, far[j]);
      }
      if (candidates != 0) {
        // The nearest is searched first.
        least = warp.least(least);
        unsigned first = 0;
        for (unsigned j = 0; j < kEach; j++) first |= warp.vote(far[j] == least) << j * kSize;
        first = lowest_bit(first);
        const unsigned others = candidates & ~(1u << first);
        for (unsigned j = 0; j < kEach; j++) {
          const unsigned k = j * kSize + rank;
          if (others >> k & 1u)
            stack[n + static_cast<unsigned>(count_bits(others & ((1u << k) - 1)))] = {
                Bounds::rounded_down(far[j]), node.child[k]};
        }
        n += static_cast<unsigned>(count_bits(others));
        child = node.child[first];
        continue;
      }
    }
    warp.wait();    // for what others have put on the stack
    do {
      if (n == 0) return;
      n--;
    } while (!bounds.is_within(stack[n].far));
    child = stack[n].child;
    warp.wait();    // until all have read it
  }
}

// Calls found(primitive) for all primitives that are at most `radius` from q, and for some that are farther. `stack` has room
// for kTreeStack.
template <class Bounds, class Found>
void visit_within(const TreeView &tree, const Vec3 &q, Real radius, TreeWaiting *stack,
                  const Found &found)
{
  using T = typename Bounds::Type;
  const Warp<1> alone;
  Bounds bounds(tree.scaled(q));
  bounds.set_most(radius * tree.inv_scale);
  unsigned n = 0;
  stack[n++].child = tree.root;
  while (n > 0) {
    const std::uint32_t child = stack[--n].child;
    if (child & kTreeLeaf) {
      const std::uint32_t leaf = child & ~kTreeLeaf, slot = leaf * kTreeWidth;
      const unsigned candidates = bounds.candidates_in(tree.leaves[leaf], tree.sides[leaf], alone);
      for (unsigned k = 0; k < kTreeWidth && slot + k < tree.n_primitives; k++)
        if (candidates >> k & 1u) found(slot + k);
      continue;
    }
    const TreeNode &node = tree.nodes[child];
    for (unsigned k = 0; k < kTreeWidth; k++) {
      const T far = bounds.box(node, k);
      if (bounds.is_within(far)) stack[n++].child = node.child[k];
    }
  }
}

}    // namespace lsdcd
