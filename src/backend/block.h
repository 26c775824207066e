// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Code that is written for a GPU's blocks of threads reads and calls this. A block's work is a struct F with
//   kThreads, kBlocksAtOnce    threads of a block at most, and blocks at once on a processor at least
//   operator()(block) const    what each thread does
// for the backend's for_each_block(). Its members lie where all threads read them at once.
#pragma once

#include "backend/warp.h"

#include <cuda_pipeline_primitives.h>
#include <cuda_runtime.h>

#include <cstddef>
#include <cstring>

// Functions that only a GPU runs, and memory that a block's threads share.
#define LSDCD_GPU_FN __device__ inline
#define LSDCD_SHARED __shared__

namespace lsdcd {

using GpuWarp = Warp<kWarpSize>;

struct LaunchShape {
  unsigned blocks, threads;     // threads of a block
  bool begins_early = false;    // may it begin while the work before it runs?
};

// The block of the thread that asks.
struct Block {
  LSDCD_GPU_FN static unsigned thread() { return threadIdx.x; }    // its number in the block
  LSDCD_GPU_FN static unsigned warp() { return threadIdx.x / kWarpSize; }
  LSDCD_GPU_FN static unsigned n_threads() { return blockDim.x; }
  LSDCD_GPU_FN static unsigned number() { return blockIdx.x; }
  LSDCD_GPU_FN static unsigned n_blocks() { return gridDim.x; }
  // Until all threads of the block are here.
  LSDCD_GPU_FN static void wait() { __syncthreads(); }

  // Work that may begin early does so once each block of the work before it has called let_next_begin() or
  // ended, on GPUs that can (from Hopper on). It waits for what it needs of that one.
  LSDCD_GPU_FN static void let_next_begin()
  {
#if __CUDA_ARCH__ >= 900
    asm volatile("griddepcontrol.launch_dependents;" ::: "memory");
#endif
  }
  LSDCD_GPU_FN static void wait_for_last()
  {
#if __CUDA_ARCH__ >= 900
    asm volatile("griddepcontrol.wait;" ::: "memory");
#endif
  }
};

// 16 bytes, which a thread reads and writes at once.
using Chunk = uint4;

// Begins to copy a chunk to shared memory, past the caches and the registers. After wait_for_copies() those
// that this thread has begun before commit_copies() are there.
LSDCD_GPU_FN void begin_copy(Chunk *to, const Chunk *from)
{
  __pipeline_memcpy_async(to, from, sizeof(Chunk));
}
LSDCD_GPU_FN void commit_copies()
{
  __pipeline_commit();
}
LSDCD_GPU_FN void wait_for_copies()
{
  __pipeline_wait_prior(0);
}

// Read once and in order: other things stay in the cache.
template <class T>
LSDCD_GPU_FN T read_once(const T &from)
{
  static_assert(sizeof(T) % sizeof(Chunk) == 0 && alignof(T) % sizeof(Chunk) == 0, "in pieces");
  constexpr unsigned kChunks = sizeof(T) / sizeof(Chunk);
  Chunk chunks[kChunks];
#pragma unroll
  for (unsigned k = 0; k < kChunks; k++)
    chunks[k] = __ldcs(reinterpret_cast<const Chunk *>(&from) + k);
  T out;
  std::memcpy(&out, chunks, sizeof out);
  return out;
}

}    // namespace lsdcd
