// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The kernel that computes the energy balance of pairs in a step, on every backend.
#pragma once

#include "pair/booked_law.h"
#include "pair/pair_energy.h"
#include "pair/step_on.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace lsdcd {

// Records what pairs do with energy that touch now or did a step ago; a warp sums it. kOne: there
// is only one law.
template <class Law, bool kOne>
struct BookPairs {
  static constexpr unsigned kBlocksAtOnce = Law::kContactTorque ? 3 : 4;
  struct None {};
  PairStepView s;
  EnergyRows *sums;    // of each warp
  char *is_booked;
  std::conditional_t<kOne, Law, None> only;

  template <class W>
  LSDCD_FN void operator()(const W &warp, bool mine, std::size_t k) const
  {
    EnergyRows sum;
    bool any = false;
    for_each_pair<true>(s, warp, mine, k, [&](bool is_pair, const PairOfRow &pair) {
      if (is_pair) any |= book(pair, sum);
    });
    if (!warp.any(any)) return;
    for (int row = 0; row < kEnergyRows; row++)
      if (books_row<Law>(static_cast<EnergyRow>(row))) sum.of[row] = warp.sum(sum.of[row]);
    if (warp.rank() > 0) return;
    sums[k / W::kSize].add(sum);
    is_booked[k / W::kSize] = 1;
  }

 private:
  // Returns whether the pair has this law; if so, adds its energy to `sum`.
  LSDCD_FN bool book(const PairOfRow &pair, EnergyRows &sum) const
  {
    const int i = s.list.grain[pair.row], with = s.list.at(i, pair.place), j = with & s.list.mask;
    const Law *law;
    if constexpr (kOne) {
      law = &only;
    } else {
      const int of_pair = s.law(i, j);
      if (s.kind_of[of_pair] != s.kind) return false;
      law = &s.laws[of_pair].template in_kernel<Law>();
    }
    const auto grains = [&] { return grain_pair(s, i, j, s.update); };
    if (!!pair.old) {
      EnergyRows rows;
      book_old_pair(*law, grains(), pair.old, s.kept, !!pair.now, rows);
      add(with, rows, sum);
    }
    if (!!pair.now) {
      EnergyRows rows;
      book_new_pair(*law, grains, pair.old, pair.now, s.kept, rows);
      add(with, rows, sum);
    }
    return true;
  }
  LSDCD_FN void add(int with, const EnergyRows &rows, EnergyRows &sum) const
  {
    const bool whole = !s.list.full && (s.both_sides || (with & s.list.mask) < s.n_own);
    const Real share = (whole ? 1 : 0.5) * s.factor[with >> s.list.factor_shift & 3];
    for (int row = 0; row < kEnergyRows; row++)
      if (books_row<Law>(static_cast<EnergyRow>(row))) sum.of[row] += share * rows.of[row];
  }
};

template <class Law, class B>
void run_pair_book(const PairStepView &s, const LawBytes &law, EnergyRows *sums, char *is_booked,
                   B &b)
{
  const auto rows = static_cast<std::size_t>(s.list.rows);
  if (s.n_laws > 1)
    b.for_each_in_warps(rows, BookPairs<Law, false>{s, sums, is_booked, {}});
  else
    b.for_each_in_warps(rows, BookPairs<Law, true>{s, sums, is_booked, law.as<Law>()});
}

template <class B>
PairBookOn<B> pair_book_on(const ContactLaw &law)
{
  return with_booked_law(law, [](const auto &model) {
    return PairBookOn<B>{LawBytes(model), run_pair_book<std::decay_t<decltype(model)>, B>};
  });
}

}    // namespace lsdcd
