// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Runs a step by a compiled law: of the candidates of one mesh, or of multi-mesh spheres.
#pragma once

#include "engine/step/multi_mesh_step.h"

namespace lsdcd {

// Does the step of the candidates [0, n) of one mesh, or of the multi-mesh spheres [0, n).
template <class Law, class Backend>
void run_compiled_law(const LawBytes &bytes, const StepJob &job, std::size_t n, Backend &backend)
{
  if constexpr (Law::kPosed)
    if (job.multi_mesh.meshes) {
      run_step(backend, n, MultiMeshStep<Law>{job});
      return;
    }
  run_step(backend, n, MeshStep<Law>{bytes.as<Law>(), job});
}

}    // namespace lsdcd
