// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A backend has memory, and loops over many things, on a CPU or on a GPU. All else is made of these verbs.
//
//   Array, Scratch, CpuArray    memory where it computes; the same for a while; memory of the CPU that copies
//                                quickly, and without a wait
//   copy_in, copy_out            n things from and to the host. Its memory may be changed and read after wait()
//   wait                         until all that was started has ended
//   for_each                     f(i) for i in [0, n), in any order, possibly at once
//   for_each_in_warps            the same by threads that share their work: f(warp, mine, i)
//   largest                      of read(i), i in [0, n); waits
//   exclusive_scan               numbers become the sums of those before them; returns the total; waits
//   sort_pairs                   by key, stable, up to the bits of the largest key
//   compact                      what is flagged of an array, or of the numbers [0, n), in order
//   Event                        a point in what was started: record() and wait() for it; one that was never recorded counts as reached
//   SideStream                   what is started between begin() and end() waits for what came before ready() only
//   milliseconds                 that f() takes
//   scratch_bytes                of the memory that these need meanwhile
//   name                         for logs
//
// What these need of memory meanwhile is the backend's own, which it keeps: so a backend is moved, never copied, and one
// thread uses it. What is started beside has other scratch memory, as it may run at the same time.
//
// kOnCpu says whether its memory is the CPU's. A GPU's has for_each_block() beside these, for what is written for
// blocks of threads (block.h), Limits, which says how many of them it holds, and sort_in(), which sorts in memory that
// the caller keeps.
#pragma once

#include "backend/owned_array.h"
#include "base/real.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace lsdcd {

// Returns how many bits keys up to this one have; at least 1.
inline int bits_of(std::uint32_t largest)
{
  int bits = 1;
  while (bits < 32 && (largest >> bits) > 0) bits++;
  return bits;
}

// Copies of whole arrays, which wait.

template <class B, class T>
typename B::template Array<T> from_cpu(B &b, const std::vector<T> &host)
{
  typename B::template Array<T> array(host.size());
  b.copy_in(host.data(), array.data(), host.size());
  b.wait();
  return array;
}

// The first n of an array.
template <class B, class Array>
auto to_cpu(B &b, const Array &array, std::size_t n)
{
  using T = std::decay_t<decltype(*array.data())>;
  std::vector<T> host(n);
  b.copy_out(array.data(), host.data(), n);
  b.wait();
  return host;
}

// What a kernel does to an array of the backend. None of these waits. Their work is in named structs, which private functions
// can start: nvcc takes no device lambda from one.

template <class T>
struct PutAll {
  T *to;
  T value;
  LSDCD_FN void operator()(std::size_t i) const { to[i] = value; }
};
template <class B, class T, class Value>
void put_all(B &b, T *to, std::size_t n, const Value &value)
{
  b.for_each(n, PutAll<T>{to, static_cast<T>(value)});
}
template <class B, class T, class Value>
void put_one(B &b, T *to, const Value &value)
{
  put_all(b, to, 1, value);
}

template <class From, class To>
struct CopyAll {
  const From *from;
  To *to;
  LSDCD_FN void operator()(std::size_t i) const { to[i] = static_cast<To>(from[i]); }
};
template <class B, class From, class To>
void copy_all(B &b, const From *from, To *to, std::size_t n)
{
  b.for_each(n, CopyAll<From, To>{from, to});
}

// Copies of one thing, which wait.

template <class B, class T>
T read_one(B &b, const T *at)
{
  T value;
  b.copy_out(at, &value, 1);
  b.wait();
  return value;
}

}    // namespace lsdcd
