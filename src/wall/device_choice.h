// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// With `device automatic`: does a wall whose spheres are in the memory of the host compute on a GPU or on the CPU? A
// GPU takes less time for a sphere and more for a step, so that it pays from some number of spheres near the wall on.
#pragma once

#include "engine/engine.h"

#include <cstdint>

namespace lsdcd {

class DeviceChoice {
 public:
  DeviceChoice() = default;
  // `gpus`: of this node, on which `processes` run. Without a GPU, or where a device was asked for, that one holds.
  DeviceChoice(Device asked, int gpus, int processes);

  bool is_open() const { return least_ > 0; }
  Device device() const { return device_; }
  std::int64_t least_for_gpu() const { return least_; }    // spheres near the wall

  // Decides by the most spheres near the wall that one process has. True where the device is another one from now on.
  bool update(std::int64_t near);

 private:
  Device device_ = Device::cpu;
  std::int64_t least_ = 0;
};

}    // namespace lsdcd
