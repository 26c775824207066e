// Queries checked on a GPU.
#include "support/query_checks.h"

#include "query/warp_queues_cuda.h"

namespace lsdcd {

std::unique_ptr<QueryChecks> query_checks_on_cuda(const Bins &bins, const QueryCheckSettings &s)
{
  return std::make_unique<QueryChecksOn<CudaBackend, WarpQueues>>(bins, s);
}

}    // namespace lsdcd
