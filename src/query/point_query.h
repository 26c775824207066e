// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Finds distance, closest point, triangle and side of points relative to a wall, in the caller's own arrays.
#pragma once

#include "grid/lookup/brick_words.h"
#include "query/point_work.h"

#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

class TriangleTree;

// A borrowed grid on the CPU, with its brick table as bits.
struct CpuGrid {
  ViewOf<QueryGrid> view{GridView()};
  std::vector<BrickWord> words;
  BrickTable table;

  CpuGrid() = default;
  CpuGrid(CpuGrid &&) = default;    // the words stay in place
  CpuGrid &operator=(CpuGrid &&) = default;
  explicit CpuGrid(const ViewOf<QueryGrid> &grid) :
      view(grid), words(brick_words(grid)), table(words, words.data())
  {
  }
};

// Computes on the CPU, with threads() threads. There is no state, so that any number of threads may call it at
// the same time. Throws InputError if a radius in `radii` exceeds the grid's cutoff; the answers are then
// undefined. T: float or double.
template <class T>
void query_grid(const CpuGrid &grid, const TriangleTable &names, const PointArrays<T> &io);

// A query on a stream (cudaStream_t), for arrays that its device can read. It does not wait for the stream,
// unless `radii` have to be checked. Only one thread at a time may use it.
class StreamQuery {
 public:
  virtual ~StreamQuery() = default;
  virtual void enqueue(const PointArrays<float> &io) = 0;
  virtual void enqueue(const PointArrays<double> &io) = 0;
};

int current_cuda_device();
std::string current_cuda_name();

// A grid or tree on the CUDA device that was current when it was copied.
class DeviceCopy : public std::enable_shared_from_this<DeviceCopy> {
 public:
  virtual ~DeviceCopy() = default;
  // Returns a query on a stream of that device; null: the default stream. The query shares this copy.
  virtual std::unique_ptr<StreamQuery> query_on(void *stream) const = 0;

  const int device = current_cuda_device();
};
// Copies cells with lists, which answer up to their cutoff, or a tree, which answers at any distance, to the
// current device.
std::shared_ptr<const DeviceCopy> copy_to_cuda(const ViewOf<QueryGrid> &grid,
                                               const TriangleTable &names);
std::shared_ptr<const DeviceCopy> copy_to_cuda(const TriangleTree &tree);

// Throws InputError naming `what` unless the array is in memory that this device can reach.
void check_on_device(int device, const void *array, const char *what);

}    // namespace lsdcd
