// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "law/contact_slope.h"

#include "law/submodels/damping.h"
#include "law/submodels/normal.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

constexpr Real kHertzSlope = 1.5;    // tangent stiffness / secant stiffness

// Tangential stiffness (force/length) where the contact radius is a.
Real tangential_stiffness(const ContactLaw &law, Real a)
{
  if (!law.has_spring()) return 0;
  switch (law.tangential) {
    case TangentialModel::linear_history:
    case TangentialModel::linear_history_slip:
    case TangentialModel::linear_history_liggghts:
      return law.k_tangent;
    default:
      return law.k_tangent * a;
  }
}

// With the tangential ones of a law without friction, too.
ContactSlopes slopes_of(const ContactLaw &law, Real overlap, Real radius, Real mass)
{
  if (law.is_classic()) {
    const bool hertz = law.is(NormalModel::hertz);
    const Real scale = hertz ? std::sqrt(radius * overlap) : 1;
    return {{scale * ((hertz ? kHertzSlope : 1) * law.k_normal), scale * mass * law.eta},
            {scale * law.k_tangent, scale * mass * law.gamma_tangent}};
  }
  Contact c = {};
  c.overlap = overlap;
  c.radius = radius;
  c.mass = mass;
  const Real a = law.is(NormalModel::jkr)
                     ? JkrNormal(law.modulus, law.surface_energy).contact_radius(c)
                     : std::sqrt(overlap * radius);
  const Real k = law.is(NormalModel::hooke) ? law.k_normal : kHertzSlope * law.k_normal * a;
  const Real damping = GranularDamping{law.damping, law.eta}.coefficient(c, a, k * overlap);
  return {{k, damping}, {tangential_stiffness(law, a), damping * law.xgammat}};
}

}    // namespace

ContactSlope contact_slope(const ContactLaw &law, Real overlap, Real radius, Real mass)
{
  const Real flattest = law.for_shapes && overlap > 0 ? radius * (radius / overlap) : radius;
  const ContactSlopes s = slopes_of(law, overlap, std::max(radius, flattest), mass);
  return {std::max(s.normal.stiffness, s.tangential.stiffness),
          std::max(s.normal.damping, s.tangential.damping)};
}

ContactSlopes contact_slopes(const ContactLaw &law, Real overlap, Real radius, Real mass)
{
  ContactSlopes s = slopes_of(law, overlap, radius, mass);
  if (law.mu == 0) s.tangential = {};
  return s;
}

Real rolling_stiffness(const ContactLaw &law, Real overlap, Real radius)
{
  const Real *const numbers = law.rolling.numbers, mu = numbers[0];
  const ContactSlopes s = slopes_of(law, overlap, radius, 0);
  const Real secant = s.normal.stiffness / (law.is(NormalModel::hooke) ? 1 : kHertzSlope);
  switch (law.rolling.model) {
    case RollingModel::sds:
      return numbers[0] * radius * radius;
    case RollingModel::epsd2:
      return s.tangential.stiffness * radius * radius;
    case RollingModel::epsd:
      return 2.25 * secant * mu * mu * radius * radius;
    case RollingModel::epsd3:
      return numbers[2] * secant * mu * mu * radius * radius;
    default:
      return 0;
  }
}

}    // namespace lsdcd
