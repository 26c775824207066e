// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Decides, with `device automatic`, whether a wall whose spheres are in the memory of the host computes on a GPU or
// on the CPU. A GPU takes less time for each sphere and more for each step, so it pays off only from a certain number
// of spheres near the wall on.
#pragma once

#include "engine/engine.h"

#include <cstdint>

namespace lsdcd {

class DeviceChoice {
 public:
  DeviceChoice() = default;
  // `gpus`: GPUs of this node, on which `processes` run. If a device was asked for, or if there is no GPU, `asked` stays.
  DeviceChoice(Device asked, int gpus, int processes);

  bool is_open() const { return least_ > 0; }
  Device device() const { return device_; }
  std::int64_t least_for_gpu() const { return least_; }    // spheres near the wall

  // Decides by `near`, the largest number of spheres near the wall on any process. Returns true if the device changes
  // from now on.
  bool update(std::int64_t near);

 private:
  Device device_ = Device::cpu;
  std::int64_t least_ = 0;
};

}    // namespace lsdcd
