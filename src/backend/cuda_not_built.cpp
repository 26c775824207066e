// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/cuda_available.h"
#include "backend/gpu_arrays.h"
#include "base/input_error.h"

namespace lsdcd {

bool cuda_available(std::string *why)
{
#if defined(LSDCD_CUDA_LEFT_OUT)
  if (why) *why = "left out of this build by LSDCD_CUDA=OFF, as ./run does where there is no GPU";
#else
  if (why) *why = "built without the CUDA toolkit";
#endif
  return false;
}

int cuda_devices()
{
  return 0;
}

std::unique_ptr<GpuArrays> make_gpu_arrays(void *)
{
  std::string why;
  cuda_available(&why);
  throw InputError("CUDA: " + why);
}

}    // namespace lsdcd
