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

// Books what pairs do that touch, or did a step ago; a warp sums it.
template <class Law>
struct BookPairs {
  static constexpr unsigned kBlocksAtOnce = 3;
  PairStepView s;
  EnergyRows *sums;    // of each warp
  char *is_booked;

  template <class W>
  LSDCD_FN void operator()(const W &warp, bool mine, std::size_t k) const
  {
    EnergyRows sum;
    bool any = false;
    for_each_pair<true>(s, warp, mine, k, [&](bool is_pair, const PairOfRow &pair) {
      if (is_pair) any |= book(pair, sum);
    });
    if (!warp.any(any)) return;
    for (int row = 0; row < kEnergyRows; row++) sum.of[row] = warp.sum(sum.of[row]);
    if (warp.rank() > 0) return;
    sums[k / W::kSize].add(sum);
    is_booked[k / W::kSize] = 1;
  }

 private:
  // Returns whether the pair is one of this law.
  LSDCD_FN bool book(const PairOfRow &pair, EnergyRows &sum) const
  {
    const int i = s.list.grain[pair.row], with = s.list.at(i, pair.place), j = with & s.list.mask,
              law = s.law(i, j);
    if (s.kind_of[law] != s.kind) return false;
    EnergyRows of;
    book_pair(s.laws[law].template in_kernel<Law>(), grain_pair(s, i, j, s.update), pair.old,
              pair.now, s.width, of);
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
                         [](const PairStepView &s, EnergyRows *sums, char *is_booked, B &b) {
                           b.for_each_in_warps(static_cast<std::size_t>(s.list.rows),
                                               BookPairs<Law>{s, sums, is_booked});
                         }};
  });
}

}    // namespace lsdcd
