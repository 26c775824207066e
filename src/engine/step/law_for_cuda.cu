#include "engine/step/law_for.h"
#include "backend/backend_cuda.h"

namespace lsdcd {

template CompiledLaw<CudaBackend> law_for<CudaBackend>(const EngineSettings &);

}    // namespace lsdcd
