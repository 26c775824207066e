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
