// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// For LAMMPS's list of styles: LSDCD.cmake.
#ifdef PAIR_CLASS
// clang-format off
PairStyle(granular/lsdcd,GuardedPair<PairGranularLsdcd>);
// clang-format on
#else
#include "lammps/guarded_styles.h"
#include "lammps/pair_granular_lsdcd.h"
#endif
