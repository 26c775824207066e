// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/engine_input.h"

#include <cstddef>

namespace lsdcd {

EngineSettings EngineInput::settings(Device device, bool virial, bool pushed) const
{
  EngineSettings want;
  want.laws = laws_;
  want.corner = wall_.corner;
  want.side = wall_.side;
  want.meshes = static_cast<int>(meshes_.size());
  want.moves = meshes_.size() > 1;
  for (const MeshPart &m : meshes_) {
    want.moves |= m.nodes() || m.mover.moves_or_varies();
    want.nodes |= m.nodes() != nullptr;
    if (!want.surface.moves()) want.surface = m.spec.surface;
  }
  want.contacts = wall_.has_loads() || wall_.each_contact || virial;
  want.bodies = pushed;
  want.wear = wall_.wear.model;
  want.device = device;
  want.device_rank = host_.ranks().node_rank;
  want.names = host_.names();
  return want;
}

StepSettings EngineInput::step(const StepInput &input, const StepAsks &asks)
{
  StepSettings step;
  step.number = input.step.number;
  step.dt = input.step.dt;
  step.update_history = input.step.kind == Step::step;
  step.synchronous = input.step.synchronous;
  step.per_sphere = wall_.contacts || wall_.each_contact || asks.contacts;
  step.contacts = wall_.has_loads() || wall_.each_contact || input.virial || asks.contacts;
  step.totals = asks.totals || wall_.average_every > 0;
  const bool several = meshes_.size() > 1;
  if (several || wall_.meshes.front().surface_varies()) {
    surfaces_.clear();
    for (const MeshPart &m : meshes_) surfaces_.push_back(m.mover.surface_motion());
    step.surface = surfaces_.data();
  }
  if (asks.pushed) {
    mobilities_.clear();
    for (const MeshPart &m : meshes_) mobilities_.push_back(m.mobility());
    step.mobility = mobilities_.data();
  }
  if (!wall_.law().has_heat()) return step;
  temperatures_.clear();
  for (const MeshSpec &m : wall_.meshes)
    temperatures_.push_back(m.temperature_input == kNoInput
                                ? m.temperature
                                : input.inputs.at(static_cast<std::size_t>(m.temperature_input)));
  step.wall_temperature = temperatures_.front();
  if (several) step.mesh_temperature = temperatures_.data();
  return step;
}

}    // namespace lsdcd
