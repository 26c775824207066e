// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Gives freed memory back to the operating system.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif
#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace lsdcd {

// glibc keeps freed arrays of up to 32 MB for itself; a wall's set-up frees most of what it has allocated.
inline void give_back_memory()
{
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

// Calls copy(begin, end) for one part of n elements after another, and gives their pages back at once, so
// that an array and its copy are never in memory both. The contents of `from` (by malloc) are lost.
template <class T, class Copy>
void move_and_release(T *from, std::size_t n, const Copy &copy)
{
  constexpr std::size_t kPart = (std::size_t(1) << 20) / sizeof(T) + 1;
  for (std::size_t i = 0; i < n; i += kPart) {
    T *const end = from + std::min(i + kPart, n);
    copy(from + i, end);
#if defined(__linux__)
    // Whole pages of this machine alone: the last bytes of the part may share one with what is not copied.
    static const std::size_t kPage = sysconf(_SC_PAGESIZE);
    char *const begin = reinterpret_cast<char *>(from + i);
    const std::size_t bytes = reinterpret_cast<char *>(end) - begin,
                      before = (kPage - reinterpret_cast<std::uintptr_t>(begin) % kPage) % kPage;
    if (bytes >= before + kPage)
      madvise(begin + before, (bytes - before) / kPage * kPage, MADV_DONTNEED);
#endif
  }
}

template <class T>
std::vector<T> drained(T *from, std::size_t n)
{
  std::vector<T> to;
  to.reserve(n);
  move_and_release(from, n, [&](T *begin, T *end) { to.insert(to.end(), begin, end); });
  return to;
}

}    // namespace lsdcd
