#include "engine/backend_cuda.h"
#include "engine/find_first.h"

namespace lsdcd {

template void find_first<CudaBackend>(CudaBackend &, const LawJob &, std::size_t, Real);

}    // namespace lsdcd
