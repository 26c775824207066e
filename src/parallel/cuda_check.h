// What CUDA says of its calls, as errors that say what to do.
#pragma once

#include "base/input_error.h"

#include <cuda_runtime.h>

#include <string>

namespace lsdcd {

inline void cuda_check(cudaError_t status, const char *what)
{
  if (status == cudaSuccess) return;
  throw InputError(std::string("CUDA: ") + what + ": " + cudaGetErrorString(status) +
                   (status == cudaErrorMemoryAllocation
                        ? "; free memory of the GPU, with fewer processes on it, or use the CPU"
                        : ""));
}

}    // namespace lsdcd
