// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Tangential friction, with and without a spring, limited by Coulomb's law.
#pragma once

#include "law/contact.h"
#include "law/force_parts.h"

namespace lsdcd {

enum class TangentialModel {
  linear_nohistory_classic,
  linear_history_classic,
  linear_nohistory,
  linear_nohistory_liggghts,
  linear_history,
  linear_history_slip,
  linear_history_liggghts,
  mindlin,
  mindlin_force,
  mindlin_slip,
  mindlin_liggghts,
  mindlin_rescale,
  mindlin_rescale_force
};

// Returns friction that grows with the slip velocity up to `limit`. `viscous`: force time/length.
LSDCD_FN Vec3 viscous_friction(const Vec3 &v_tangent, Real viscous, Real limit)
{
  const Real speed = norm(v_tangent);
  if (!(speed > 0)) return {0, 0, 0};
  const Real drag = viscous * speed;
  return (-(drag < limit ? drag : limit) / speed) * v_tangent;
}

// Returns whether this friction is less than what viscous_friction() returns without a limit.
LSDCD_FN bool is_below(const Vec3 &friction, Real viscous, const Vec3 &v_tangent)
{
  return norm(friction) < (1 - 1e-12) * viscous * norm(v_tangent);
}

// ---- the classic styles ------------------------------------------------------------------

// Viscous friction up to mu |F_normal| (`hooke`).
struct LinearNoHistory {
  static constexpr bool kHistory = false;
  Real gamma, mu;

  LSDCD_FN Vec3 force(const Contact &c, Real, Real f_normal, Vec3 &) const
  {
    return viscous_friction(c.v_tangent, c.mass * gamma, mu * fabs(f_normal));
  }
  LSDCD_FN Real energy(Real, const Vec3 &) const { return 0; }
};

// A spring and a dashpot in the tangent plane; where they exceed mu |F_normal|
// the spring is cut back to what the limit allows (`*/history`; Silbert et al.
// 2001). The shear displacement is moved with the contact where c.update is set.
struct LinearHistory {
  static constexpr bool kHistory = true;
  Real k, gamma, mu;

  LSDCD_FN Vec3 force(const Contact &c, Real scale, Real f_normal, Vec3 &shear) const
  {
    if (c.update) shear += c.dt * c.v_tangent;
    const Real stretched = norm(shear);
    if (c.update) shear -= dot(shear, c.normal) * c.normal;

    const Vec3 viscous = (c.mass * gamma) * c.v_tangent;
    const Vec3 f = -scale * (k * shear + viscous);
    const Real size = norm(f), limit = mu * fabs(f_normal);
    if (!(size > limit)) return f;
    if (!(stretched > 0)) return {0, 0, 0};
    const Real part = limit / size;
    if (c.update && k > 0) shear = part * (shear + (1 / k) * viscous) - (1 / k) * viscous;
    return part * f;
  }
  LSDCD_FN Real energy(Real scale, const Vec3 &shear) const
  {
    return 0.5 * scale * k * norm_sq(shear);
  }
};

// ---- the sub-models of `granular` --------------------------------------------------------
// a: the contact's radius. `damping`: the normal damping's coefficient (mass/time).

// `linear_nohistory` without a spring, else `linear_history`, or with `by_radius` `mindlin`, whose
// stiffness is proportional to the contact radius. `shear` is the displacement or, with `of_force`, the
// spring's force. With `rescale` it shrinks as the contact unloads (Thornton et al.
// 2013), for which the radius of the last step is stored. With `slip` it is cut alone. With `at_midpoint` the friction is
// that of LIGGGHTS: slip and force are those of the middle of the overlap, and sticking_force() is that of the spring.
struct GranularFriction {
  Real k, xgammat, mu;    // k: 0 where there is no spring
  bool spring, by_radius, of_force, rescale, slip, at_midpoint;

