// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/kept_rows.h"

#include <algorithm>

namespace lsdcd {

void KeptRows::begin(int row_size)
{
  row_size_ = row_size;
  std::fill(count_.begin(), count_.end(), 0);
  numbers_.clear();
}

void KeptRows::grow(int n_grains)
{
  if (n_grains <= this->n_grains()) return;
  first_.resize(n_grains, 0);
  count_.resize(n_grains, 0);
}

Real *KeptRows::add(int i, int n)
{
  const int had = count_[i];
  const std::size_t end = numbers_.size();
  numbers_.resize(end + static_cast<std::size_t>(had + n) * row_size_);
  std::copy_n(row(i, 0), static_cast<std::size_t>(had) * row_size_, numbers_.data() + end);
  first_[i] = end / row_size_;
  count_[i] = had + n;
  return row(i, had);
}

int KeptRows::pack(int i, Real *to) const
{
  to[0] = count_[i];
  std::copy_n(row(i, 0), row_size_ * count_[i], to + 1);
  return packed_size(i);
}

int KeptRows::unpack(int i, const Real *from)
{
  clear(i);
  return unpack_more(i, from);
}

int KeptRows::unpack_more(int i, const Real *from)
{
  const int n = static_cast<int>(from[0]);
  std::copy_n(from + 1, row_size_ * n, add(i, n));
  return 1 + row_size_ * n;
}

int KeptRows::largest_packed_size() const
{
  const auto most = std::max_element(count_.begin(), count_.end());
  return 1 + (most == count_.end() ? 0 : row_size_ * *most);
}

std::size_t KeptRows::bytes() const
{
  return first_.capacity() * sizeof first_[0] + count_.capacity() * sizeof count_[0] +
         numbers_.capacity() * sizeof numbers_[0];
}

}    // namespace lsdcd
