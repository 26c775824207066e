// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// for_each over parts of things.
#pragma once

#include "base/real.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

// Parts of a run, at most.
template <class B>
constexpr std::uint64_t kMaxParts = std::uint64_t(1) << (B::kOnCpu ? 24 : 27);

// Finds the thing that part k of a run belongs to.
template <class F>
struct PartOfThing {
  const std::uint64_t *offset;
  std::size_t begin, end;
  std::uint64_t first;
  F f;

  LSDCD_FN void operator()(std::size_t k) const
  {
    // The last thing that begins at or before this part.
    std::size_t lo = begin, hi = end;
    while (hi - lo > 1) {
      const std::size_t middle = lo + (hi - lo) / 2;
      if (offset[middle] <= first + k)
        lo = middle;
      else
        hi = middle;
    }
    f(lo, first + k - offset[lo], k);
  }
};

// Thing i has offset[i + 1] - offset[i] parts. Calls f(i, part, k) for those of the things [run.begin, run.end),
// which are `run.n` parts from number `run.first` on; k counts the parts of the run.
template <class B, class Run, class F>
void for_each_part(B &b, const std::uint64_t *offset, const Run &run, const F &f)
{
  if constexpr (B::kOnCpu)
    b.for_each(run.end - run.begin, [&](std::size_t thing) {
      const std::size_t i = run.begin + thing;
      for (std::uint64_t at = offset[i]; at < offset[i + 1]; at++)
        f(i, at - offset[i], at - run.first);
    });
  else
    b.for_each(run.n, PartOfThing<F>{offset, run.begin, run.end, run.first, f});
}

}    // namespace lsdcd
