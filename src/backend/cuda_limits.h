// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Limits of the device, for kernels whose blocks stay as long as there is work.
#pragma once

#include "backend/cuda_check.h"

#include <cuda_runtime.h>

namespace lsdcd {

class CudaLimits {
 public:
  unsigned processors()
  {
    ask();
    return processors_;
  }

 private:
  void ask()
  {
    if (processors_ > 0) return;
    int device = 0, processors = 0;
    cuda_check(cudaGetDevice(&device), "asking for the device");
    cuda_check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device),
               "asking for the device's limits");
    processors_ = static_cast<unsigned>(processors);
  }
  unsigned processors_ = 0;
};

}    // namespace lsdcd
