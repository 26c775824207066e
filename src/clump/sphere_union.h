// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Volume, centre and inertia of spheres that overlap, each point counted once.
#pragma once

#include "clump/ball.h"
#include "rigid/mass_properties.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

// Removes each sphere that lies within another one, which adds nothing to the union; of equal ones the first stays. Returns how
// many it has removed. The others keep their order.
std::size_t remove_covered(std::vector<Ball> &balls);

struct SphereUnion {
  MassProperties properties;
  // By how much the volume may be off, over the volume: see union_of().
  Real error = 0;
};

// Returns mass, centre (length) and inertia about it (mass length^2) of the union of spheres of one density (mass / length^3).
// No sphere may lie within another one (remove_covered()), and there must be one at least.
//
// The divergence theorem makes surface integrals of these: of polynomials in the normal over the part of each sphere that no
// other one covers. There, at each height along the sphere's axis, the exposed arcs of a circle are known, and their integrals in
// closed form. Over heights they are integrated by Gauss and Legendre, from one height to the next at which an arc begins, ends
// or meets another one, and in halves where 8 and 16 points differ by more than 1e-10. `error` is the larger of two
// measures: the sum of these differences, and how far the surface is from closed, for which the integrals of x nx, y ny and z nz must each
// be the volume, and those of x ny and the like 0.
SphereUnion union_of(const std::vector<Ball> &balls, Real density);

// Returns the radius of the sphere about a point that has all spheres in it.
Real radius_around(const std::vector<Ball> &balls, const Vec3 &point);

}    // namespace lsdcd
