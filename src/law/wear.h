// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Wear of the wall: how fast one contact removes material, per unit of the law's
// coefficient.
#pragma once

#include "law/contact.h"
#include "law/force_parts.h"

namespace lsdcd {

enum class WearModel { none, archard, finnie, oka };

// The numbers of oka, which is a law of one impact: the volume E90 g(a) (v/v')^k2 (D/D')^k3 comes off for each mass of grains that
// strike at the speed v under the angle a, of the diameter D (Oka, Okamura and Yoshida 2005).
struct OkaWear {
  // Of the wall (Vickers), GPa in all units, as n1 and n2 are fitted for these.
  Real hardness = 0;
  Real n1 = 0, n2 = 0;             // g(a) = (sin a)^n1 (1 + hardness (1 - sin a))^n2
  Real k2 = 0, k3 = 0;             // exponents of speed and diameter
  Real speed = 1, diameter = 1;    // v' and D', at which E90 was measured (length/time, length)
  // Impacts that are not faster along the normal wear nothing (length/time).
  Real least_speed = 0;
};

struct Wear {
  WearModel model = WearModel::none;
  // Volume per work: K/H (archard), K (finnie); 1/pressure. Of oka E90: volume per mass.
  Real per_work = 0;
  OkaWear oka = {};
};

// Returns what oka wears off over E90 and the mass of the sphere, which strikes with these speeds of its centre towards the wall (above 0)
// and along it.
LSDCD_FN Real oka_share(const OkaWear &oka, Real towards, Real along, Real diameter)
{
  const Real v = sqrt(towards * towards + along * along), sine = towards / v;
  return pow(sine, oka.n1) * pow(1 + oka.hardness * (1 - sine), oka.n2) *
         pow(v / oka.speed, oka.k2) * pow(diameter / oka.diameter, oka.k3);
}

// Returns the wearing power of finnie, to be multiplied by Wear::per_work: f(a) F_n v with the impact angle a, tan a =
// -v_normal/v_along, and f(a) = sin 2a - 3 sin^2 a up to tan a = 1/3, cos^2 a/3 above (Finnie 1960); nothing while the sphere
// leaves. `force` is the contact's normal force (0 where it pulls), v_normal > 0 and v_along the velocity of its centre away from
// the wall and along it.
LSDCD_FN Real finnie_power(Real force, Real v_normal, Real v_along)
{
  if (!(v_normal < 0)) return 0;
  const Real v_sq = v_normal * v_normal + v_along * v_along, v = sqrt(v_sq);
  const Real sine = -v_normal / v, cosine = v_along / v;
  const Real f = 3 * sine < cosine ? 2 * sine * cosine - 3 * sine * sine : cosine * cosine / 3;
  return f * force * v;
}

// Returns the speed (length/time) at which surfaces slip beyond the spring of friction: surfaces that stick move as far as it
// stretches, and wear nothing. Without a spring it is all of the tangential speed. Times F_n it is the wearing power of archard
// (Archard 1953, V = K F_n s/H). `begun`, `now`: the contact's memory before and after evaluate().
template <class Law, class Memory>
LSDCD_FN Real slip_speed([[maybe_unused]] const Law &law, const Contact &c,
                         [[maybe_unused]] const Memory &begun, [[maybe_unused]] const Memory &now)
{
  if constexpr (Law::kHistory) {
    const SpringPart spring = law.friction_spring(c, begun, now);
    if (spring.k > 0 && c.dt > 0) {
      const Vec3 path = c.dt * c.v_tangent, cut = spring.cut_off(path);
      return spring.is_cut(cut, path) ? norm(cut) / c.dt : 0;
    }
  }
  return norm(c.v_tangent);
}

}    // namespace lsdcd
