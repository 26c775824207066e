#include "engine/cuda_law.h"

namespace lsdcd {

CudaLaw cuda_jkr_law(const ContactLaw &p)
{
  return with_granular_law(p, JkrNormal<Real>(p.granular.modulus, p.granular.cohesion),
                           MakeCudaLaw());
}

}    // namespace lsdcd
