// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "engine/engine.h"

namespace lsdcd {

void WallEngine::set_tree(const TriangleTree &, int)
{
  throw std::logic_error("this engine has laws for spheres alone");
}

bool WallEngine::choose_if_due(const Spheres &spheres, const SphereDrift &drift,
                               const std::vector<MovingMesh> &moving)
{
  const CandidateUpdate choice = schedule_.next(drift, moving, [&] { return has_moved(spheres); });
  if (!choice.is_due) return false;
  choose(spheres, choice.margin, choice.watch);
  schedule_.note_update(drift, moving);
  return true;
}

void step_once(WallEngine &engine, const Spheres &spheres, const StepSettings &step,
               KeptRows *springs)
{
  if (springs) engine.springs().from_cpu(*springs, spheres.n);
  engine.choose(spheres, 0);
  engine.step(spheres, step);
  engine.read_diagnostics();    // throws where a sphere was left out
  if (springs && step.update_history) engine.springs().to_cpu(*springs, spheres.n);
}

}    // namespace lsdcd
