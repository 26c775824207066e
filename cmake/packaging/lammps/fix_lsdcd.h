// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// For LAMMPS's list of styles: LSDCD.cmake.
#ifdef FIX_CLASS
// clang-format off
FixStyle(gravity/lsdcd,FixGravity);
FixStyle(insert/lsdcd,GuardedFix<FixInsertLsdcd>);
FixStyle(massflow/lsdcd,GuardedFix<FixMassflowLsdcd>);
FixStyle(SPRINGS/LSDCD,GuardedFix<FixSpringsLsdcd>);
FixStyle(wall/lsdcd,GuardedFix<FixWallLsdcd>);
// clang-format on
#else
#include "lammps/fix_insert_lsdcd.h"
#include "lammps/fix_massflow_lsdcd.h"
#include "lammps/fix_springs_lsdcd.h"
#include "lammps/fix_wall_lsdcd.h"
#include "lammps/guarded_styles.h"

#include "fix_gravity.h"
#endif
