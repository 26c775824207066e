// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What becomes of energy at the triangles of a wall's meshes, and the spectra of impacts on them, on all processes, since the
// beginning.
#pragma once

#include "engine/loads/energy_engine.h"
#include "output/impact_spectrum.h"
#include "wall/spec/wall_spec.h"
#include "wall/sums/mesh_recorder.h"

#include <vector>

namespace lsdcd {

class EnergyRecorder : public MeshRecorder<PlaceEnergy> {
 public:
  // Both arguments must outlive this object.
  EnergyRecorder(Host &host, const WallSpec &settings);

  void set_engine(EnergyEngine *engine);

  // Adds a step of duration `dt` (time). `records`: of all meshes on this process, which are read where no engine adds them up; null: the
  // step left nothing. `of_coats`: the same on all processes.
  void add(const RecordedMesh &mesh, const EnergyRecords *records, const EnergyRecords &of_coats,
           Real dt);

  // Returns the spectrum of all processes. Collective.
  ImpactSpectrum spectrum(int mesh);

  // Restores data of a saved state, as MeshRecorder does, and that of ImpactSpectrum::packed().
  void restore(int mesh, const std::vector<double> &packed, const std::vector<double> &spectrum);

  std::size_t bytes() const;    // of this process

 private:
  void add_here(const RecordedMesh &mesh, const EnergyRecords &records);
  ImpactSpectrum &taken_spectrum(int mesh);

  const WallSpec &settings_;
  EnergyEngine *bins_ = nullptr;           // the engine, for its bins
  std::vector<ImpactSpectrum> spectra_;    // of this process; none where nothing is recorded
};

}    // namespace lsdcd
