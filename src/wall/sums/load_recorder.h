// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Loads and wear of a wall's meshes, added up over the steps on all processes.
#pragma once

#include "engine/loads/load.h"
#include "wall/spec/wall_spec.h"
#include "wall/sums/mesh_recorder.h"

#include <vector>

namespace lsdcd {

// A mesh without wear and without mesh_fields has no loads.
class LoadRecorder : public MeshRecorder<Load> {
 public:
  // Both arguments must outlive this object. settings.wear.per_work is volume per work in the host's units.
  LoadRecorder(Host &host, const WallSpec &settings);

  // Adds a step of duration `dt` (time). `contacts`: of all meshes on this process, which are read where no engine adds up loads; null:
  // the step left nothing.
  void add(const RecordedMesh &mesh, const std::vector<StepContact> *contacts, Real dt);

  // Returns the time of the average.
  Real time(int mesh) const { return times_[static_cast<std::size_t>(mesh)]; }
  // Returns the volume (length^3) worn off the mesh so far, on all processes. Collective.
  Real worn(int mesh);

  // Begins the average again; what has worn off stays.
  void begin_average(int mesh);

  void restore(int mesh, Real time, const std::vector<double> &packed);

 private:
  Real wear_per_work(int mesh) const;
  Load from_engine(int mesh, const Load &load) const override;

  const WallSpec &settings_;
  std::vector<Real> times_;    // of each mesh
};

}    // namespace lsdcd
