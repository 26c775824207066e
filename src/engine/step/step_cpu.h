// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Runs a step over many spheres on a CPU.
#pragma once

#include "backend/threads.h"
#include "backend/warp.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

// Compiles a function with all functions that it calls inlined, so that the numbers of a sphere stay in registers. A step then
// takes 24.5 ns a sphere, and 77 if the compiler decides what to inline. This is half of the time that a law takes to compile;
// with sanitizers it would take minutes.
#if defined(__SANITIZE_ADDRESS__)
#define LSDCD_FLATTEN
#else
#define LSDCD_FLATTEN gnu::flatten
#endif

namespace lsdcd {

// The largest number of items of a step that a thread takes at once.
constexpr std::int64_t kMostItems = 512;
struct StepItems {
  int n = 0;
  std::int64_t at[kMostItems];

  void add(std::int64_t i) { at[n++] = i; }
};

// Takes the fast path for the items [begin, end). `left` gets the items that this path is not for. The path is inlined into the
// loop, with its contact in registers.
template <class Work>
[[gnu::noinline, LSDCD_FLATTEN]] void run_fast_path(const Work &work, std::int64_t begin,
                                                    std::int64_t end, StepItems &left)
{
  for (std::int64_t i = begin; i < end; i++)
    if (!work.fast_path(static_cast<std::size_t>(i))) left.add(i);
}

// Prefetches the data from which the lists of n items are made, at most kPrefetched items. Otherwise each item would wait for
// memory several times.
constexpr int kPrefetched = 32;
template <class Work>
void prefetch_lists([[maybe_unused]] const Work &work, [[maybe_unused]] const std::int64_t *items,
                    [[maybe_unused]] int n)
{
  if constexpr (Work::kFastPath) {
    if (n < 2) return;
    typename Work::Ahead ahead[kPrefetched];
    for (int k = 0; k < n; k++) ahead[k] = work.list_ahead(static_cast<std::size_t>(items[k]));
    for (int part = 0; part < Work::Ahead::kParts; part++)
      for (int k = 0; k < n; k++) work.prefetch(ahead[k], part);
  }
}

// Takes the items that the fast path has left, which are few and take long. Those that need lists get them and take the fast path
// once more; the others take the general path.
template <class Work>
[[gnu::noinline]] void run_left(const Work &work, const StepItems &left)
{
  const bool has_fast_path = work.has_fast_path();
  StepItems due, general;
  for (int k = 0; k < left.n; k++)
    (work.needs_list(static_cast<std::size_t>(left.at[k])) ? due : general).add(left.at[k]);
  for (int k = 0; k < due.n; k++) {
    if (k % kPrefetched == 0) prefetch_lists(work, due.at + k, std::min(kPrefetched, due.n - k));
    const std::int64_t i = due.at[k];
    work.make_list(Warp<1>(), true, static_cast<std::size_t>(i));
    if (has_fast_path)
      run_fast_path(work, i, i + 1, general);
    else
      general.add(i);
  }
  typename Work::Memory memory;
  for (int k = 0; k < general.n; k++)
    work.general_path(static_cast<std::size_t>(general.at[k]), memory);
}

// Runs a step over the items [0, n) of `work`, a MeshStep or a MultiMeshStep.
template <class B, class Work>
void run_step(B &, std::size_t n, const Work &work)
{
  work.begin();
  const std::int64_t m = static_cast<std::int64_t>(n);
  // A run is long enough that several of its items need lists, and short enough that there are runs for all threads.
  const std::int64_t run = std::min(kMostItems, std::max<std::int64_t>(64, m / (8 * threads())));
#pragma omp parallel for schedule(dynamic) num_threads(threads()) if (m > 256)
  for (std::int64_t begin = 0; begin < m; begin += run) {
    const std::int64_t end = std::min(m, begin + run);
    StepItems left;
    if (work.has_fast_path())
      run_fast_path(work, begin, end, left);
    else
      for (std::int64_t i = begin; i < end; i++) left.add(i);
    if (left.n > 0) run_left(work, left);
  }
}

}    // namespace lsdcd
