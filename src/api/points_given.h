// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Points with radii as calls take them: what lsdcd_query and lsdcd_contacts have in common. Q is either.
#pragma once

#include "api/c_border.h"
#include "api/objects.h"
#include "base/input_words.h"
#include "base/strided_view.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace lsdcd {

template <class Q>
void check_points(const Q &q)
{
  check_type(q.type);
  check_threads(q.threads);
  if (q.n > static_cast<std::size_t>(std::numeric_limits<std::int64_t>::max()) / 64)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "`n` is " + std::to_string(q.n));
  if (q.n > 0) need(q.points, "points");
}

// Without radii and radius: as far as the grid finds anything.
template <class Q>
void settle_radius(const ApiGrid &grid, Q &q)
{
  if (q.radii && q.radius != 0)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "`radii` and `radius` are both given");
  if (!q.radii && q.radius == 0) q.radius = grid.is_limited() ? grid.cutoff() : kAnyDistance;
  if (!(q.radius >= 0))
    throw ApiError(LSDCD_ERROR_ARGUMENT, "`radius` is " + number_text(q.radius));
  if (q.radius > grid.cutoff())
    throw ApiError(LSDCD_ERROR_CUTOFF,
                   "`radius` is " + number_text(q.radius) + ", more than the grid's cutoff " +
                       number_text(grid.cutoff()) + ": build the grid with a larger cutoff");
}

template <class T>
StridedView<T> vectors(T *at, std::ptrdiff_t row, std::ptrdiff_t column)
{
  return {at, row == 0 ? 3 : row, column == 0 ? 1 : column};
}
template <class T>
Column<T> numbers(T *at, std::ptrdiff_t step)
{
  return {at, step == 0 ? 1 : step};
}

}    // namespace lsdcd
