// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Selects the candidate spheres on a GPU: flags spheres and collects those that are flagged, in order. The first pass
// tests by cells, the second by the features of these cells.
#pragma once

#include "backend/backend.h"
#include "engine/broad_phase/selection.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

// Flags sphere i if it passes the tests by cells.
template <class Work>
struct FlagByCells {
  Work work;
  char *flags;

  LSDCD_FN void operator()(std::size_t i) const
  {
    const auto item = work.read(i);
    work.check(i, item);
    const Vec3 x = work.centres()[i];
    const bool passes = (work.coarse_test(item, x) && work.is_near(x)) || work.closes(i, item);
    if (!passes) work.note_out(i);
    flags[i] = passes;
  }
};

// Flags the k-th of the spheres that passed the first test if it passes the test by features, too.
template <class Work>
struct FlagByFeatures {
  Work work;
  const int *left;
  char *flags;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t k) const
  {
    const int i = left[k];
    bool passes = work.refine(warp, mine, i);
    if (!mine) return;
    passes = passes || work.closes(i, work.read(i));
    if (!passes) work.note_out(i);
    flags[k] = passes;
  }
};

template <class B>
class Selection<B, false> {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  template <class Work>
  void run(B &b, std::size_t n, const Work &work, int *to, std::uint32_t *total)
  {
    flags_.reserve(n);
    char *flags = flags_.data();
    b.for_each(n, FlagByCells<Work>{work, flags});
    if (!work.has_refine()) return b.compact(n, nullptr, flags, to, total);
    left_.reserve(n);
    b.compact(n, nullptr, flags, left_.data(), total);
    const std::size_t n_left = read_one(b, total);
    b.for_each_in_warps(n_left, FlagByFeatures<Work>{work, left_.data(), flags});
    b.compact(n_left, left_.data(), flags, to, total);
  }

  std::size_t bytes() const { return flags_.size() + left_.size() * sizeof(int); }

 private:
  Array<char> flags_;
  Array<int> left_;    // those that passed the test by cells
};

}    // namespace lsdcd
