// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cpu.h"
#include "base/input_error.h"
#include "study/sample_timer_on.h"

namespace lsdcd {

#if defined(LSDCD_HAVE_CUDA)
std::unique_ptr<SampleTimer> make_cuda_sample_timer(const SphereSample &sample);
#endif

std::unique_ptr<SampleTimer> make_sample_timer(bool on_cuda, const SphereSample &sample)
{
  if (!on_cuda)
    return std::make_unique<SampleTimerOn<CpuBackend>>(sample, CpuBackend(), make_cpu_engine);
  std::string why = "LSDCD was built without CUDA";
#if defined(LSDCD_HAVE_CUDA)
  if (cuda_available(&why)) return make_cuda_sample_timer(sample);
#endif
  throw InputError("device cuda: " + why + "; use device cpu");
}

}    // namespace lsdcd
