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

// A warp shares the pairs of its rows, each of which has few, and sums what they do; a thread of a CPU has a row.
template <class Law>
struct BookPairs {
  static constexpr unsigned kBlocksAtOnce = 3;
  PairStepView s;
  EnergyRows *sums;    // of each warp
  char *is_booked;

  template <class W>
  LSDCD_FN void operator()(const W &warp, bool mine, std::size_t k) const
  {
    const std::size_t begin = warp.of(k, 0);    // the first row
    EnergyRows sum;
    bool any = false;
    for (int w = 0; w < s.words; w++) {
      const unsigned count = mine ? static_cast<unsigned>(count_bits(either(w, k))) : 0,
                     end = warp.sum_up(count), first = end - count,
                     last = warp.of(end, W::kSize - 1);
      for (unsigned from = 0; from < last; from += W::kSize) {
        const unsigned pair = from + warp.rank(), owner = owner_of(warp, first, pair),
                       n = pair - warp.of(first, owner);
        if (pair < last) any |= book(begin + owner, w, n, sum);
      }
    }
    if (!warp.any(any)) return;
    for (int row = 0; row < kEnergyRows; row++) sum.of[row] = warp.sum(sum.of[row]);
    if (warp.rank() > 0) return;
    sums[begin / W::kSize].add(sum);
    is_booked[begin / W::kSize] = 1;
  }

 private:
  // Returns a bit for each pair of a word of a row that touches, now or a step ago.
  LSDCD_FN std::uint32_t word_of(const TouchingPairs &pairs, int w, std::size_t k) const
  {
    return pairs.words ? pairs.words[std::size_t(w) * s.list.rows + k] : 0;
  }
  LSDCD_FN std::uint32_t either(int w, std::size_t k) const
  {
    return word_of(s.now, w, k) | word_of(s.old, w, k);
  }
  // Returns what the pair of this bit keeps; null where it does not touch.
  LSDCD_FN PairNumbers<Real> numbers_of(const TouchingPairs &pairs, int w, std::size_t k,
                                        std::uint32_t bit) const
  {
    const std::uint32_t word = word_of(pairs, w, k);
    if (!(word & bit)) return {nullptr, 0};
    int before = count_bits(word & (bit - 1));
    for (int v = 0; v < w; v++) before += count_bits(word_of(pairs, v, k));
    return pairs.of(pairs.first[k] + std::size_t(s.step) * static_cast<std::size_t>(before));
  }

  // Books the n-th pair of a word that touches or did. Returns whether it is one of this law.
  LSDCD_FN bool book(std::size_t k, int w, unsigned n, EnergyRows &sum) const
  {
    std::uint32_t bits = either(w, k);
    for (; n > 0; n--) bits &= bits - 1;
    const unsigned place = lowest_bit(bits);
    const std::uint32_t bit = std::uint32_t(1) << place;
    return book(k, s.list.at(s.list.grain[k], kWordBits * w + static_cast<int>(place)),
                numbers_of(s.old, w, k, bit), numbers_of(s.now, w, k, bit), sum);
  }
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
                         [](const PairStepView &s, EnergyRows *sums, char *is_booked, B &b) {
                           b.for_each_in_warps(static_cast<std::size_t>(s.list.rows),
                                               BookPairs<Law>{s, sums, is_booked});
                         }};
  });
}

}    // namespace lsdcd
