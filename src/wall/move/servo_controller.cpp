// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/move/servo_controller.h"

#include "base/input_words.h"
#include "law/contact_slope.h"
#include "wall/spec/mesh_name.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

// The gain is stable if all contacts of the last step had the largest possible stiffness.
Real ServoController::stable_gain(const ServoLoad &load, const Pose &placed, Real dt) const
{
  const Servo &s = servo();
  Real arm = 1;
  if (s.turns) {
    const Vec3 past = {load.radius, load.radius, load.radius};
    const Box bounds = placed_bounds(placed, {load.extents.lo - past, load.extents.hi + past});
    arm = 0;
    for_corners(bounds, [&](const Vec3 &corner) {
      arm = std::max(arm, norm(cross(s.axis, corner - s.point)));
    });
  }
  const Real overlap = load.overlap * load.radius + s.max_speed * arm * dt,
             contacts = std::max<Real>(1, load.contacts);
  ContactSlope one;    // the steepest
  for (int kind = 0; kind < laws_.kinds; kind++) {
    const ContactSlope of =
        contact_slope(law_of(laws_, mesh_, kind), overlap, load.radius, load.mass);
    one = {std::max(one.stiffness, of.stiffness), std::max(one.damping, of.damping)};
  }
  return servo_gain(contacts * arm * arm * one.stiffness, contacts * arm * arm * one.damping, dt);
}

// Once for a servo: its own gain, or that the one that was given would not be stable.
void ServoController::log_gain(const ServoLoad &load, Real gain, Real dt)
{
  const Real given = servo().max_gain;
  const bool is_given = std::isfinite(given);
  if (gain_logged_ || load.contacts == 0 || (is_given ? gain >= given : wall_.brief)) return;
  gain_logged_ = true;
  const std::string with = counted(static_cast<std::int64_t>(load.contacts), "contact") +
                           " at the timestep " + number_text(dt);
  if (is_given)
    host_.warn(with_mesh_name(wall_, mesh_,
                              "a servo's gain of " + number_text(given) +
                                  " would not be stable with " + with + ": " + number_text(gain) +
                                  " is used instead, and a smaller one with more contacts; this "
                                  "warning is shown once"));
  else
    host_.log(with_mesh_name(wall_, mesh_,
                             "the servo's gain is " + number_text(gain) + " with " + with +
                                 ", and smaller with more contacts"));
}

void ServoController::advance(const ServoLoad &load, const Pose &placed, Real dt, std::int64_t step)
{
  Servo &s = servo();
  const Real pushes = push(load), gain = stable_gain(load, placed, dt);
  log_gain(load, gain, dt);
  if (!s.advance(pushes, gain, dt) || limit_warned_) return;
  limit_warned_ = true;
  host_.log(with_mesh_name(wall_, mesh_,
                           "the servo is at its limit " + number_text(s.position) + " at step " +
                               std::to_string(step) + ", where it pushes with " +
                               number_text(pushes) + " instead of " + number_text(s.target) +
                               "; this message is shown once"));
}

}    // namespace lsdcd
