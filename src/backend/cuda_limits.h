// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Limits of the device, for kernels whose blocks stay as long as there is work.
#pragma once

#include "backend/cuda_check.h"

#include <cuda_runtime.h>

#include <algorithm>
#include <cstddef>

namespace lsdcd {

class CudaLimits {
 public:
  unsigned processors()
  {
    ask();
    return processors_;
  }
  // The warps of a block, up to `most_warps`, and its shared memory, where `blocks` blocks are on a processor at
  // once. A warp needs `of_warp` bytes. A block is faster with a table of `table` bytes (0: there is none): it
  // has one if at least half of the warps still fit.
  struct Shape {
    unsigned warps;
    std::size_t shared;
    bool has_table;
  };
  Shape shape(unsigned most_warps, unsigned blocks, std::size_t of_warp, std::size_t table)
  {
    ask();
    const std::size_t room = most_shared_ / blocks,
                      beside = room > table ? (room - table) / of_warp : 0;
    const bool has_table = table > 0 && 2 * beside >= most_warps;
    const unsigned warps = static_cast<unsigned>(
        std::clamp<std::size_t>(has_table ? beside : room / of_warp, 1, most_warps));
    return {warps, warps * of_warp + (has_table ? table : 0), has_table};
  }

 private:
  void ask()
  {
    if (processors_ > 0) return;
    int device = 0, shared = 0, processors = 0;
    cuda_check(cudaGetDevice(&device), "asking for the device");
    cuda_check(cudaDeviceGetAttribute(&shared, cudaDevAttrMaxSharedMemoryPerBlockOptin, device),
               "asking for the device's limits");
    cuda_check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device),
               "asking for the device's limits");
    most_shared_ = static_cast<std::size_t>(shared);
    processors_ = static_cast<unsigned>(processors);
  }
  std::size_t most_shared_ = 0;
  unsigned processors_ = 0;
};

}    // namespace lsdcd
