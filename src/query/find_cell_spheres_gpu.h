// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The first kernel of a query on a GPU: it answers every sphere as if the wall were far away, and lists the
// spheres in occupied cells.
#pragma once

#include "backend/atomic.h"
#include "backend/block.h"
#include "grid/lookup/brick_filter.h"
#include "query/sphere.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

// A sphere in an occupied cell, with the list of that cell, so that the kernel that answers waits for neither.
template <class S>
struct alignas(16) CellSphere {
  S s;
  Cell cell;
  std::uint32_t sphere, pad;
};

// For the first kernel: threads in a block, blocks at once on a processor (32 registers a thread), and bytes
// of spheres that each thread loads at once.
constexpr unsigned kFindBlock = 256, kFindBlocks = 8, kFindBytes = 64;
template <class S>
constexpr unsigned kFindEach = kFindBytes / sizeof(S);
template <class S>
constexpr unsigned kFindTile = kFindBlock *kFindEach<S>;

// There are as many lists of spheres as a warp has threads. Block k writes to list k modulo that number, and
// each list has a count of its own. A list grows from its front by spheres whose cell has one entry, and from
// its back by those with more entries.
constexpr unsigned kSphereLists = kWarpSize;
struct CellSphereCounts {
  struct alignas(128) OfList {
    unsigned long long n;    // low word: one entry; high word: more entries
  } list[kSphereLists];
  unsigned with_long;    // how many of the spheres with more entries have long lists
};
template <class S>
struct CellSphereLists {
  CellSphere<S> *first;
  unsigned room;    // length of a list
  CellSphereCounts *counts;

  LSDCD_GPU_FN CellSphere<S> *list(unsigned l) const { return first + std::size_t(l) * room; }
};

// Answers n spheres as if all were far away, and lists those that are not.
template <class Work>
struct FindCellSpheres {
  static constexpr unsigned kThreads = kFindBlock, kBlocksAtOnce = kFindBlocks;
  using S = typename Work::Item;

  unsigned n;
  Work work;
  CellSphereLists<S> lists;

  LSDCD_GPU_FN void operator()(const Block &block) const
  {
    block.let_next_begin();
    LSDCD_SHARED Chunk room[kFindTile<S> * sizeof(S) / sizeof(Chunk)];
    LSDCD_SHARED std::uint16_t maybe_at[kFindTile<S>];
    LSDCD_SHARED std::uint32_t coarse[CoarseTable::kWords];
    LSDCD_SHARED unsigned n_maybe;
    S *const sphere = reinterpret_cast<S *>(room);

    const unsigned tile = block.number() * kFindTile<S>, n_tile = min(n - tile, kFindTile<S>);
    begin_to_load(block, tile, n_tile, sphere);
    load_coarse(block, coarse);
    if (block.thread() == 0) n_maybe = 0;
    block.wait();
    wait_for_copies();    // this thread's own

    list_maybe(block, n_tile, read_bricks(block, sphere, coarse), maybe_at, &n_maybe);
    answer_far(block, tile, n_tile);
    block.wait();

    list_in_cells(block, tile, sphere, maybe_at, n_maybe);
  }

 private:
  static constexpr unsigned kEach = kFindEach<S>;

  // Which spheres of a thread may be in a brick. Its sphere k is sphere thread() + k * kFindBlock of the tile.
  struct BrickBits {
    // The word of the table for sphere k, and 5 bits for each sphere: the number of its bit in that word. All bits of the
    // word are set if the brick of the sphere is not certain.
    std::uint32_t word[kEach], bit = 0;
    static_assert(5 * kEach <= 32, "in one number");

    LSDCD_GPU_FN bool maybe(unsigned k) const { return word[k] >> (bit >> 5 * k) % 32 & 1u; }
  };

  // Begins to copy the tile to shared memory, in which `sphere` is. Each thread copies the spheres that it tests.
  LSDCD_GPU_FN void begin_to_load(const Block &block, unsigned tile, unsigned n_tile,
                                  S *sphere) const
  {
#pragma unroll
    for (unsigned k = 0; k < kEach; k++) {
      const unsigned i = block.thread() + k * kFindBlock;
      const Chunk *from = reinterpret_cast<const Chunk *>(work.spheres + tile + min(i, n_tile - 1));
#pragma unroll
      for (unsigned chunk = 0; chunk < sizeof(S) / sizeof(Chunk); chunk++)
        begin_copy(reinterpret_cast<Chunk *>(sphere + i) + chunk, from + chunk);
    }
    commit_copies();
  }

