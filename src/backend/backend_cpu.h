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

// Compiles a function with all that it calls, which is quick to run and slow to compile: with
// sanitizers it would take minutes.
#if defined(__SANITIZE_ADDRESS__)
#define LSDCD_FLATTEN
#else
#define LSDCD_FLATTEN gnu::flatten
#endif

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
  void for_each_together(std::size_t n, const F &f, const std::uint32_t *n_at = nullptr)
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

  // select: the i in [0, n) that `work` keeps, ascending, into `to`, which has room for n; `total`
  // becomes how many. check() is told of each i, with what read() has read of it. may_keep() and
  // find() are asked by its row of places(), and where looks_twice() keep_after_all() of what was
  // found. Where it notes(), note() is told.
  struct SelectScratch {
    std::size_t bytes() const { return 0; }
  };
  template <class Work>
  void select(std::size_t n, const Work &work, SelectScratch &, int *to, std::uint32_t *total)
  {
    // Blocks of one size whatever the number of threads, so that order is fixed.
    constexpr std::int64_t kBlock = 4096;
    const std::int64_t n_blocks = (static_cast<std::int64_t>(n) + kBlock - 1) / kBlock;
    std::vector<int> found(n_blocks, 0);
#pragma omp parallel for schedule(dynamic) num_threads(threads()) if (n_blocks > 1)
    for (std::int64_t b = 0; b < n_blocks; b++) {
      const std::int64_t lo = b * kBlock;
      const std::int64_t hi = std::min(lo + kBlock, static_cast<std::int64_t>(n));
      int count = 0;
      for (std::int64_t k = lo; k < hi; k++) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Vec3 place = work.places()[i];
        const auto item = work.read(i);
        work.check(i, item);
        const bool kept = work.may_keep(item, place, work.table) &&
                          work.find(place, work.table) != Work::kNotFound;
        if (work.notes()) work.note(i, kept);
        if (kept) to[lo + count++] = static_cast<int>(i);
      }
      found[b] = work.looks_twice() ? look_again(work, to + lo, count) : count;
    }
    std::uint32_t n_kept = 0;
    for (std::int64_t b = 0; b < n_blocks; b++) {
      std::copy(to + b * kBlock, to + b * kBlock + found[b], to + n_kept);
      n_kept += found[b];
    }
    *total = n_kept;
  }
  // On a GPU a second look may have too little room.
  bool had_room(std::uint32_t /*total*/, SelectScratch &)
  {
    return true;
  }

  // keep: of from[0, n) those whose flag is set, in order, into `to`; *total becomes how many.
  void keep(std::size_t n, const int *from, const char *flags, SelectScratch &, int *to,
            std::uint32_t *total)
  {
    std::uint32_t kept = 0;
    for (std::size_t k = 0; k < n; k++)
      if (flags[k]) to[kept++] = from[k];
    *total = kept;
  }

  // step: work.begin() once, and of each i in [0, n) work.single(i), or where that says false or
  // !work.has_single(), work.several(i), before that work.make_list(warp, true, i) if
  // work.needs_list(i), and with a list that is new work.single(i) once more.
  template <class Work>
  void step(std::size_t n, const Work &work)
  {
    work.begin();
    const std::int64_t m = static_cast<std::int64_t>(n);
    // Long enough that several items of a run need lists, and enough runs for all threads.
    const std::int64_t run = std::min(kRun, std::max<std::int64_t>(64, m / (8 * threads())));
#pragma omp parallel for schedule(dynamic) num_threads(threads()) if (m > 256)
    for (std::int64_t begin = 0; begin < m; begin += run)
      step_run(work, begin, std::min(m, begin + run));
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

 private:
  // Of n items leaves those that are kept after all, and returns how many. What is read first is asked for
  // a few items ahead.
  template <class Work>
  static int look_again(const Work &work, int *items, int n)
  {
    constexpr int kAhead = 4;
    int n_kept = 0;
    for (int k = 0; k < n; k++) {
      if (k + kAhead < n) work.ask_ahead(work.places()[items[k + kAhead]]);
      const int i = items[k];
      if (work.keep_after_all(Warp<1>(), true, i, Work::kNotKnown))
        items[n_kept++] = i;
      else if (work.notes())
        work.note(i, false);
    }
    return n_kept;
  }

  // Items of a step that a thread takes at once, at most.
  static constexpr std::int64_t kRun = 512;
  struct Items {
    int n = 0;
    std::int64_t at[kRun];

    void add(std::int64_t i) { at[n++] = i; }
  };

  template <class Work>
  static void step_run(const Work &work, std::int64_t begin, std::int64_t end)
  {
    Items left;
    if (work.has_single())
      step_singles(work, begin, end, left);
    else
      for (std::int64_t i = begin; i < end; i++) left.add(i);
    if (left.n > 0) step_left(work, left);
  }
  // single() is compiled into the loop whole, with its contact in registers; the rest is rare, and
  // long.
  template <class Work>
  [[gnu::noinline, LSDCD_FLATTEN]] static void step_singles(const Work &work, std::int64_t begin,
                                                            std::int64_t end, Items &left)
  {
    for (std::int64_t i = begin; i < end; i++)
      if (!work.single(static_cast<std::size_t>(i))) left.add(i);
  }
  // Those that need lists get them, and go through single() once more.
  template <class Work>
  [[gnu::noinline]] static void step_left(const Work &work, const Items &left)
  {
    const bool has_single = work.has_single();
    Items due, several;
    for (int k = 0; k < left.n; k++)
      (work.needs_list(static_cast<std::size_t>(left.at[k])) ? due : several).add(left.at[k]);
    for (int k = 0; k < due.n; k++) {
      if (k % kAsked == 0) ask_for_lists(work, due.at + k, std::min(kAsked, due.n - k));
      const std::int64_t i = due.at[k];
      work.make_list(Warp<1>(), true, static_cast<std::size_t>(i));
      if (has_single)
        step_singles(work, i, i + 1, several);
      else
        several.add(i);
    }
    for (int k = 0; k < several.n; k++) work.several(static_cast<std::size_t>(several.at[k]));
  }

  // Asks for what the lists of n items are made from, at most kAsked: else each would wait for memory
  // several times.
  static constexpr int kAsked = 32;
  template <class Work>
  static void ask_for_lists([[maybe_unused]] const Work &work,
                            [[maybe_unused]] const std::int64_t *items, [[maybe_unused]] int n)
  {
    if constexpr (Work::kSingle) {
      if (n < 2) return;
      typename Work::Ahead ahead[kAsked];
      for (int k = 0; k < n; k++) ahead[k] = work.list_ahead(static_cast<std::size_t>(items[k]));
      for (int part = 0; part < Work::Ahead::kParts; part++)
        for (int k = 0; k < n; k++) work.ask_for(ahead[k], part);
    }
  }
};

}    // namespace lsdcd
