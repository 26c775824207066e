#include "engine/force/host_law.h"
#include "engine/resident_on.h"

namespace lsdcd {

std::unique_ptr<ResidentEngine> make_resident_cpu_engine(const EngineSettings &settings)
{
  return std::make_unique<ResidentOn<CpuBackend>>(settings, host_law(settings), CpuBackend());
}

#if !defined(LSDCD_HAVE_CUDA)
std::unique_ptr<ResidentEngine> make_resident_cuda_engine(const EngineSettings &, int, void *)
{
  throw InputError("built without the CUDA toolkit: the particles are on a GPU, the wall "
                   "cannot be; build it where nvcc is found, or use wall/lsdcd/kk/host");
}
#endif

}    // namespace lsdcd
