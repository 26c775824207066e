// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/input_error.h"
#include "engine/engine.h"
#include "engine/shape_engine.h"

namespace lsdcd {

#if defined(LSDCD_HAVE_CUDA)
std::unique_ptr<WallEngine> make_cuda_engine(const EngineSettings &settings);
#else
std::unique_ptr<WallEngine> make_cuda_engine_in_place(const EngineSettings &settings, int, void *)
{
  throw InputError(
      std::string("the spheres are on a GPU, and LSDCD was built without its CUDA engine: build it "
                  "where nvcc is found, or ") +
      settings.names.compute_on_cpu);
}
#endif

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
               ContactHistory *springs)
{
  if (springs) engine.springs().from_store(*springs, spheres.n);
  engine.choose(spheres, 0);
  engine.step(spheres, step);
  engine.read_diagnostics();    // throws where a sphere was left out
  if (springs && step.update_history) engine.springs().to_store(*springs, spheres.n);
}

std::unique_ptr<WallEngine> make_engine(const EngineSettings &settings)
{
  if (settings.law().for_shapes) return make_shape_engine(settings);
  std::string why;
  const bool cuda = settings.device != Device::cpu && cuda_available(&why);
#if defined(LSDCD_HAVE_CUDA)
  if (cuda) return make_cuda_engine(settings);
#endif
  if (!cuda && settings.device == Device::cuda)
    throw InputError("device cuda: " + why + "; use device auto or cpu");
  return make_cpu_engine(settings);
}

}    // namespace lsdcd
