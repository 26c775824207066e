// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "rigid/body_spec.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "base/vector_text.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace lsdcd {

namespace {

void check_finite(const char *what, const Vec3 &a)
{
  if (!std::isfinite(a.x) || !std::isfinite(a.y) || !std::isfinite(a.z))
    throw InputError(std::string(what) + " is " + vector_text(a) + ", which is not finite");
}

void check_not_below_0(const char *what, Real value)
{
  if (!(value >= 0) || !std::isfinite(value))
    throw InputError(std::string(what) + " is " + number_text(value) +
                     ", not a number of 0 or more");
}

void check_axis(const Joint &j)
{
  if (!j.has_coordinate() && j.kind != JointKind::planar) return;
  check_finite("the joint's direction", j.axis);
  constexpr Real kRounding = 1e-9;
  if (j.axis == Vec3{0, 0, 0}) throw InputError("a direction must not be 0 0 0");
  if (std::fabs(norm(j.axis) - 1) > kRounding)
    throw InputError("the joint's direction " + vector_text(j.axis) + " is not of length 1");
}

// Spring, limits and motor act on the coordinate of a joint.
void check_has_coordinate(const BodySpec &body)
{
  const JointDrive &d = body.drive, none = JointDrive();
  const struct {
    const char *word;
    bool given;
  } words[] = {{"spring", d.stiffness != 0 || d.damping != 0 || d.rest != 0},
               {"limits", d.lo != none.lo || d.hi != none.hi},
               {"motor", d.motor != 0 || body.motor_input != kNoInput}};
  for (const auto &w : words)
    if (w.given && !body.joint.has_coordinate())
      throw InputError(std::string(w.word) +
                       " works only with a joint hinge or slider, and this body has neither");
}

std::string limits_text(const JointDrive &d)
{
  return "the limits " + number_text(d.lo) + " " + number_text(d.hi);
}

void check_drive(const JointDrive &d)
{
  check_not_below_0("the stiffness", d.stiffness);
  check_not_below_0("the damping", d.damping);
  check_finite("rest of the spring and the motor", {d.rest, d.motor, 0});
  if (std::isnan(d.lo) || std::isnan(d.hi)) throw InputError(limits_text(d) + " are not numbers");
  if (d.lo > d.hi) throw InputError(limits_text(d) + " are reversed: the lower one comes first");
}

void check_mass(const BodySpec &body)
{
  check_not_below_0("the density", body.density);
  if (body.density > 0) return;
  const SymmetricMatrix &i = body.mass.inertia;
  check_finite("the centre of mass", body.mass.centre);
  check_finite("the inertia", {i.xx, i.yy, i.zz});
  check_finite("the inertia", {i.xy, i.xz, i.yz});
  check_mass_properties(body.mass, "inertia");
}

}    // namespace

void check_body(const BodySpec &body)
{
  if (!body.present) return;
  const int kind = static_cast<int>(body.joint.kind);
  if (kind < 0 || kind >= static_cast<int>(std::size(kJointNames)))
    throw InputError("there is no joint of kind " + std::to_string(kind));
  check_mass(body);
  if (body.joint.has_point()) check_finite("the joint's point", body.joint.point);
  check_axis(body.joint);
  check_has_coordinate(body);
  check_drive(body.drive);
  check_finite("the load", body.load);
  check_finite("the moment", body.moment);
  check_finite("the velocity", body.velocity);
  check_finite("omega", body.omega);
  check_finite("gravity", body.gravity);
  check_not_below_0("the spacing of the coat", body.coat.spacing);
  check_not_below_0("the radius of the coat", body.coat.radius);
}

void check_limits(const JointDrive &drive, Real coordinate)
{
  if (drive.lo <= coordinate && coordinate <= drive.hi) return;
  throw InputError(limits_text(drive) + " do not contain " + number_text(coordinate) +
                   ", which is where the body " + (coordinate == 0 ? "begins" : "is"));
}

}    // namespace lsdcd
