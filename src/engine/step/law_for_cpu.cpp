#include "engine/step/law_for.h"
#include "engine/step/run_step_cpu.h"

namespace lsdcd {

template CompiledLaw<CpuBackend> law_for<CpuBackend>(const EngineSettings &);

}    // namespace lsdcd
