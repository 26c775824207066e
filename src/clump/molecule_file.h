// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A clump as a molecule file of LAMMPS.
#pragma once

#include "clump/ball.h"
#include "rigid/mass_properties.h"

#include <string>
#include <vector>

namespace lsdcd {

// Returns the text of a file for the command molecule of LAMMPS: mass, centre and inertia of the clump in the header, and places,
// types, diameters and masses of its spheres. `type`: of its atoms. `about`: a line of text that says what it is, without an end.
//
// The inertia is about the centre along the axes of the file, in the order xx yy zz yz xz xy: so LAMMPS reads it, in 29Sep2021 as in
// 4Jul2026 (Molecule::compute_inertia() in src/molecule.cpp), where the page of the command has xy xz yz.
std::string molecule_text(const std::vector<Ball> &balls, const std::vector<Real> &masses,
                          const MassProperties &clump, int type, const std::string &about);

}    // namespace lsdcd
