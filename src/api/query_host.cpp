// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_query_host, and the checks of all queries
#include "api/c_border.h"
#include "api/call_progress.h"
#include "api/call_threads.h"
#include "api/device_memory.h"
#include "api/query_arrays.h"
#include "api/refusals.h"
#include "backend/backend_cpu.h"
#include "query/radius_error.h"

#include <cstddef>
#include <cstdlib>
#include <utility>
#include <vector>

namespace lsdcd {

namespace {

void check_sides(const ApiGrid &grid, bool on_cpu)
{
  if (!grid.has_sides)
    throw ApiError(LSDCD_ERROR_SIDE,
                   "the mesh is not closed and oriented, so it has no side: " +
                       why_no_inside(grid.mesh->mesh) +
                       "; `estimate_sides` gives those of the winding number, on the host");
  if (!on_cpu && !grid.sides_by_normals())
    throw ApiError(LSDCD_ERROR_SIDE,
                   "triangles of the mesh cut, overlap or touch each other, and only the "
                   "host tells its sides: use lsdcd_query_host()");
}

// Refuses an array of vectors in which numbers of two points have one place, where the answer to one of them would be lost.
void check_rows(const lsdcd_query &q, const void *array, std::ptrdiff_t row, std::ptrdiff_t column,
                const char *name)
{
  if (!array) return;
  if (row == 0) row = 3;
  if (column == 0) column = 1;
  for (std::ptrdiff_t k = 1; k < 3; k++) {
    if (k * column % row != 0 || static_cast<std::size_t>(std::abs(k * column / row)) >= q.n)
      continue;
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "`" + std::string(name) +
                       "`: numbers of several points have one place with a row of " +
                       std::to_string(row) + " and a column of " + std::to_string(column) +
                       ": give a row of 3 or more, or a column of `n` or more");
  }
}

}    // namespace

lsdcd_query checked_query(const ApiGrid &grid, const lsdcd_query *given, bool on_cpu)
{
  lsdcd_query q = checked(given, "lsdcd_query");
  check_points(q);
  checked_flag(q.estimate_sides, "estimate_sides");
  if (q.n > 0 && !q.distance && !q.closest && !q.normal && !q.triangle && !q.feature && !q.side &&
      !q.status && !q.winding && !q.signed_distance && !q.barycentric)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "nothing is asked for: all arrays of answers are null");
  if (q.winding && !on_cpu)
    throw ApiError(LSDCD_ERROR_SIDE, "only the host tells winding numbers: use lsdcd_query_host()");
  if ((q.side || q.signed_distance) && !(on_cpu && needs_estimate(grid, q)))
    check_sides(grid, on_cpu);
  check_rows(q, q.closest, q.closest_row, q.closest_column, "closest");
  check_rows(q, q.normal, q.normal_row, q.normal_column, "normal");
  check_rows(q, q.barycentric, q.barycentric_row, q.barycentric_column, "barycentric");
  settle_radius(grid, q);
  return q;
}

}    // namespace lsdcd

using namespace lsdcd;

