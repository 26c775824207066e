// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Kernels that copy what the pairs of a list keep to grains and partners, and back.
#pragma once

#include "pair/step_on.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

// Calls f(j) for the pairs of a row that touch, in order.
template <class F>
LSDCD_FN void for_touching(const PairRows &list, int words, const std::uint32_t *touching,
                           std::size_t k, const F &f)
{
  const int i = list.grain[k];
  for (int w = 0; w < words; w++)
    for (std::uint32_t bits = touching[std::size_t(w) * list.rows + k]; bits != 0; bits &= bits - 1)
      f(list.at(i, kWordBits * w + static_cast<int>(lowest_bit(bits))) & list.mask);
}

// The kinds of laws: a kind says which numbers a law keeps, and which of these change sign (ContactLaw).
struct KindsOfLaws {
  const int *law_of;
  int n_types;
  const std::uint32_t *flips;
  const int *kind;

  LSDCD_FN int law(const int *type, int i, int j) const
  {
    return law_of[type[i] * n_types + type[j]];
  }
};

// The rows of partners.
struct PartnerRows {
  PartnerForm form;
  Real *numbers;

  LSDCD_FN int size() const { return form.row_size(); }
  LSDCD_FN Real *row(std::size_t place) const { return numbers + place * size(); }
  LSDCD_FN void write(std::size_t place, double *to) const
  {
    for (int k = 0; k < size(); k++) to[k] = row(place)[k];
  }
  LSDCD_FN void read(std::size_t place, const double *from) const
  {
    for (int k = 0; k < size(); k++) row(place)[k] = from[k];
  }
};

// The partners of the first n grains, while kernels write them.
struct PartnersView {
  int n;
  int *first, *count;
  PartnerRows rows;
};

struct CountPartners {
  PairRows list;
  int words;
  const std::uint32_t *touching;
  PartnersView to;

  LSDCD_FN void operator()(std::size_t k) const
  {
    int own = 0;
    for_touching(list, words, touching, k, [&](int j) {
      own++;
      if (!list.full && j < to.n) fetch_add(to.count + j, 1);
    });
    const int i = list.grain[k];
    if (i < to.n && own > 0) fetch_add(to.count + i, own);
  }
};

struct FillPartners {
  PairRows list;
  int words;
  TouchingPairs from;
  ListedGrains grains;
  KindsOfLaws laws;
  unsigned step;    // see kGpuPairStep
  PartnersView to;

  LSDCD_FN void operator()(std::size_t k) const
  {
    const int i = list.grain[k];
    std::size_t pair = static_cast<std::size_t>(from.first[k]);
    for_touching(list, words, from.words, k, [&](int j) {
      if (i < to.n) put(i, j, from.of(pair), 0);
      if (!list.full && j < to.n) put(j, i, from.of(pair), laws.flips[laws.law(grains.type, i, j)]);
      pair += step;
    });
  }

 private:
  LSDCD_FN void put(int i, int partner, const PairNumbers<Real> &numbers, std::uint32_t flip) const
  {
    const std::size_t at = std::size_t(to.first[i]) + fetch_add(to.count + i, 1);
    const PartnerForm &form = to.rows.form;
    Real *put = to.rows.row(at);
    *put++ = static_cast<Real>(grains.name[partner]);
    for (int n = 0; n < form.width; n++) put[n] = flip >> n & 1 ? -numbers[n] : numbers[n];
    if (form.by_law) put[form.width] = laws.kind[laws.law(grains.type, i, partner)];
    if (!form.by_image) return;
    const Vec3 offset = grains.x[i] - grains.x[partner];
    for (int n = 0; n < 3; n++) put[form.image_at() + n] = offset[n];
  }
};

// Clears the first of_law numbers of touching pairs whose law is of another kind than it was with the types `was`.
struct ClearOfOtherLaws {
  PairRows list;
  int words;
  TouchingPairs pairs;
  KindsOfLaws laws;
  const int *was, *type;
  int of_law;
  unsigned step;    // see kGpuPairStep
  int *cleared;     // becomes 1 if one of them was not 0

  LSDCD_FN void operator()(std::size_t k) const
  {
    const int i = list.grain[k];
    std::size_t pair = static_cast<std::size_t>(pairs.first[k]);
    for_touching(list, words, pairs.words, k, [&](int j) {
      if (laws.kind[laws.law(was, i, j)] != laws.kind[laws.law(type, i, j)])
        clear(pairs.of(pair), of_law, cleared);
      pair += step;
    });
  }

  LSDCD_FN static void clear(const PairNumbers<Real> &numbers, int n, int *cleared)
  {
    for (int k = 0; k < n; k++) {
      if (numbers[k] != 0) set_flag(cleared);
      numbers[k] = 0;
    }
  }
};

// Numbers of places for what pairs of a list keep: those that are taken, and those that would be if all pairs touched.
struct PlaceCounts {
  std::uint64_t most;
  std::uint32_t taken;
};

// Reserves places for as many pairs of a row as its grain has partners.
struct TakePlaces {
  PairRows list;
  const int *count;    // of partners
  PlaceCounts *places;
  int *first;

  template <class W>
  LSDCD_FN void operator()(const W &warp, bool mine, std::size_t k) const
  {
    const int i = mine ? list.grain[k] : 0;
    take_places(warp, mine, k, mine ? static_cast<unsigned>(count[i]) : 0, &places->taken, first);
    const unsigned most =
        places_side_by_side(warp, mine ? static_cast<unsigned>(list.length[i]) : 0);
    if (warp.rank() % kSide<W> == 0) add_to(&places->most, most);
  }
};

// Transfers what partners have to the pairs of a new list; see Partners::hand_out().
struct HandOut {
  PairRows list;
  int words;
  TouchingPairs to;
  ListedGrains grains;
  KindsOfLaws laws;
  int of_law;
  unsigned step;    // see kGpuPairStep
  PartnersView from;
  int *cleared;    // becomes 1 if a number was not 0

  LSDCD_FN void operator()(std::size_t k) const
  {
    const int i = list.grain[k], n = list.length[i], count = from.count[i];
    const Real *const all = from.rows.row(static_cast<std::size_t>(from.first[i]));
    const PartnerForm &form = from.rows.form;
    const bool has_images =
        form.by_image && grains.near > 0;    // x is null in a box that has become wider
    std::size_t pair = static_cast<std::size_t>(to.first[k]);
    int left = count;
    for (int w = 0; w < words; w++) {
      std::uint32_t bits = 0;
      for (int bit = 0; bit < kWordBits && kWordBits * w + bit < n && left > 0; bit++) {
        const int j = list.at(i, kWordBits * w + bit) & list.mask;
        const Real other = static_cast<Real>(grains.name[j]), *kept = all;
        int p = 0;
        while (p < count && !(kept[0] == other && (!has_images || is_image(kept + 1, i, j)))) {
          p++;
          kept += from.rows.size();
        }
        if (p == count) continue;
        bits |= std::uint32_t(1) << bit;
        kept++;
        for (int m = 0; m < form.width; m++) to.of(pair)[m] = kept[m];
        if (form.by_law && !form.is_of_law(kept, laws.kind[laws.law(grains.type, i, j)]))
          ClearOfOtherLaws::clear(to.of(pair), of_law, cleared);
        pair += step;
        left--;
      }
      to.words[std::size_t(w) * list.rows + k] = bits;
    }
  }

 private:
  LSDCD_FN bool is_image(const Real *kept, int i, int j) const
  {
    return from.rows.form.is_image(kept, grains.x[i] - grains.x[j], grains.near);
  }
};

}    // namespace lsdcd
