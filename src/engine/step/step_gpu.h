// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Runs a step over many spheres on a GPU: a thread for each sphere, and at the same time warps for spheres with
// several contacts. Such a sphere takes twenty times as long as the others, so that it must not start after
// them.
#pragma once

#include "backend/block.h"
#include "engine/step/step_job.h"

#include <algorithm>

namespace lsdcd {

constexpr unsigned kStepWarps = kStepBlock / kWarpSize;
// How many blocks do the items of a list. While the fast path runs there are few, because they would displace
// other blocks that hide its memory latency.
constexpr int kFewBlocks = kFewGeneral / kStepBlock, kMaxBlocks = kMostGeneral / kStepBlock;

// The items of the general path: those of `list`, or all of [0, n) if the list is null. The first `blocks` of
// the kernel take them; while there are few items, only `few` of these blocks do. `leaves_lists`: an item that
// needs a list is left to the next kernel, in which more threads share the work.
struct GeneralPart {
  const int *list, *n_listed;
  int n, few;
  unsigned blocks;
  bool leaves_lists;
};

// Appends k to a list, whose length is `n`, for each thread that has an item.
LSDCD_GPU_FN void put_listed(bool has_one, int k, int *list, int *n)
{
  const GpuWarp warp;
  const unsigned votes = warp.vote(has_one);
  if (votes == 0) return;
  const int at = warp.take_room(n, warp.count(votes));
  if (has_one) list[at + warp.count_below(votes)] = k;
}

template <class Work>
LSDCD_GPU_FN void run_general_path(const GeneralPart &part, const Work &work)
{
  const WorkLists &lists = work.work_lists();
  const int end = part.list ? *part.n_listed : part.n;
  const int enough = max(part.few, (end + int(kStepBlock) - 1) / int(kStepBlock));
  const GpuWarp warp;
  const int warps = min(int(part.blocks), enough) * int(kStepWarps), step = kWarpSize * warps;
  const int number = Block::number() * kStepWarps + Block::warp(), rank = warp.rank();
  if (number >= warps) return;
  auto &memory = static_cast<typename Work::Memory *>(lists.memory)[kWarpSize * number + rank];
  // Listed items are few, and each takes its own branches: at first a warp takes one item.
  const int first = part.list ? rank * warps + number : kWarpSize * number + rank;
  for (int s = first; warp.any(s < end); s += step) {
    bool has_one = s < end;
    const int k = !has_one ? 0 : part.list ? part.list[s] : s;
    const bool is_due = has_one && work.needs_list(k);
    if (part.leaves_lists) {
      put_listed(is_due, k, lists.found, lists.n_found);
      has_one = has_one && !is_due;
    } else {
      // Lists take long to make: the whole warp helps.
      if (warp.any(is_due)) work.make_list(warp, is_due, k);
      warp.wait();
    }
    const bool again = has_one && work.general_path(k, memory);
    warp.wait();
    if (!part.list || !lists.next) continue;
    put_listed(again, k, lists.next, lists.n_next);
    if (again) lists.listed_in[k] = lists.step + 1;
  }
}

// Runs general_path() for a part of the items, and fast_path() for all of [0, n) that are not listed.
template <class Work>
struct StepPart {
  static constexpr unsigned kThreads = kStepBlock, kBlocksAtOnce = Work::kBlocksAtOnce;

  GeneralPart part;
  unsigned n;
  int *to_clear;
  Work work;

  LSDCD_GPU_FN void operator()(const Block &block) const
  {
    if (block.number() == 0 && block.thread() == 0) {
      work.begin();
      if (to_clear) *to_clear = 0;
    }
    if (block.number() < part.blocks) {
      run_general_path(part, work);
      return;
    }
    if constexpr (Work::kFastPath) {
      const WorkLists &lists = work.work_lists();
      const unsigned k = (block.number() - part.blocks) * kStepBlock + block.thread();
      // The general path may have set listed_in to the next step already.
      const bool mine = k < n && !(lists.listed_in && lists.listed_in[k] >= lists.step);
      put_listed(mine && !work.fast_path(k), static_cast<int>(k), lists.found, lists.n_found);
    }
  }
};

// Runs a step over the items [0, n) of `work`, a MeshStep or a MultiMeshStep: fast_path(i), and general_path(i)
// if that returns false or does not exist. Before that a warp makes the lists of the items for which
// needs_list(i). Lists of work.work_lists() have space for n items; those to be written are empty.
template <class B, class Work>
void run_step(B &b, std::size_t n_items, const Work &work)
{
  if (n_items == 0) return;
  const unsigned n = static_cast<unsigned>(n_items);
  const unsigned blocks = (n + kStepBlock - 1) / kStepBlock,
                 have_memory = static_cast<unsigned>(work.work_lists().memory_bytes /
                                                     (kStepBlock * sizeof(typename Work::Memory))),
                 general_blocks = std::min({blocks, unsigned(kMaxBlocks), have_memory});
  const WorkLists &lists = work.work_lists();
  GeneralPart part = {nullptr, nullptr, static_cast<int>(n), 0, general_blocks, false};
  int *to_clear = lists.n_found_next;
  if (work.has_fast_path()) {
    part = {lists.last, lists.n_last, 0, kFewBlocks, lists.last ? general_blocks : 0, true};
    b.for_each_block({part.blocks + blocks, kStepBlock}, StepPart<Work>{part, n, to_clear, work});
    to_clear = lists.n_last;    // `next` of the next step
    part = {lists.found, lists.n_found, 0, kMaxBlocks, general_blocks, false};
  }
  b.for_each_block({part.blocks, kStepBlock}, StepPart<Work>{part, 0, to_clear, work});
}

}    // namespace lsdcd
