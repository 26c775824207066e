// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Sums over the candidates of a step, in fixed point (sum_unit.h). No bit of them depends on the order of candidates, or on which
// other spheres are candidates. So what follows from the loads, a servo or a body, moves in the same way whenever candidates are
// searched for.
#pragma once

#include "backend/atomic.h"
#include "backend/warp.h"
#include "engine/results/result_columns.h"
#include "engine/results/sum_unit.h"

namespace lsdcd {

// The numbers of a result that are summed: energy, and force and torque on the mesh.
constexpr int kSummands = 7;

// The range of the results of a part of the candidates: of one mesh, or of all.
struct TotalsRange {
  std::int64_t count;                   // number of candidates that touch
  std::uint64_t exponent[kSummands];    // the largest exponent_field() of each number

  LSDCD_FN SumUnit unit(int number) const
  {
    return SumUnit({static_cast<std::uint64_t>(count), exponent[number]});
  }
};

struct UnitTotals {
  std::int64_t units[kSummands];
  std::int64_t contacts, uncertified;
  Real largest_uncertain, largest_overlap_ratio;
  int largest_overlap_sphere;    // -1: none
  int pad;                       // keeps the struct free of indeterminate bytes

  LSDCD_FN void add(const UnitTotals &t)
  {
    for (int j = 0; j < kSummands; j++) units[j] += t.units[j];
    contacts += t.contacts;
    uncertified += t.uncertified;
    largest_uncertain = fmax(largest_uncertain, t.largest_uncertain);
    raise_overlap(t.largest_overlap_ratio, t.largest_overlap_sphere);
  }
  LSDCD_FN void raise_overlap(Real ratio, int sphere)
  {
    if (!(ratio > largest_overlap_ratio)) return;
    largest_overlap_ratio = ratio;
    largest_overlap_sphere = sphere;
  }
};
LSDCD_FN UnitTotals no_totals()
{
  UnitTotals none = {};
  none.largest_overlap_sphere = -1;
  return none;
}

// Candidates in parts. Each part has blocks of all candidates.
struct TotalsParts {
  ResultColumns result;
  std::size_t n, n_blocks;
  const int *candidates;
  const int *mesh;          // of each candidate; null: there is one part
  const Real *uncertain;    // of each candidate, or null

  LSDCD_FN int part(std::size_t at) const { return static_cast<int>(at / n_blocks); }
  // Calls f(candidate) for those candidates of block `at`, counted over all parts, that belong to its part.
  template <class F>
  LSDCD_FN void for_each(std::size_t at, const F &f) const
  {
    const std::size_t begin = at % n_blocks * kTotalsBlock;
    for (std::size_t k = begin; k < begin + kTotalsBlock && k < n; k++)
      if (!mesh || mesh[k] == part(at)) f(k);
  }
  LSDCD_FN void summands(std::size_t k, Real (&of)[kSummands]) const
  {
    const Vec3 force = result.force[k], moment = result.moment[k];
    of[0] = result.energy[k];
    for (int d = 0; d < 3; d++) {
      of[1 + d] = -force[d];
      of[4 + d] = -moment[d];
    }
  }
};

// Finds the range of a block. The ranges must be clear before.
struct SeeTotals {
  TotalsParts in;
  TotalsRange *range;    // of each part

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t at) const
  {
    std::int64_t count[1] = {0};
    std::uint64_t most[kSummands] =
        {};    // without the sign, so that a value that is not a number is the largest
    if (mine)
      in.for_each(at, [&](std::size_t k) {
        if (in.result.n_contacts[k] == 0) return;
        count[0]++;
        Real number[kSummands];
        in.summands(k, number);
        for (int j = 0; j < kSummands; j++) {
          const std::uint64_t size = bits_of(number[j]) << 1;
          if (size > most[j]) most[j] = size;
        }
      });
    const bool has = count[0] > 0;
    const int part = mine ? in.part(at) : 0;
    if (has)
      for (int j = 0; j < kSummands; j++)
        raise_to(&range[part].exponent[j], most[j] >> (kExponentAt + 1));
    // Only few threads add to the same number at the same time.
    if (warp.sum_by_key(has, part, count)) add_signed(&range[part].count, count[0]);
  }
};

// Stores the sums of a block.
struct SumTotals {
  TotalsParts in;
  const TotalsRange *range;
  UnitTotals *sums;

  LSDCD_FN void operator()(std::size_t at) const
  {
    UnitTotals t = no_totals();
    const TotalsRange &of_part = range[in.part(at)];
    in.for_each(at, [&](std::size_t k) {
      if (in.uncertain && in.uncertain[k] > 0) {
        t.uncertified++;
        t.largest_uncertain = fmax(t.largest_uncertain, in.uncertain[k]);
      }
      if (in.result.n_contacts[k] == 0) return;
      Real number[kSummands];
      in.summands(k, number);
      for (int j = 0; j < kSummands; j++) {
        const SumUnit unit = of_part.unit(j);
        if (unit.is_finite()) t.units[j] += unit.units(number[j]);
      }
      t.contacts += in.result.n_contacts[k];
      t.raise_overlap(in.result.overlap_ratio[k], in.candidates[k]);
    });
    sums[at] = t;
  }
};

// Stores the sums of a group of blocks.
struct SumTotalsOfBlocks {
  const UnitTotals *block;
  std::size_t n_blocks, n_groups;
  UnitTotals *sums;

  LSDCD_FN void operator()(std::size_t at) const
  {
    const UnitTotals *const blocks = block + at / n_groups * n_blocks;
    const std::size_t begin = at % n_groups * kTotalsBlock;
    UnitTotals t = no_totals();
    for (std::size_t k = begin; k < begin + kTotalsBlock && k < n_blocks; k++) t.add(blocks[k]);
    sums[at] = t;
  }
};

inline WallTotals totals_of(const UnitTotals &t, const TotalsRange &range)
{
  Real number[kSummands];
  for (int j = 0; j < kSummands; j++) number[j] = range.unit(j).value(t.units[j]);
  WallTotals totals;
  totals.energy = number[0];
  totals.force = {number[1], number[2], number[3]};
  totals.torque = {number[4], number[5], number[6]};
  totals.contacts = t.contacts;
  totals.uncertified = t.uncertified;
  totals.largest_uncertain = t.largest_uncertain;
  totals.largest_overlap_ratio = t.largest_overlap_ratio;
  totals.largest_overlap_sphere = t.largest_overlap_sphere;
  return totals;
}

}    // namespace lsdcd
