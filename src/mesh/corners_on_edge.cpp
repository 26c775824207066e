// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/corners_on_edge.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsdcd {

namespace {

// Lengths may be 1e100: sums of their squares would leave the range of Real.
Real length(const Vec3 &a)
{
  return std::hypot(a.x, a.y, a.z);
}

Real largest(const Vec3 &a)
{
  return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
}

// May a segment be nearer than `margin` to the box? It compares intervals between pairs of planes.
bool passes(const Vec3 &a, const Vec3 &b, const Box &box, Real margin)
{
  Real from = 0, to = 1;
  for (int k = 0; k < 3; k++) {
    const Real lo = box.lo[k] - margin, hi = box.hi[k] + margin, d = b[k] - a[k];
    if (std::fabs(d) <= margin) {    // within a margin of a whole: no division
      if (std::max(a[k], b[k]) < lo || std::min(a[k], b[k]) > hi) return false;
      continue;
    }
    Real near = (lo - a[k]) / d, far = (hi - a[k]) / d;
    if (near > far) std::swap(near, far);
    from = std::max(from, near);
    to = std::min(to, far);
  }
  return from <= to;
}

std::vector<int> marked(const std::vector<char> &used)
{
  std::vector<int> numbers;
  for (std::size_t i = 0; i < used.size(); i++)
    if (used[i]) numbers.push_back(static_cast<int>(i));
  return numbers;
}

std::vector<Box> boxes_of(const std::vector<Vec3> &corners, const std::vector<int> &numbers)
{
  std::vector<Box> boxes;
  for (const int i : numbers) boxes.push_back({corners[i], corners[i]});
  return boxes;
}

}    // namespace

CornersOnEdge::CornersOnEdge(const std::vector<Vec3> &corners, const std::vector<char> &used) :
    corners_(corners), used_(marked(used)), tree_(boxes_of(corners, used_))
{
}

std::vector<CornersOnEdge::On> CornersOnEdge::on(int a, int b, Real tolerance) const
{
  const Vec3 &from = corners_[a], &to = corners_[b], edge = to - from;
  const Real whole = length(edge);
  if (whole == 0) return {};
  // The limits of face_plane(), a little wider for rounding here.
  const Real limit =
      std::max({tolerance, 8 * kRoundoff * std::max(largest(from), largest(to)), 1e-14 * whole}) *
      (1 + 1e-6);
  const Vec3 direction = (1 / whole) * edge;
  std::vector<On> found;
  tree_.visit([&](const Box &box) { return passes(from, to, box, 2 * limit); },
              [&](int i) {
                const int c = used_[i];
                const Vec3 d = corners_[c] - from;
                const On on = {c, dot(d, direction), length(cross(d, direction))};
                if (c != a && c != b && on.along > 0 && on.along < whole && on.off <= limit &&
                    length(d) < whole && length(to - corners_[c]) < whole)
                  found.push_back(on);
              });
  std::sort(found.begin(), found.end(), [](const On &p, const On &q) {
    return p.along != q.along ? p.along < q.along : p.corner < q.corner;
  });
  return found;
}

Real CornersOnEdge::distance(const Vec3 &x) const
{
  const auto to_box = [&](const Box &box) {
    Vec3 d;
    for (int k = 0; k < 3; k++) d[k] = std::max({box.lo[k] - x[k], x[k] - box.hi[k], Real(0)});
    return length(d);
  };
  return tree_.least(std::numeric_limits<Real>::infinity(), to_box,
                     [&](int i) { return length(corners_[used_[i]] - x); });
}

}    // namespace lsdcd
