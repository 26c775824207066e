// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distance, closest point, triangle and side of points against a wall, in the caller's own arrays.
#pragma once

#include "grid/lookup/brick_words.h"
#include "query/point_work.h"

#include <memory>
#include <vector>

namespace lsdcd {

// A grid on the host, borrowed, with its brick table as bits.
struct HostGrid {
  GridView view = {};
  std::vector<BrickWord> words;
  BrickTable table;

  HostGrid() = default;
  HostGrid(HostGrid &&) = default;    // keeps the words where they are
  HostGrid &operator=(HostGrid &&) = default;
  explicit HostGrid(const GridView &grid) :
      view(grid), words(brick_words(grid)), table(words, words.data())
  {
  }
};

// On the host, with threads() threads. It keeps no memory, so that any number of threads may call it at
// once. Throws InputError if a radius in `radii` exceeds the grid's cutoff; the answers are then
// undefined.
void answer_points(const HostGrid &grid, const TriangleTable &names, const PointArrays<float> &io);
void answer_points(const HostGrid &grid, const TriangleTable &names, const PointArrays<double> &io);

// A copy of a grid, a flat block, on the CUDA device that is current.
class DeviceGrid;
std::shared_ptr<const DeviceGrid> copy_to_cuda(const GridView &grid, const TriangleTable &names);
int device_of(const DeviceGrid &grid);
int current_cuda_device();

// A query on a stream (cudaStream_t) of that device, for arrays that the device can read. It does not wait
// for the stream, unless `radii` have to be checked. Only one thread may use it at a time.
class StreamQuery {
 public:
  virtual ~StreamQuery() = default;
  virtual void answer(const PointArrays<float> &io) = 0;
  virtual void answer(const PointArrays<double> &io) = 0;
};
std::unique_ptr<StreamQuery> make_stream_query(std::shared_ptr<const DeviceGrid> grid,
                                               void *stream);

// Throws InputError naming `what` unless the array is in memory that this device can reach.
void check_on_device(const DeviceGrid &grid, const void *array, const char *what);

}    // namespace lsdcd
