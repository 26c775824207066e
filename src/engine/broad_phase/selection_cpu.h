// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Selects the candidate spheres on a CPU.
#pragma once

#include "backend/threads.h"
#include "backend/warp.h"
#include "base/vec3.h"
#include "engine/broad_phase/selection.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

template <class B>
class Selection<B, true> {
 public:
  std::size_t bytes() const { return 0; }

  template <class Work>
  void run(B &, std::size_t n, const Work &work, int *to, std::uint32_t *total)
  {
    // Blocks have the same size for any number of threads, so that the order is fixed.
    constexpr std::int64_t kBlock = 4096;
    const std::int64_t n_blocks = (static_cast<std::int64_t>(n) + kBlock - 1) / kBlock;
    std::vector<int> found(n_blocks, 0);
#pragma omp parallel for schedule(dynamic) num_threads(threads()) if (n_blocks > 1)
    for (std::int64_t b = 0; b < n_blocks; b++) {
      const std::int64_t lo = b * kBlock;
      const std::int64_t hi = std::min(lo + kBlock, static_cast<std::int64_t>(n));
      int count = 0;
      for (std::int64_t k = lo; k < hi; k++) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Vec3 x = work.centres()[i];
        const auto item = work.read(i);
        work.check(i, item);
        const bool passes = (work.coarse_test(item, x) && work.is_near(x)) || work.closes(i, item);
        if (passes)
          to[lo + count++] = static_cast<int>(i);
        else
          work.note_out(i);
      }
      found[b] = work.has_refine() ? refine(work, to + lo, count) : count;
    }
    std::uint32_t n_passed = 0;
    for (std::int64_t b = 0; b < n_blocks; b++) {
      std::copy(to + b * kBlock, to + b * kBlock + found[b], to + n_passed);
      n_passed += found[b];
    }
    *total = n_passed;
  }

 private:
  // Keeps those of n spheres that pass the last test of `work`, and returns their number. Memory that the test reads first
  // is prefetched a few spheres ahead.
  template <class Work>
  static int refine(const Work &work, int *spheres, int n)
  {
    constexpr int kAhead = 4;
    int n_passed = 0;
    for (int k = 0; k < n; k++) {
      if (k + kAhead < n) work.prefetch(work.centres()[spheres[k + kAhead]]);
      const int i = spheres[k];
      const auto sphere = static_cast<std::size_t>(i);
      if (work.refine(Warp<1>(), true, i) || work.closes(sphere, work.read(sphere)))
        spheres[n_passed++] = i;
      else
        work.note_out(i);
    }
    return n_passed;
  }
};

}    // namespace lsdcd
