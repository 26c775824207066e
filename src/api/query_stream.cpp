// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_has_cuda, lsdcd_stream_*, lsdcd_query_stream
#include "api/c_border.h"
#include "api/query_arrays.h"
#include "engine/engine.h"

using namespace lsdcd;

struct lsdcd_stream {
  std::shared_ptr<const ApiGrid> grid;
#if defined(LSDCD_HAVE_CUDA)
  std::shared_ptr<const DeviceCopy> copy;
  std::unique_ptr<StreamQuery> query;
#endif
};

namespace {

#if defined(LSDCD_HAVE_CUDA)
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
#else
constexpr const char *kNoCuda =
    "this build of the library is for the CPU only; use lsdcd_query_host()";
#endif

}    // namespace

extern "C" {

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

int lsdcd_stream_open(const lsdcd_grid *grid, void *cuda_stream, lsdcd_stream **stream)
{
  return guard([&] {
    need(stream, "stream");
    need(grid, "grid");
#if defined(LSDCD_HAVE_CUDA)
    std::string why;
    if (!cuda_available(&why)) throw ApiError(LSDCD_ERROR_DEVICE, "CUDA: " + why);
    auto made = std::make_unique<lsdcd_stream>();
    made->grid = grid->in;
    made->copy = copy_on_cuda(*made->grid);
    made->query = made->copy->query_on(cuda_stream);
    *stream = made.release();
#else
    (void) cuda_stream;
    throw ApiError(LSDCD_ERROR_DEVICE, kNoCuda);
#endif
  });
}

int lsdcd_query_stream(lsdcd_stream *stream, const lsdcd_query *query)
{
  return guard([&] {
    need(stream, "stream");
#if defined(LSDCD_HAVE_CUDA)
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
      stream->query->enqueue(arrays_of<float>(q));
    else
      stream->query->enqueue(arrays_of<double>(q));
#else
    (void) query;
    throw ApiError(LSDCD_ERROR_DEVICE, kNoCuda);
#endif
  });
}

void lsdcd_stream_free(lsdcd_stream *stream)
{
  delete stream;
}

}    // extern "C"
