// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Loads and wear of a wall's meshes, added up over the steps on all processes.
#pragma once

#include "engine/loads/load_engine.h"
#include "host/host.h"
#include "output/mesh_loads.h"
#include "wall/spec/wall_spec.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

// Meshes are counted from 0. One without wear and without mesh_fields has no loads.
class LoadRecorder {
 public:
  // Both must outlive it. settings.wear.per_work is volume per work in the host's units.
  LoadRecorder(Host &host, const WallSpec &settings);

  // Takes what the last engine has added up, and from now on that of this one; null: it adds up nothing. The last one must still be there.
  void set_engine(LoadEngine *engine);

  // A step of duration `dt` (time): what contacts of this process did to all meshes. `features`: of
  // the mesh with its periodic images; empty where there are no contacts.
  void add(int mesh, const std::vector<StepContact> &contacts, Real dt,
           const MeshFeaturesView &features);

  // Volume (length^3) worn off the mesh so far, on all processes. Collective.
  Real worn(int mesh);

  // Loads of all processes, on the first one; elsewhere only their time. Collective.
  MeshLoads gathered(int mesh);

  // The average begins again; what has worn off stays.
  void begin_average(int mesh);

  // Restores data of a saved state, before the first step: the time of the average and rows as of
  // MeshLoads::packed(), the same on all processes. The first one keeps the rows.
  void restore(int mesh, Real time, const std::vector<double> &rows);

  std::size_t bytes() const;    // of this process

 private:
  Real wear_per_work(int mesh) const;
  MeshLoads &taken(int mesh);

  Host &host_;
  const WallSpec &settings_;
  LoadEngine *engine_ = nullptr;
  std::vector<MeshLoads> loads_;    // of this process; one per mesh
};

}    // namespace lsdcd
