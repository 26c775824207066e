// How steeply the force of a contact can change.
#pragma once

#include "model/contact_law.h"

namespace lsdcd {

// Bounds of what one contact's force changes by, in any direction.
struct ContactSlope {
  Real stiffness = 0;    // force/length
  Real damping = 0;      // force/velocity
};
ContactSlope contact_slope(const ContactLaw &law, Real overlap, Real radius, Real mass);

}    // namespace lsdcd
