// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How kernels that are written for a GPU are started, and how one begins while the one before it runs.
#pragma once

#include "backend/cuda_check.h"

#include <cuda_runtime.h>

#include <cstddef>

namespace lsdcd {

struct LaunchShape {
  unsigned blocks, threads;     // threads of a block
  std::size_t shared = 0;       // bytes of a block's shared memory beside what the kernel declares
  bool begins_early = false;    // may it begin while the kernel before it on the stream runs?
};

template <class... Parameters, class... Arguments>
void launch(cudaStream_t stream, void (*kernel)(Parameters...), const LaunchShape &shape,
            const Arguments &...arguments)
{
  cudaLaunchAttribute early = {};
  early.id = cudaLaunchAttributeProgrammaticStreamSerialization;
  early.val.programmaticStreamSerializationAllowed = 1;
  cudaLaunchConfig_t config = {};
  config.gridDim = dim3(shape.blocks);
  config.blockDim = dim3(shape.threads);
  config.dynamicSmemBytes = shape.shared;
  config.stream = stream;
  config.attrs = &early;
  config.numAttrs = shape.begins_early ? 1 : 0;
  cuda_check(cudaLaunchKernelEx(&config, kernel, arguments...), "starting a kernel");
}

// From Hopper on a kernel that may begin early does so once each block of the one before it has called
// let_next_begin() or ended. It waits for what it needs of that one.
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
// Was the code of this kernel that runs here compiled with these two?
template <class Kernel>
bool can_begin_early(Kernel *kernel)
{
  cudaFuncAttributes attributes;
  return cudaFuncGetAttributes(&attributes, kernel) == cudaSuccess && attributes.ptxVersion >= 90;
}

}    // namespace lsdcd
