// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Sums the energy balance over the candidate-mesh pairs of a step, by mesh, in fixed point (sum_unit.h).
#pragma once

#include "backend/atomic.h"
#include "backend/backend.h"
#include "backend/warp.h"
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

// Candidate-mesh pairs in blocks. On a GPU each thread has one pair, and its warp adds up before it writes to memory; on a CPU a
// thread writes once for a block.
struct BookedSlots {
  std::size_t n;
  const EnergyRows *rows;
  const char *is_booked;
  const int *mesh;    // of each candidate-mesh pair; null: there is one mesh

  template <class B>
  static constexpr std::size_t kBlock = B::kOnCpu ? kTotalsBlock : 1;
  template <class B>
  std::size_t n_blocks() const
  {
    return (n + kBlock<B> - 1) / kBlock<B>;
  }

  LSDCD_FN int mesh_of(std::size_t k) const { return mesh ? mesh[k] : 0; }
  // Calls see(k) for each recorded candidate-mesh pair of block `at`, and flush(mesh) after the pairs of a mesh if pairs of another
  // mesh follow in this block. Returns the last mesh, whose pairs are still to be flushed; -1: no pair is recorded.
  template <class B, class See, class Flush>
  LSDCD_FN int for_each(std::size_t at, const See &see, const Flush &flush) const
  {
    int last = -1;
    for (std::size_t k = at * kBlock<B>; k < (at + 1) * kBlock<B> && k < n; k++) {
      if (!is_booked[k]) continue;
      if (last >= 0 && last != mesh_of(k)) flush(last);
      last = mesh_of(k);
      see(k);
    }
    return last;
  }
};

// Finds the ranges of a block; they must be clear before.
template <class B>
struct SeeEnergy {
  BookedSlots in;
  EnergyRange *range;    // of each mesh

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t at) const
  {
    std::int64_t count[1] = {0};
    std::uint64_t most[kEnergyRows] = {};
    const auto raise = [&](int mesh) {
      for (int row = 0; row < kEnergyRows; row++) {
        if (most[row] > 0) raise_to(&range[mesh].exponent[row], most[row]);
        most[row] = 0;
      }
    };
    const auto add = [&](int mesh) {
      add_signed(reinterpret_cast<std::int64_t *>(&range[mesh].count), count[0]);
      count[0] = 0;
    };
    int last = -1;
    if (mine)
      last = in.template for_each<B>(
          at,
          [&](std::size_t k) {
            count[0]++;
            for (int row = 0; row < kEnergyRows; row++) {
              const std::uint64_t exponent = exponent_field(in.rows[k].of[row]);
              if (exponent > most[row]) most[row] = exponent;
            }
          },
          [&](int mesh) {
            raise(mesh);
            add(mesh);
          });
    if (last >= 0) raise(last);
    if (warp.sum_by_key(last >= 0, last, count)) add(last);
  }
};
// Adds a block to the sums, which must be 0 before.
template <class B>
struct SumEnergy {
  BookedSlots in;
  const EnergyRange *range;
  EnergyUnits *sums;    // of each mesh

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t at) const
  {
    EnergyUnits added = {};
    const auto flush = [&](int mesh) {
      for (int row = 0; row < kEnergyRows; row++)
        if (added.of[row] != 0) add_signed(&sums[mesh].of[row], added.of[row]);
      added = {};
    };
    int last = -1;
    if (mine)
      last = in.template for_each<B>(
          at,
          [&](std::size_t k) {
            for (int row = 0; row < kEnergyRows; row++) {
              const SumUnit unit = range[in.mesh_of(k)].unit(row);
              const Real number = in.rows[k].of[row];
              if (number != 0 && unit.is_finite()) added.of[row] += unit.units(number);
            }
          },
          flush);
    if (warp.sum_by_key(last >= 0, last, added.of)) flush(last);
  }
};

inline EnergyRows energy_of(const EnergyUnits &sums, const EnergyRange &range)
{
  EnergyRows rows;
  for (int row = 0; row < kEnergyRows; row++) rows.of[row] = range.unit(row).value(sums.of[row]);
  return rows;
}

// Sums the recorded candidate-mesh pairs of each mesh, and copies the sums to the CPU.
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
    const std::size_t n_blocks = in.n_blocks<B>();
    b.for_each(n_meshes, [=] LSDCD_LAMBDA(std::size_t m) {
      range[m] = EnergyRange();
      sum[m] = EnergyUnits();
    });
    b.for_each_in_warps(n_blocks, SeeEnergy<B>{in, range});
    b.for_each_in_warps(n_blocks, SumEnergy<B>{in, range, sum});
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
