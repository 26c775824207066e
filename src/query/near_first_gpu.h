// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A query whose kernels have one kind of work each. The first is light, with many threads and more than one
// sphere in flight in each: it answers every sphere as if the wall were far, and lists those near
// to it with what a search reads first. A kernel searches cells of one candidate, and another one cells of
// more, both with full warps whatever the order of the spheres in memory. The last kernel searches long
// lists, each by a warp.
#pragma once

#include "backend/backend.h"
#include "query/list_near_gpu.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

// Blocks at once on a processor: 64 registers a thread for one candidate, 80 for
// more.
constexpr unsigned kAnswerBlock = 256, kSinglesBlocks = 4, kSeveralBlocks = 3;

// The order in which a block walks the lists: kAnswerBlock spheres of one list, then of the next. Lists grow in
// parallel, so that neighbours in memory are searched in the same turn. `n`: the length of the list whose number is
// this thread's rank.
class NearTurns {
 public:
  LSDCD_GPU_FN explicit NearTurns(unsigned n) : n_(n), longest_(GpuWarp::largest(n)) {}

  // Calls search(list, k) for the spheres of this thread.
  template <class Search>
  LSDCD_GPU_FN void take(Search search) const
  {
    for (unsigned turn = Block::number(); turn / kNearLists * kAnswerBlock < longest_;
         turn += Block::n_blocks()) {
      const unsigned list = turn % kNearLists,
                     k = turn / kNearLists * kAnswerBlock + Block::thread();
      if (k < GpuWarp::of(n_, list)) search(list, k);
    }
  }

  // Lists differ in length. With an odd number of blocks each takes from all, in another order.
  static unsigned blocks(unsigned most) { return (most - 1) | 1; }

 private:
  unsigned n_, longest_;
};
static_assert(kNearLists == kWarpSize, "a thread for each");

// Answers the listed spheres whose cell has one candidate.
template <class Work>
struct AnswerSingles {
  static constexpr unsigned kThreads = kAnswerBlock, kBlocksAtOnce = kSinglesBlocks;

  Work work;
  NearLists<typename Work::Item> lists;

  LSDCD_GPU_FN void operator()(const Block &block) const
  {
    block.wait_for_last();
    block.let_next_begin();
    NearTurns(static_cast<unsigned>(lists.counts->list[GpuWarp::rank()].n))
        .take([&](unsigned list, unsigned k) {
          const NearSphere<typename Work::Item> near = read_once(lists.list(list)[k]);
          work.search_list(near.sphere, near.s, Cell{near.cell.first, 1});
        });
  }
};

// Answers those with more candidates. It lists at most `max_long` of those with long lists again. It
// also clears the counts of the next run. It can run beside the kernel before it, which has waited for
// the lists.
template <class Work>
struct AnswerSeveral {
  static constexpr unsigned kThreads = kAnswerBlock, kBlocksAtOnce = kSeveralBlocks;

  Work work;
  NearLists<typename Work::Item> lists;
  NearCounts *next_counts;
  NearSphere<typename Work::Item> *long_list;
  unsigned max_long;

  LSDCD_GPU_FN void operator()(const Block &block) const
  {
    if (block.number() == 0) {
      if (block.thread() < kNearLists) next_counts->list[block.thread()].n = 0;
      if (block.thread() == 0) next_counts->with_long = 0;
    }
    NearTurns(static_cast<unsigned>(lists.counts->list[GpuWarp::rank()].n >> 32))
        .take([&](unsigned list, unsigned k) {
          const NearSphere<typename Work::Item> near =
              read_once(lists.list(list)[lists.room - 1 - k]);
          if (work.is_long(near.cell)) {
            const unsigned at = fetch_add(&lists.counts->with_long, 1u);
            if (at < max_long) {
              long_list[at] = near;
              return;
            }
          }
          work.search_list(near.sphere, near.s, near.cell);
        });
    // A kernel that waits for this one thus waits for that one, too.
    block.wait_for_last();
  }
};

// A warp for each sphere with a long list.
template <class Work>
struct AnswerLong {
  static constexpr unsigned kThreads = kAnswerBlock, kBlocksAtOnce = 1;

  Work work;
  const NearSphere<typename Work::Item> *long_list;
  const NearCounts *counts;
  unsigned max_long;

  LSDCD_GPU_FN void operator()(const Block &block) const
  {
    const unsigned n = min(counts->with_long, max_long);
    for (unsigned k = block.number() * (kAnswerBlock / kWarpSize) + block.warp(); k < n;
         k += block.n_blocks() * (kAnswerBlock / kWarpSize)) {
      const NearSphere<typename Work::Item> one = long_list[k];
      work.search_in_warp(one.sphere, one.s, one.cell, GpuWarp());
    }
  }
};

template <class B>
class NearFirst {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // Room for the worst case, all spheres of a run near: 32 bytes for each in float, 48 in double.
  template <class S>
  void reserve(std::size_t n)
  {
    if (counts_.size() == 0) {
      long_list_ = Array<char>(kMaxLong * sizeof(NearSphere<Sphere>));
      B b;
      counts_ = from_host(b, std::vector<NearCounts>(2));
    }
    const std::size_t most = room<S>(std::min(n, kRun)) * kNearLists * sizeof(NearSphere<S>);
    if (list_.size() < most) list_ = Array<char>(most);
  }

  template <class Work>
  void run(B &b, std::size_t n, const Work &work)
  {
    using S = typename Work::Item;
    using Near = NearSphere<S>;
    Near *long_list = reinterpret_cast<Near *>(long_list_.data());
    for (std::size_t from = 0; from < n; from += kRun) {
      const Work mine = work.after(from);
      const unsigned m = static_cast<unsigned>(std::min(n - from, kRun));
      NearCounts *counts = counts_.data() + turn_, *next = counts_.data() + (1 - turn_);
      turn_ = 1 - turn_;
      const NearLists<S> lists = {reinterpret_cast<Near *>(list_.data()),
                                  static_cast<unsigned>(room<S>(m)), counts};
      b.for_each_block({n_tiles<S>(m), kNearBlock}, ListNear<Work>{m, mine, lists});
      b.for_each_block({blocks(kSinglesBlocks), kAnswerBlock, 0, true},
                       AnswerSingles<Work>{mine, lists});
      b.for_each_block({blocks(kSeveralBlocks), kAnswerBlock, 0, true},
                       AnswerSeveral<Work>{mine, lists, next, long_list, kMaxLong});
      if constexpr (Work::kHasLong)
        b.for_each_block({limits_.processors(), kAnswerBlock},
                         AnswerLong<Work>{mine, long_list, counts, kMaxLong});
    }
  }

 private:
  static constexpr std::size_t kRun = std::size_t(1) << 24;    // spheres of a turn of kernels

  // Threads read the lists of any more.
  static constexpr unsigned kMaxLong = 1 << 16;

  template <class S>
  static unsigned n_tiles(std::size_t n)
  {
    return static_cast<unsigned>((n + kNearTile<S> - 1) / kNearTile<S>);
  }
  // For all of its blocks' spheres in a list.
  template <class S>
  static std::size_t room(std::size_t n)
  {
    return std::size_t((n_tiles<S>(n) + kNearLists - 1) / kNearLists) * kNearTile<S>;
  }
  unsigned blocks(unsigned of_processor)
  {
    return NearTurns::blocks(limits_.processors() * of_processor);
  }

  typename B::Limits limits_;
  Array<char> list_, long_list_;    // of NearSphere
  Array<NearCounts> counts_;        // of this run and of the next
  int turn_ = 0;
};

}    // namespace lsdcd