  // Copies the coarse table to shared memory.
  LSDCD_GPU_FN void load_coarse(const Block &block, std::uint32_t *coarse) const
  {
    for (unsigned w = block.thread(); w < CoarseTable::kWords; w += kFindBlock)
      coarse[w] = work.coarse.words[w];
  }

  // Guesses the bricks of this thread's spheres, and reads from the tables whether they are occupied.
  LSDCD_GPU_FN BrickBits read_bricks(const Block &block, const S *sphere,
                                     const std::uint32_t *coarse) const
  {
    BrickBits bits;
#pragma unroll
    for (unsigned k = 0; k < kEach; k++) {
      const BrickGuess guess = work.guess(sphere[block.thread() + k * kFindBlock]);
      bits.word[k] = guess.unsure ? ~0u : 0;
      if (guess.inside & !guess.unsure &&
          CoarseTable::at(coarse, work.filter.index(work.coarse, guess))) {
        const std::uint32_t index = work.filter.index(work.grid, guess);
        bits.bit |= index % 32 << 5 * k;
        bits.word[k] = work.table.words[index / 32].bits;
      }
    }
    return bits;
  }

  // Lists, in shared memory, the spheres of the tile that may be in a brick.
  LSDCD_GPU_FN void list_maybe(const Block &block, unsigned n_tile, const BrickBits &bits,
                               std::uint16_t *maybe_at, unsigned *n_maybe) const
  {
    const GpuWarp warp;
    unsigned votes[kEach], all = 0;
#pragma unroll
    for (unsigned k = 0; k < kEach; k++) {
      const bool there = block.thread() + k * kFindBlock < n_tile;
      votes[k] = warp.vote(there && bits.maybe(k));
      all += warp.count(votes[k]);
    }
    unsigned to = warp.take_room(n_maybe, all);
#pragma unroll
    for (unsigned k = 0; k < kEach; k++) {
      if (votes[k] >> warp.rank() & 1u) {
        const unsigned at = to + warp.count_below(votes[k]);
        maybe_at[at] = static_cast<std::uint16_t>(block.thread() + k * kFindBlock);
      }
      to += warp.count(votes[k]);
    }
  }

  // Answers all spheres of the tile as if they were far away. Later kernels overwrite the answers of those that are not.
  LSDCD_GPU_FN void answer_far(const Block &block, unsigned tile, unsigned n_tile) const
  {
    for (unsigned four = 4 * block.thread(); four < n_tile; four += 4 * kFindBlock)
      if (four + 4 <= n_tile)
        work.four_far(tile + four);
      else
        for (unsigned i = four; i < n_tile; i++) work.far(tile + i);
  }

  // Finds the cells of the spheres that may be in a brick, and lists those in occupied cells for the next kernels. Only few
  // spheres may be in a brick: they are tested in full warps, nearly always in one round.
  LSDCD_GPU_FN void list_in_cells(const Block &block, unsigned tile, const S *sphere,
                                  const std::uint16_t *maybe_at, unsigned n_maybe) const
  {
    for (unsigned first = block.warp() * kWarpSize; first < n_maybe; first += kFindBlock) {
      const unsigned m = first + GpuWarp::rank();
      CellSphere<S> in_cell;
      in_cell.pad = 0;
      std::uint32_t cell = kNoCell;
      if (m < n_maybe) {
        in_cell.sphere = tile + maybe_at[m];
        in_cell.s = sphere[maybe_at[m]];
        work.check(in_cell.sphere, in_cell.s);
        cell = work.cell(in_cell.s);
        if (cell != kNoCell) in_cell.cell = *work.list(cell);
      }
      append(block.number() % kSphereLists, cell != kNoCell, in_cell);
    }
  }

  // Adds to a list the spheres of the warp's threads that are in occupied cells.
  LSDCD_GPU_FN void append(unsigned list, bool is_occupied, const CellSphere<S> &in_cell) const
  {
    const GpuWarp warp;
    const bool is_one = is_occupied && in_cell.cell.count == 1;
    const unsigned one = warp.vote(is_one), more = warp.vote(is_occupied && !is_one);
    unsigned long long at = 0;
    if (warp.rank() == 0 && (one | more) != 0)
      at = fetch_add(&lists.counts->list[list].n,
                     static_cast<unsigned long long>(warp.count(more)) << 32 | warp.count(one));
    at = warp.of(at, 0);
    const unsigned to =
        is_one ? static_cast<unsigned>(at) + warp.count_below(one)
               : lists.room - 1 - static_cast<unsigned>(at >> 32) - warp.count_below(more);
    if (is_occupied) lists.list(list)[to] = in_cell;
  }
};

}    // namespace lsdcd
