// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/sums/energy_recorder.h"

namespace lsdcd {

EnergyRecorder::EnergyRecorder(Host &host, const WallSpec &settings) :
    MeshRecorder(host, settings.meshes.size()), settings_(settings),
    spectra_(settings.records_energy() ? settings.meshes.size() : 0)
{
}

void EnergyRecorder::set_engine(EnergyEngine *engine)
{
  for (std::size_t mesh = 0; mesh < spectra_.size(); mesh++) taken_spectrum(static_cast<int>(mesh));
  MeshRecorder::set_engine(engine);
  bins_ = engine;
}

void EnergyRecorder::add(const RecordedMesh &mesh, const EnergyRecords *records,
                         const EnergyRecords &of_coats, Real dt)
{
  if (records && engine())
    engine()->add(mesh.index, mesh.counts, dt);
  else if (records)
    add_here(mesh, *records);
  if (host_.is_first()) add_here(mesh, of_coats);
}

void EnergyRecorder::add_here(const RecordedMesh &mesh, const EnergyRecords &records)
{
  const std::size_t k = static_cast<std::size_t>(mesh.index);
  const auto number = static_cast<std::uint32_t>(mesh.index);
  if (settings_.has_energy_places(settings_.meshes[k]))
    rows(mesh.index).add(records.at, records.n, PlaceEnergyOf(), mesh.features, number);
  if (settings_.impact_speed > 0) spectra_[k].add(records, number);
}

// Returns the spectrum with what the engine has added up since the last time.
ImpactSpectrum &EnergyRecorder::taken_spectrum(int mesh)
{
  ImpactSpectrum &spectrum = spectra_[static_cast<std::size_t>(mesh)];
  if (bins_) spectrum.add(bins_->take_bins(mesh));
  return spectrum;
}

ImpactSpectrum EnergyRecorder::spectrum(int mesh)
{
  if (spectra_.empty()) return {};
  std::vector<double> numbers = taken_spectrum(mesh).packed();
  host_.sum(numbers.data(), static_cast<int>(numbers.size()));
  ImpactSpectrum all;
  all.unpack(numbers);
  return all;
}

void EnergyRecorder::restore(int mesh, const std::vector<double> &packed,
                             const std::vector<double> &spectrum)
{
  MeshRecorder::restore(mesh, packed);
  if (spectra_.empty()) return;
  ImpactSpectrum &to = taken_spectrum(mesh);
  to = ImpactSpectrum();
  if (host_.is_first()) to.unpack(spectrum);
}

std::size_t EnergyRecorder::bytes() const
{
  return MeshRecorder::bytes() + spectra_.size() * kImpactBins * sizeof(ImpactBin);
}

}    // namespace lsdcd
