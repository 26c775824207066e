#include "engine/force/law_for.h"
#include "parallel/backend_cuda.h"

namespace lsdcd {

template CompiledLaw<CudaBackend> law_for<CudaBackend>(const EngineSettings &);

}    // namespace lsdcd
