// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "motion/servo.h"

#include <algorithm>
#include <limits>

namespace lsdcd {

bool Servo::advance(Real push, Real gain, Real dt)
{
  const Real wanted = std::min(gain, max_gain) * (target - push),
             v = std::max(-max_speed, std::min(max_speed, wanted)), next = position + v * dt,
             allowed = std::max(lo, std::min(hi, next));
  velocity = allowed == next ? v : (allowed - position) / dt;
  position = allowed;
  return allowed != next;
}

Real servo_gain(Real stiffness, Real damping, Real dt)
{
  const Real bound = stiffness * dt + 2 * damping;
  return bound > 0 ? 0.5 / bound : std::numeric_limits<Real>::max();
}

}    // namespace lsdcd
