// What the benchmark programs share: timing, statistics, CSV rows.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

namespace lsdcd {

struct Timing {
  double median_ms, min_ms, max_ms;
  int repeats;
};

// Runs f once to warm up, then `repeats` times.
template <class F>
Timing time_it(int repeats, F f)
{
  f();
  std::vector<double> ms;
  for (int i = 0; i < repeats; i++) {
    const auto start = std::chrono::steady_clock::now();
    f();
    ms.push_back(1e3 *
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(ms.begin(), ms.end());
  return {ms[ms.size() / 2], ms.front(), ms.back(), repeats};
}

inline const char *compiler()
{
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

}    // namespace lsdcd
