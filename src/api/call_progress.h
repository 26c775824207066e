// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Calls `progress` of a struct of options, and ends the call where that asks for it.
#pragma once

#include "api/c_border.h"
#include "base/progress.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>

namespace lsdcd {

class CallProgress {
 public:
  CallProgress(lsdcd_progress *call, void *data) : call_(call), data_(data) {}

  // Throws LSDCD_ERROR_CANCELLED. Something new is reported at once, else at most ten times a second.
  void tell(const std::string &what, double share)
  {
    const Clock::time_point now = Clock::now();
    if (what == what_ && now - last_ < std::chrono::milliseconds(100)) return;
    what_ = what;
    last_ = now;
    if (call_(data_, what.c_str(), share) != 0)
      throw ApiError(LSDCD_ERROR_CANCELLED,
                     "`progress` cancelled the call, at: " + progress_text(what, share));
  }
  // It must outlive the listener.
  ProgressListener listener()
  {
    if (!call_) return {};
    return [this](const std::string &what, double share) { tell(what, share); };
  }
  // Calls part(from, n) for [0, n): at once, or where somebody listens in parts of about a tenth of a second.
  template <class Part>
  void in_parts(const std::string &what, std::size_t n, const Part &part)
  {
    if (!call_) return part(std::size_t(0), n);
    std::size_t each = 4096;
    for (std::size_t from = 0; from < n;) {
      tell(what, static_cast<double>(from) / static_cast<double>(n));
      const Clock::time_point start = Clock::now();
      const std::size_t here = std::min(each, n - from);
      part(from, here);
      from += here;
      const Clock::duration passed = Clock::now() - start;
      if (passed < std::chrono::milliseconds(50)) each *= 2;
      if (passed > std::chrono::milliseconds(200)) each = each / 2 + 1;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  lsdcd_progress *call_;
  void *data_;
  std::string what_;
  Clock::time_point last_;
};

}    // namespace lsdcd
