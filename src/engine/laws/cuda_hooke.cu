#include "engine/cuda_law.h"

namespace lsdcd {

CudaLaw cuda_hooke_law(const ContactLaw &p)
{
  return with_granular_law(p, HookeNormal<Real>{p.granular.k_normal}, MakeCudaLaw());
}

}    // namespace lsdcd
