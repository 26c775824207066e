// A backend on the host. doc/design.md, "Adding a backend", lists what a backend has.
#pragma once

#include "backend/atomic.h"
#include "backend/warp.h"
#include "base/strided_view.h"
#include "backend/threads.h"
#include "backend/owned_array.h"

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
  static constexpr bool kOnHost = true;    // is its memory the host's?

  // allocate
  struct Memory {
    static void *allocate(std::size_t bytes) { return ::operator new(bytes); }
    static void free(void *at) { ::operator delete(at); }
  };
  template <class T>
  using Array = OwnedArray<T, Memory>;
  template <class T>
  using Scratch = Array<T>;    // for a while
  template <class T>
  using HostArray = Array<T>;    // what copies quickly

  // copy
  template <class T>
  void copy_in(const T *host, T *to, std::size_t n)
  {
    std::copy(host, host + n, to);
  }
  template <class T>
  void send(const HostArray<T> &host, Array<T> &to, std::size_t n)
  {
    std::copy(host.data(), host.data() + n, to.data());
  }
  template <class T>
  void receive(const Array<T> &from, HostArray<T> &host, std::size_t n)
  {
    std::copy(from.data(), from.data() + n, host.data());
  }
  template <class T>
  Array<T> from_host(const std::vector<T> &host)
  {
    Array<T> a(host.size());
    copy_in(host.data(), a.data(), host.size());
    return a;
  }
  template <class T>
  std::vector<T> to_host(const Array<T> &a, std::size_t n)
  {
    return std::vector<T>(a.data(), a.data() + n);
  }
  template <class T>
  T read_one(const T *at)
  {
    return *at;
  }
  void wait() {}

  // ask: what is at `at`; answer() tells.
  template <class T>
  using Asked = T;
  template <class T>
  void ask(const T *at, T &asked)
  {
    asked = *at;
  }
  template <class T>
  T answer(const T &asked)
  {
    return asked;
  }

  // beside: here one thing comes after the other.
  struct Beside {
    void ready(CpuBackend &) {}
    void begin(CpuBackend &) {}
    void end(CpuBackend &) {}
  };

  // for_each: f(i) for i in [0, n), in any order and possibly at once.
  // The last argument is for GPUs: how many run together.
  template <class F>
  void for_each(std::size_t n, const F &f, unsigned /*block*/ = 0)
  {
    const std::int64_t m = static_cast<std::int64_t>(n);
#pragma omp parallel for schedule(dynamic, 64) num_threads(threads()) if (m > 256)
    for (std::int64_t i = 0; i < m; i++) f(static_cast<std::size_t>(i));
  }

  // f(warp, mine, i), likewise, by threads that share their work; one that is there only to help
  // has an i that is not `mine`. With `n_at`: for *n_at in place of n, or none if that is more.
  template <class F>
  void for_each_in_warps(std::size_t n, const F &f, const std::uint32_t *n_at = nullptr)
  {
    if (n_at) n = *n_at <= n ? *n_at : 0;
    for_each(n, [&](std::size_t i) { f(Warp<1>(), true, i); });
  }

  // What f() takes, in milliseconds.
  template <class F>
  double milliseconds(const F &f)
  {
    const auto start = std::chrono::steady_clock::now();
    f();
    return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  // for_each over parts of things: thing i has offset[i + 1] - offset[i] of them. Calls
  // f(i, part, k), k counting the parts of the run.
  static constexpr std::uint64_t kMostParts = 1 << 24;    // in a run
  template <class Run, class F>
  void for_each_part(const std::uint64_t *offset, const Run &run, const F &f)
  {
    const std::int64_t begin = run.begin, end = run.end;
#pragma omp parallel for schedule(dynamic, 64) num_threads(threads()) if (run.n > 256)
    for (std::int64_t i = begin; i < end; i++)
      for (std::uint64_t at = offset[i]; at < offset[i + 1]; at++)
        f(static_cast<std::size_t>(i), at - offset[i], at - run.first);
  }

  // compact: of from[0, n) those whose flag is set, in order, into `to`; *total becomes how many.
  void compact(std::size_t n, const int *from, const char *flags, Array<char> & /*scratch*/,
               int *to, std::uint32_t *total)
  {
    std::uint32_t kept = 0;
    for (std::size_t k = 0; k < n; k++)
      if (flags[k]) to[kept++] = from[k];
    *total = kept;
  }

  // Does test(i) hold for any i in [0, n)?
  struct Flag {};
  template <class Test>
  bool any(std::size_t n, Flag &, const Test &test)
  {
    for (std::size_t i = 0; i < n; i++)
      if (test(i)) return true;
    return false;
  }

  // reduce
  template <class T, class Read>
  T largest(std::size_t n, const Read &read)
  {
    T most = n > 0 ? read(0) : T(0);
    for (std::size_t i = 1; i < n; i++) most = std::max<T>(most, read(i));
    return most;
  }
  template <class T>
  T sum(const T *values, std::size_t n)
  {
    return std::accumulate(values, values + n, T(0));
  }

  // scan: values become the sums of what was before them; returns the total.
  template <class T>
  T exclusive_scan(T *values, std::size_t n)
  {
    T total = 0;
    for (std::size_t i = 0; i < n; i++) total += std::exchange(values[i], total);
    return total;
  }

  // sort: stable, by key; 16 bits at a time up to the largest key's bits.
  void sort_pairs(Scratch<std::uint32_t> &keys, Scratch<std::uint32_t> &values,
                  std::uint32_t largest)
  {
    const std::size_t n = keys.size();
    Scratch<std::uint32_t> other_keys(n), other_values(n);
    for (int shift = 0; shift < 32 && (largest >> shift) > 0; shift += 16) {
      std::vector<std::size_t> start(65536, 0);
      for (std::size_t i = 0; i < n; i++) start[(keys.data()[i] >> shift) & 0xffff]++;
      exclusive_scan(start.data(), start.size());
      for (std::size_t i = 0; i < n; i++) {
        const std::size_t to = start[(keys.data()[i] >> shift) & 0xffff]++;
        other_keys.data()[to] = keys.data()[i];
        other_values.data()[to] = values.data()[i];
      }
      std::swap(keys, other_keys);
      std::swap(values, other_values);
    }
  }

  std::string name() const
  {
    const int n = threads();
    return "CPU, " + std::to_string(n) + (n == 1 ? " thread" : " threads");
  }
};

}    // namespace lsdcd
