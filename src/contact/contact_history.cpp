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
  int at = 0;
  buffer[at++] = count_[i];
  for (int k = 0; k < count_[i]; k++) {
    const Spring &s = pool_[first_[i] + k];
    buffer[at++] = packed_location(s);
    for (int c = 0; c < 3; c++) buffer[at++] = s.normal[c];
    for (int c = 0; c < 3; c++) buffer[at++] = s.shear[c];
    for (int c = 0; c < n_extra_; c++) buffer[at++] = extra_of(i)[k * n_extra_ + c];
  }
  return at;
}

int ContactHistory::unpack(int i, const double *buffer)
{
  int at = 0;
  arrived_.resize(static_cast<std::size_t>(buffer[at++]));
  arrived_extra_.clear();
  for (Spring &s : arrived_) {
    s = {};
    unpack_location(buffer[at++], s);
    for (int c = 0; c < 3; c++) s.normal[c] = buffer[at++];
    for (int c = 0; c < 3; c++) s.shear[c] = buffer[at++];
    for (int c = 0; c < n_extra_; c++) arrived_extra_.push_back(buffer[at++]);
  }
  set(i, arrived_.data(), arrived_extra_.data(), static_cast<int>(arrived_.size()));
  return at;
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
