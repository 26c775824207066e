#include "engine/cuda_law.h"

namespace lsdcd {

CudaLaw cuda_on_wall_law(const EngineSettings &s)
{
  return with_classic_law<Real>(s.law, MakeCudaLaw<WallKernels::each>{wall_effects(s)});
}

}    // namespace lsdcd
