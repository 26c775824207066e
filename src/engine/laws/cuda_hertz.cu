#include "engine/cuda_law.h"

namespace lsdcd {

CudaLaw cuda_hertz_law(const ContactLaw &p)
{
  return with_granular_law(p, HertzNormal<Real>{p.granular.k_normal}, MakeCudaLaw());
}

}    // namespace lsdcd
