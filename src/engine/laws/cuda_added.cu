#include "engine/cuda_law.h"

namespace lsdcd {

CudaLaw cuda_added_law(const EngineSettings &s)
{
  return with_added_law(s.law, MakeCudaLaw<WallKernels::both>{wall_effects(s)});
}

}    // namespace lsdcd
