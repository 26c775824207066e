// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "study/spheres.h"

#include "backend/backend_cpu.h"
#include "base/curve.h"

namespace lsdcd {

namespace {

constexpr int kCurveBits = 10;

}    // namespace

std::uint32_t number_on_curve(const SphereBox &box, const Vec3 &at)
{
  Vec3 share;
  for (int k = 0; k < 3; k++) share[k] = (at[k] - box.lo[k]) / (box.hi[k] - box.lo[k]);
  return number_on_curve(share, kCurveBits);
}

std::vector<Sphere> make_spheres(const SphereBox &box, std::size_t n, Order order)
{
  CpuBackend cpu;
  std::vector<Sphere> spheres(n);
  if (order == Order::random) {
    cpu.for_each(n, [&](std::size_t i) { spheres[i] = box.sphere(i); });
    return spheres;
  }
  CpuBackend::Array<std::uint32_t> key(n), from(n);
  cpu.for_each(n, [&](std::size_t i) {
    key.data()[i] = number_on_curve(box, box.sphere(i).centre());
    from.data()[i] = static_cast<std::uint32_t>(i);
  });
  cpu.sort_pairs(key, from, (1u << 3 * kCurveBits) - 1);
  cpu.for_each(n, [&](std::size_t i) { spheres[i] = box.sphere(from.data()[i]); });
  return spheres;
}

}    // namespace lsdcd
