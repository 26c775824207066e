// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/sums/energy_recorder.h"

namespace lsdcd {

EnergyRecorder::EnergyRecorder(Host &host, const WallSpec &settings) :
    host_(host), settings_(settings),
    meshes_(settings.records_energy() ? settings.meshes.size() : 0)
{
}

// Returns the numbers with what the engine has added up since the last time.
EnergyRecorder::OfMesh &EnergyRecorder::taken(int mesh)
{
  OfMesh &m = meshes_[static_cast<std::size_t>(mesh)];
  if (!engine_) return m;
  static_assert(EnergyEngine::kRow == EnergyPlaces::kPacked);
  m.places.add_packed(engine_->take(mesh));
  m.spectrum.add(engine_->take_bins(mesh));
  return m;
}

void EnergyRecorder::set_engine(EnergyEngine *engine)
{
  for (int mesh = 0; mesh < static_cast<int>(meshes_.size()); mesh++) taken(mesh);
  engine_ = engine;
}

void EnergyRecorder::add(int mesh, const EnergyRecords &records, const MeshFeaturesView &features)
{
  OfMesh &m = meshes_[static_cast<std::size_t>(mesh)];
  const auto number = static_cast<std::uint32_t>(mesh);
  if (settings_.has_energy_places(settings_.meshes[static_cast<std::size_t>(mesh)]))
    m.places.add(records, features, number);
  if (settings_.impact_speed > 0) m.spectrum.add(records, number);
}

ImpactSpectrum EnergyRecorder::spectrum(int mesh)
{
  if (meshes_.empty()) return {};
  std::vector<double> numbers = taken(mesh).spectrum.packed();
  host_.sum(numbers.data(), static_cast<int>(numbers.size()));
  ImpactSpectrum all;
  all.unpack(numbers);
  return all;
}

EnergyPlaces EnergyRecorder::gathered(int mesh)
{
  EnergyPlaces all;
  if (meshes_.empty()) return all;
  all.add_packed(host_.gather(taken(mesh).places.packed()));
  return all;
}

void EnergyRecorder::restore(int mesh, const std::vector<double> &places,
                             const std::vector<double> &spectrum)
{
  if (meshes_.empty()) return;
  OfMesh &m = taken(mesh);
  m = OfMesh();
  if (!host_.is_first()) return;
  m.places.add_packed(places);
  m.spectrum.unpack(spectrum);
}

std::size_t EnergyRecorder::bytes() const
{
  std::size_t bytes = 0;
  for (const OfMesh &m : meshes_) bytes += m.places.bytes() + kImpactBins * sizeof(ImpactBin);
  return bytes;
}

}    // namespace lsdcd
