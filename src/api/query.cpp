// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_query_*, lsdcd_stream_*
#include "api/c_border.h"
#include "api/call_progress.h"
#include "api/call_threads.h"
#include "api/device_memory.h"
#include "api/points_given.h"
#include "backend/backend_cpu.h"
#include "engine/wall_engine.h"
#include "query/radius_error.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

using namespace lsdcd;

struct lsdcd_stream {
  std::shared_ptr<const ApiGrid> grid;
#if defined(LSDCD_HAVE_CUDA)
  std::shared_ptr<const DeviceCopy> copy;
  std::unique_ptr<StreamQuery> query;
#endif
};

namespace {

void check_sides(const ApiGrid &grid, bool on_host)
{
  if (!grid.has_sides)
    throw ApiError(LSDCD_ERROR_SIDE,
                   "the mesh is not closed and oriented, so that it has no side: " +
                       why_no_inside(grid.mesh->mesh) +
                       "; `estimate_sides` gives those of the winding number, on the host");
  if (!on_host && !grid.sides_by_normals())
    throw ApiError(LSDCD_ERROR_SIDE,
                   "triangles of the mesh cut, overlap or touch each other, and only the "
                   "host tells its sides: use lsdcd_query_host()");
}

// Checks a query of this grid and fills in defaults.
lsdcd_query checked_query(const ApiGrid &grid, const lsdcd_query *given, bool on_host)
{
  lsdcd_query q = checked(given, "lsdcd_query", offsetof(lsdcd_query, winding));
  check_points(q);
  if (q.n > 0 && !q.distance && !q.closest && !q.normal && !q.triangle && !q.feature && !q.side &&
      !q.status && !q.winding && !q.signed_distance && !q.barycentric)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "nothing is asked for: all arrays of answers are null");
  if (q.winding && !on_host)
    throw ApiError(LSDCD_ERROR_SIDE, "only the host tells winding numbers: use lsdcd_query_host()");
  const bool with_sides = q.side || q.signed_distance;
  q.estimate_sides = with_sides && q.estimate_sides && on_host && !grid.has_sides;
  if (with_sides && !q.estimate_sides) check_sides(grid, on_host);
  settle_radius(grid, q);
  return q;
}

template <class T>
void answer_on_host(const ApiGrid &grid, const PointArrays<T> &io)
{
  if (grid.uses_tree()) {
    answer_with_sides(grid.tree(), grid.near(), grid.mesh->sides, grid.cutoff(), io);
    return;
  }
  const ApiCells &cells = grid.cells();
  answer_with_sides(cells.grid, grid.names, grid.mesh->sides, cells.sides_by_normals, io);
}

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

// Of all points before any is answered, so that an error of a part has the number of its point.
template <class T>
void check_radii(const ApiGrid &grid, const lsdcd_query &q)
{
  const Column<const T> radii = numbers(static_cast<const T *>(q.radii), q.radii_step);
  const T most = static_cast<T>(grid.cutoff());
  for (std::size_t i = 0; i < q.n; i++)
    if (!(radii[i] >= 0 && radii[i] <= most)) throw_bad_radius("point", i, radii[i], most);
}

template <class T>
void answer_on_host(const ApiGrid &grid, const lsdcd_query &q)
{
  PointArrays<T> io = arrays_of<T>(q);
  // Sides are found after distances here, and the sign last.
  const Column<T> with_sign = std::exchange(io.signed_distance, {});
  if (with_sign.at && !io.distance.at) io.distance = with_sign;
  std::vector<std::int8_t> own_sides(with_sign.at && !q.side ? q.n : 0);
  std::int8_t *const side = own_sides.empty() ? q.side : own_sides.data();
  io.side = q.estimate_sides ? nullptr : side;
  if (io.distance.at || io.status || io.side || !io.only_distance()) answer_on_host(grid, io);
  if (q.winding || q.estimate_sides)
    estimate_sides(grid.mesh->sides, io.n, io.points,
                   numbers(static_cast<T *>(q.winding), q.winding_step),
                   q.estimate_sides ? side : nullptr, q.status);
  if (with_sign.at)
    CpuBackend().for_each(q.n, [&](std::size_t i) {
      with_sign[i] = static_cast<T>(signed_distance(io.distance[i], side[i]));
    });
}

