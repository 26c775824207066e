// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/weld_points.h"

#include "mesh/box.h"
#include "mesh/hash_index.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace lsdcd {
namespace {

WeldedPoints weld_equal(const std::vector<Vec3> &corners)
{
  WeldedPoints out;
  out.corner_point.reserve(corners.size());
  HashIndex table;
  for (const Vec3 &corner : corners) {
    const Vec3 x = corner + Vec3{0, 0, 0};    // -0.0 becomes 0.0, which has other bits
    const int fresh = static_cast<int>(out.points.size());
    const int point = table.find_or_insert(hash_three(x.x, x.y, x.z), fresh,
                                           [&](int i) { return out.points[i] == x; });
    if (point == fresh) out.points.push_back(x);
    out.corner_point.push_back(point);
  }
  return out;
}

Box bounds(const std::vector<Vec3> &points)
{
  Box box = {points[0], points[0]};
  for (const Vec3 &x : points) extend(box, x);
  return box;
}

struct Cell {
  std::int64_t i, j, k;
};

bool operator==(const Cell &a, const Cell &b)
{
  return a.i == b.i && a.j == b.j && a.k == b.k;
}

// Points that are more than `tolerance` apart, in the cells of a hashed grid.
class PointGrid {
 public:
  PointGrid(const std::vector<Vec3> &points, Real tolerance) : points_(points)
  {
    const Box box = bounds(points);
    lo_ = box.lo;
    const Real extent = std::max({box.hi.x - box.lo.x, box.hi.y - box.lo.y, box.hi.z - box.lo.z});
    // A little more than the tolerance, for the rounding of cell coordinates.
    cutoff_ = 1.001 * tolerance;
    // Several tolerances wide, so that a search seldom leaves its cell, and wide enough
    // that cell numbers are exact integers.
    cell_ = std::max(8 * tolerance, std::ldexp(extent, -50));
    tolerance_ = tolerance;
    next_.assign(points.size(), HashIndex::kNone);
  }

  void insert(int point)
  {
    const Cell cell = cell_of(points_[point]);
    const int head =
        table_.find_or_insert(hash(cell), n_cells(), [&](int c) { return cells_[c] == cell; });
    if (head == n_cells()) {
      cells_.push_back(cell);
      first_.push_back(HashIndex::kNone);
    }
    next_[point] = first_[head];
    first_[head] = point;
  }

  // The nearest point within the tolerance, of equals the lowest; kNone if there is none.
  int nearest(const Vec3 &x) const
  {
    const Vec3 cutoff = {cutoff_, cutoff_, cutoff_};
    const Cell lo = cell_of(x - cutoff), hi = cell_of(x + cutoff);
    int best = HashIndex::kNone;
    Real best_distance = tolerance_;
    for (std::int64_t i = lo.i; i <= hi.i; ++i)
      for (std::int64_t j = lo.j; j <= hi.j; ++j)
        for (std::int64_t k = lo.k; k <= hi.k; ++k) {
          const Cell cell = {i, j, k};
          const int head = table_.find(hash(cell), [&](int c) { return cells_[c] == cell; });
          if (head == HashIndex::kNone) continue;
          for (int p = first_[head]; p != HashIndex::kNone; p = next_[p]) {
            const Vec3 d = points_[p] - x;
            const Real distance = std::hypot(d.x, d.y, d.z);    // squares might underflow
            if (distance > best_distance) continue;
            if (distance == best_distance && best != HashIndex::kNone && p > best) continue;
            best = p;
            best_distance = distance;
          }
        }
    return best;
  }

 private:
  Cell cell_of(const Vec3 &x) const
  {
    const auto number = [&](int axis) {
      return static_cast<std::int64_t>(std::floor((x[axis] - lo_[axis]) / cell_));
    };
    return {number(0), number(1), number(2)};
  }

  static std::uint64_t hash(const Cell &c) { return hash_three(c.i, c.j, c.k); }

  int n_cells() const { return static_cast<int>(cells_.size()); }

  const std::vector<Vec3> &points_;
  Vec3 lo_;
  Real cutoff_, cell_, tolerance_;
  HashIndex table_;    // of cells_
  std::vector<Cell> cells_;
  std::vector<int> first_;    // point in each cell, and from it
  std::vector<int> next_;     // to the others
};

}    // namespace

WeldedPoints weld_points(const std::vector<Vec3> &corners, Real tolerance)
{
  WeldedPoints exact = weld_equal(corners);
  if (tolerance == 0 || corners.empty()) return exact;

  // Exact copies are merged already, which leaves a sixth of the corners of a usual mesh.
  const std::vector<Vec3> &points = exact.points;
  PointGrid grid(points, tolerance);
  std::vector<int> moved;
  for (int p = 0; p < static_cast<int>(points.size()); ++p) {
    if (grid.nearest(points[p]) == HashIndex::kNone)
      grid.insert(p);
    else
      moved.push_back(p);
  }
  if (moved.empty()) return exact;

  // All points are known now, so that the nearest does not depend on the order.
  std::vector<int> onto(points.size());
  std::iota(onto.begin(), onto.end(), 0);
  for (const int p : moved) onto[p] = grid.nearest(points[p]);
  return move_points(std::move(exact), onto);
}

WeldedPoints weld_copies(const std::vector<Vec3> &points, const std::vector<int> &first,
                         Real tolerance)
{
  WeldedPoints all;
  all.points = points;
  all.corner_point.resize(points.size());
  std::iota(all.corner_point.begin(), all.corner_point.end(), 0);
  std::vector<int> onto = all.corner_point;
  // Zero has no cells: equal points are within the smallest distance that there is between numbers.
  PointGrid grid(points, std::max(tolerance, std::numeric_limits<Real>::min()));
  for (std::size_t c = 0; c < first.size(); c++) {
    const int begin = first[c];
    const int end = c + 1 < first.size() ? first[c + 1] : static_cast<int>(points.size());
    for (int p = begin; p < end; p++) {
      const int nearest = grid.nearest(points[p]);
      if (nearest != HashIndex::kNone) onto[p] = nearest;
    }
    for (int p = begin; p < end; p++)
      if (onto[p] == p) grid.insert(p);
  }
  return move_points(std::move(all), onto);
}

WeldedPoints move_points(WeldedPoints from, const std::vector<int> &onto)
{
  WeldedPoints out;
  std::vector<int> renumbered(from.points.size());
  for (std::size_t p = 0; p < from.points.size(); ++p) {
    if (onto[p] != static_cast<int>(p)) continue;
    renumbered[p] = static_cast<int>(out.points.size());
    out.points.push_back(from.points[p]);
  }
  out.corner_point = std::move(from.corner_point);
  for (int &point : out.corner_point) point = renumbered[onto[point]];
  return out;
}

}    // namespace lsdcd
