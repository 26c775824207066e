// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The spectrum of impacts: their number and their energy, in bins of equal ratio. Sums are in fixed point, so that they have the
// same bits in any order, on any number of threads and of processes.
#pragma once

#include "backend/atomic.h"
#include "base/real.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace lsdcd {

// Bins begin at 10^(k/10) units of energy, from 10^-40 on. The first and the last bin include what is beyond them.
constexpr int kBinsPerDecade = 10, kFirstDecade = -40, kLastDecade = 40;
constexpr int kImpactBins = kBinsPerDecade * (kLastDecade - kFirstDecade);

// Returns where bin k begins (energy), which is the same number on all machines, to rounding.
inline Real begin_of_bin(int k)
{
  return std::pow(Real(10), static_cast<Real>(k + kFirstDecade * kBinsPerDecade) / kBinsPerDecade);
}
// Returns where each bin begins, and where the last one ends.
inline std::vector<Real> begins_of_bins()
{
  std::vector<Real> begins;
  for (int k = 0; k <= kImpactBins; k++) begins.push_back(begin_of_bin(k));
  return begins;
}

// Energies are whole multiples of 2^-kBinBits times the beginning of the bin. They are split in two parts, so that neither reaches
// 2^63 before there are 2^31 impacts.
constexpr int kLowBits = 30, kBinBits = 48;
struct ImpactBin {
  std::int64_t count, high, low;

  // Returns the energy of the bin's impacts. `begin`: where the bin begins (energy).
  Real energy(Real begin) const
  {
    return begin *
           std::ldexp(std::ldexp(static_cast<Real>(high), kLowBits) + static_cast<Real>(low),
                      -kBinBits);
  }
};

// The bins of one mesh.
struct ImpactBins {
  ImpactBin *bins;
  const Real *begins;    // as begins_of_bins() returns them

  // Adds an impact of this energy, which is above 0. Several threads may add at the same time.
  LSDCD_FN void add(Real energy) const
  {
    const Real guess = floor(kBinsPerDecade * (log10(energy) - kFirstDecade));
    int k = guess > 0 ? (guess < kImpactBins ? static_cast<int>(guess) : kImpactBins - 1) : 0;
    while (k > 0 && energy < begins[k]) k--;
    while (k < kImpactBins - 1 && energy >= begins[k + 1]) k++;
    constexpr Real kUnits = Real(std::int64_t(1) << kBinBits), kMost = 9e18;
    const Real units = fmin(energy / begins[k] * kUnits, kMost);
    const auto whole = static_cast<std::int64_t>(units);
    add_signed(&bins[k].count, 1);
    add_signed(&bins[k].high, whole >> kLowBits);
    add_signed(&bins[k].low, whole & ((std::int64_t(1) << kLowBits) - 1));
  }
};

}    // namespace lsdcd
