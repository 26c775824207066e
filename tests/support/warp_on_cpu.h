// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A warp of a GPU as 32 threads of a CPU, for code that is written for warps. To be included before all headers of LSDCD, which
// then compile for a GPU: what they call of CUDA is here. Threads that are together in a function of the warp have to call the same
// one; on a GPU a call that some of them leave out is an illegal instruction or a wrong answer, here it is an error.
//
// A program with this header takes the GPU's branches of all inline functions. Its tests are a program of their own.
#pragma once

// These ask for __CUDACC__ themselves, and are not meant for it here.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#define __CUDACC__
#define __CUDA_ARCH__ 900
#define __host__
#define __device__
#define __shared__ static
#include "base/real.h"
#undef LSDCD_NOINLINE
#define LSDCD_NOINLINE __attribute__((noinline))
#pragma GCC diagnostic ignored "-Wunknown-pragmas"

struct ThreadIndex {
  unsigned x, y, z;
};
inline thread_local ThreadIndex threadIdx = {0, 0, 0};

namespace warp_on_cpu {

constexpr unsigned kThreads = 32;
enum class Function { end, wait, vote, any, of, from_below, of_other, match };

class Meeting {
 public:
  using Values = std::array<std::uint64_t, kThreads>;

  // Waits for all threads. Returns what each of them has brought. Throws in all where they are at different functions.
  Values meet(Function function, std::uint64_t brought)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    if (n_ > 0 && function != function_) apart_ = true;
    function_ = function;
    brought_[threadIdx.x] = brought;
    if (!apart_ && ++n_ == kThreads) {
      met_ = brought_;
      n_ = 0;
      round_++;
    } else {
      const auto round = round_;
      if (apart_) changed_.notify_all();
      changed_.wait(lock, [&] { return round_ != round || apart_; });
    }
    if (apart_) throw std::logic_error("threads of a warp call different functions of it");
    changed_.notify_all();
    return met_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  Values brought_ = {}, met_ = {};
  Function function_ = Function::end;
  unsigned n_ = 0;
  std::uint64_t round_ = 0;
  bool apart_ = false;
};
inline thread_local Meeting *meeting = nullptr;    // null: the thread is in no warp

// Runs f() by the threads of a warp. Throws what the first of them throws.
inline void run(const std::function<void()> &f)
{
  Meeting all;
  std::mutex mutex;
  std::exception_ptr error;
  std::vector<std::thread> threads;
  for (unsigned k = 0; k < kThreads; k++)
    threads.emplace_back([&, k] {
      threadIdx.x = k;
      meeting = &all;
      try {
        f();
        all.meet(Function::end, 0);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!error) error = std::current_exception();
      }
    });
  for (std::thread &t : threads) t.join();
  if (error) std::rethrow_exception(error);
}

template <class T>
std::uint64_t bits_of(T value)
{
  static_assert(sizeof value <= sizeof(std::uint64_t), "a register or two");
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof value);
  return bits;
}
// Returns what the thread `from` brings; its own of one that is in no warp.
template <class T>
T of(Function function, T value, unsigned from)
{
  if (!meeting) return value;
  const std::uint64_t bits = meeting->meet(function, bits_of(value))[from % kThreads];
  std::memcpy(&value, &bits, sizeof value);
  return value;
}
inline unsigned vote(Function function, bool yes)
{
  if (!meeting) return unsigned(yes) << threadIdx.x;
  const Meeting::Values all = meeting->meet(function, yes);
  unsigned votes = 0;
  for (unsigned k = 0; k < kThreads; k++) votes |= unsigned(all[k] != 0) << k;
  return votes;
}

}    // namespace warp_on_cpu

// What the code for a GPU calls, for whole warps.

inline void __syncwarp(unsigned)
{
  if (warp_on_cpu::meeting) warp_on_cpu::meeting->meet(warp_on_cpu::Function::wait, 0);
}
inline unsigned __ballot_sync(unsigned, bool yes)
{
  return warp_on_cpu::vote(warp_on_cpu::Function::vote, yes);
}
inline bool __any_sync(unsigned, bool yes)
{
  return warp_on_cpu::vote(warp_on_cpu::Function::any, yes) != 0;
}
template <class T>
T __shfl_sync(unsigned, T value, unsigned from, int = 32)
{
  return warp_on_cpu::of(warp_on_cpu::Function::of, value, from);
}
template <class T>
T __shfl_up_sync(unsigned, T value, unsigned step, int = 32)
{
  const unsigned me = threadIdx.x;
  return warp_on_cpu::of(warp_on_cpu::Function::from_below, value, me >= step ? me - step : me);
}
template <class T>
T __shfl_xor_sync(unsigned, T value, unsigned apart, int = 32)
{
  return warp_on_cpu::of(warp_on_cpu::Function::of_other, value, threadIdx.x ^ apart);
}
inline unsigned __match_any_sync(unsigned, int key)
{
  const std::uint64_t bits = warp_on_cpu::bits_of(key);
  const auto all = warp_on_cpu::meeting->meet(warp_on_cpu::Function::match, bits);
  unsigned same = 0;
  for (unsigned k = 0; k < warp_on_cpu::kThreads; k++) same |= unsigned(all[k] == bits) << k;
  return same;
}

// Threads that happen to be together: each is alone.
inline unsigned __activemask()
{
  return 1u << threadIdx.x;
}
inline unsigned __reduce_add_sync(unsigned, unsigned n)
{
  return n;
}

inline int __popc(unsigned word)
{
  return __builtin_popcount(word);
}
inline int __popcll(unsigned long long word)
{
  return __builtin_popcountll(word);
}
inline unsigned __ffs(int word)
{
  return static_cast<unsigned>(__builtin_ffs(word));
}
inline long long __double2ll_rn(double x)
{
  return std::llrint(x);
}
inline long long __double_as_longlong(double x)
{
  return static_cast<long long>(warp_on_cpu::bits_of(x));
}
// The sum rounded down: the rounded one, less where the error that it has is above 0.
inline double __dadd_rd(double a, double b)
{
  const volatile double sum = a + b, b_in_sum = sum - a, a_in_sum = sum - b_in_sum;
  const double error = (a - a_in_sum) + (b - b_in_sum);
  return error < 0 ? std::nextafter(sum, -HUGE_VAL) : sum;
}
inline unsigned max(unsigned a, unsigned b)
{
  return a > b ? a : b;
}
template <class T, class N>
T atomicAdd(T *at, N n)
{
  return __atomic_fetch_add(at, static_cast<T>(n), __ATOMIC_RELAXED);
}
inline double atomicAdd(double *at, double more)
{
  double seen = *at, sum;
  do sum = seen + more;
  while (!__atomic_compare_exchange(at, &seen, &sum, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED));
  return seen;
}
template <class T>
T atomicMax(T *at, T value)
{
  T seen = __atomic_load_n(at, __ATOMIC_RELAXED);
  while (seen < value &&
         !__atomic_compare_exchange_n(at, &seen, value, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
  }
  return seen;
}
inline int atomicCAS(int *at, int expected, int value)
{
  __atomic_compare_exchange_n(at, &expected, value, false, __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST);
  return expected;
}
inline int atomicExch(int *at, int value)
{
  return __atomic_exchange_n(at, value, __ATOMIC_SEQ_CST);
}
inline void __threadfence()
{
  __atomic_thread_fence(__ATOMIC_SEQ_CST);
}
