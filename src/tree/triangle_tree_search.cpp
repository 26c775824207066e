// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The search of a tree on a CPU: eight boxes of a node, or eight triangles of a leaf, in one vector.
#include "tree/tree_search.h"
#include "tree/triangle_tree.h"

#include <cmath>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace lsdcd {

namespace {

typedef float Eight __attribute__((vector_size(32), may_alias));
typedef int EightBits __attribute__((vector_size(32)));

const Eight &eight(const float *at)
{
  return *reinterpret_cast<const Eight *>(at);
}

// A bit for each lane that is true.
[[gnu::always_inline]] inline unsigned lanes(const EightBits &are)
{
#if defined(__x86_64__)
  const __m128i *half = reinterpret_cast<const __m128i *>(&are);
  return static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(half[0]))) |
         static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(half[1]))) << 4;
#else
  unsigned bits = 0;
  for (int k = 0; k < 8; k++) bits |= (are[k] & 1u) << k;
  return bits;
#endif
}

// Squares of the distances from a point to the boxes of a node. Vectors are returned by reference, as their calling
// convention differs between processors.
[[gnu::always_inline]] inline void test_boxes(const TreeNode &node, const float (&at)[3],
                                              Eight &square)
{
  const Eight none = {};
  for (int a = 0; a < 3; a++) {
    const Eight to_lo = eight(node.lo[a]) - at[a], to_hi = at[a] - eight(node.hi[a]);
    Eight out = to_lo > to_hi ? to_lo : to_hi;
    out = out > none ? out : none;
    square = a == 0 ? out * out : square + out * out;
  }
}

// Squares of the least distances from a point at `d` from the leaf's origin to its triangles: from the plane, and from
// the farthest side that the point is past, which is `past` outside it.
[[gnu::always_inline]] inline void test_planes(const TreeLeaf &leaf, const float (&d)[3],
                                               Eight &square, Eight &past)
{
  const Eight none = {};
  const Eight height = eight(leaf.normal[0]) * d[0] + eight(leaf.normal[1]) * d[1] +
                       eight(leaf.normal[2]) * d[2] + eight(leaf.offset);
  past = none - kTreeHuge;
  for (int s = 0; s < 3; s++) {
    const Eight outside = -(eight(leaf.side[s][0]) * d[0] + eight(leaf.side[s][1]) * d[1] +
                            eight(leaf.side[s][2]) * d[2] + eight(leaf.side_offset[s]));
    past = outside > past ? outside : past;
  }
  const Eight beside = past > none ? past : none;
  square = height * height + beside * beside;
}

// Squares of the distances to the sides of its triangles, which are segments.
[[gnu::always_inline]] inline void test_sides(const TreeSides &sides, const float (&d)[3],
                                              Eight &least)
{
  const Eight none = {};
  least = none + kTreeHuge * kTreeHuge;
  for (int s = 0; s < 3; s++) {
    const auto &from = sides.corner[s], &to = sides.corner[s == 2 ? 0 : s + 1];
    Eight px = d[0] - eight(from[0]), py = d[1] - eight(from[1]), pz = d[2] - eight(from[2]);
    const Eight ex = eight(to[0]) - eight(from[0]), ey = eight(to[1]) - eight(from[1]),
                ez = eight(to[2]) - eight(from[2]);
    Eight t = (px * ex + py * ey + pz * ez) * eight(sides.over_square[s]);
    t = t > none ? t : none;
    t = t < 1.0f ? t : none + 1.0f;
    px -= t * ex, py -= t * ey, pz -= t * ez;
    const Eight square = px * px + py * py + pz * pz;
    least = square < least ? square : least;
  }
}

}    // namespace

// How far what has been found is, in float.
struct FloatBound {
  float rounding;    // of boxes
  float most = 0, most_sq = 0;

  [[gnu::always_inline]] void set(Real distance)
  {
    most = static_cast<float>(std::fmin(distance, Real(kTreeHuge))) * kWiden;
    most_sq = (most + rounding) * (most + rounding) * kWiden;
  }
  // The square of a distance in a leaf whose planes are rounded so.
  [[gnu::always_inline]] float limit(float plane_rounding) const
  {
    const float l = most + plane_rounding;
    return l * l * kWiden;
  }
};

