#include "parallel/backend_cuda.h"
#include "engine/narrow/find_first.h"

namespace lsdcd {

template void find_first<CudaBackend>(CudaBackend &, const LawJob &, std::size_t, Real);

}    // namespace lsdcd
