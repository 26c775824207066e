// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The files of a wall's meshes that a run writes at regular steps.
#pragma once

#include "output/file_series.h"
#include "wall/sums/energy_recorder.h"
#include "wall/sums/load_recorder.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

// A mesh, with its place in this step.
struct PosedMesh {
  const WeldedMesh *mesh;    // of the first process; elsewhere it may be null
  Pose pose;
};

// Only the first process writes. If a file cannot be written, it warns once a run, and the run continues, because it may be
// weeks old.
class WallFiles {
 public:
  // Host and settings must outlive this object. `pressure_unit`: a force per area of 1 in the host's unit of pressure.
  WallFiles(Host &host, const WallSpec &settings, Real pressure_unit);

  // Returns a number of steps: files are due only in its multiples. 0: there are no files.
  int every() const;

  // Continues the lists of files that an earlier run wrote.
  void continue_lists() { continues_ = true; }

  // Prepares for a run. Throws InputError on all processes if a file cannot be made, or would replace one that the wall reads,
  // so that the user is told now and not hours later. Collective.
  void begin_run(std::int64_t step);

  // Writes the files that are due in this step, at `time`. `loads`: null in a snapshot, which has no mesh_fields and no
  // spectrum. An average that was written begins again; one that could not be written continues to the next file. Collective.
  void write_due(std::int64_t step, double time, const std::vector<PosedMesh> &meshes,
                 LoadRecorder *loads, EnergyRecorder &energies);

 private:
  void check(int mesh, const char *keyword, const FileEvery &file, std::int64_t step);
  bool try_to_write(const std::string &lost, const std::function<void()> &write);
  void write_fields(int mesh, std::int64_t step, double time, const PosedMesh &now,
                    LoadRecorder &loads, EnergyRecorder &energies);

  Host &host_;
  const WallSpec &settings_;
  Real pressure_unit_;
  bool continues_ = false;
  bool warned_ = false;                                // in this run
  std::vector<std::unique_ptr<FileSeries>> series_;    // of mesh_fields; on the first process
};

}    // namespace lsdcd
