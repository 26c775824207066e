// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What becomes of energy at the triangles of a wall's meshes, and the spectra of impacts on them, on all processes, since the
// beginning.
#pragma once

#include "engine/loads/energy_engine.h"
#include "host/host.h"
#include "output/energy_places.h"
#include "output/impact_spectrum.h"
#include "wall/spec/wall_spec.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

// Meshes are counted from 0.
class EnergyRecorder {
 public:
  // Both must outlive it.
  EnergyRecorder(Host &host, const WallSpec &settings);

  // Takes what the last engine has added up, and from now on that of this one; null: it adds up nothing. The last one must still be there.
  void set_engine(EnergyEngine *engine);

  // Adds a step: the records of this process on a mesh, of an engine that adds up nothing, or `counts` for one that does. `features`:
  // of the mesh with its periodic images; empty where there are no records.
  void add(int mesh, const EnergyRecords &records, const MeshFeaturesView &features);
  void add(int mesh, const FeatureCounts &counts) { engine_->add(mesh, counts); }

  // Returns the spectrum of all processes. Collective.
  ImpactSpectrum spectrum(int mesh);
  // Returns what becomes of energy on all processes, on the first one. Collective.
  EnergyPlaces gathered(int mesh);

  // Restores data of a saved state, before the first step, the same on all processes: EnergyPlaces::packed() and
  // ImpactSpectrum::packed(). The first one keeps them.
  void restore(int mesh, const std::vector<double> &places, const std::vector<double> &spectrum);

  std::size_t bytes() const;    // of this process

 private:
  struct OfMesh {
    EnergyPlaces places;
    ImpactSpectrum spectrum;
  };
  OfMesh &taken(int mesh);

  Host &host_;
  const WallSpec &settings_;
  EnergyEngine *engine_ = nullptr;
  std::vector<OfMesh> meshes_;    // of this process; none where nothing is recorded
};

}    // namespace lsdcd
