// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "output/impact_spectrum.h"

#include "base/atomic_file.h"
#include "base/number_words.h"

#include <algorithm>

namespace lsdcd {

namespace {

const std::vector<Real> &begins()
{
  static const std::vector<Real> all = begins_of_bins();
  return all;
}

constexpr char kColumns[] = "energy_from,energy_to,impacts,energy";

std::string row_text(const ImpactSpectrum::Row &r)
{
  return exact_text(r.begins) + "," + exact_text(r.ends) + "," + exact_text(r.impacts) + "," +
         exact_text(r.energy);
}

}    // namespace

void ImpactSpectrum::add(Real energy)
{
  ImpactBins{bins_.data(), begins().data()}.add(energy);
}

void ImpactSpectrum::add(const EnergyRecords &records, std::uint32_t mesh)
{
  const ImpactBins to = {bins_.data(), begins().data()};
  for (int k = 0; k < records.n; k++)
    if (records.at[k].mesh == mesh && records.at[k].impact > 0) to.add(records.at[k].impact);
}

void ImpactSpectrum::add(const std::vector<ImpactBin> &bins)
{
  for (std::size_t k = 0; k < bins.size(); k++) {
    bins_[k].count += bins[k].count;
    bins_[k].high += bins[k].high;
    bins_[k].low += bins[k].low;
  }
}

std::vector<double> ImpactSpectrum::packed() const
{
  constexpr std::int64_t kLow = std::int64_t(1) << kLowBits;
  std::vector<double> numbers;
  for (const ImpactBin &b : bins_)
    for (const std::int64_t n : {b.count, b.high + b.low / kLow, b.low % kLow})
      numbers.push_back(static_cast<double>(n));
  return numbers;
}

void ImpactSpectrum::unpack(const std::vector<double> &numbers)
{
  for (std::size_t k = 0; numbers.size() == kPacked && k < bins_.size(); k++) {
    const double *n = numbers.data() + 3 * k;
    bins_[k] = {static_cast<std::int64_t>(n[0]), static_cast<std::int64_t>(n[1]),
                static_cast<std::int64_t>(n[2])};
  }
}

std::vector<ImpactSpectrum::Row> ImpactSpectrum::rows() const
{
  const auto has_any = [](const ImpactBin &b) { return b.count > 0; };
  const auto first = std::find_if(bins_.begin(), bins_.end(), has_any);
  const auto end = std::find_if(bins_.rbegin(), bins_.rend(), has_any).base();
  std::vector<Row> rows;
  for (auto b = first; b < end; ++b) {
    const std::size_t k = static_cast<std::size_t>(b - bins_.begin());
    rows.push_back(
        {begins()[k], begins()[k + 1], static_cast<Real>(b->count), b->energy(begins()[k])});
  }
  return rows;
}

Real ImpactSpectrum::impacts() const
{
  Real sum = 0;
  for (const Row &r : rows()) sum += r.impacts;
  return sum;
}

Real ImpactSpectrum::energy() const
{
  Real sum = 0;
  for (const Row &r : rows()) sum += r.energy;
  return sum;
}

void write_spectrum(const std::string &path, const ImpactSpectrum &spectrum)
{
  std::string text = std::string(kColumns) + "\n";
  for (const ImpactSpectrum::Row &r : spectrum.rows()) text += row_text(r) + "\n";
  write_whole_file(path, text);
}

void write_spectra(const std::string &path, const std::vector<TypesSpectrum> &spectra)
{
  std::string text = std::string("type_i,type_j,") + kColumns + ",energy_i,energy_j\n";
  for (const TypesSpectrum &of : spectra)
    for (const ImpactSpectrum::Row &r : of.spectrum.rows())
      text += std::to_string(of.type_i) + "," + std::to_string(of.type_j) + "," + row_text(r) +
              "," + exact_text(of.share_i * r.energy) + "," +
              exact_text((1 - of.share_i) * r.energy) + "\n";
  write_whole_file(path, text);
}

}    // namespace lsdcd
