// The tangential springs of a process's spheres between two steps, on the host.
#pragma once

#include "contact/spring.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

constexpr int kPacked = 0;    // a stride: no gaps

// Springs of sphere i are pool[first[i]] .. pool[first[i] + count[i] - 1].
// Two ints per sphere, one Spring per contact. The engine rebuilds the pool
// every step; between steps spheres may be copied, packed, unpacked and reset.
class SpringStore {
 public:
  static constexpr int kDoublesPerSpring = 7;    // feature, normal, stretch

  void grow(int n_spheres);    // keeps what is there, new spheres have none
  void copy(int from, int to) { first_[to] = first_[from], count_[to] = count_[from]; }
  void clear(int i) { count_[i] = 0; }

  int count(int i) const { return count_[i]; }
  const Spring *of(int i) const { return pool_.data() + first_[i]; }
  void set(int i, const Spring *springs, int n);

  // Exchange and restart: a count, then kDoublesPerSpring numbers for each.
  int packed_size(int i) const { return 1 + kDoublesPerSpring * count_[i]; }
  int pack(int i, double *buffer) const;      // returns packed_size(i)
  int unpack(int i, const double *buffer);    // returns the numbers taken
  int largest_packed_size() const;            // over all spheres

  const int *first() const { return first_.data(); }
  const int *count() const { return count_.data(); }
  const Spring *pool() const { return pool_.data(); }
  std::size_t pool_size() const { return pool_.size(); }
  std::size_t bytes() const;

  // Replaces everything: spheres which[k] get counts[k] springs found at
  // springs + k * stride, or with kPacked one after another; all others get none.
  void replace(const int *which, int n, const int *counts, const Spring *springs, int stride);

 private:
  std::vector<int> first_, count_;
  std::vector<Spring> pool_, next_, arrived_;
};

}    // namespace lsdcd
