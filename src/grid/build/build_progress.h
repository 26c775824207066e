// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How far a long build is, for a listener.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>

namespace lsdcd {

class BuildProgress {
 public:
  explicit BuildProgress(const std::function<void(const std::string &)> &tell) : tell_(tell) {}

  // Of cells of this length from now on.
  void of(double length) { length_ = length; }

  // Calls part(from, n) for [0, n): at once, or on the host with a listener in a hundred parts
  // or more.
  template <class Part>
  void in_parts(bool on_host, const char *what, std::size_t n, const Part &part) const
  {
    constexpr std::size_t kFewest = 1024;    // enough for all threads
    const std::size_t each = tell_ && on_host ? std::max(n / 100, kFewest) : n;
    for (std::size_t from = 0; from < n; from += each) {
      tell(what, double(from) / double(n));
      part(from, std::min(each, n - from));
    }
  }
  void tell(const char *what, double share) const
  {
    if (!tell_) return;
    char text[96];
    std::snprintf(text, sizeof text, "grid %.6g: %s, %.0f%%", length_, what, 100 * share);
    tell_(text);
  }

 private:
  const std::function<void(const std::string &)> &tell_;
  double length_ = 0;
};

}    // namespace lsdcd
