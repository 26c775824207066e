// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Memory of the CPU for blocks that are read at random.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace lsdcd {

// Aligned to 64 bytes. From 4 MB on it uses pages of 2 MB if Linux has some. A processor keeps the
// addresses of few pages, so that most random reads in pages of 4 kB first wait for an
// address.
struct LargeMemory {
  static constexpr std::size_t kPage = std::size_t(1) << 21;

  static void *allocate(std::size_t bytes)
  {
    const std::size_t align = bytes >= 2 * kPage ? kPage : 64;
    const std::size_t rounded = (bytes + align - 1) / align * align;
    void *at = std::aligned_alloc(align, rounded);
    if (!at) throw std::bad_alloc();
#if defined(__linux__)
    if (align == kPage) madvise(at, rounded, MADV_HUGEPAGE);    // a wish: it may be refused
#endif
    return at;
  }
  static void free(void *at)
  {
    std::free(at);
  }
};

}    // namespace lsdcd
