// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "support/device_memory.h"

#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>

#if defined(LSDCD_HAVE_CUDA)
#include <cuda_runtime_api.h>
#endif

namespace lsdcd {

#if defined(LSDCD_HAVE_CUDA)
static void check(cudaError_t status)
{
  if (status != cudaSuccess) throw std::runtime_error(cudaGetErrorString(status));
}
#endif

void *allocate_on(bool cuda, std::size_t bytes)
{
#if defined(LSDCD_HAVE_CUDA)
  if (cuda) {
    void *at = nullptr;
    check(cudaMalloc(&at, bytes));
    return at;
  }
#endif
  (void) cuda;
  return ::operator new(bytes);
}

void free_on(bool cuda, void *at)
{
#if defined(LSDCD_HAVE_CUDA)
  if (cuda) {
    cudaFree(at);
    return;
  }
#endif
  (void) cuda;
  ::operator delete(at);
}

void copy_to(bool cuda, void *to, const void *host, std::size_t bytes)
{
  if (bytes == 0) return;
#if defined(LSDCD_HAVE_CUDA)
  if (cuda) return check(cudaMemcpy(to, host, bytes, cudaMemcpyHostToDevice));
#endif
  (void) cuda;
  std::memcpy(to, host, bytes);
}

void copy_from(bool cuda, void *host, const void *from, std::size_t bytes)
{
  if (bytes == 0) return;
#if defined(LSDCD_HAVE_CUDA)
  if (cuda) return check(cudaMemcpy(host, from, bytes, cudaMemcpyDeviceToHost));
#endif
  (void) cuda;
  std::memcpy(host, from, bytes);
}

}    // namespace lsdcd
