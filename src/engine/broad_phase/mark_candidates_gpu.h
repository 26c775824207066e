// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The first part of the broad phase on a GPU: a test of each sphere by cells, which sets a bit or lists the sphere for
// the exact test.
#pragma once

#include "base/strided_view.h"
#include "engine/broad_phase/refine_gpu.h"
#include "engine/broad_phase/shared_brick_table_gpu.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

constexpr unsigned kMarkTile = 128,
                   kMarkWords = kMarkTile / kWarpSize;    // spheres of a warp at a time

// Warps of a block at most, and blocks at once on a processor: 48 registers a thread.
constexpr unsigned kMarkWarps = 20, kMarkBlocks = 2;

// A warp's tile.
struct alignas(16) MarkTile {
  double centre[kMarkTile][3];
  unsigned passes[kMarkWords];        // a bit for each sphere
  std::uint8_t waiting[kMarkTile];    // spheres that pass the coarse test
};

// Begins to load n rows from `first` on for a warp. They are there after wait_for_copies() and a
// barrier. Packed rows are loaded in parts of 16 bytes, each by any thread.
LSDCD_GPU_FN void load_rows(const StridedView<const double> &rows, std::size_t first, unsigned n,
                            double (*to)[3])
{
  const unsigned rank = GpuWarp::rank();
  if (n == kMarkTile && rows.row == 3 && rows.column == 1 &&
      reinterpret_cast<std::uintptr_t>(rows.of(first)) % sizeof(Chunk) == 0) {
    const Chunk *from = reinterpret_cast<const Chunk *>(rows.of(first)) + rank;
    Chunk *there = reinterpret_cast<Chunk *>(to) + rank;
#pragma unroll
    for (unsigned k = 0; k < kMarkTile * 3 * sizeof(double) / sizeof(Chunk); k += kWarpSize)
      begin_copy(there + k, from + k);
  } else {
    for (unsigned i = rank; i < n; i += kWarpSize) {
      const Vec3 row = rows[first + i];
      to[i][0] = row.x;
      to[i][1] = row.y;
      to[i][2] = row.z;
    }
  }
  commit_copies();
}

// Warps stay, and take one tile after the other. Few spheres pass the coarse test. The rest of the work is
// for these alone, by full warps.
template <bool kTableShared, class Work>
struct MarkCandidates {
  static constexpr unsigned kThreads = kWarpSize * kMarkWarps, kBlocksAtOnce = kMarkBlocks;

  unsigned n;
  Work work;
  unsigned *words;
  CandidateLists list;

  LSDCD_GPU_FN void operator()(const Block &block) const
  {
    constexpr unsigned kEach = kMarkTile / kWarpSize;
    LSDCD_SHARED unsigned turns;
    const GpuWarp warp;
    const unsigned rank = warp.rank(), n_warps = block.n_threads() / kWarpSize;
    MarkTile *const tiles = static_cast<MarkTile *>(block.memory()), &mine = tiles[block.warp()];
    if (block.thread() == 0) turns = n_warps;
    const auto table = [&] {
      if constexpr (kTableShared)
        return SharedBrickTable(work.table, tiles + n_warps);
      else
        return work.table;
    }();
    block.wait();
    const auto centre_of = [&](unsigned i) {
      return Vec3{mine.centre[i][0], mine.centre[i][1], mine.centre[i][2]};
    };

    // A block has every n_blocks()-th tile. Each of its warps takes the next one when it is done.
    for (unsigned turn = block.warp();;) {
      const unsigned tile = turn * block.n_blocks() + block.number(), first = tile * kMarkTile;
      if (first >= n) return;
      const unsigned last = min(n - first, kMarkTile) - 1;
      load_rows(work.centres(), first, last + 1, mine.centre);
      typename Work::Item item[kEach];
      bool odd = false;
#pragma unroll
      for (unsigned k = 0; k < kEach; k++)
        item[k] = work.read(first + min(rank + k * kWarpSize, last));
      if (rank < kMarkWords) mine.passes[rank] = 0;
      turn = warp.take_room(&turns, 1);
#pragma unroll
      for (unsigned k = 0; k < kEach; k++) odd = odd || work.may_be_large(item[k]);
      if (odd)
        for (unsigned i = rank; i <= last; i += kWarpSize)
          work.check(first + i, work.read(first + i));
      wait_for_copies();
      warp.wait();

      unsigned waiting = 0;
#pragma unroll
      for (unsigned k = 0; k < kEach; k++) {
        const unsigned i = rank + k * kWarpSize;
        const bool may = work.coarse_test(item[k], centre_of(min(i, last)), table) & (i <= last);
        const unsigned votes = warp.vote(may);
        if (may) mine.waiting[waiting + warp.count_below(votes)] = static_cast<std::uint8_t>(i);
        waiting += warp.count(votes);
      }
      warp.wait();
#pragma unroll 1    // nearly always one turn
      for (unsigned turn_first = 0; turn_first < waiting; turn_first += kWarpSize) {
        const unsigned w = turn_first + rank, i = mine.waiting[min(w, waiting - 1)];
        const std::uint32_t cell = w < waiting ? work.locate(centre_of(i), table) : Work::kNotFound;
        const bool passes = cell != Work::kNotFound;
        if (passes) set_bits(&mine.passes[i / 32], 1u << i % 32);
        if (list.items) list.put(passes, {first + i, cell});
      }
      warp.wait();
      if (work.has_notes())
        for (unsigned i = rank; i <= last; i += kWarpSize)
          work.note(first + i, mine.passes[i / 32] >> rank & 1u);
      if (rank < kMarkWords) words[tile * kMarkWords + rank] = list.items ? 0 : mine.passes[rank];
      warp.wait();
    }
  }
};

}    // namespace lsdcd
