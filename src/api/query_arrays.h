// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Queries of points by the library: the checks of lsdcd_query, and its arrays.
#pragma once

#include "api/points_given.h"
#include "query/point_query.h"

#include <cmath>
#include <utility>

namespace lsdcd {

// Are sides asked for that the mesh does not have, and an estimate of them on the host?
inline bool needs_estimate(const ApiGrid &grid, const lsdcd_query &q)
{
  return (q.side || q.signed_distance) && q.estimate_sides && !grid.has_sides;
}

// Returns the caller's query with its defaults filled in. Throws ApiError where it does not fit the grid.
lsdcd_query checked_query(const ApiGrid &grid, const lsdcd_query *given, bool on_cpu);

template <class T>
PointArrays<T> arrays_of(const lsdcd_query &q)
{
  PointArrays<T> io;
  io.n = q.n;
  io.points = vectors(static_cast<const T *>(q.points), q.points_row, q.points_column);
  io.radii = numbers(static_cast<const T *>(q.radii), q.radii_step);
  // The largest number of this type that is not above it, so that float and double give the same answers.
  io.radius = static_cast<T>(q.radius);
  if (io.radius > q.radius) io.radius = std::nextafter(static_cast<T>(q.radius), T(0));
  io.distance = numbers(static_cast<T *>(q.distance), q.distance_step);
  io.closest = vectors(static_cast<T *>(q.closest), q.closest_row, q.closest_column);
  io.normal = vectors(static_cast<T *>(q.normal), q.normal_row, q.normal_column);
  io.signed_distance = numbers(static_cast<T *>(q.signed_distance), q.signed_distance_step);
  io.barycentric =
      vectors(static_cast<T *>(q.barycentric), q.barycentric_row, q.barycentric_column);
  io.triangle = q.triangle;
  io.feature = q.feature;
  io.side = q.side;
  io.status = q.status;
  return io;
}

// check(array, name) of each array that is given.
template <class Check>
void each_given(const lsdcd_query &q, const Check &check)
{
  const std::pair<const void *, const char *> arrays[] = {{q.points, "points"},
                                                          {q.radii, "radii"},
                                                          {q.distance, "distance"},
                                                          {q.closest, "closest"},
                                                          {q.normal, "normal"},
                                                          {q.triangle, "triangle"},
                                                          {q.feature, "feature"},
                                                          {q.side, "side"},
                                                          {q.status, "status"},
                                                          {q.winding, "winding"},
                                                          {q.signed_distance, "signed_distance"},
                                                          {q.barycentric, "barycentric"}};
  for (const auto &[array, name] : arrays)
    if (array) check(array, name);
}

}    // namespace lsdcd
