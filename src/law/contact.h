// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Arguments and results of a contact law.
#pragma once

#include "base/vec3.h"

#include <cstdint>

namespace lsdcd {

// Enumerators of sub-models are as wide as a Real: vectors of the two have as many lanes.
using ModelNumber = std::int64_t;

// One contact of a sphere with a wall, or of two spheres, in one step.
struct Contact {
  static constexpr bool kPair = false;    // of two spheres?

  Vec3 normal;       // unit, wall -> centre
  Real overlap;      // length, > 0 where they touch
  Real radius;       // of the sphere; its effective radius against a wall
  Real mass;         // of the sphere, or of the rigid body it belongs to
  Real v_normal;     // length/time, > 0 when it moves away from the wall
  Vec3 v_tangent;    // length/time, of the sphere's surface at the contact
  Vec3 omega;        // 1/time, of the sphere; set only where the law has kContactTorque
  Real temperature_difference;    // wall less sphere; set only where it has kHeat
  Real dt;                        // time
  bool update;                    // false: springs act but do not move (setup)
};

// A contact of the spheres i and j, as sphere i sees it if j is taken for the wall: the normal points from j to i, velocities are those of
// i less those of j, forces and torques are on i. `radius` and `mass` are the reduced ones, Ri Rj/(Ri + Rj) and mi mj/(mi + mj). The law
// itself turns what a contact keeps with the normal.
struct PairContact : Contact {
  static constexpr bool kPair = true;
  Real radius_i, radius_j, mass_i, mass_j;
};

// A kept vector is turned only if its component along the normal is more than this share of its limit (as in LAMMPS).
constexpr Real kTurnFrom = 1e-10;

// Returns a vector that a pair keeps, turned into the tangent plane; the length stays. `stiff`: the factor that makes a force of the
// vector; `limit`: that of the force.
LSDCD_FN Vec3 turned_into_plane(const Vec3 &h, const Vec3 &normal, Real stiff, Real limit)
{
  const Real along = dot(h, normal);
  if (!(fabs(along) * stiff > kTurnFrom * limit)) return h;
  const Vec3 flat = h - along * normal;
  const Real length = norm(flat);
  return length > 0 ? (norm(h) / length) * flat : Vec3{0, 0, 0};
}

// Returns the part of a vector across the normal.
LSDCD_FN Vec3 in_plane(const Vec3 &h, const Vec3 &normal)
{
  return h - dot(h, normal) * normal;
}

// Returns whether the limit cuts a spring of this size. In a setup a spring that was cut in the last step is at the limit, to rounding.
LSDCD_FN bool is_cut(Real size, Real limit, const Contact &c)
{
  return c.update ? size > limit : size >= (1 - 1e-9) * limit;
}

struct ContactForce {
  Real normal;        // force along the normal, < 0 where it pulls
  Vec3 tangential;    // force on the sphere at the contact
  Real energy;        // elastic energy held
};

// Memory of a contact from step to step: a tangential spring and, with some laws, further
// numbers: first vectors in the tangent plane, then scalars.
template <int kExtra>
struct ContactMemory {
  static constexpr int kSize = kExtra;
  Vec3 shear;
  Real extra[kExtra];

  LSDCD_FN Vec3 vec(int at) const { return {extra[at], extra[at + 1], extra[at + 2]}; }
  LSDCD_FN void put(int at, const Vec3 &a)
  {
    for (int k = 0; k < 3; k++) extra[at + k] = a[k];
  }
};
template <>
struct ContactMemory<0> {
  static constexpr int kSize = 0;
  Vec3 shear;
};

}    // namespace lsdcd
