// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cpu.h"
#include "base/input_error.h"
#include "study/sphere_query_on.h"

namespace lsdcd {

#if defined(LSDCD_HAVE_CUDA)
std::unique_ptr<SphereQuery> make_cuda_query();
#endif

std::unique_ptr<SphereQuery> make_sphere_query(Device device)
{
  std::string why;
  const bool cuda = device != Device::cpu && cuda_available(&why);
#if defined(LSDCD_HAVE_CUDA)
  if (cuda) return make_cuda_query();
#endif
  if (!cuda && device == Device::cuda)
    throw InputError("device cuda: " + why + "; use device auto or cpu");
  return std::make_unique<SphereQueryOn<CpuBackend>>(CpuBackend());
}

}    // namespace lsdcd
