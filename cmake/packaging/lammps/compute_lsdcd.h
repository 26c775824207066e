// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// For LAMMPS's list of styles: LSDCD.cmake.
#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(lsdcd/collide,GuardedCompute<ComputeCollideLsdcd>);
ComputeStyle(lsdcd/energy,GuardedCompute<ComputeEnergyLsdcd>);
ComputeStyle(lsdcd/impacts,GuardedCompute<ComputeImpactsLsdcd>);
// clang-format on
#else
#include "lammps/compute_collide_lsdcd.h"
#include "lammps/compute_energy_lsdcd.h"
#include "lammps/compute_impacts_lsdcd.h"
#include "lammps/guarded_styles.h"
#endif
