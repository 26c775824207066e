// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a backend has: memory, and loops over many things, on a CPU or on a GPU. All else is made of these verbs.
//
//   Array, Scratch, HostArray    memory where it computes; the same for a while; memory of the host that copies
//                                quickly, and without a wait
//   copy_in, copy_out            n things from and to the host. Its memory may be changed and read after wait()
//   wait                         until all that was started has ended
//   for_each                     f(i) for i in [0, n), in any order, possibly at once
//   for_each_in_warps            the same by threads that share their work: f(warp, mine, i)
//   largest                      of read(i), i in [0, n); waits
//   exclusive_scan               numbers become the sums of those before them; returns the total; waits
//   sort_pairs                   by key, stable
//   compact                      what is flagged of an array, in order
//   Event                        a point in what was started: record() and wait() for it
//   SideStream                   what is started between begin() and end() waits for what came before ready() only
//   milliseconds                 that f() takes
//   name                         for logs
//
// kOnHost says whether its memory is the host's. A GPU's has launch() beside these, for kernels that are written
// for it. tests/tool/check_backends.py holds each backend to this list.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace lsdcd {

namespace backend_detail {

struct Read {
  int operator()(std::size_t) const;
};
struct Each {
  void operator()(std::size_t) const;
};
struct EachInWarps {
  template <class Warp>
  void operator()(const Warp &, bool, std::size_t) const;
};
struct Work {
  void operator()() const;
};

template <class B, class = void>
struct HasVerbs : std::false_type {
};
template <class B>
struct HasVerbs<
    B, std::void_t<
           typename B::template Array<int>, typename B::template Scratch<int>,
           typename B::template HostArray<int>,
           decltype(std::declval<B &>().copy_in((const int *) nullptr, (int *) nullptr, 1)),
           decltype(std::declval<B &>().copy_out((const int *) nullptr, (int *) nullptr, 1)),
           decltype(std::declval<B &>().wait()), decltype(std::declval<B &>().for_each(1, Each())),
           decltype(std::declval<B &>().for_each(1, Each(), 64u)),
           decltype(std::declval<B &>().for_each_in_warps(1, EachInWarps(),
                                                          (const std::uint32_t *) nullptr)),
           decltype(int(std::declval<B &>().template largest<int>(1, Read()))),
           decltype(int(std::declval<B &>().exclusive_scan((int *) nullptr, 1))),
           decltype(std::declval<B &>().sort_pairs(
               std::declval<typename B::template Scratch<std::uint32_t> &>(),
               std::declval<typename B::template Scratch<std::uint32_t> &>(), std::uint32_t(0))),
           decltype(std::declval<B &>().compact(1, (const int *) nullptr, (const char *) nullptr,
                                                std::declval<typename B::template Array<char> &>(),
                                                (int *) nullptr, (std::uint32_t *) nullptr)),
           decltype(std::declval<typename B::Event &>().record(std::declval<B &>())),
           decltype(std::declval<typename B::Event &>().wait()),
           decltype(std::declval<typename B::SideStream &>().ready(std::declval<B &>())),
           decltype(std::declval<typename B::SideStream &>().begin(std::declval<B &>())),
           decltype(std::declval<typename B::SideStream &>().end(std::declval<B &>())),
           decltype(double(std::declval<B &>().milliseconds(Work()))),
           decltype(std::string(std::declval<const B &>().name())),
           std::enable_if_t<B::kOnHost || !B::kOnHost>>> : std::true_type {
};

}    // namespace backend_detail

template <class B>
constexpr bool is_backend = backend_detail::HasVerbs<B>::value;

// Copies of whole arrays, which wait.

template <class B, class T>
typename B::template Array<T> from_host(B &b, const std::vector<T> &host)
{
  typename B::template Array<T> array(host.size());
  b.copy_in(host.data(), array.data(), host.size());
  b.wait();
  return array;
}

// The first n of an array.
template <class B, class Array>
auto to_host(B &b, const Array &array, std::size_t n)
{
  using T = std::decay_t<decltype(*array.data())>;
  std::vector<T> host(n);
  b.copy_out(array.data(), host.data(), n);
  b.wait();
  return host;
}

template <class B, class T>
T read_one(B &b, const T *at)
{
  T value;
  b.copy_out(at, &value, 1);
  b.wait();
  return value;
}

}    // namespace lsdcd
