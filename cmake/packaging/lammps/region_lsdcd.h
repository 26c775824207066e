// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// For LAMMPS's list of styles: LSDCD.cmake.
#ifdef REGION_CLASS
// clang-format off
RegionStyle(mesh/lsdcd,GuardedRegion<RegionMeshLsdcd>);
// clang-format on
#else
#include "lammps/guarded_styles.h"
#include "lammps/region_mesh_lsdcd.h"
#endif
