// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cuda.h"
#include "backend/cuda_device.h"
#include "engine/broad_phase/selection_gpu.h"
#include "engine/on_backend/engine_on.h"
#include "engine/step/compile_law.h"

namespace lsdcd {

namespace {

// The stream outlives what runs in it.
class CudaEngine : private CudaStream, public EngineOn<CudaBackend> {
 public:
  explicit CudaEngine(const EngineSettings &settings) :
      CudaStream(settings.device_rank),
      EngineOn(settings, law_for<CudaBackend>(settings), CudaBackend(get()))
  {
  }
};

}    // namespace

std::unique_ptr<WallEngine> make_cuda_engine(const EngineSettings &settings)
{
  EngineSettings apart = settings;
  apart.arrays = HostArrays::apart;
  return std::make_unique<CudaEngine>(apart);
}

std::unique_ptr<WallEngine> make_cuda_engine_in_place(const EngineSettings &settings, int device,
                                                      void *stream)
{
  // The host code has chosen its device with a CUDA runtime of its own.
  use_gpu(device);
  return std::make_unique<EngineOn<CudaBackend>>(settings, law_for<CudaBackend>(settings),
                                                 CudaBackend(stream));
}

}    // namespace lsdcd
