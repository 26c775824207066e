#include "engine/force/cuda_law.h"
#include "engine/resident_on.h"

namespace lsdcd {

std::unique_ptr<ResidentEngine> make_resident_cuda_engine(const EngineSettings &settings,
                                                          int device, void *stream)
{
  // The host code has chosen its device with a CUDA runtime of its own.
  cuda_check(cudaSetDevice(device), "choosing the GPU of the particles");
  CudaBackend backend;
  backend.stream = static_cast<cudaStream_t>(stream);
  return std::make_unique<ResidentOn<CudaBackend>>(settings, cuda_law(settings), backend);
}

}    // namespace lsdcd
