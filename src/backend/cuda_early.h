// Kernels that begin while the one before them on their stream runs.
#pragma once

#include "backend/cuda_check.h"

#include <cuda_runtime.h>

namespace lsdcd {

// From Hopper on a kernel can begin while the one before it runs: once each block of that
// has called let_next_begin() or ended. What it needs of it, it waits for.
__device__ inline void let_next_begin()
{
#if __CUDA_ARCH__ >= 900
  asm volatile("griddepcontrol.launch_dependents;" ::: "memory");
#endif
}
__device__ inline void wait_for_last_kernel()
{
#if __CUDA_ARCH__ >= 900
  asm volatile("griddepcontrol.wait;" ::: "memory");
#endif
}
// Is what runs here of a kernel compiled with these two?
template <class Kernel>
bool can_begin_early(Kernel *kernel)
{
  cudaFuncAttributes attributes;
  return cudaFuncGetAttributes(&attributes, kernel) == cudaSuccess && attributes.ptxVersion >= 90;
}

// Starts a kernel, beside the one before it on the stream if `early` and it can.
template <class... Parameters, class... Arguments>
void start_beside(bool early, cudaStream_t stream, unsigned blocks, unsigned block,
                  void (*kernel)(Parameters...), const Arguments &...arguments)
{
  cudaLaunchAttribute beside = {};
  beside.id = cudaLaunchAttributeProgrammaticStreamSerialization;
  beside.val.programmaticStreamSerializationAllowed = 1;
  cudaLaunchConfig_t config = {};
  config.gridDim = dim3(blocks);
  config.blockDim = dim3(block);
  config.stream = stream;
  config.attrs = &beside;
  config.numAttrs = early ? 1 : 0;
  cuda_check(cudaLaunchKernelEx(&config, kernel, arguments...), "starting a kernel");
}

}    // namespace lsdcd
