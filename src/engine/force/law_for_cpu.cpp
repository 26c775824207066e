#include "engine/force/law_for.h"
#include "parallel/backend_cpu.h"

namespace lsdcd {

template CompiledLaw<CpuBackend> law_for<CpuBackend>(const EngineSettings &);

}    // namespace lsdcd
