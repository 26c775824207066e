// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "query/point_sides.h"

#include "backend/backend_cpu.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsdcd {

namespace {

// Calls query(io) for all but sides, and for these, too, where normals give them. Sides that it leaves 0 are those of
// winding numbers.
template <class T, class Query>
void query_then_fill(const PointSides &sides, bool by_normals, const PointArrays<T> &io,
                     const Query &query)
{
  PointArrays<T> asked = io;
  if (!by_normals) asked.side = nullptr;
  query(asked);
  if (!io.side) return;
  if (!by_normals) std::fill_n(io.side, io.n, std::int8_t(0));
  fill_sides<T>(sides, io.n, io.points, io.side);
}

}    // namespace

template <class T>
void query_with_sides(const CpuGrid &grid, const TriangleTable &names, const PointSides &sides,
                      bool by_normals, const PointArrays<T> &io)
{
  query_then_fill(sides, by_normals, io,
                  [&](const PointArrays<T> &asked) { query_grid(grid, names, asked); });
}
template <class T>
void query_with_sides(const TriangleTree &tree, const CutoffBoxes *boxes, const PointSides &sides,
                      Real cutoff, const PointArrays<T> &io)
{
  query_then_fill(sides, false, io,
                  [&](const PointArrays<T> &asked) { query_tree(tree, boxes, cutoff, asked); });
}

template <class T>
void estimate_sides(const PointSides &sides, std::size_t n, const StridedView<const T> &points,
                    const Column<T> &number, std::int8_t *side, std::uint8_t *status)
{
  const GeneralizedWinding &winding = sides.generalized();
  CpuBackend().for_each(n, [&](std::size_t i) {
    const Vec3 q = points[i];
    const bool is_none = std::isnan(q.x + q.y + q.z);
    const GeneralizedWinding::Answer a = winding.at(q);
    if (number.at)
      number[i] = is_none ? std::numeric_limits<T>::quiet_NaN() : static_cast<T>(a.number);
    if (!side) return;
    side[i] = static_cast<std::int8_t>(is_none ? 0 : GeneralizedWinding::side(a));
    if (status) status[i] |= kSideEstimated;
  });
}

template <class T>
void fill_sides(const PointSides &sides, std::size_t n, const StridedView<const T> &points,
                std::int8_t *side)
{
  if (std::find(side, side + n, 0) == side + n) return;
  const WindingNumber &winding = sides.winding();
  CpuBackend().for_each(n, [&](std::size_t i) {
    const Vec3 q = points[i];
    if (side[i] == 0 && !std::isnan(q.x + q.y + q.z))
      side[i] = static_cast<std::int8_t>(winding.side(q));
  });
}

template void query_with_sides(const CpuGrid &, const TriangleTable &, const PointSides &, bool,
                               const PointArrays<float> &);
template void query_with_sides(const TriangleTree &, const CutoffBoxes *, const PointSides &, Real,
                               const PointArrays<float> &);
template void estimate_sides(const PointSides &, std::size_t, const StridedView<const float> &,
                             const Column<float> &, std::int8_t *, std::uint8_t *);
template void query_with_sides(const CpuGrid &, const TriangleTable &, const PointSides &, bool,
                               const PointArrays<double> &);
template void query_with_sides(const TriangleTree &, const CutoffBoxes *, const PointSides &, Real,
                               const PointArrays<double> &);
template void estimate_sides(const PointSides &, std::size_t, const StridedView<const double> &,
                             const Column<double> &, std::int8_t *, std::uint8_t *);
template void fill_sides(const PointSides &, std::size_t, const StridedView<const double> &,
                         std::int8_t *);

}    // namespace lsdcd
