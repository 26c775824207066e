// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How steeply the force of a contact changes, and what holds an adhesive one.
#pragma once

#include "law/contact_law.h"

namespace lsdcd {

// Bounds of the change of one contact's force, in any direction.
struct ContactSlope {
  Real stiffness = 0;    // force/length
  Real damping = 0;      // force/velocity
};
// Returns bounds for one contact. `radius`: that of a sphere, or of the sphere around a grain if the law is for shapes. Then the bounds
// also hold for a flat side, whose contact is as wide as the grain.
ContactSlope contact_slope(const ContactLaw &law, Real overlap, Real radius, Real mass);

// Bounds of the change of one contact's force along the normal, and in the plane, where it is 0 without friction.
struct ContactSlopes {
  ContactSlope normal, tangential;
};
ContactSlopes contact_slopes(const ContactLaw &law, Real overlap, Real radius, Real mass);

// Returns the steepest slope of a cohesion that acts beyond touch, force/length; 0: the law has none.
Real pulling_slope(const ContactLaw &law, const Contact &c);

// Returns the stiffness of the spring that resists rolling, torque/angle; 0: there is none.
Real rolling_stiffness(const ContactLaw &law, Real overlap, Real radius);

}    // namespace lsdcd
