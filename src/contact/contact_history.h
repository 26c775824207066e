// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The springs of a process's spheres in memory of the CPU, for the time in which a host moves
// spheres.
#pragma once

#include "contact/spring.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

// Springs of sphere i are pool[first[i]] .. pool[first[i] + count[i] - 1].
// Holds two ints per sphere, one Spring per contact, and for each Spring the `n_extra` numbers that
// further effects of the contact law keep (most laws have none). The host may copy, pack, unpack and
// reset spheres.
class ContactHistory {
 public:
  explicit ContactHistory(int n_extra = 0) : n_extra_(n_extra) {}

  int n_extra() const { return n_extra_; }
  int doubles_per_spring() const { return kPackedSpring + n_extra_; }

  void grow(int n_spheres);    // keeps present springs; new spheres have none
  void copy(int from, int to) { first_[to] = first_[from], count_[to] = count_[from]; }
  void clear(int i) { count_[i] = 0; }

  int count(int i) const { return count_[i]; }
  const Spring *of(int i) const { return pool_.data() + first_[i]; }
  const Real *extra_of(int i) const
  {
    return extra_.data() + static_cast<std::size_t>(first_[i]) * n_extra_;
  }
  SpringsView view() const
  {
    return {{first_.data()}, {count_.data()}, pool_.data(), extra_.data()};
  }
  void set(int i, const Spring *springs, const Real *extra, int n);

  // Replaces each feature by rename(mesh, feature).
  template <class Rename>
  void rename_features(const Rename &rename)
  {
    for (std::size_t i = 0; i < count_.size(); i++)
      for (int k = 0; k < count_[i]; k++) {
        Spring &s = pool_[first_[i] + k];
        s.feature = rename(static_cast<int>(s.mesh), s.feature);
      }
  }

  // Takes the springs of n spheres from elsewhere, with first[] and count[] as they are there.
  void assign(std::vector<int> first, std::vector<int> count, std::vector<Spring> pool,
              std::vector<Real> extra);

  // The packed form, for exchange and restart: a count, then doubles_per_spring() numbers for each
  // spring.
  int packed_size(int i) const { return 1 + doubles_per_spring() * count_[i]; }
  int pack(int i, double *buffer) const;      // returns packed_size(i)
  int unpack(int i, const double *buffer);    // returns how many numbers were read
  // Does the same for numbers that were packed with n_extra extra numbers for each spring. Surplus
  // ones are left out, missing ones are 0.
  int unpack(int i, const double *buffer, int n_extra);
  int largest_packed_size() const;    // over all spheres

  std::size_t pool_size() const { return pool_.size(); }
  std::size_t bytes() const;

 private:
  int n_extra_;
  std::vector<int> first_, count_;
  std::vector<Spring> pool_, arrived_;
  std::vector<Real> extra_, arrived_extra_;
};

}    // namespace lsdcd
