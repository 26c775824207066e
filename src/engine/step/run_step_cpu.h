// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A step over many spheres on a CPU.
#pragma once

#include "backend/threads.h"
#include "backend/warp.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

// Compiles a function with all that it calls, which is quick to run and slow to compile: with
// sanitizers it would take minutes.
#if defined(__SANITIZE_ADDRESS__)
#define LSDCD_FLATTEN
#else
#define LSDCD_FLATTEN gnu::flatten
#endif

namespace lsdcd {

class CpuStep {
 public:
  // Of each i in [0, n): work.single(i). Where that says false, or where !work.has_single(): work.several(i).
  // Before that, if work.needs_list(i): work.make_list(), and then work.single(i) once more.
  template <class Work>
  static void run(std::size_t n, const Work &work)
  {
    work.begin();
    const std::int64_t m = static_cast<std::int64_t>(n);
    // Long enough that several items of a run need lists, and enough runs for all threads.
    const std::int64_t run = std::min(kRun, std::max<std::int64_t>(64, m / (8 * threads())));
#pragma omp parallel for schedule(dynamic) num_threads(threads()) if (m > 256)
    for (std::int64_t begin = 0; begin < m; begin += run)
      step_run(work, begin, std::min(m, begin + run));
  }

 private:
  // Items of a step that a thread takes at once, at most.
  static constexpr std::int64_t kRun = 512;
  struct Items {
    int n = 0;
    std::int64_t at[kRun];

    void add(std::int64_t i) { at[n++] = i; }
  };

  template <class Work>
  static void step_run(const Work &work, std::int64_t begin, std::int64_t end)
  {
    Items left;
    if (work.has_single())
      step_singles(work, begin, end, left);
    else
      for (std::int64_t i = begin; i < end; i++) left.add(i);
    if (left.n > 0) step_left(work, left);
  }
  // single() is compiled into the loop whole, with its contact in registers; the rest is rare, and
  // long.
  template <class Work>
  [[gnu::noinline, LSDCD_FLATTEN]] static void step_singles(const Work &work, std::int64_t begin,
                                                            std::int64_t end, Items &left)
  {
    for (std::int64_t i = begin; i < end; i++)
      if (!work.single(static_cast<std::size_t>(i))) left.add(i);
  }
  // Those that need lists get them, and go through single() once more.
  template <class Work>
  [[gnu::noinline]] static void step_left(const Work &work, const Items &left)
  {
    const bool has_single = work.has_single();
    Items due, several;
    for (int k = 0; k < left.n; k++)
      (work.needs_list(static_cast<std::size_t>(left.at[k])) ? due : several).add(left.at[k]);
    for (int k = 0; k < due.n; k++) {
      if (k % kPrefetched == 0) prefetch_lists(work, due.at + k, std::min(kPrefetched, due.n - k));
      const std::int64_t i = due.at[k];
      work.make_list(Warp<1>(), true, static_cast<std::size_t>(i));
      if (has_single)
        step_singles(work, i, i + 1, several);
      else
        several.add(i);
    }
    for (int k = 0; k < several.n; k++) work.several(static_cast<std::size_t>(several.at[k]));
  }

  // Prefetches what the lists of n items are made from, at most kPrefetched: else each would wait for memory
  // several times.
  static constexpr int kPrefetched = 32;
  template <class Work>
  static void prefetch_lists([[maybe_unused]] const Work &work,
                             [[maybe_unused]] const std::int64_t *items, [[maybe_unused]] int n)
  {
    if constexpr (Work::kSingle) {
      if (n < 2) return;
      typename Work::Ahead ahead[kPrefetched];
      for (int k = 0; k < n; k++) ahead[k] = work.list_ahead(static_cast<std::size_t>(items[k]));
      for (int part = 0; part < Work::Ahead::kParts; part++)
        for (int k = 0; k < n; k++) work.prefetch(ahead[k], part);
    }
  }
};

template <class B, class Work>
void run_step(B &, std::size_t n, const Work &work)
{
  CpuStep::run(n, work);
}

}    // namespace lsdcd
