#include "flow/triangle_tree.h"

#include "geometry/primitive_distance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsdcd {

namespace {

constexpr int kLeaf = 4;    // triangles

Real distance_sq(const Box &box, const Vec3 &q)
{
  Real sum = 0;
  for (int d = 0; d < 3; d++) {
    const Real out = std::max({box.lo[d] - q[d], q[d] - box.hi[d], Real(0)});
    sum += out * out;
  }
  return sum;
}

// Never more than the distance but for rounding: where the triangle is too thin to tell its plane,
// all of it is near its sides.
Real distance_to(const Corners &t, const Vec3 &q)
{
  constexpr Real kThin = 1e-6;
  const Real sides = std::min({segment_distance(t[0], t[1], q), segment_distance(t[1], t[2], q),
                               segment_distance(t[2], t[0], q)});
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const Real twice_area = norm(normal);
  const Real longest_sq =
      std::max({norm_sq(t[1] - t[0]), norm_sq(t[2] - t[1]), norm_sq(t[0] - t[2])});
  if (!(twice_area > kThin * longest_sq))
    return std::max(Real(0), sides - 2 * kThin * std::sqrt(longest_sq));
  for (int k = 0; k < 3; k++)
    if (dot(cross(normal, t[(k + 1) % 3] - t[k]), q - t[k]) < 0) return sides;
  return std::min(sides, std::fabs(dot(normal, q - t[0])) / twice_area);
}

}    // namespace

TriangleTree::TriangleTree(std::vector<Corners> triangles) : triangles_(std::move(triangles))
{
  build(0, static_cast<int>(triangles_.size()));
}

Box TriangleTree::bounds_of(const Corners &t)
{
  Box box;
  for (int d = 0; d < 3; d++) {
    box.lo[d] = std::min({t[0][d], t[1][d], t[2][d]});
    box.hi[d] = std::max({t[0][d], t[1][d], t[2][d]});
  }
  return box;
}

void TriangleTree::build(int first, int last)
{
  Box bounds = bounds_of(triangles_[first]);
  for (int t = first + 1; t < last; t++) {
    const Box more = bounds_of(triangles_[t]);
    for (int d = 0; d < 3; d++) {
      bounds.lo[d] = std::min(bounds.lo[d], more.lo[d]);
      bounds.hi[d] = std::max(bounds.hi[d], more.hi[d]);
    }
  }
  const std::size_t at = nodes_.size();
  const bool leaf = last - first <= kLeaf;
  nodes_.push_back({bounds, first, leaf ? last - first : 0, 0});
  if (leaf) return;

  const Vec3 size = bounds.hi - bounds.lo;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const int middle = first + (last - first) / 2;
  const auto place = [axis](const Corners &t) { return t[0][axis] + t[1][axis] + t[2][axis]; };
  std::nth_element(triangles_.begin() + first, triangles_.begin() + middle,
                   triangles_.begin() + last,
                   [&](const Corners &a, const Corners &b) { return place(a) < place(b); });
  build(first, middle);
  nodes_[at].second = static_cast<int>(nodes_.size());
  build(middle, last);
}

Real TriangleTree::distance(const Vec3 &q, Real within) const
{
  int stack[kDepth], n = 0;
  stack[n++] = 0;
  while (n > 0) {
    const int at = stack[--n];
    const Node &node = nodes_[at];
    if (!(distance_sq(node.bounds, q) < within * within)) continue;
    for (int t = node.first; t < node.first + node.count; t++)
      within = std::min(within, distance_to(triangles_[t], q));
    if (node.count > 0) continue;
    int nearer = at + 1, other = node.second;
    if (distance_sq(nodes_[other].bounds, q) < distance_sq(nodes_[nearer].bounds, q))
      std::swap(nearer, other);
    stack[n++] = other;
    stack[n++] = nearer;
  }
  return within;
}

}    // namespace lsdcd
