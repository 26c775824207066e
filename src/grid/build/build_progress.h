// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How far a long build is, for a listener.
#pragma once

#include "base/progress.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>

namespace lsdcd {

class BuildProgress {
 public:
  explicit BuildProgress(const ProgressListener &tell) : tell_(tell) {}

  // Cells have this length from now on.
  void of(double length) { length_ = length; }

  // Calls part(from, n) for [0, n): at once, or on the CPU with a listener in a hundred parts
  // or more.
  template <class Part>
  void in_parts(bool on_cpu, const char *what, std::size_t n, const Part &part) const
  {
    constexpr std::size_t kFewest = 1024;    // enough for all threads
    const std::size_t each = tell_ && on_cpu ? std::max(n / 100, kFewest) : n;
    for (std::size_t from = 0; from < n; from += each) {
      tell(what, double(from) / double(n));
      part(from, std::min(each, n - from));
    }
  }
  void tell(const char *what, double share) const
  {
    if (!tell_) return;
    char text[96];
    std::snprintf(text, sizeof text, "grid %.6g: %s", length_, what);
    tell_(text, share);
  }

 private:
  const ProgressListener &tell_;
  double length_ = 0;
};

}    // namespace lsdcd
