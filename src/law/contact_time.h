// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How long contacts and surface waves last, which a timestep has to resolve.
#pragma once

#include "law/contact_law.h"

namespace lsdcd {

// The fix warns if a contact lasts fewer steps, which do not resolve its force.
constexpr Real kStepsPerContact = 10;

// Returns whether the stiffness grows with the overlap.
bool stiffens(const ContactLaw &law);

// Returns the duration of a binary contact of a sphere with the wall: half a period of the damped spring (undamped with granular, whose
// damping may be anything) or, if that is shorter, of the spring that resists rolling. A spring that stiffens is taken at an overlap of 1 %
// of the radius. `ftm2v`: force per mass to velocity per time, LAMMPS's number of the units. `inertia`: the moment that rolls, 1/(1/I1 +
// 1/I2) of two spheres; 0: that of a sphere, 2/5 m R^2.
Real contact_time(const ContactLaw &law, Real mass, Real radius, Real ftm2v, Real inertia = 0);

// An elastic Hertz impact of two bodies: `modulus` is their E*, `mass` and `radius` the effective ones
// 1/(1/m1 + 1/m2) and 1/(1/R1 + 1/R2), `speed` > 0 that along the normal. Units of any consistent system.
// Johnson, Contact Mechanics, 1985, chapter 11.
struct HertzImpact {
  Real overlap;    // the largest
  Real time;       // from touch to release
};
HertzImpact hertz_impact(Real modulus, Real mass, Real radius, Real speed);

// Returns the time in which a Rayleigh wave runs round half a sphere, by the usual fit of its speed: pi R sqrt(density /
// G) / (0.1631 nu + 0.8766), with G = E / (2 (1 + nu)). Li, Xu and Thornton, Powder Technol. 160, 219 (2005).
Real rayleigh_time(Real radius, Real density, Real youngs_modulus, Real poissons_ratio);

}    // namespace lsdcd
