// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cuda.h"
#include "backend/cuda_device.h"
#include "pair/pair_engine_on.h"

namespace lsdcd {

std::unique_ptr<PairEngine> make_cuda_pair_engine(int device, void *stream)
{
  // The host code has chosen its device with a CUDA runtime of its own.
  use_gpu(device);
  return std::make_unique<PairEngineOn<CudaBackend>>(CudaBackend(stream));
}

}    // namespace lsdcd
