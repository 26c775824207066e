// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Wear of the wall: how fast one contact removes material, per unit of the law's
// coefficient.
#pragma once

#include "law/contact.h"

namespace lsdcd {

enum class WearModel { none, archard, finnie };

struct Wear {
  WearModel model = WearModel::none;
  Real per_work = 0;    // volume per work: K/H (archard), K (finnie); 1/pressure
};

// The wearing power, to be multiplied by Wear::per_work. `force` is the contact's normal
// force (0 where it pulls), `slip` the speed of the sphere's surface along the wall's,
// v_normal > 0 and v_along the velocity of its centre away from the wall and along it.
//
// archard: F_n slip (Archard 1953, V = K F s/H). finnie: f(a) F_n v with the impact
// angle a, tan a = -v_normal/v_along, and f(a) = sin 2a - 3 sin^2 a up to tan a = 1/3,
// cos^2 a/3 above (Finnie 1960); nothing while the sphere leaves.
LSDCD_FN Real wear_power(WearModel model, Real force, Real slip, Real v_normal, Real v_along)
{
  if (model == WearModel::archard) return force * slip;
  if (!(v_normal < 0)) return 0;
  const Real v_sq = v_normal * v_normal + v_along * v_along, v = sqrt(v_sq);
  const Real sine = -v_normal / v, cosine = v_along / v;
  const Real f = 3 * sine < cosine ? 2 * sine * cosine - 3 * sine * sine : cosine * cosine / 3;
  return f * force * v;
}

}    // namespace lsdcd
