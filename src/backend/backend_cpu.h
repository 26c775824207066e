// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The backend of a CPU; backend.h says what its functions do.
#pragma once

#include "backend/atomic.h"
#include "backend/backend.h"
#include "backend/owned_array.h"
#include "backend/threads.h"
#include "backend/warp.h"
#include "base/number_words.h"
#include "base/strided_view.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <new>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace lsdcd {

struct CpuBackend {
  static constexpr bool kOnCpu = true;    // is its memory the CPU's?

  CpuBackend() = default;
  CpuBackend(CpuBackend &&) = default;    // as a GPU's, which owns memory
  CpuBackend &operator=(CpuBackend &&) = default;

  struct Memory {
    static void *allocate(std::size_t bytes) { return ::operator new(bytes); }
    static void free(void *at) { ::operator delete(at); }
  };
  template <class T>
  using Array = OwnedArray<T, Memory>;
  template <class T>
  using Scratch = Array<T>;
  template <class T>
  using CpuArray = Array<T>;

  template <class T>
  void copy_in(const T *host, T *to, std::size_t n)
  {
    std::copy(host, host + n, to);
  }
  template <class T>
  void copy_out(const T *from, T *host, std::size_t n)
  {
    std::copy(from, from + n, host);
  }
  void wait() {}

  std::size_t scratch_bytes() const { return 0; }

  // One thing comes after the other.
  struct Event {
    void record(CpuBackend &) {}
    void wait() const {}
  };
  struct SideStream {
    void ready(CpuBackend &) {}
    void begin(CpuBackend &) {}
    void end(CpuBackend &) {}
    std::size_t scratch_bytes() const { return 0; }
  };

  // The last argument is for GPUs: threads of a block.
  template <class F>
  void for_each(std::size_t n, const F &f, unsigned /*block*/ = 0)
  {
    const std::int64_t m = static_cast<std::int64_t>(n);
#pragma omp parallel for schedule(dynamic, 64) num_threads(threads()) if (m > 256)
    for (std::int64_t i = 0; i < m; i++) f(static_cast<std::size_t>(i));
  }

  // A thread that is there only to help has an i that is not `mine`. With `n_at`: for *n_at in place of n, or
  // none if that is more.
  template <class F>
  void for_each_in_warps(std::size_t n, const F &f, const std::uint32_t *n_at = nullptr)
  {
    if (n_at) n = *n_at <= n ? *n_at : 0;
    for_each(n, [&](std::size_t i) { f(Warp<1>(), true, i); });
  }

  template <class F>
  double milliseconds(const F &f)
  {
    const auto start = std::chrono::steady_clock::now();
    f();
    return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  // Copies those of from[0, n), or of the numbers [0, n) where it is null, whose flag is set to `to`; *total becomes how
  // many they are.
  void compact(std::size_t n, const int *from, const char *flags, int *to, std::uint32_t *total)
  {
    std::uint32_t kept = 0;
    for (std::size_t k = 0; k < n; k++)
      if (flags[k]) to[kept++] = from ? from[k] : static_cast<int>(k);
    *total = kept;
  }

  template <class T, class Read>
  T largest(std::size_t n, const Read &read)
  {
    T largest = n > 0 ? read(0) : T(0);
    for (std::size_t i = 1; i < n; i++) largest = std::max<T>(largest, read(i));
    return largest;
  }
  template <class T>
  T exclusive_scan(T *values, std::size_t n)
  {
    T total = 0;
    for (std::size_t i = 0; i < n; i++) total += std::exchange(values[i], total);
    return total;
  }

  void sort_pairs(Scratch<std::uint32_t> &keys, Scratch<std::uint32_t> &values,
                  std::uint32_t largest)
  {
    const std::size_t n = keys.size();
    Scratch<std::uint32_t> other_keys(n), other_values(n);
    for (int shift = 0; shift < bits_of(largest); shift += 16) {
      sort_by_16_bits(n, shift, keys.data(), values.data(), other_keys.data(), other_values.data());
      std::swap(keys, other_keys);
      std::swap(values, other_values);
    }
  }
  std::string name() const
  {
    const int n = threads();
    return "CPU, " + counted(n, "thread");
  }

 private:
  void sort_by_16_bits(std::size_t n, int shift, const std::uint32_t *keys,
                       const std::uint32_t *values, std::uint32_t *to_keys,
                       std::uint32_t *to_values)
  {
    std::vector<std::size_t> start(65536, 0);
    for (std::size_t i = 0; i < n; i++) start[(keys[i] >> shift) & 0xffff]++;
    exclusive_scan(start.data(), start.size());
    for (std::size_t i = 0; i < n; i++) {
      const std::size_t to = start[(keys[i] >> shift) & 0xffff]++;
      to_keys[to] = keys[i];
      to_values[to] = values[i];
    }
  }
};

}    // namespace lsdcd
