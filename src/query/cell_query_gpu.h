// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A query on a GPU whose kernels each have one kind of work. The first kernel is light, with many threads and more
// than one sphere in flight in each. It answers every sphere as if the wall were far away, and lists the spheres
// that are near it, with the data that a search reads first. The second kernel searches cells of one entry, and the
// third cells of more entries, both with full warps for any order of the spheres in memory. The last kernel
// searches long lists, each by a warp.
#pragma once

#include "backend/backend.h"
#include "query/find_cell_spheres_gpu.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

// Blocks at once on a processor: they leave 64 registers to a thread for one entry, and 80 for more.
constexpr unsigned kSearchBlock = 256, kSinglesBlocks = 4, kListsBlocks = 3;

// The order in which a block takes the lists: kSearchBlock spheres of one list, then of the next. Lists grow in
// parallel, so that neighbours in memory are searched at about the same time. `n`: the length of the list whose
// number is this thread's rank.
class ListTurns {
 public:
  LSDCD_GPU_FN explicit ListTurns(unsigned n) : n_(n), longest_(GpuWarp::largest(n)) {}

  // Calls search(list, k) for the spheres of this thread.
  template <class Search>
  LSDCD_GPU_FN void take(Search search) const
  {
    for (unsigned turn = Block::number(); turn / kSphereLists * kSearchBlock < longest_;
         turn += Block::n_blocks()) {
      const unsigned list = turn % kSphereLists,
                     k = turn / kSphereLists * kSearchBlock + Block::thread();
      if (k < GpuWarp::of(n_, list)) search(list, k);
    }
  }

  // Returns an odd number of blocks. Lists differ in length, and with an odd number each block takes from all
  // lists, in another order.
  static unsigned blocks(unsigned most) { return (most - 1) | 1; }

 private:
  unsigned n_, longest_;
};
static_assert(kSphereLists == kWarpSize, "a thread for each");

// Answers the listed spheres whose cell has one entry.
template <class Work>
struct SearchSingles {
  static constexpr unsigned kThreads = kSearchBlock, kBlocksAtOnce = kSinglesBlocks;

  Work work;
  CellSphereLists<typename Work::Item> lists;

  LSDCD_GPU_FN void operator()(const Block &block) const
  {
    block.wait_for_last();
    block.let_next_begin();
    ListTurns(static_cast<unsigned>(lists.counts->list[GpuWarp::rank()].n))
        .take([&](unsigned list, unsigned k) {
          const CellSphere<typename Work::Item> in_cell = read_once(lists.list(list)[k]);
          work.search_list(in_cell.sphere, in_cell.s, Cell{in_cell.cell.first, 1});
        });
  }
};

// Answers the listed spheres whose cell has more entries. It lists at most `max_long` of those with long lists
// again. It also clears the counts of the next run. It can run at the same time as the kernel before it, which has
// waited for the lists.
template <class Work>
struct SearchLists {
  static constexpr unsigned kThreads = kSearchBlock, kBlocksAtOnce = kListsBlocks;

  Work work;
  CellSphereLists<typename Work::Item> lists;
  CellSphereCounts *next_counts;
  CellSphere<typename Work::Item> *long_list;
  unsigned max_long;

  LSDCD_GPU_FN void operator()(const Block &block) const
  {
    if (block.number() == 0) {
      if (block.thread() < kSphereLists) next_counts->list[block.thread()].n = 0;
      if (block.thread() == 0) next_counts->with_long = 0;
    }
    ListTurns(static_cast<unsigned>(lists.counts->list[GpuWarp::rank()].n >> 32))
        .take([&](unsigned list, unsigned k) {
          const CellSphere<typename Work::Item> in_cell =
              read_once(lists.list(list)[lists.room - 1 - k]);
          if (work.is_long(in_cell.cell)) {
            const unsigned at = fetch_add(&lists.counts->with_long, 1u);
            if (at < max_long) {
              long_list[at] = in_cell;
              return;
            }
          }
          work.search_list(in_cell.sphere, in_cell.s, in_cell.cell);
        });
    // A kernel that waits for this one therefore also waits for the one before.
    block.wait_for_last();
  }
};

