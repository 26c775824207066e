// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Errors of CUDA's calls, as exceptions that say what to do.
#pragma once

#include "base/input_error.h"

#include <cuda_runtime.h>

#include <string>

namespace lsdcd {

inline std::string cuda_remedy(cudaError_t status)
{
  if (status == cudaErrorMemoryAllocation)
    return "; free memory of the GPU, with fewer processes on it, or use the CPU";
  if (status == cudaErrorNoKernelImageForDevice || status == cudaErrorUnsupportedPtxVersion)
    return "; this build has no code for this GPU: build where it is, or for all GPUs with ./run "
           "build all";
  return "";
}

inline void cuda_check(cudaError_t status, const char *what)
{
  if (status != cudaSuccess)
    throw InputError(std::string("CUDA: ") + what + ": " + cudaGetErrorString(status) +
                     cuda_remedy(status));
}

}    // namespace lsdcd
