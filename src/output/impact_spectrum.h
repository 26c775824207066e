// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The spectrum of the impacts on a mesh, or between grains of two types, since the beginning, and its file.
#pragma once

#include "engine/results/impact_bins.h"
#include "engine/results/step_results.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lsdcd {

class ImpactSpectrum {
 public:
  ImpactSpectrum() : bins_(kImpactBins) {}

  void add(Real energy);    // of one impact
  // Adds the records of a step that are of this mesh.
  void add(const EnergyRecords &records, std::uint32_t mesh);
  // Adds kImpactBins bins, or none.
  void add(const std::vector<ImpactBin> &bins);

  // Returns kPacked whole numbers, three of each bin: sums of these over processes are exact. unpack() takes them.
  static constexpr std::size_t kPacked = 3 * kImpactBins;
  std::vector<double> packed() const;
  void unpack(const std::vector<double> &numbers);

  // Rows are the bins from the first to the last one that has impacts; none where there were none.
  struct Row {
    Real begins, ends;    // energy of an impact
    Real impacts, energy;
  };
  std::vector<Row> rows() const;
  Real impacts() const;
  Real energy() const;

 private:
  std::vector<ImpactBin> bins_;
};

// Writes the rows as CSV with a line of names, in a file that appears whole or not at all. Throws InputError that names it.
void write_spectrum(const std::string &path, const ImpactSpectrum &spectrum);

// The spectrum of the impacts between grains of two types, and the share of their energy that those of the first type take.
struct TypesSpectrum {
  int type_i, type_j;
  Real share_i;
  ImpactSpectrum spectrum;
};
// Writes the rows of each pair of types as write_spectrum() does.
void write_spectra(const std::string &path, const std::vector<TypesSpectrum> &spectra);

}    // namespace lsdcd
