// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/cuda_available.h"

#include <cuda_runtime.h>

namespace lsdcd {

bool cuda_available(std::string *why)
{
  int n = 0;
  const cudaError_t status = cudaGetDeviceCount(&n);
  if (status == cudaSuccess && n > 0) return true;
  if (why)
    *why = status == cudaSuccess ? "no GPU found"
                                 : std::string("no usable GPU: ") + cudaGetErrorString(status);
  cudaGetLastError();    // or the next call would report it again
  return false;
}

int cuda_devices()
{
  int n = 0;
  const cudaError_t status = cudaGetDeviceCount(&n);
  cudaGetLastError();    // or the next call would report it again
  return status == cudaSuccess ? n : 0;
}

}    // namespace lsdcd
