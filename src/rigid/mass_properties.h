// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Mass, centre and inertia of a rigid body.
#pragma once

#include "mesh/welded_mesh.h"
#include "rigid/symmetric_matrix.h"

#include <string>

namespace lsdcd {

struct MassProperties {
  Real mass = 0;
  Vec3 centre = {0, 0, 0};    // of mass; length
  // About the centre, along the axes of the frame: mass length^2. Signs are those of fix rigid's file: xy is the
  // tensor's element, - integral of x y.
  SymmetricMatrix inertia;
};

// Returns a body of this density that fills a closed mesh. Its integrals are exact polynomials of the corners: tetrahedra
// of a point and each face (Eberly, Polyhedral Mass Properties, 2009). Inner shells are hollows. Either winding will do.
// Throws InputError, with the place of open edges, where the mesh does not bound a volume.
MassProperties mass_properties(const WeldedMesh &mesh, Real density);

// Throws InputError, which begins with `of`, where no body has such numbers: a mass or a principal moment that is not
// above 0, or a moment larger than the other two together (equal: a lamina); or where steps could not compute with them.
void check_mass_properties(const MassProperties &p, const std::string &of);

}    // namespace lsdcd
