// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// What a pair style asks of LAMMPS whose headers a package does not install.
#ifndef LSDCD_HOST_PAIRS_H
#define LSDCD_HOST_PAIRS_H

namespace LAMMPS_NS {
class Neighbor;
class Pair;
class Update;
}    // namespace LAMMPS_NS

namespace lsdcd {

// Asks for a half list of the pair style. `by_radii`: pairs are those within the sum of their radii and the skin; else within
// the cutoff of their types. `instance`: of the pair style. Throws InputError where LAMMPS is not as it is known.
void request_half_list(LAMMPS_NS::Neighbor &neighbor, LAMMPS_NS::Pair *pair, int instance,
                       bool by_radii);

// Returns the timestep of a level of run_style respa. Throws InputError as above.
double step_of_level(const LAMMPS_NS::Update &update, int level);

}    // namespace lsdcd

#endif
