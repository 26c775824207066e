// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Sums of what contacts do with energy over the slots of a step, by mesh, in fixed point (sum_unit.h).
#pragma once

#include "backend/atomic.h"
#include "backend/backend.h"
#include "engine/results/result_columns.h"
#include "engine/results/step_results.h"
#include "engine/results/sum_unit.h"

namespace lsdcd {

struct EnergyRange {
  std::uint64_t count;
  std::uint64_t exponent[kEnergyRows];

  LSDCD_FN SumUnit unit(int row) const { return SumUnit({count, exponent[row]}); }
};
struct EnergyUnits {
  std::int64_t of[kEnergyRows];
};

// Slots in blocks.
struct BookedSlots {
  std::size_t n;
  const EnergyRows *rows;
  const char *is_booked;
  const int *mesh;    // of each; null: there is one

  LSDCD_FN int mesh_of(std::size_t k) const { return mesh ? mesh[k] : 0; }
  // Calls see(k) for each booked slot of block `at`, and flush(mesh) behind those of a mesh that follow each other: what a thread
  // gathers of them goes to memory once, as threads wait for each other there.
  template <class See, class Flush>
  LSDCD_FN void for_each(std::size_t at, const See &see, const Flush &flush) const
  {
    int last = -1;
    for (std::size_t k = at * kTotalsBlock; k < (at + 1) * kTotalsBlock && k < n; k++) {
      if (!is_booked[k]) continue;
      if (last >= 0 && last != mesh_of(k)) flush(last);
      last = mesh_of(k);
      see(k);
    }
    if (last >= 0) flush(last);
  }
};

// Sees the ranges of a block; they are clear before.
struct SeeEnergy {
  BookedSlots in;
  EnergyRange *range;    // of each mesh

  LSDCD_FN void operator()(std::size_t at) const
  {
    EnergyRange seen = {};
    in.for_each(
        at,
        [&](std::size_t k) {
          seen.count++;
          for (int row = 0; row < kEnergyRows; row++) {
            const std::uint64_t exponent = exponent_field(in.rows[k].of[row]);
            if (exponent > seen.exponent[row]) seen.exponent[row] = exponent;
          }
        },
        [&](int mesh) {
          EnergyRange &of = range[mesh];
          add_signed(reinterpret_cast<std::int64_t *>(&of.count),
                     static_cast<std::int64_t>(seen.count));
          for (int row = 0; row < kEnergyRows; row++)
            if (seen.exponent[row] > 0) raise_to(&of.exponent[row], seen.exponent[row]);
          seen = {};
        });
  }
};
// Adds a block to the sums, which are 0 before.
struct SumEnergy {
  BookedSlots in;
  const EnergyRange *range;
  EnergyUnits *sums;    // of each mesh

  LSDCD_FN void operator()(std::size_t at) const
  {
    EnergyUnits added = {};
    in.for_each(
        at,
        [&](std::size_t k) {
          for (int row = 0; row < kEnergyRows; row++) {
            const SumUnit unit = range[in.mesh_of(k)].unit(row);
            const Real number = in.rows[k].of[row];
            if (number != 0 && unit.is_finite()) added.of[row] += unit.units(number);
          }
        },
        [&](int mesh) {
          for (int row = 0; row < kEnergyRows; row++)
            if (added.of[row] != 0) add_signed(&sums[mesh].of[row], added.of[row]);
          added = {};
        });
  }
};

inline EnergyRows energy_of(const EnergyUnits &sums, const EnergyRange &range)
{
  EnergyRows rows;
  for (int row = 0; row < kEnergyRows; row++) rows.of[row] = range.unit(row).value(sums.of[row]);
  return rows;
}

// Sums the booked slots of each mesh to the CPU.
template <class B>
class EnergySums {
 public:
  void sum(B &b, const BookedSlots &in, std::size_t n_meshes, EnergyRows *of_mesh)
  {
    ranges_.reserve(n_meshes);
    sums_.reserve(n_meshes);
    ranges_on_cpu_.reserve(n_meshes);
    sums_on_cpu_.reserve(n_meshes);
    EnergyRange *range = ranges_.data();
    EnergyUnits *sum = sums_.data();
    const std::size_t n_blocks = (in.n + kTotalsBlock - 1) / kTotalsBlock;
    b.for_each(n_meshes, [=] LSDCD_LAMBDA(std::size_t m) {
      range[m] = EnergyRange();
      sum[m] = EnergyUnits();
    });
    b.for_each(n_blocks, SeeEnergy{in, range});
    b.for_each(n_blocks, SumEnergy{in, range, sum});
    b.copy_out(range, ranges_on_cpu_.data(), n_meshes);
    b.copy_out(sum, sums_on_cpu_.data(), n_meshes);
    b.wait();
    for (std::size_t m = 0; m < n_meshes; m++)
      of_mesh[m] = energy_of(sums_on_cpu_.data()[m], ranges_on_cpu_.data()[m]);
  }

 private:
  typename B::template Array<EnergyRange> ranges_;
  typename B::template Array<EnergyUnits> sums_;
  typename B::template CpuArray<EnergyRange> ranges_on_cpu_;
  typename B::template CpuArray<EnergyUnits> sums_on_cpu_;
};

}    // namespace lsdcd
