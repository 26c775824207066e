// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cuda.h"
#include "backend/cuda_device.h"
#include "study/sample_timer_on.h"

namespace lsdcd {

std::unique_ptr<SampleTimer> make_cuda_sample_timer(const SphereSample &sample)
{
  const auto make_engine = [](const EngineSettings &settings) {
    return make_cuda_engine_in_place(settings, current_gpu(), nullptr);
  };
  return std::make_unique<SampleTimerOn<CudaBackend>>(sample, CudaBackend(), +make_engine);
}

}    // namespace lsdcd
