// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "law/contact_time.h"

#include "law/contact_slope.h"
#include "law/smallest_model.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

// Returns a contact whose overlap is this share of the radius.
Contact shallow_contact(Real radius, Real share = 0.01)
{
  Contact c = {};
  c.overlap = share * radius;
  c.radius = radius;
  return c;
}

}    // namespace

bool stiffens(const ContactLaw &law)
{
  const Contact c = shallow_contact(1), deeper = shallow_contact(1, 0.02);
  return with_normal(law, [&](const auto &normal) {
    return normal.tangent(deeper, normal.contact_radius(deeper)) >
           normal.tangent(c, normal.contact_radius(c));
  });
}

Real contact_time(const ContactLaw &law, Real mass, Real radius, Real ftm2v, Real inertia)
{
  const Contact c = shallow_contact(radius);
  const Real a = std::sqrt(c.overlap * radius);    // the contact's radius without adhesion
  const Real k =
      std::max(with_normal(law, [&](const auto &normal) { return normal.tangent(c, a); }),
               pulling_slope(law, c));
  const Real gamma = (law.is_classic() ? law.eta : 0) * (stiffens(law) ? a : 1);
  const Real omega_sq = ftm2v * k / mass, half = 0.5 * ftm2v * gamma;
  const Real damped_sq = omega_sq - half * half;
  const Real of_normal = kPi / std::sqrt(damped_sq > 0 ? damped_sq : omega_sq);
  if (!law.rolling.is_on()) return of_normal;
  if (inertia == 0) inertia = 0.4 * mass * radius * radius;
  const Real stiffness = ftm2v * rolling_stiffness(law, 0.01 * radius, radius);
  return std::min(of_normal, kPi / std::sqrt(stiffness / inertia));
}

HertzImpact hertz_impact(Real modulus, Real mass, Real radius, Real speed)
{
  // m v^2 / 2 = (8/15) E* sqrt(R) overlap^(5/2)
  const Real overlap =
      std::pow(15 * mass * speed * speed / (16 * modulus * std::sqrt(radius)), 0.4);
  // Twice the integral of 1 / sqrt(1 - x^(5/2)) from 0 to 1, a beta function: 2.9432.
  const Real constant = 0.8 * std::sqrt(kPi) * std::tgamma(0.4) / std::tgamma(0.9);
  return {overlap, constant * overlap / speed};
}

Real rayleigh_time(Real radius, Real density, Real youngs_modulus, Real poissons_ratio)
{
  const Real shear = youngs_modulus / (2 * (1 + poissons_ratio));
  return kPi * radius * std::sqrt(density / shear) / (0.1631 * poissons_ratio + 0.8766);
}

}    // namespace lsdcd
