// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "pair/partners.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

void Partners::set_form(const PartnerForm &form)
{
  resize_rows(form.row_size(), [&](const Real *from, Real *to) {
    *to++ = *from++;
    std::copy_n(from, std::min(form.width, form_.width), to);
    if (form.by_law) to[form.width] = form_.by_law ? from[form_.width] : PartnerForm::kUnknownLaw;
    if (form.by_image && form_.by_image)
      std::copy_n(from + form_.image_at(), 3, to + form.image_at());
  });
  form_ = form;
}

int Partners::pack(int i, Real *to, int width) const
{
  Real *const begin = to;
  *to++ = count(i);
  for (int k = 0; k < count(i); k++) {
    to = std::copy_n(row(i, k), 1 + width, to);
    to = std::copy(numbers(i, k) + form_.width, numbers(i, k) + form_.size(), to);
  }
  return static_cast<int>(to - begin);
}

bool Partners::is_sound(const Real *from, int size) const
{
  if (size < 1) return false;
  const Real n = from[0];
  const int each = row_size();
  if (!(n >= 0) || n != std::floor(n) || size != 1 + n * each ||
      !std::all_of(from, from + size, [](Real a) { return std::isfinite(a); }))
    return false;
  for (int at = 1; at < size; at += each)
    if (std::fabs(from[at]) > 0x1p53 || from[at] != std::floor(from[at])) return false;
  return true;
}

}    // namespace lsdcd
