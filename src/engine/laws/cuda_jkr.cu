#include "engine/cuda_law.h"

namespace lsdcd {

CudaLaw cuda_jkr_law(const EngineSettings &s)
{
  const ContactLaw &p = s.law;
  return with_granular_law(p, JkrNormal<Real>(p.granular.modulus, p.granular.cohesion),
                           MakeCudaLaw<WallKernels::both>{wall_effects(s)});
}

}    // namespace lsdcd
