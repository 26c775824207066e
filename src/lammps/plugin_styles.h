// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Tells LAMMPS the styles of a plugin. plugin_guard.cpp has asked LAMMPS before whether they fit.
#pragma once

#include "lammps/guarded_styles.h"
#include "lammps/plugin_api.h"

namespace lsdcd {

// Adds a style of a kind, "fix", "compute" or "region".
void add_style(const char *kind, void *lmp, void *handle, void *regfunc, const char *name,
               const char *info, lammpsplugin_factory2 *create);
// Adds a pair style.
void add_pair_style(void *lmp, void *handle, void *regfunc, const char *name, const char *info,
                    lammpsplugin_factory1 *create);

// Makes a style. LAMMPS reads the result as a pointer to the kind's own class.
template <class Base, class Guarded>
void *create_style(void *lmp, int narg, char **arg)
{
  Base *made = new Guarded(static_cast<LAMMPS_NS::LAMMPS *>(lmp), narg, arg);
  return made;
}
template <class Guarded>
void *create_fix(void *lmp, int narg, char **arg)
{
  return create_style<LAMMPS_NS::Fix, Guarded>(lmp, narg, arg);
}
template <class Guarded>
void *create_pair(void *lmp)
{
  LAMMPS_NS::Pair *made = new Guarded(static_cast<LAMMPS_NS::LAMMPS *>(lmp));
  return made;
}

// Adds all styles that do not need Kokkos.
void add_plain_styles(void *lmp, void *handle, void *regfunc);

}    // namespace lsdcd
