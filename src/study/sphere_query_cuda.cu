#include "query/near_first_cuda.h"
#include "study/sphere_query_on.h"

namespace lsdcd {

std::unique_ptr<SphereQuery> make_cuda_query()
{
  return std::make_unique<QueryOn<CudaBackend, NearFirst>>(CudaBackend());
}

}    // namespace lsdcd
