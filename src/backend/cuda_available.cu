// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/cuda_available.h"

#include <cuda_runtime.h>

namespace lsdcd {

namespace {

cudaError_t count_gpus(int &n)
{
  n = 0;
  const cudaError_t status = cudaGetDeviceCount(&n);
  cudaGetLastError();    // or the next call would report it again
  return status;
}

}    // namespace

bool cuda_available(std::string *why)
{
  int n;
  const cudaError_t status = count_gpus(n);
  if (status == cudaSuccess && n > 0) return true;
  if (why)
    *why = status == cudaSuccess ? "no GPU found"
                                 : std::string("no usable GPU: ") + cudaGetErrorString(status);
  return false;
}

int cuda_devices()
{
  int n;
  return count_gpus(n) == cudaSuccess ? n : 0;
}

}    // namespace lsdcd