  LSDCD_FN Real stiffness(Real a) const { return by_radius ? k * a : k; }
  LSDCD_FN Vec3 slip_force(const Contact &c, Real damping, Real limit) const
  {
    return viscous_friction(c.v_tangent, xgammat * damping, limit);
  }
  // Shrinks the spring as the contact unloads. `a`: the contact radius; the scalar `at` of the memory is that of the last step.
  template <class Memory>
  LSDCD_FN void rescale_spring(Real a, Memory &m, int at) const
  {
    if (a < m.extra[at]) m.shear = (a / m.extra[at]) * m.shear;
    m.extra[at] = a;
  }
  template <class C, class Memory>
  LSDCD_FN Vec3 spring_force(const C &c, Real a, Real damping, Real limit, Memory &m) const
  {
    const Real stiff = stiffness(a);
    if constexpr (C::kPair)
      if (c.update) m.shear = turned_into_plane(m.shear, c.normal, of_force ? 1 : stiff, limit);
    if (c.update) m.shear += (of_force ? -stiff * c.dt : c.dt) * c.v_tangent;

    const Vec3 viscous = (-xgammat * damping) * c.v_tangent;
    if (slip) return cut_apart(stiff, viscous, limit, m);
    const Vec3 f = (of_force ? m.shear : -stiff * m.shear) + viscous;
    const Real size = norm(f);
    if (!(size > limit)) return f;
    if (!(norm_sq(m.shear) > 0)) return {0, 0, 0};
    const Vec3 cut = (limit / size) * f;
    if (of_force)
      m.shear = cut - viscous;
    else if (stiff > 0)
      m.shear = (-1 / stiff) * (cut - viscous);
    return cut;
  }
  // Returns the friction if the limit cuts the spring first, and then the sum. LAMMPS's form leaves the spring that gives the limit
  // together with the dashpot: in fast slip it is longer than the limit allows, or pulls along the slip.
  template <class Memory>
  LSDCD_FN Vec3 cut_apart(Real stiff, const Vec3 &viscous, Real limit, Memory &m) const
  {
    const Real pull = stiff * norm(m.shear);
    if (pull > limit) m.shear = (limit / pull) * m.shear;
    const Vec3 f = -stiff * m.shear + viscous;
    const Real size = norm(f);
    return size > limit ? (limit / size) * f : f;
  }
  // Returns the friction of LIGGGHTS (`tangential history`): the limit cuts the spring, and the dashpot acts only while the spring is not
  // cut.
  template <class C, class Memory>
  LSDCD_FN Vec3 sticking_force(const C &c, Real a, Real damping, Real limit, Memory &m) const
  {
    const Real stiff = stiffness(a);
    if (c.update) m.shear += c.dt * c.v_tangent;
    if constexpr (C::kPair)
      if (c.update) m.shear -= dot(m.shear, c.normal) * c.normal;
    const Real pull = stiff * norm(m.shear);
    if (pull > limit) m.shear = (limit / pull) * m.shear;
    const Vec3 f = -stiff * m.shear;
    return is_cut(pull, limit, c) ? f : f - (xgammat * damping) * c.v_tangent;
  }
  // Returns whether the limit leaves a spring that pulls along the slip where the dashpot alone is beyond it, while the stiffness varies.
  LSDCD_FN bool may_slave_spring() const { return spring && by_radius && !slip && !at_midpoint; }
  // Returns the spring of a step with the memory before and after it. `at`, `limit`: of rescale_spring() and spring_force().
  template <class C, class Memory>
  LSDCD_FN SpringPart part(const C &c, Real a, const Memory &begun, const Memory &now,
                           [[maybe_unused]] int at, [[maybe_unused]] Real limit) const
  {
    const Real stiff = stiffness(a);
    Vec3 begins = begun.shear;
    if constexpr (Memory::kSize > 0)
      if (rescale && a < begun.extra[at]) begins = (a / begun.extra[at]) * begins;
    if constexpr (C::kPair)
      if (c.update)
        begins = at_midpoint ? in_plane(begins, c.normal)
                             : turned_into_plane(begins, c.normal, of_force ? 1 : stiff, limit);
    if (!of_force) return {begins, now.shear, stiff, at_midpoint};
    if (!(stiff > 0)) return {};
    return {(-1 / stiff) * begins, (-1 / stiff) * now.shear, stiff, false};
  }
  template <class Memory>
  LSDCD_FN Real energy(Real a, const Memory &m) const
  {
    const Real stiff = stiffness(a), sq = norm_sq(m.shear);
    return of_force ? (stiff > 0 ? 0.5 * sq / stiff : 0) : 0.5 * stiff * sq;
  }
};

}    // namespace lsdcd
