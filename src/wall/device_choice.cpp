// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/device_choice.h"

namespace lsdcd {

namespace {

// Measured on cores and an H200 (doc/notes/performance.md): from so many spheres near the wall on a GPU is faster. Processes
// that share one take turns in slices of time, so that each needs more spheres the more of them there are.
constexpr std::int64_t kAlone = 400, kShared = 1200;

}    // namespace

DeviceChoice::DeviceChoice(Device asked, int gpus, int processes) : device_(asked)
{
  if (asked != Device::automatic || gpus < 1) return;
  const int on_one = (processes + gpus - 1) / gpus;
  least_ = on_one == 1 ? kAlone : kShared * on_one;
}

// Half of the number leads back to the CPU, so that a number that swings about it does not change the device each time.
bool DeviceChoice::update(std::int64_t near)
{
  if (!is_open()) return false;
  const bool was_gpu = device_ != Device::cpu;
  const bool is_gpu = near >= (was_gpu ? least_ / 2 : least_);
  device_ = is_gpu ? Device::cuda : Device::cpu;
  return is_gpu != was_gpu;
}

}    // namespace lsdcd
