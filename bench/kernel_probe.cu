// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "kernel_probe.h"

namespace lsdcd {

__global__ void probed(const __grid_constant__ GridView grid, const __grid_constant__ ProbedLaw law,
                       const __grid_constant__ ForceSettings settings, const SphereState *spheres,
                       SphereResult *result, Spring *springs)
{
  const unsigned k = blockIdx.x * blockDim.x + threadIdx.x;
  SphereSink sink;
  sink.springs = springs + k * 8;
  result[k] = probed_force(grid, law, settings, spheres[k], sink);
}

}    // namespace lsdcd
