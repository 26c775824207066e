// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// From the settings of an engine and of a step to those of a kernel.
#pragma once

#include "engine/step/wall_force.h"

namespace lsdcd {

inline SearchSettings search_settings(const EngineSettings &engine)
{
  SearchSettings s;
  s.blend = engine.corner == Corner::blend;
  s.side = engine.side == Side::both ? 0 : (engine.side == Side::out ? 1 : -1);
  return s;
}

// Of one mesh.
inline ForceSettings force_settings(const EngineSettings &engine, const StepSettings &step,
                                    const Pose &pose, int mesh)
{
  ForceSettings s;
  s.mesh = static_cast<std::uint32_t>(mesh);
  s.dt = step.dt;
  s.update = step.update_history;
  s.search = search_settings(engine);
  s.with_point = step.per_sphere;
  s.wall_temperature = step.mesh_temperature ? step.mesh_temperature[mesh] : step.wall_temperature;
  s.surface = step.surface ? step.surface[mesh] : engine.surface;
  s.surface_moves = s.surface.moves();
  s.pose = pose;
  s.back = s.update ? step.dt / 2 : 0;
  s.wall_velocity = pose.turn_to_mesh(pose.velocity - s.back * pose.acceleration);
  s.wall_angular = pose.turn_to_mesh(pose.angular - s.back * pose.spin_up);
  s.wear = engine.wear;
  return s;
}

// What a step needs of one mesh.
struct MeshWork {
  GridView grid;
  ForceSettings settings;
};

}    // namespace lsdcd
