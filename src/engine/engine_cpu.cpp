#include "engine/engine_on.h"
#include "engine/force/host_law.h"

namespace lsdcd {

std::unique_ptr<InPlaceEngine> make_cpu_engine(const EngineSettings &settings)
{
  return std::make_unique<EngineOn<CpuBackend>>(settings, host_law(settings), CpuBackend());
}

}    // namespace lsdcd
