// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What the force of a contact is made of, for the energy balance: parts() of a law returns it after evaluate(). A
// formula says its spring in terms of what a contact keeps, and nothing of what it dissipates.
#pragma once

#include "base/vec3.h"

#include <cstddef>

namespace lsdcd {

// A spring in one step. Its force (or torque) is -k ends.
struct SpringPart {
  // The displacement of the spring as the step took it over, and now: length (or radians).
  Vec3 begins = {0, 0, 0}, ends = {0, 0, 0};
  Real k = 0;    // 0: there is none
  // In a pair: whether the kept displacement is projected into the plane of the new normal. Otherwise it is turned into that plane, and
  // keeps its length.
  bool projected = false;

  LSDCD_FN Vec3 force() const { return -k * ends; }
  // Returns what the limit cuts off a path of the contact, of which the spring holds the rest.
  LSDCD_FN Vec3 cut_off(const Vec3 &path) const { return begins + path - ends; }
  // Returns whether `cut`, which cut_off() has returned, is more than rounding.
  LSDCD_FN bool is_cut(const Vec3 &cut, const Vec3 &path) const
  {
    constexpr Real kRounding = 1e-9;
    return norm(cut) > kRounding * (norm(path) + norm(begins));
  }
};

struct ForceParts {
  Real elastic;           // normal force without damping
  SpringPart friction;    // of the tangential force
  bool slides;            // friction without a spring is at its limit
  // In a law that leaves its spring what the limit and the dashpot do not balance, and whose stiffness varies: the dashpot of friction
  // alone is beyond the limit (force).
  bool dashpot_slides;
  Real limit;             // of friction; set only in such a law
  SpringPart rolling;     // of the contact torque across the normal
  Vec3 rolls;             // the angular velocity by which that spring turns
  SpringPart twisting;    // of the contact torque about the normal
};

// What a contact keeps of a step for the next one, which adds the second half of its work to the energy balance.
// Forces and torques act on the sphere; they and the stiffnesses are times the weight of the contact. Vectors are in
// the frame of the mesh.
struct KeptForces {
  Real held;                // elastic energy
  Real weight;              // of the contact among those that share an overlap
  Real elastic, damping;    // forces along the normal
  Real distance, arm;       // of the sphere's centre from the wall, and of friction: length
  Vec3 friction, friction_spring;            // the tangential force, and that of its spring
  Vec3 rolling, rolling_spring;              // contact torques across the normal
  Real twisting, twisting_spring;            // about it
  Real k_friction, k_rolling, k_twisting;    // stiffnesses of the springs, 0 without; kSlaved

  // In place of k_friction: the spring is no store of energy, because it only makes up for a dashpot that is beyond the limit. What it
  // would hold, F^2/2k, has no bound where k goes to 0. `friction_spring` is 0 then, and all that friction does is the slider's loss.
  static constexpr Real kSlaved = -1;
  LSDCD_FN bool is_slaved() const { return k_friction == kSlaved; }

  // Returns which of the numbers change sign if the spheres of a pair change places: the vectors.
  static constexpr unsigned flips() { return 0xfffu << 6; }
};
constexpr int kKeptForces = static_cast<int>(sizeof(KeptForces) / sizeof(Real));

// What a contact keeps in addition to KeptForces if nodes of a mesh move: springs turn with their feature, and KeptForces do not.
struct KeptAtNodes {
  Vec3 normal;      // of the forces
  Real share[3];    // of the nodes of its feature, which add up to 1
};
constexpr int kKeptAtNodes = static_cast<int>(sizeof(KeptAtNodes) / sizeof(Real));

// What a contact keeps in addition to KeptForces if walls list contacts: what it dissipates by each cause, in the order of EnergyRow from
// `damping` on.
constexpr int kLossCauses = 6;
constexpr int kListedCauses =
    5;    // of lists of contacts and rows of outputs; yielding, the last one, is apart
struct KeptLosses {
  Real power[kLossCauses];     // in the last step, energy/time
  Real energy[kLossCauses];    // since the contact began
  Real from;    // the number of the contact of the last step that goes on in it; -1: none
};
constexpr int kKeptLosses = static_cast<int>(sizeof(KeptLosses) / sizeof(Real));

// Returns the energy that a spring of this force and stiffness holds.
LSDCD_FN Real spring_energy(Real force_sq, Real k)
{
  return k > 0 ? 0.5 * force_sq / k : 0;
}

template <class Law>
LSDCD_FN Real springs_energy(const KeptForces &kept)
{
  Real sum = spring_energy(norm_sq(kept.friction_spring), kept.k_friction);
  if constexpr (Law::kContactTorque) {
    sum += spring_energy(norm_sq(kept.rolling_spring), kept.k_rolling);
    sum += spring_energy(kept.twisting_spring * kept.twisting_spring, kept.k_twisting);
  }
  return sum;
}

}    // namespace lsdcd
