// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/engine_input.h"

#include <cstddef>

namespace lsdcd {

EngineInput::EngineInput(const Host &host, const WallSpec &wall, const LawTable &laws,
                         const std::deque<MeshPart> &meshes, Real velocity_unit) :
    host_(host),
    wall_(wall), laws_(laws), meshes_(meshes), velocity_unit_(velocity_unit),
    has_surfaces_(wall.meshes.size() > 1 || wall.meshes.front().surface_varies()),
    has_heat_(wall.law().has_heat())
{
  of_all_steps_.per_sphere = wall.contacts || wall.each_contact;
  of_all_steps_.contacts = wall.each_contact;
  of_all_steps_.totals = wall.average_every > 0;
}

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
  want.contacts = of_all_steps_.contacts || wall_.has_loads() || virial;
  want.bodies = pushed;
  want.wear = wall_.wear.model;
  want.oka = wall_.wear.oka;
  want.energy_places = wall_.has_energy_places();
  want.impact_speed = wall_.impact_speed;
  want.velocity_unit = velocity_unit_;
  want.friction_heat = wall_.friction_heat;
  want.device = device;
  want.device_rank = host_.ranks().node_rank;
  want.names = host_.names();
  return want;
}

StepSettings EngineInput::step(const StepInput &input, const StepAsks &asks)
{
  StepSettings step = of_all_steps_;
  step.number = input.step.number;
  step.dt = input.step.dt;
  step.update_history = input.step.kind == Step::step;
  step.synchronous = input.step.synchronous;
  step.per_sphere |= asks.contacts;
  step.contacts |= input.virial || asks.contacts || asks.loads;
  step.totals |= asks.totals;
  if (has_surfaces_) {
    surfaces_.clear();
    for (const MeshPart &m : meshes_) surfaces_.push_back(m.mover.surface_motion());
    step.surface = surfaces_.data();
  }
  if (asks.pushed) {
    mobilities_.clear();
    for (const MeshPart &m : meshes_) mobilities_.push_back(m.mobility());
    step.mobility = mobilities_.data();
  }
  if (!has_heat_) return step;
  temperatures_.clear();
  for (const MeshSpec &m : wall_.meshes)
    temperatures_.push_back(m.temperature_input == kNoInput
                                ? m.temperature
                                : input.inputs.at(static_cast<std::size_t>(m.temperature_input)));
  step.wall_temperature = temperatures_.front();
  if (meshes_.size() > 1) step.mesh_temperature = temperatures_.data();
  return step;
}

}    // namespace lsdcd
