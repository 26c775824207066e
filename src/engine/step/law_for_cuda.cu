#include "engine/step/law_for.h"
#include "engine/step/run_step_cuda.h"

namespace lsdcd {

template CompiledLaw<CudaBackend> law_for<CudaBackend>(const EngineSettings &);

}    // namespace lsdcd
