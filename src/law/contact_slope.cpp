// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "law/contact_slope.h"

#include "law/smallest_model.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

Contact contact_of(Real overlap, Real radius, Real mass)
{
  Contact c = {};
  c.overlap = overlap;
  c.radius = radius;
  c.mass = mass;
  return c;
}

}    // namespace

Real pulling_slope(const ContactLaw &law, const Contact &c)
{
  return law.reaches() ? reaching_cohesion(law).slope(c) : 0;
}

namespace {

// With the tangential ones of a law without friction, too.
ContactSlopes slopes_of(const ContactLaw &law, Real overlap, Real radius, Real mass)
{
  const Contact c = contact_of(overlap, radius, mass);
  return with_normal(law, [&](const auto &normal) -> ContactSlopes {
    const Real a = normal.contact_radius(c), k = normal.tangent(c, a);
    if (law.is_classic()) {
      const Real scale = normal.uses_contact_radius() ? a : 1;
      return {{k, scale * mass * law.eta},
              {scale * law.k_tangent, scale * mass * law.gamma_tangent}};
    }
    const Real damping = GranularDamping{law.damping, law.eta}.coefficient(c, a, k * overlap);
    return {{std::max(k, pulling_slope(law, c)), damping},
            {granular_friction(law).stiffness(a), damping * law.xgammat}};
  });
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
  const Contact c = contact_of(overlap, radius, 0);
  const Real secant = with_normal(
      law, [&](const auto &normal) { return normal.secant(c, normal.contact_radius(c)); });
  switch (law.rolling.model) {
    case RollingModel::sds:
      return numbers[0] * radius * radius;
    case RollingModel::epsd2:
      return slopes_of(law, overlap, radius, 0).tangential.stiffness * radius * radius;
    case RollingModel::epsd:
      return 2.25 * secant * mu * mu * radius * radius;
    case RollingModel::epsd3:
      return numbers[2] * secant * mu * mu * radius * radius;
    default:
      return 0;
  }
}

}    // namespace lsdcd
