#include "engine/cuda_law.h"

namespace lsdcd {

CudaLaw cuda_dmt_law(const EngineSettings &s)
{
  const ContactLaw &p = s.law;
  return with_granular_law(p, DmtNormal<Real>(p.granular.k_normal, p.granular.cohesion),
                           MakeCudaLaw<WallKernels::both>{wall_effects(s)});
}

}    // namespace lsdcd
