// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The kernel that books what pairs do with energy in a step, on every backend.
#pragma once

#include "law/smallest_model.h"
#include "pair/pair_energy.h"
#include "pair/step_on.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace lsdcd {

template <class Law>
struct BookPairs {
  PairStepView s;
  EnergyRows *rows;
  char *is_booked;

  LSDCD_FN void operator()(std::size_t k) const
  {
    EnergyRows of_row;
    bool any = false;
    std::size_t place = std::size_t(s.now.first[k]),
                old_place = s.old.words ? std::size_t(s.old.first[k]) : 0;
    for (int w = 0; w < s.words; w++) {
      const std::size_t at = std::size_t(w) * s.list.rows + k;
      const std::uint32_t now = s.now.words[at], old = s.old.words ? s.old.words[at] : 0;
      for (std::uint32_t bits = now | old; bits != 0; bits &= bits - 1) {
        const unsigned bit = lowest_bit(bits);
        const bool touches = now >> bit & 1, touched = old >> bit & 1;
        const PairNumbers<Real> none = {nullptr, 0};
        any |= book(k, s.list.at(s.list.grain[k], kWordBits * w + static_cast<int>(bit)),
                    touched ? s.old.of(old_place) : none, touches ? s.now.of(place) : none, of_row);
        place += touches ? s.step : 0;
        old_place += touched ? s.step : 0;
      }
    }
    if (!any) return;
    rows[k].add(of_row);
    is_booked[k] = 1;
  }

 private:
  // Returns whether the pair is one of this law.
  LSDCD_FN bool book(std::size_t k, int with, const PairNumbers<Real> &old,
                     const PairNumbers<Real> &now, EnergyRows &sum) const
  {
    const int i = s.list.grain[k], j = with & s.list.mask, law = s.law(i, j);
    if (s.kind_of[law] != s.kind) return false;
    EnergyRows of;
    book_pair(s.laws[law].template in_kernel<Law>(), grain_pair(s, i, j, s.update), old, now,
              s.width, of);
    const bool whole = !s.list.full && (s.both_sides || j < s.n_own);
    const Real share = (whole ? 1 : 0.5) * s.factor[with >> s.list.factor_shift & 3];
    for (int row = 0; row < kEnergyRows; row++) sum.of[row] += share * of.of[row];
    return true;
  }
};

template <class B>
PairBookOn<B> pair_book_on(const ContactLaw &law)
{
  return with_energy_law(law, [](const auto &model) {
    using Law = std::decay_t<decltype(model)>;
    return PairBookOn<B>{LawBytes(model),
                         [](const PairStepView &s, EnergyRows *rows, char *is_booked, B &b) {
                           b.for_each(static_cast<std::size_t>(s.list.rows),
                                      BookPairs<Law>{s, rows, is_booked}, 128u);
                         }};
  });
}

}    // namespace lsdcd
