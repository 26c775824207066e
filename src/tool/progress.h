// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Shows the progress of long work in a line on stderr, on a terminal or if asked for.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

#include <unistd.h>

namespace lsdcd {

inline double seconds_since(std::chrono::steady_clock::time_point then)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

class Progress {
 public:
  explicit Progress(bool asked) : terminal_(isatty(STDERR_FILENO) == 1), on_(asked || terminal_) {}
  ~Progress() { clear(); }

  // Shown no more often than one can read it.
  void show(const std::string &text)
  {
    const auto now = std::chrono::steady_clock::now();
    if (!on_ || (shown_ && now - last_ < std::chrono::milliseconds(500))) return;
    last_ = now;
    shown_ = true;
    std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n", text.c_str());
    std::fflush(stderr);
  }
  void clear()
  {
    if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
    shown_ = false;
  }

 private:
  bool terminal_, on_, shown_ = false;
  std::chrono::steady_clock::time_point last_;
};

}    // namespace lsdcd
