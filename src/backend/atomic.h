// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Counters that many threads share. Only sums and maxima of whole numbers: their result
// does not depend on the order.
#pragma once

#include "backend/bits.h"

#include <cstdint>
#include <cstring>

namespace lsdcd {

// Adds n; returns what was there before.
template <class T>
LSDCD_FN T fetch_add(T *at, T n)
{
#if LSDCD_ON_GPU()
  return atomicAdd(at, n);
#else
  return __atomic_fetch_add(at, n, __ATOMIC_RELAXED);
#endif
}

// Adds n, which may be less than 0.
LSDCD_FN void add_signed(std::int64_t *at, std::int64_t n)
{
#if LSDCD_ON_GPU()
  atomicAdd(reinterpret_cast<unsigned long long *>(at), static_cast<unsigned long long>(n));
#else
  __atomic_fetch_add(at, n, __ATOMIC_RELAXED);
#endif
}

// Adds 1 and returns what was there before, for numbers that many threads add to at once.
LSDCD_FN std::uint64_t fetch_add_one(std::uint64_t *at)
{
#if LSDCD_ON_GPU()
  // One addition for all lanes that are here: thousands to one number would wait for each other.
  const unsigned lanes = __activemask(), lane = threadIdx.x % 32;
  const unsigned first = __ffs(lanes) - 1;
  unsigned long long begin = 0;
  if (lane == first) begin = atomicAdd(reinterpret_cast<unsigned long long *>(at), __popc(lanes));
  return __shfl_sync(lanes, begin, first) + __popc(lanes & ((1u << lane) - 1));
#else
  return __atomic_fetch_add(at, 1, __ATOMIC_RELAXED);
#endif
}

LSDCD_FN void add_to(std::uint64_t *at, std::uint32_t n)
{
#if LSDCD_ON_GPU() && __CUDA_ARCH__ >= 800
  // As above.
  const unsigned lanes = __activemask();
  const unsigned sum = __reduce_add_sync(lanes, static_cast<unsigned>(n));
  if (threadIdx.x % 32 == __ffs(lanes) - 1)
    atomicAdd(reinterpret_cast<unsigned long long *>(at), static_cast<unsigned long long>(sum));
#elif LSDCD_ON_GPU()
  atomicAdd(reinterpret_cast<unsigned long long *>(at), static_cast<unsigned long long>(n));
#else
  __atomic_fetch_add(at, n, __ATOMIC_RELAXED);
#endif
}
LSDCD_FN void count_one(std::uint64_t *at)
{
  add_to(at, 1);
}

// Puts a value that is the same of all threads that put one.
template <class T>
LSDCD_FN void put_same(T *at, T value)
{
#if LSDCD_ON_GPU()
  *static_cast<volatile T *>(at) = value;
#else
  __atomic_store_n(at, value, __ATOMIC_RELAXED);
#endif
}

// Sets a flag that any thread may set.
LSDCD_FN void set_flag(int *flag)
{
  put_same(flag, 1);
}

// A lock is 0 while it is free. Threads of a GPU's warp wait for each other one by one.
LSDCD_FN bool try_lock(int *lock)
{
#if LSDCD_ON_GPU()
  if (atomicCAS(lock, 0, 1) != 0) return false;
  __threadfence();
  return true;
#else
  return __atomic_exchange_n(lock, 1, __ATOMIC_ACQUIRE) == 0;
#endif
}
LSDCD_FN void unlock(int *lock)
{
#if LSDCD_ON_GPU()
  __threadfence();
  atomicExch(lock, 0);
#else
  __atomic_store_n(lock, 0, __ATOMIC_RELEASE);
#endif
}

// Returns whether it was lower.
LSDCD_FN bool raise_to(std::uint64_t *at, std::uint64_t value)
{
#if LSDCD_ON_GPU()
  static_assert(sizeof(unsigned long long) == sizeof(std::uint64_t), "64 bits");
  return *static_cast<volatile std::uint64_t *>(at) < value &&
         atomicMax(reinterpret_cast<unsigned long long *>(at),
                   static_cast<unsigned long long>(value)) < value;
#else
  std::uint64_t seen = __atomic_load_n(at, __ATOMIC_RELAXED);
  while (seen < value)
    if (__atomic_compare_exchange_n(at, &seen, value, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
      return true;
  return false;
#endif
}

// A number >= 0 as bits that ascend with it, and back.
LSDCD_FN std::uint32_t ascending_bits(float value)
{
  std::uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}
LSDCD_FN float from_ascending_bits(std::uint32_t bits)
{
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

}    // namespace lsdcd
