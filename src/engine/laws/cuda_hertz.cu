#include "engine/cuda_law.h"

namespace lsdcd {

CudaLaw cuda_hertz_law(const EngineSettings &s)
{
  const ContactLaw &p = s.law;
  return with_granular_law(p, HertzNormal<Real>{p.granular.k_normal},
                           MakeCudaLaw<WallKernels::both>{wall_effects(s)});
}

}    // namespace lsdcd
