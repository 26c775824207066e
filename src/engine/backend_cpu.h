// The five verbs of a backend on the host: allocate, copy, for_each, reduce, scan/sort.
#pragma once

#include "base/threads.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace lsdcd {

struct CpuBackend {
  static constexpr bool kIsDevice = false;

  // allocate: contents are undefined until written.
  template <class T>
  class Array {
   public:
    Array() = default;
    explicit Array(std::size_t n) : data_(new T[n]), n_(n) {}
    ~Array() { delete[] data_; }
    Array(Array &&other) noexcept { swap(other); }
    Array &operator=(Array &&other) noexcept
    {
      swap(other);
      return *this;
    }
    Array(const Array &) = delete;
    Array &operator=(const Array &) = delete;
    T *data() { return data_; }
    const T *data() const { return data_; }
    std::size_t size() const { return n_; }

   private:
    void swap(Array &other)
    {
      std::swap(data_, other.data_);
      std::swap(n_, other.n_);
    }
    T *data_ = nullptr;
    std::size_t n_ = 0;
  };

  // copy
  template <class T>
  Array<T> from_host(const std::vector<T> &host)
  {
    Array<T> a(host.size());
    std::copy(host.begin(), host.end(), a.data());
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

  // for_each: f(i) for i in [0, n), in any order and possibly at once.
  template <class F>
  void for_each(std::size_t n, const F &f)
  {
    const std::int64_t m = static_cast<std::int64_t>(n);
#pragma omp parallel for schedule(dynamic, 64) num_threads(threads()) if (m > 256)
    for (std::int64_t i = 0; i < m; i++) f(static_cast<std::size_t>(i));
  }

  // reduce
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
  void sort_pairs(Array<std::uint32_t> &keys, Array<std::uint32_t> &values, std::uint32_t largest)
  {
    const std::size_t n = keys.size();
    Array<std::uint32_t> other_keys(n), other_values(n);
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
