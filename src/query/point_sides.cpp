// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "query/point_sides.h"

#include "backend/backend_cpu.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsdcd {

namespace {

template <class T>
Vec3 point(const StridedView<T> &points, std::size_t i)
{
  const T *at = points.of(i);
  return {at[0], at[points.column], at[2 * points.column]};
}

template <class T>
void estimate(const PointSides &sides, std::size_t n, const StridedView<const T> &points,
              const Column<T> &number, std::int8_t *side, std::uint8_t *status)
{
  const GeneralizedWinding &winding = sides.generalized();
  CpuBackend().for_each(n, [&](std::size_t i) {
    const Vec3 q = point(points, i);
    const bool is_none = std::isnan(q.x + q.y + q.z);
    const GeneralizedWinding::Answer a = winding.at(q);
    if (number.at)
      number[i] = is_none ? std::numeric_limits<T>::quiet_NaN() : static_cast<T>(a.number);
    if (!side) return;
    side[i] = static_cast<std::int8_t>(is_none ? 0 : GeneralizedWinding::side(a));
    if (status) status[i] |= kSideEstimated;
  });
}

// Where a side is 0; it stays 0 where a coordinate is no number.
template <class T>
void fill(const PointSides &sides, std::size_t n, const StridedView<T> &points, std::int8_t *side)
{
  if (std::find(side, side + n, 0) == side + n) return;
  const WindingNumber &winding = sides.winding();
  CpuBackend().for_each(n, [&](std::size_t i) {
    const Vec3 q = point(points, i);
    if (side[i] == 0 && !std::isnan(q.x + q.y + q.z))
      side[i] = static_cast<std::int8_t>(winding.side(q));
  });
}

// find() gives all answers but sides, and these, too, where normals tell them.
template <class T, class Find>
void answer(const PointSides &sides, bool by_normals, const PointArrays<T> &io, const Find &find)
{
  PointArrays<T> asked = io;
  if (!by_normals) asked.side = nullptr;
  find(asked);
  if (!io.side) return;
  if (!by_normals) std::fill_n(io.side, io.n, std::int8_t(0));
  fill(sides, io.n, io.points, io.side);
}

template <class T>
void answer(const HostGrid &grid, const TriangleTable &names, const PointSides &sides,
            bool by_normals, const PointArrays<T> &io)
{
  answer(sides, by_normals, io,
         [&](const PointArrays<T> &asked) { answer_points(grid, names, asked); });
}

template <class T>
void answer(const TriangleTree &tree, const NearBoxes *near, const PointSides &sides, Real cutoff,
            const PointArrays<T> &io)
{
  answer(sides, false, io,
         [&](const PointArrays<T> &asked) { answer_points(tree, near, cutoff, asked); });
}

}    // namespace

void answer_with_sides(const TriangleTree &tree, const NearBoxes *near, const PointSides &sides,
                       Real cutoff, const PointArrays<float> &io)
{
  answer(tree, near, sides, cutoff, io);
}
void answer_with_sides(const TriangleTree &tree, const NearBoxes *near, const PointSides &sides,
                       Real cutoff, const PointArrays<double> &io)
{
  answer(tree, near, sides, cutoff, io);
}

void answer_with_sides(const HostGrid &grid, const TriangleTable &names, const PointSides &sides,
                       bool by_normals, const PointArrays<float> &io)
{
  answer(grid, names, sides, by_normals, io);
}
void answer_with_sides(const HostGrid &grid, const TriangleTable &names, const PointSides &sides,
                       bool by_normals, const PointArrays<double> &io)
{
  answer(grid, names, sides, by_normals, io);
}

void estimate_sides(const PointSides &sides, std::size_t n, const StridedView<const float> &points,
                    const Column<float> &number, std::int8_t *side, std::uint8_t *status)
{
  estimate(sides, n, points, number, side, status);
}
void estimate_sides(const PointSides &sides, std::size_t n, const StridedView<const double> &points,
                    const Column<double> &number, std::int8_t *side, std::uint8_t *status)
{
  estimate(sides, n, points, number, side, status);
}

void fill_sides(const PointSides &sides, std::size_t n, const double *at, std::int8_t *side)
{
  fill(sides, n, StridedView<const double>{at, 3, 1}, side);
}

}    // namespace lsdcd
