// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "contact/contact_history.h"

#include "base/countable.h"

#include <algorithm>

namespace lsdcd {

void ContactHistory::grow(int n_spheres)
{
  if (n_spheres <= static_cast<int>(count_.size())) return;
  first_.resize(n_spheres, 0);
  count_.resize(n_spheres, 0);
}

void ContactHistory::set(int i, const Spring *springs, const Real *extra, int n)
{
  first_[i] = countable_here(pool_.size(), "springs in one process", "use more processes");
  count_[i] = n;
  pool_.insert(pool_.end(), springs, springs + n);
  extra_.insert(extra_.end(), extra, extra + n * n_extra_);
}

void ContactHistory::assign(std::vector<int> first, std::vector<int> count,
                            std::vector<Spring> pool, std::vector<Real> extra)
{
  first_.swap(first);
  count_.swap(count);
  pool_.swap(pool);
  extra_.swap(extra);
}

int ContactHistory::pack(int i, double *buffer) const
{
  double *at = buffer;
  *at++ = count_[i];
  for (int k = 0; k < count_[i]; k++) {
    at = pack_spring(pool_[first_[i] + k], at);
    at = std::copy_n(extra_of(i) + k * n_extra_, n_extra_, at);
  }
  return static_cast<int>(at - buffer);
}

int ContactHistory::unpack(int i, const double *buffer)
{
  return unpack(i, buffer, n_extra_);
}

int ContactHistory::unpack(int i, const double *buffer, int n_extra)
{
  const double *at = buffer;
  arrived_.resize(static_cast<std::size_t>(*at++));
  arrived_extra_.clear();
  for (Spring &s : arrived_) {
    at = unpack_spring(at, s);
    arrived_extra_.insert(arrived_extra_.end(), at, at + std::min(n_extra, n_extra_));
    arrived_extra_.resize(arrived_extra_.size() + std::max(n_extra_ - n_extra, 0), 0);
    at += n_extra;
  }
  set(i, arrived_.data(), arrived_extra_.data(), static_cast<int>(arrived_.size()));
  return static_cast<int>(at - buffer);
}

int ContactHistory::largest_packed_size() const
{
  int most = 0;
  for (int n : count_) most = std::max(most, n);
  return 1 + doubles_per_spring() * most;
}

std::size_t ContactHistory::bytes() const
{
  return (first_.capacity() + count_.capacity()) * sizeof(int) + pool_.capacity() * sizeof(Spring) +
         extra_.capacity() * sizeof(Real);
}

}    // namespace lsdcd
