#include "engine/step/law_for.h"
#include "backend/backend_cpu.h"

namespace lsdcd {

template CompiledLaw<CpuBackend> law_for<CpuBackend>(const EngineSettings &);

}    // namespace lsdcd
