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
  numbers_.insert(numbers_.end(), numbers, numbers + stride_);
}

void Partners::set_form(const PartnerForm &form)
{
  const auto of = static_cast<std::size_t>(form.stride());
  std::vector<Real> numbers(name_.size() * of);
  for (std::size_t k = 0; k < name_.size(); k++) {
    const Real *const from = numbers_.data() + k * stride_;
    Real *const to = numbers.data() + k * of;
    std::copy_n(from, std::min(form.width, form_.width), to);
    if (form.by_law) to[form.width] = form_.by_law ? from[form_.width] : PartnerForm::kUnknownLaw;
    if (form.by_image && form_.by_image)
      std::copy_n(from + form_.image_at(), 3, to + form.image_at());
  }
  numbers_ = std::move(numbers);
  form_ = form;
  stride_ = of;
}

int Partners::pack(int i, Real *to, int width) const
{
  Real *const begin = to;
  *to++ = count_[i];
  for (int k = 0; k < count_[i]; k++) {
    *to++ = static_cast<Real>(name(i, k));
    to = std::copy_n(numbers(i, k), width, to);
    to = std::copy(numbers(i, k) + form_.width, numbers(i, k) + stride_, to);
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
        numbers_.begin() + static_cast<std::ptrdiff_t>((old + k) * stride_),
        numbers_.begin() + static_cast<std::ptrdiff_t>((old + k + 1) * stride_));
    append(name_[old + k], numbers.data());
  }
  for (int k = 0; k < more; k++) {
    const Real *const row = from + 1 + k * (1 + stride_);
    append(static_cast<Name>(row[0]), row + 1);
  }
  count_[i] = had + more;
  return static_cast<int>(1 + more * (1 + stride_));
}

int Partners::largest_packed_size() const
{
  const auto most = std::max_element(count_.begin(), count_.end());
  return 1 + (most == count_.end() ? 0 : *most) * (1 + form_.stride());
}

bool Partners::is_sound(const Real *from, int size) const
{
  if (size < 1) return false;
  const Real n = from[0];
  const int each = 1 + form_.stride();
  if (!(n >= 0) || n != std::floor(n) || size != 1 + n * each ||
      !std::all_of(from, from + size, [](Real a) { return std::isfinite(a); }))
    return false;
  for (int at = 1; at < size; at += each)
    if (std::fabs(from[at]) > 0x1p53 || from[at] != std::floor(from[at])) return false;
  return true;
}

std::size_t Partners::bytes() const
{
  return first_.capacity() * sizeof first_[0] + count_.capacity() * sizeof count_[0] +
         name_.capacity() * sizeof name_[0] + numbers_.capacity() * sizeof numbers_[0];
}

}    // namespace lsdcd
