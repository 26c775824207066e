// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "on_cuda.h"

#include "backend/backend_cuda.h"

#include <algorithm>

namespace lsdcd {

std::string cuda_name()
{
  return CudaBackend().name();
}

double cuda_copy_gb_s()
{
  constexpr std::size_t kBytes = std::size_t(1) << 31;    // forty times an L2 cache
  CudaBackend b;
  CudaBackend::Array<char> from(kBytes), to(kBytes);
  cuda_check(cudaMemset(from.data(), 1, kBytes), "clearing memory");
  double least = 1e300;
  for (int k = 0; k < 12; k++)    // the first ones warm up
    least = std::min(least, b.milliseconds([&] {
      cuda_check(
          cudaMemcpyAsync(to.data(), from.data(), kBytes, cudaMemcpyDeviceToDevice, b.stream),
          "copying on the device");
    }));
  return 2 * double(kBytes) / least / 1e6;
}

double cuda_brute_force_ms(const TriangleGrid &grid, std::size_t n, std::size_t stride)
{
  CudaBackend b;
  return brute_force_ms(b, grid, n, stride);
}

}    // namespace lsdcd