// Answers the spheres with long lists, each by a warp.
template <class Work>
struct SearchLongLists {
  static constexpr unsigned kThreads = kSearchBlock, kBlocksAtOnce = 1;

  Work work;
  const CellSphere<typename Work::Item> *long_list;
  const CellSphereCounts *counts;
  unsigned max_long;

  LSDCD_GPU_FN void operator()(const Block &block) const
  {
    const unsigned n = min(counts->with_long, max_long);
    for (unsigned k = block.number() * (kSearchBlock / kWarpSize) + block.warp(); k < n;
         k += block.n_blocks() * (kSearchBlock / kWarpSize)) {
      const CellSphere<typename Work::Item> one = long_list[k];
      work.search_in_warp(one.sphere, one.s, one.cell, GpuWarp());
    }
  }
};

template <class B>
class CellQuery {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // Reserves memory for the worst case, in which all spheres of a run are in occupied cells: 32 bytes for each in
  // float, 48 in double.
  template <class S>
  void reserve(std::size_t n)
  {
    if (counts_.size() == 0) {
      long_list_ = Array<char>(kMaxLong * sizeof(CellSphere<Sphere>));
      B b;
      counts_ = from_cpu(b, std::vector<CellSphereCounts>(2));
    }
    const std::size_t most = room<S>(std::min(n, kRun)) * kSphereLists * sizeof(CellSphere<S>);
    if (list_.size() < most) list_ = Array<char>(most);
  }

  template <class Work>
  void run(B &b, std::size_t n, const Work &work)
  {
    using S = typename Work::Item;
    using InCell = CellSphere<S>;
    InCell *long_list = reinterpret_cast<InCell *>(long_list_.data());
    for (std::size_t from = 0; from < n; from += kRun) {
      const Work mine = work.after(from);
      const unsigned m = static_cast<unsigned>(std::min(n - from, kRun));
      CellSphereCounts *counts = counts_.data() + turn_, *next = counts_.data() + (1 - turn_);
      turn_ = 1 - turn_;
      const CellSphereLists<S> lists = {reinterpret_cast<InCell *>(list_.data()),
                                        static_cast<unsigned>(room<S>(m)), counts};
      b.for_each_block({n_tiles<S>(m), kFindBlock}, FindCellSpheres<Work>{m, mine, lists});
      b.for_each_block({blocks(kSinglesBlocks), kSearchBlock, true},
                       SearchSingles<Work>{mine, lists});
      b.for_each_block({blocks(kListsBlocks), kSearchBlock, true},
                       SearchLists<Work>{mine, lists, next, long_list, kMaxLong});
      if constexpr (Work::kHasLong)
        b.for_each_block({limits_.processors(), kSearchBlock},
                         SearchLongLists<Work>{mine, long_list, counts, kMaxLong});
    }
  }

 private:
  static constexpr std::size_t kRun = std::size_t(1) << 24;    // spheres of one round of kernels

  // At most this many long lists are searched by warps; more are searched by threads.
  static constexpr unsigned kMaxLong = 1 << 16;

  template <class S>
  static unsigned n_tiles(std::size_t n)
  {
    return static_cast<unsigned>((n + kFindTile<S> - 1) / kFindTile<S>);
  }
  // Returns how many spheres a list must have space for: all of the spheres of its blocks.
  template <class S>
  static std::size_t room(std::size_t n)
  {
    return std::size_t((n_tiles<S>(n) + kSphereLists - 1) / kSphereLists) * kFindTile<S>;
  }
  unsigned blocks(unsigned of_processor)
  {
    return ListTurns::blocks(limits_.processors() * of_processor);
  }

  typename B::Limits limits_;
  Array<char> list_, long_list_;      // of CellSphere
  Array<CellSphereCounts> counts_;    // of this run and of the next one
  int turn_ = 0;
};

}    // namespace lsdcd