// Tries the triangles of a leaf that can be nearest, the nearest first.
[[gnu::always_inline]] inline void TriangleTree::search_leaf(std::uint32_t number, const Vec3 &q,
                                                             const Vec3 &at, FloatBound &bound,
                                                             TreeAnswer &best) const
{
  const TreeLeaf &leaf = leaves_.data()[number];
  const std::uint32_t start = number * kTreeWidth, n_primitives = view_.n_primitives;
  const float d[3] = {static_cast<float>(at.x - leaf.origin[0]),
                      static_cast<float>(at.y - leaf.origin[1]),
                      static_cast<float>(at.z - leaf.origin[2])};
  Eight square, past;
  test_planes(leaf, d, square, past);
  const float rounding =
      kPlaneRounding * (std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]) + leaf.size);
  unsigned near = lanes(square <= bound.limit(rounding));
  if (start + kTreeWidth > n_primitives) near &= (1u << (n_primitives - start)) - 1;
  if ((near & (near - 1)) != 0) {
    // Past a corner the planes give less than the distance. Beside a triangle its sides are nearest.
    Eight least;
    test_sides(sides_.data()[number], d, least);
    square = past > rounding ? least : square;
    near &= lanes(square <= bound.limit(rounding));
  }
  if (near == 0) return;
  alignas(32) float of_lane[kTreeWidth];
  *reinterpret_cast<Eight *>(of_lane) = square;
  while (near != 0) {
    int least = __builtin_ctz(near);
    for (unsigned others = near & (near - 1); others != 0; others &= others - 1) {
      const int k = __builtin_ctz(others);
      if (of_lane[k] < of_lane[least]) least = k;
    }
    if (of_lane[least] > bound.limit(rounding)) break;
    near &= ~(1u << least);
    if (start + least == best.primitive) continue;
    view_.attempt(start + least, q, best);
    bound.set(best.distance * view_.inv_scale);
  }
}

// Searches the nearest box first, and the others later from the stack.
[[gnu::always_inline]] inline void TriangleTree::search_in_float(const Vec3 &q, const Vec3 &at,
                                                                 TreeAnswer &best) const
{
  const float point[3] = {static_cast<float>(at.x), static_cast<float>(at.y),
                          static_cast<float>(at.z)};
  FloatBound bound = {
      kBoxRounding *
      std::fmax(std::fabs(point[0]), std::fmax(std::fabs(point[1]), std::fabs(point[2])))};
  bound.set(best.distance * view_.inv_scale);
  TreeWaiting stack[kTreeStack];
  int n = 0;
  std::uint32_t child = view_.root;
  const TreeNode *const nodes = nodes_.data();
  for (;;) {
    bool is_far = false;
    while (!(child & kTreeLeaf)) {
      const TreeNode &node = nodes[child];
      Eight square;
      test_boxes(node, point, square);
      unsigned near = lanes(square <= bound.most_sq);
      if (near == 0) {
        is_far = true;
        break;
      }
      alignas(32) float of_child[kTreeWidth];
      *reinterpret_cast<Eight *>(of_child) = square;
      int k = __builtin_ctz(near);
      TreeWaiting first = {of_child[k], node.child[k]};
      for (near &= near - 1; near != 0; near &= near - 1) {
        k = __builtin_ctz(near);
        TreeWaiting next = {of_child[k], node.child[k]};
        if (next.far < first.far) std::swap(first, next);
        stack[n++] = next;
      }
      child = first.child;
    }
    if (!is_far) search_leaf(child & ~kTreeLeaf, q, at, bound, best);
    do {
      if (n == 0) return;
      n--;
    } while (stack[n].far > bound.most_sq);
    child = stack[n].child;
  }
}

void TriangleTree::search_in_float_plain(const Vec3 &q, const Vec3 &at, TreeAnswer &best) const
{
  search_in_float(q, at, best);
}
#if defined(__x86_64__)
[[gnu::target("avx2")]] void TriangleTree::search_in_float_avx2(const Vec3 &q, const Vec3 &at,
                                                                TreeAnswer &best) const
{
  search_in_float(q, at, best);
}
#endif

void TriangleTree::search_in_double(const Vec3 &q, TreeAnswer &best) const
{
  TreeWaiting stack[kTreeStack];
  search_tree<TreeBoundsDouble>(view_, Warp<1>(), q, stack, best);
}

bool &TriangleTree::wide()
{
#if defined(__x86_64__)
  static bool is = __builtin_cpu_supports("avx2");
#else
  static bool is = false;
#endif
  return is;
}

TreeAnswer TriangleTree::nearest(const Vec3 &q, Real radius, std::uint32_t hint) const
{
  TreeAnswer best = {radius, kNoFeature, kNoPrimitive};
  const Vec3 at = view_.scaled(q);
  const TreeSearch search = view_.search_for(at);
  if (search != TreeSearch::none) {
    if (hint != kNoPrimitive) view_.attempt(hint, q, best);
    if (search == TreeSearch::in_double) search_in_double(q, best);
#if defined(__x86_64__)
    else if (wide())
      search_in_float_avx2(q, at, best);
#endif
    else
      search_in_float_plain(q, at, best);
  }
  if (!best.found()) best.distance = kAnyDistance;
  return best;
}

bool TriangleTree::is_within(const Vec3 &q, Real radius, std::uint32_t &hint) const
{
  FeatureCode feature = kNoFeature;
  if (hint != kNoPrimitive && view_.exact(hint, q, feature) < radius) return true;
  const TreeAnswer a = nearest(q, radius, kNoPrimitive);
  if (a.found()) hint = a.primitive;
  return a.found();
}

}    // namespace lsdcd
