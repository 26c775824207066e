// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Divides items among few threads, because each thread ends with something that all of them write.
#pragma once

#include "backend/warp.h"

#include <algorithm>
#include <cstddef>

namespace lsdcd {

constexpr std::size_t kItemsInRow = 16;    // consecutive items of a thread on a CPU

// Returns how many threads share n items; on a GPU at most `most`.
template <class B>
std::size_t threads_for(std::size_t n, std::size_t most)
{
  return B::kOnCpu ? (n + kItemsInRow - 1) / kItemsInRow : std::min(n, most);
}

// Calls f(i) for the items i < n of thread t. On a CPU these are consecutive items; on a GPU every n_threads-th item, so
// that neighbouring threads read neighbouring items.
template <unsigned kSize, class F>
LSDCD_FN void for_each_of_thread(const Warp<kSize> &, std::size_t t, std::size_t n_threads,
                                 std::size_t n, const F &f)
{
  constexpr bool kIsCpu = kSize == 1;
  const std::size_t first = kIsCpu ? t * kItemsInRow : t, step = kIsCpu ? 1 : n_threads,
                    end = kIsCpu && first + kItemsInRow < n ? first + kItemsInRow : n;
  for (std::size_t i = first; i < end; i += step) f(i);
}

}    // namespace lsdcd
