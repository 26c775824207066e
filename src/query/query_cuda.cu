#include "query/warp_queues_cuda.h"
#include "query/query_on.h"

namespace lsdcd {

std::unique_ptr<SphereQuery> make_cuda_query()
{
  return std::make_unique<QueryOn<CudaBackend, WarpQueues>>(CudaBackend());
}

}    // namespace lsdcd
