#include "engine/cuda_law.h"

namespace lsdcd {

CudaLaw cuda_dmt_law(const ContactLaw &p)
{
  return with_granular_law(p, DmtNormal<Real>(p.granular.k_normal, p.granular.cohesion),
                           MakeCudaLaw());
}

}    // namespace lsdcd
