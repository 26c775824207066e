// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What grains keep from step to step, in memory of the CPU, for the time in which a host moves grains.
#pragma once

#include "base/real.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace lsdcd {

// Rows of numbers, all of one size: grain i has count(i) of them. The host may copy, pack, unpack and clear grains. In messages
// and files a grain has its count of rows, then their numbers.
class KeptRows {
 public:
  explicit KeptRows(int row_size) : row_size_(row_size) {}

  int row_size() const { return row_size_; }
  void begin(int row_size);    // forgets all rows; those to come have this size
  void grow(int n_grains);     // keeps present rows; new grains have none
  void copy(int from, int to) { first_[to] = first_[from], count_[to] = count_[from]; }
  void clear(int i) { count_[i] = 0; }

  int n_grains() const { return static_cast<int>(count_.size()); }
  int count(int i) const { return count_[i]; }
  Real *row(int i, int k) { return numbers_.data() + (first_[i] + k) * row_size_; }
  const Real *row(int i, int k) const { return numbers_.data() + (first_[i] + k) * row_size_; }
  // Gives grain i n more rows, of zeros, behind those that it has, and returns the first of them.
  Real *add(int i, int n);
  // Makes each row one of this size: change(row, row of zeros that takes its place).
  template <class Change>
  void resize_rows(int row_size, const Change &change)
  {
    const std::size_t old = row_size_, of = row_size, n = numbers_.size() / old;
    std::vector<Real> numbers(n * of, 0);
    for (std::size_t k = 0; k < n; k++) change(numbers_.data() + k * old, numbers.data() + k * of);
    numbers_ = std::move(numbers);
    row_size_ = row_size;
  }

  int packed_size(int i) const { return 1 + row_size_ * count_[i]; }
  int pack(int i, Real *to) const;             // returns packed_size(i)
  int unpack(int i, const Real *from);         // returns how many numbers were read
  int unpack_more(int i, const Real *from);    // does the same, and keeps present rows
  int largest_packed_size() const;             // over all grains

  std::size_t bytes() const;

 private:
  int row_size_;
  std::vector<std::size_t> first_;    // rows of grain i: first_[i] .. first_[i] + count_[i] - 1
  std::vector<int> count_;
  std::vector<Real> numbers_;
};

}    // namespace lsdcd
