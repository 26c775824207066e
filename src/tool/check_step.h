// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A timed step of the wall whose forces are known in closed form.
#pragma once

#include "engine/settings.h"

#include <string>

namespace lsdcd {

struct CheckedStep {
  std::string device;    // "CPU, 1 thread" or "CUDA, NVIDIA H200"
  int contacts;
  double ns_per_contact;    // the fastest of several steps
  Real largest_error;       // of a force, relative to Hooke's
};

// Rounding: the overlap is a difference of numbers up to 200 times as large, which are sums of few.
constexpr Real kStepTolerance = 1e-12;

// Does steps of 10^4 spheres, each 1 % of its radius deep in a plane of many triangles, on one core or on the first GPU, with particles in
// the memory of the host. The normal force of each is `hooke`'s, stiffness times overlap, and there is no other. Throws as make_engine().
CheckedStep check_step(Device device);

}    // namespace lsdcd
