// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Masses of the spheres of a clump, whose sums are those of the clump.
#pragma once

#include "clump/ball.h"
#include "rigid/mass_properties.h"

#include <vector>

namespace lsdcd {

struct AtomMasses {
  std::vector<Real> mass;    // of each sphere, > 0
  // Mass, centre and inertia of the spheres as a program sums them that does not know of overlaps: of solid spheres with these
  // masses.
  MassProperties sums;
};

// Returns masses above 0 of spheres, whose sum is the mass of the clump and whose centre of mass is its centre (to 1e-12). Their
// inertia together, each as a solid sphere, is that of the clump where masses of 1e-6 of a sphere's share and more can have it, and near it
// elsewhere. Of all such masses they are the least far from shares by the spheres' volumes, in relative entropy
// (Kullback, Information Theory and Statistics, 1959): each is its share times the exponential of a function of its place and
// radius, which Newton's method finds. Throws InputError where no masses above 0 have this centre.
AtomMasses atom_masses(const std::vector<Ball> &balls, const MassProperties &clump);

}    // namespace lsdcd
