// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How steeply the force of a contact can change, and what holds an adhesive one.
#pragma once

#include "law/contact_law.h"

namespace lsdcd {

// Bounds of what one contact's force changes by, in any direction.
struct ContactSlope {
  Real stiffness = 0;    // force/length
  Real damping = 0;      // force/velocity
};
ContactSlope contact_slope(const ContactLaw &law, Real overlap, Real radius, Real mass);

// What share of the pull-off force of dmt and jkr a change of the overlap makes, where that force
// is in balance with the elastic one: per length. 0 for laws that do not hold.
Real pull_off_slope(const ContactLaw &law, Real radius);

}    // namespace lsdcd