namespace {

// The query of n points from one on.
template <class T>
lsdcd_query part_of(lsdcd_query q, std::size_t from, std::size_t n)
{
  const auto skip = [from](auto *&array, auto *typed, std::ptrdiff_t each) {
    if (array)
      array = static_cast<decltype(typed)>(array) + static_cast<std::ptrdiff_t>(from) * each;
  };
  const T *given = nullptr;
  T *wanted = nullptr;
  q.n = n;
  skip(q.points, given, q.points_row == 0 ? 3 : q.points_row);
  skip(q.radii, given, q.radii_step == 0 ? 1 : q.radii_step);
  skip(q.distance, wanted, q.distance_step == 0 ? 1 : q.distance_step);
  skip(q.closest, wanted, q.closest_row == 0 ? 3 : q.closest_row);
  skip(q.normal, wanted, q.normal_row == 0 ? 3 : q.normal_row);
  skip(q.winding, wanted, q.winding_step == 0 ? 1 : q.winding_step);
  skip(q.signed_distance, wanted, q.signed_distance_step == 0 ? 1 : q.signed_distance_step);
  skip(q.barycentric, wanted, q.barycentric_row == 0 ? 3 : q.barycentric_row);
  skip(q.triangle, q.triangle, 1);
  skip(q.feature, q.feature, 1);
  skip(q.side, q.side, 1);
  skip(q.status, q.status, 1);
  return q;
}

// Checks all points before any is answered, so that an error of a part has the number of its point.
template <class T>
void check_radii(const ApiGrid &grid, const lsdcd_query &q)
{
  const Column<const T> radii = numbers(static_cast<const T *>(q.radii), q.radii_step);
  const T most = static_cast<T>(grid.cutoff());
  for (std::size_t i = 0; i < q.n; i++)
    if (!(radii[i] >= 0 && radii[i] <= most)) throw_bad_radius("point", i, radii[i], most);
}

template <class T>
void query_part(const ApiGrid &grid, const lsdcd_query &q)
{
  PointArrays<T> io = arrays_of<T>(q);
  const bool estimates = needs_estimate(grid, q);
  // Sides are found after distances here, and the sign last.
  const Column<T> with_sign = std::exchange(io.signed_distance, {});
  if (with_sign.at && !io.distance.at) io.distance = with_sign;
  std::vector<std::int8_t> own_sides(with_sign.at && !q.side ? q.n : 0);
  std::int8_t *const side = own_sides.empty() ? q.side : own_sides.data();
  io.side = estimates ? nullptr : side;
  if (!io.distance.at && !io.status && io.only_distance()) {
    // Only winding numbers are asked for, or estimated sides.
  } else if (grid.uses_tree()) {
    query_with_sides(grid.tree(), grid.near(), grid.mesh->sides, grid.cutoff(), io);
  } else {
    query_with_sides(grid.cells().grid, grid.names, grid.mesh->sides, grid.host_sides_by_normals(),
                     io);
  }
  if (q.winding || estimates)
    estimate_sides(grid.mesh->sides, io.n, io.points,
                   numbers(static_cast<T *>(q.winding), q.winding_step), estimates ? side : nullptr,
                   q.status);
  if (with_sign.at)
    CpuBackend().for_each(q.n, [&](std::size_t i) {
      with_sign[i] = static_cast<T>(signed_distance(io.distance[i], side[i]));
    });
}

template <class T>
void query_in_parts(const ApiGrid &grid, const lsdcd_query &q)
{
  if (q.progress && q.radii) check_radii<T>(grid, q);
  CallProgress progress(q.progress, q.data);
  // These are made before the points, as no part of a point is reported while they are made.
  const bool estimates = needs_estimate(grid, q);
  if (q.progress && (q.winding || estimates)) grid.mesh->sides.generalized(progress.listener());
  if (q.progress && (q.side || q.signed_distance) && !estimates && !grid.host_sides_by_normals())
    grid.mesh->sides.winding(progress.listener());
  progress.in_parts("points", q.n, [&](std::size_t from, std::size_t n) {
    query_part<T>(grid, part_of<T>(q, from, n));
  });
}

}    // namespace

extern "C" {

int lsdcd_query_host(const lsdcd_grid *grid, const lsdcd_query *query)
{
  return guard([&] {
    need(grid, "grid");
    const ApiGrid &g = *grid->in;
    const lsdcd_query q = checked_query(g, query, true);
    if (q.n == 0) return;
    const DeviceMemory device;
    each_given(q, [&](const void *array, const char *name) {
      device.refuse_there(array, name, "use lsdcd_query_stream()");
    });
    const CallThreads threads(q.threads);
    if (q.type == LSDCD_FLOAT)
      query_in_parts<float>(g, q);
    else
      query_in_parts<double>(g, q);
  });
}

}    // extern "C"
