// One mesh of a wall, as an engine has it.
#pragma once

#include "engine/step/force_settings.h"
#include "engine/step/law_job.h"
#include "grid/lookup/grid_on.h"

namespace lsdcd {

template <class B>
struct EngineMesh {
  GridOn<B> grid;
  WallPose pose, chosen;    // chosen: at the last choice

  MeshWork work(const EngineSettings &settings, const StepSettings &step, int mesh) const
  {
    return {grid.view, force_settings(settings, step, pose, mesh)};
  }
};

}    // namespace lsdcd
