// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "pair/partners.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

void Partners::grow(int n_grains)
{
  first_.resize(static_cast<std::size_t>(n_grains), 0);
  count_.resize(static_cast<std::size_t>(n_grains), 0);
}

void Partners::append(Name name, const Real *numbers)
{
  name_.push_back(name);
  numbers_.insert(numbers_.end(), numbers, numbers + width_);
}

void Partners::set_width(int width)
{
  const std::size_t of = static_cast<std::size_t>(width), kept = std::min(of, width_);
  std::vector<Real> numbers(name_.size() * of);
  for (std::size_t k = 0; k < name_.size(); k++)
    std::copy_n(numbers_.data() + k * width_, kept, numbers.data() + k * of);
  numbers_ = std::move(numbers);
  width_ = of;
}

int Partners::pack(int i, Real *to, int width) const
{
  Real *const begin = to;
  *to++ = count_[i];
  for (int k = 0; k < count_[i]; k++) {
    *to++ = static_cast<Real>(name(i, k));
    to = std::copy_n(numbers(i, k), width, to);
  }
  return static_cast<int>(to - begin);
}

int Partners::unpack(int i, const Real *from)
{
  count_[i] = 0;
  return unpack_more(i, from);
}

int Partners::unpack_more(int i, const Real *from)
{
  const std::size_t old = first_[i];
  const int had = count_[i], more = static_cast<int>(from[0]);
  first_[i] = name_.size();
  for (int k = 0; k < had; k++) {
    const std::vector<Real> numbers(
        numbers_.begin() + static_cast<std::ptrdiff_t>((old + k) * width_),
        numbers_.begin() + static_cast<std::ptrdiff_t>((old + k + 1) * width_));
    append(name_[old + k], numbers.data());
  }
  for (int k = 0; k < more; k++) {
    const Real *const row = from + 1 + k * (1 + width_);
    append(static_cast<Name>(row[0]), row + 1);
  }
  count_[i] = had + more;
  return static_cast<int>(1 + more * (1 + width_));
}

int Partners::largest_packed_size() const
{
  const auto most = std::max_element(count_.begin(), count_.end());
  return 1 + (most == count_.end() ? 0 : *most) * (1 + width());
}

bool Partners::is_sound(const Real *from, int size) const
{
  if (size < 1) return false;
  const Real n = from[0];
  return n >= 0 && n == std::floor(n) && size == 1 + n * (1 + width()) &&
         std::all_of(from, from + size, [](Real a) { return std::isfinite(a); });
}

std::size_t Partners::bytes() const
{
  return first_.capacity() * sizeof first_[0] + count_.capacity() * sizeof count_[0] +
         name_.capacity() * sizeof name_[0] + numbers_.capacity() * sizeof numbers_[0];
}

}    // namespace lsdcd
