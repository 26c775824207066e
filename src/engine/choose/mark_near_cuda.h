// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The first part of a choice on a GPU: a test of each sphere by cells, which sets a bit or lists the sphere for
// the exact test.
#pragma once

#include "base/strided_view.h"
#include "engine/choose/refine_cuda.h"
#include "engine/choose/shared_brick_table.h"

#include <cuda_pipeline_primitives.h>
#include <cuda_runtime.h>

#include <cstddef>
#include <cstdint>

namespace lsdcd {

constexpr unsigned kMarkTile = 128,
                   kMarkWords = kMarkTile / kWarpSize;    // spheres of a warp at a time

// Warps of a block at most, and blocks at once on a processor: 48 registers a thread.
constexpr unsigned kMarkWarps = 20, kMarkBlocks = 2, kMarkBlock = kWarpSize * kMarkWarps;

// A warp's tile.
struct alignas(16) MarkTile {
  double centre[kMarkTile][3];
  unsigned kept[kMarkWords];          // a bit for each sphere
  std::uint8_t waiting[kMarkTile];    // spheres that pass the coarse test
};

// Begins to load n rows from `first` on for a warp. They are there after __pipeline_wait_prior(0) and a
// barrier. Packed rows are loaded in parts of 16 bytes, each by any thread.
__device__ inline void load_rows(const StridedView<const double> &rows, std::size_t first,
                                 unsigned n, double (*to)[3])
{
  const unsigned lane = Warp<kWarpSize>::rank();
  if (n == kMarkTile && rows.row == 3 && rows.column == 1 &&
      reinterpret_cast<std::uintptr_t>(rows.of(first)) % sizeof(uint4) == 0) {
    const uint4 *from = reinterpret_cast<const uint4 *>(rows.of(first)) + lane;
    uint4 *there = reinterpret_cast<uint4 *>(to) + lane;
#pragma unroll
    for (unsigned k = 0; k < kMarkTile * 3 * sizeof(double) / sizeof(uint4); k += kWarpSize)
      __pipeline_memcpy_async(there + k, from + k, sizeof(uint4));
  } else {
    for (unsigned i = lane; i < n; i += kWarpSize) {
      const Vec3 row = rows[first + i];
      to[i][0] = row.x;
      to[i][1] = row.y;
      to[i][2] = row.z;
    }
  }
  __pipeline_commit();
}

// Warps stay, and take one tile after the other. Few spheres pass the coarse test. The rest of the work is
// for these alone, by full warps.
template <bool kTableShared, class Work>
__global__ void __launch_bounds__(kMarkBlock, kMarkBlocks)
    mark_near(unsigned n, const __grid_constant__ Work work, unsigned *words,
              const CandidateLists list)
{
  constexpr unsigned kEach = kMarkTile / kWarpSize;
  extern __shared__ uint4 mark_shared[];
  __shared__ unsigned turns;
  const Warp<kWarpSize> warp;
  const unsigned lane = warp.rank(), n_warps = blockDim.x / kWarpSize;
  MarkTile *const tiles = reinterpret_cast<MarkTile *>(mark_shared),
                  &mine = tiles[threadIdx.x / kWarpSize];
  if (threadIdx.x == 0) turns = n_warps;
  const auto table = [&] {
    if constexpr (kTableShared)
      return SharedBrickTable(work.table, tiles + n_warps);
    else
      return work.table;
  }();
  __syncthreads();
  const auto centre_of = [&](unsigned i) {
    return Vec3{mine.centre[i][0], mine.centre[i][1], mine.centre[i][2]};
  };

  // A block has every gridDim.x-th tile. Each of its warps takes the next one when it is done.
  for (unsigned turn = threadIdx.x / kWarpSize;;) {
    const unsigned tile = turn * gridDim.x + blockIdx.x, first = tile * kMarkTile;
    if (first >= n) return;
    const unsigned last = min(n - first, kMarkTile) - 1;
    load_rows(work.centres(), first, last + 1, mine.centre);
    typename Work::Item item[kEach];
    bool odd = false;
#pragma unroll
    for (unsigned k = 0; k < kEach; k++)
      item[k] = work.read(first + min(lane + k * kWarpSize, last));
    if (lane < kMarkWords) mine.kept[lane] = 0;
    turn = warp.take_room(&turns, 1);
#pragma unroll
    for (unsigned k = 0; k < kEach; k++) odd = odd || work.may_be_large(item[k]);
    if (odd)
      for (unsigned i = lane; i <= last; i += kWarpSize)
        work.check(first + i, work.read(first + i));
    __pipeline_wait_prior(0);
    __syncwarp();

    unsigned waiting = 0;
#pragma unroll
    for (unsigned k = 0; k < kEach; k++) {
      const unsigned i = lane + k * kWarpSize;
      const bool may = work.coarse_test(item[k], centre_of(min(i, last)), table) & (i <= last);
      const unsigned votes = warp.vote(may);
      if (may) mine.waiting[waiting + warp.count_below(votes)] = static_cast<std::uint8_t>(i);
      waiting += warp.count(votes);
    }
    __syncwarp();
#pragma unroll 1    // nearly always one turn
    for (unsigned turn_first = 0; turn_first < waiting; turn_first += kWarpSize) {
      const unsigned w = turn_first + lane, i = mine.waiting[min(w, waiting - 1)];
      const std::uint32_t cell = w < waiting ? work.locate(centre_of(i), table) : Work::kNotFound;
      const bool kept = cell != Work::kNotFound;
      if (kept) atomicOr(&mine.kept[i / 32], 1u << (i % 32));
      if (list.items) list.put(kept, {first + i, cell});
    }
    __syncwarp();
    if (work.has_notes())
      for (unsigned i = lane; i <= last; i += kWarpSize)
        work.note(first + i, mine.kept[i / 32] >> lane & 1u);
    if (lane < kMarkWords) words[tile * kMarkWords + lane] = list.items ? 0 : mine.kept[lane];
    __syncwarp();
  }
}

}    // namespace lsdcd
