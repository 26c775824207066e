// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a wall asks of its engine: the settings at its creation, and the settings of each step.
#pragma once

#include "wall/part/mesh_part.h"
#include "wall/step_input.h"

#include <deque>
#include <vector>

namespace lsdcd {

// What the meshes of a wall need from a step.
struct StepAsks {
  bool pushed;      // mobilities, because one of the meshes is a body
  bool contacts;    // the contacts themselves
  bool loads;       // the contacts, for loads of features
  bool totals;      // sums, for the next step
};

class EngineInput {
 public:
  // Host, wall and laws must outlive this object.
  EngineInput(const Host &host, const WallSpec &wall, const LawTable &laws,
              const std::deque<MeshPart> &meshes, Real velocity_unit);

  // Returns the settings of an engine on this device. `virial`: contacts will be asked for. `pushed`: a mesh is, or was, moved by its
  // loads.
  EngineSettings settings(Device device, bool virial, bool pushed) const;
  // Returns the settings of a step, which are valid until the next call.
  StepSettings step(const StepInput &input, const StepAsks &asks);

 private:
  const Host &host_;
  const WallSpec &wall_;
  const LawTable &laws_;
  const std::deque<MeshPart> &meshes_;
  Real velocity_unit_;    // see EngineSettings
  StepSettings of_all_steps_;
  bool has_surfaces_ = false, has_heat_ = false;    // of meshes; steps ask for these
  // The values of each mesh in this step.
  std::vector<SurfaceMotion> surfaces_;
  std::vector<Real> temperatures_;
  std::vector<Mobility> mobilities_;
};

}    // namespace lsdcd
