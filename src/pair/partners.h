// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What touching pairs keep, by grain and partner: while the host's list is made anew, and while grains go to other
// processes or into files.
#pragma once

#include "pair/pair_job.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace lsdcd {

// Partners of grain i and `width` numbers for each of them, as grain i sees them. The host may copy, pack, unpack and reset
// grains. In messages and files a grain has a count, and for each partner its name and its numbers.
class Partners {
 public:
  using Name = std::int64_t;    // of a grain, the same on all processes

  explicit Partners(int width = 0) : width_(width) {}
  int width() const { return static_cast<int>(width_); }

  void grow(int n_grains);    // keeps what is there; new grains have none
  // Gives each partner as many numbers: the first ones stay, and others are 0.
  void set_width(int width);
  void copy(int from, int to) { first_[to] = first_[from], count_[to] = count_[from]; }
  void clear(int i) { count_[i] = 0; }
  // Takes partners in place of all that is there: those of grain i are first[i], and count[i] - 1 behind it.
  void assign(std::vector<std::size_t> first, std::vector<int> count, std::vector<Name> name,
              std::vector<Real> numbers)
  {
    first_ = std::move(first);
    count_ = std::move(count);
    name_ = std::move(name);
    numbers_ = std::move(numbers);
  }
  int count(int i) const { return count_[i]; }
  Name name(int i, int k) const { return name_[first_[i] + k]; }
  void rename(int i, int k, Name name) { name_[first_[i] + k] = name; }
  const Real *numbers(int i, int k) const { return numbers_.data() + width_ * (first_[i] + k); }

  // Takes over what the pairs of a list keep, for the first n grains, both of each pair. `name(i)`: of a grain.
  // `flips(i, j)`: which numbers change sign where i and j change places, see ContactLaw::flips().
  template <class NameOf, class Flips>
  void collect(const PairList &list, const PairHistory &history, int n, const NameOf &name,
               const Flips &flips);
  // Gives it to the pairs of a new list. Pairs that are not in it any more have parted.
  template <class NameOf>
  void hand_out(const PairList &list, PairHistory &history, const NameOf &name) const;

  int packed_size(int i) const { return packed_size(i, width()); }
  int pack(int i, Real *to) const { return pack(i, to, width()); }    // returns packed_size(i)
  // The same with the first `width` numbers of each partner.
  int packed_size(int i, int width) const { return 1 + (1 + width) * count_[i]; }
  int pack(int i, Real *to, int width) const;
  int unpack(int i,
             const Real *from);    // in place of what it has; returns how many numbers were read
  int unpack_more(int i, const Real *from);    // beside what it has
  int largest_packed_size() const;             // over all grains
  // Returns whether `size` numbers are what pack() can have written.
  bool is_sound(const Real *from, int size) const;
  std::size_t bytes() const;

 private:
  void append(Name name, const Real *numbers);

  std::size_t width_;
  std::vector<std::size_t> first_;
  std::vector<int> count_;
  std::vector<Name> name_;
  std::vector<Real> numbers_;
};

template <class NameOf, class Flips>
void Partners::collect(const PairList &list, const PairHistory &history, int n, const NameOf &name,
                       const Flips &flips)
{
  const auto for_pairs = [&](const auto &act) {
    std::size_t pair = 0, start = 0;
    for (int k = 0; k < list.rows; k++) {
      const int i = list.grain[k];
      const std::size_t end = start + static_cast<std::size_t>(list.length[i]);
      for (; pair < history.size() && history.key(pair) < end; pair++)
        act(i, list.row[i][history.key(pair) - start] & list.mask, pair);
      start = end;
    }
  };
  for (int &count : count_) count = 0;
  for_pairs([&](int i, int j, std::size_t) {
    if (i < n) count_[i]++;
    if (j < n) count_[j]++;
  });
  std::size_t all = 0;
  for (int i = 0; i < n; i++) {
    first_[i] = all;
    all += static_cast<std::size_t>(count_[i]);
    count_[i] = 0;
  }
  name_.resize(all);
  numbers_.resize(all * width_);
  for_pairs([&](int i, int j, std::size_t pair) {
    if (i < n) {
      const std::size_t at = first_[i] + static_cast<std::size_t>(count_[i]++);
      name_[at] = name(j);
      for (std::size_t k = 0; k < width_; k++)
        numbers_[at * width_ + k] = history.column(static_cast<int>(k))[pair];
    }
    if (j < n) {
      const std::size_t at = first_[j] + static_cast<std::size_t>(count_[j]++);
      const unsigned flip = flips(i, j);
      name_[at] = name(i);
      for (std::size_t k = 0; k < width_; k++) {
        const Real a = history.column(static_cast<int>(k))[pair];
        numbers_[at * width_ + k] = flip >> k & 1 ? -a : a;
      }
    }
  });
}

template <class NameOf>
void Partners::hand_out(const PairList &list, PairHistory &history, const NameOf &name) const
{
  history.begin(width());
  std::size_t start = 0;
  for (int k = 0; k < list.rows; k++) {
    const int i = list.grain[k];
    int left = count_[i];
    for (int place = 0; place < list.length[i] && left > 0; place++) {
      const Name other = name(list.row[i][place] & list.mask);
      for (int p = 0; p < count_[i]; p++) {
        if (this->name(i, p) != other) continue;
        const std::size_t key = start + static_cast<std::size_t>(place),
                          pair = history.append(&key, 1);
        for (int m = 0; m < width(); m++) history.column(m)[pair] = numbers(i, p)[m];
        left--;
        break;
      }
    }
    start += static_cast<std::size_t>(list.length[i]);
  }
}

}    // namespace lsdcd
