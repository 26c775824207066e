// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "study/spheres.h"

#include "backend/backend_cpu.h"

namespace lsdcd {

namespace {

constexpr int kCurveBits = 10;

// Spreads the lowest ten bits to every third place.
std::uint32_t spread(std::uint32_t x)
{
  x = (x | x << 16) & 0x030000ff;
  x = (x | x << 8) & 0x0300f00f;
  x = (x | x << 4) & 0x030c30c3;
  return (x | x << 2) & 0x09249249;
}

}    // namespace

std::uint32_t place_on_curve(const SphereBox &box, const Vec3 &at)
{
  std::uint32_t key = 0;
  for (int k = 0; k < 3; k++) {
    const Real share = (at[k] - box.lo[k]) / (box.hi[k] - box.lo[k]);
    const int most = (1 << kCurveBits) - 1;
    const int step = static_cast<int>(share * (most + 1));
    key |= spread(static_cast<std::uint32_t>(step < most ? step : most)) << k;
  }
  return key;
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
    key.data()[i] = place_on_curve(box, box.sphere(i).centre());
    from.data()[i] = static_cast<std::uint32_t>(i);
  });
  cpu.sort_pairs(key, from, (1u << 3 * kCurveBits) - 1);
  cpu.for_each(n, [&](std::size_t i) { spheres[i] = box.sphere(from.data()[i]); });
  return spheres;
}

}    // namespace lsdcd