template <class T>
void answer_in_parts(const ApiGrid &grid, const lsdcd_query &q)
{
  if (q.progress && q.radii) check_radii<T>(grid, q);
  CallProgress progress(q.progress, q.data);
  // Before the points, as no part of these is told while they are made.
  if (q.progress && (q.winding || q.estimate_sides))
    grid.mesh->sides.generalized(progress.listener());
  if (q.progress && (q.side || q.signed_distance) && !q.estimate_sides && grid.uses_tree())
    grid.mesh->sides.winding(progress.listener());
  progress.in_parts("points", q.n, [&](std::size_t from, std::size_t n) {
    answer_on_host<T>(grid, part_of<T>(q, from, n));
  });
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
      if (device.only_there(array))
        throw ApiError(LSDCD_ERROR_DEVICE, std::string("the array `") + name +
                                               "` is in a GPU's memory: use lsdcd_query_stream()");
    });
    const CallThreads threads(q.threads);
    if (q.type == LSDCD_FLOAT)
      answer_in_parts<float>(g, q);
    else
      answer_in_parts<double>(g, q);
  });
}

int lsdcd_has_cuda(void)
{
  bool yes = false;
  guard([&] {
    std::string why;
    yes = cuda_available(&why);
    if (!yes) throw ApiError(LSDCD_ERROR_DEVICE, why);
  });
  return yes;
}

#if defined(LSDCD_HAVE_CUDA)

namespace {

// For all streams of a device.
std::shared_ptr<const DeviceCopy> copy_on_cuda(const ApiGrid &grid)
{
  // Before the lock, as it takes long where it is the first call.
  if (grid.is_limited())
    grid.cells(true);
  else
    grid.tree();
  const std::lock_guard<std::mutex> alone(grid.copying);
  const int device = current_cuda_device();
  for (const auto &[on, known] : grid.copies)
    if (on == device)
      if (auto copy = known.lock()) return copy;
  auto copy = grid.is_limited() ? copy_to_cuda(grid.cells().grid.view, grid.names)
                                : copy_to_cuda(grid.tree());
  grid.copies.emplace_back(device, copy);
  return copy;
}

}    // namespace

int lsdcd_stream_open(const lsdcd_grid *grid, void *cuda_stream, lsdcd_stream **stream)
{
  return guard([&] {
    need(stream, "stream");
    need(grid, "grid");
    std::string why;
    if (!cuda_available(&why)) throw ApiError(LSDCD_ERROR_DEVICE, "CUDA: " + why);
    auto made = std::make_unique<lsdcd_stream>();
    made->grid = grid->in;
    made->copy = copy_on_cuda(*made->grid);
    made->query = made->copy->query_on(cuda_stream);
    *stream = made.release();
  });
}

int lsdcd_query_stream(lsdcd_stream *stream, const lsdcd_query *query)
{
  return guard([&] {
    need(stream, "stream");
    const lsdcd_query q = checked_query(*stream->grid, query, false);
    if (q.n == 0) return;
    each_given(q, [&](const void *array, const char *name) {
      try {
        check_on_device(stream->copy->device, array, name);
      } catch (const InputError &e) {
        throw ApiError(LSDCD_ERROR_DEVICE, e.what());
      }
    });
    if (q.type == LSDCD_FLOAT)
      stream->query->answer(arrays_of<float>(q));
    else
      stream->query->answer(arrays_of<double>(q));
  });
}

#else

namespace {

[[noreturn]] void throw_no_cuda()
{
  throw ApiError(LSDCD_ERROR_DEVICE,
                 "this build of the library is for the CPU only; use lsdcd_query_host()");
}

}    // namespace

int lsdcd_stream_open(const lsdcd_grid *grid, void *, lsdcd_stream **stream)
{
  return guard([&] {
    need(stream, "stream");
    need(grid, "grid");
    throw_no_cuda();
  });
}

int lsdcd_query_stream(lsdcd_stream *stream, const lsdcd_query *)
{
  return guard([&] {
    need(stream, "stream");
    throw_no_cuda();
  });
}

#endif

void lsdcd_stream_free(lsdcd_stream *stream)
{
  delete stream;
}

}    // extern "C"
