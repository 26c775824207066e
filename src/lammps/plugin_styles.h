// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// What plugin files of this library share: the check of the host, and telling it styles.
#pragma once

#include "fix.h"

#include "lammps/plugin_api.h"

namespace lsdcd {

// LAMMPS's classes change their layout from version to version and nothing in the loader
// compares them: a plugin of another version would crash later. Says on the first process
// why it does not match. Touches no object of LAMMPS.
bool host_matches(void *lmp);

// Of a kind, "fix", "compute" or "region".
void add_style(const char *kind, void *lmp, void *handle, void *regfunc, const char *name,
               const char *info, lammpsplugin_factory2 *create);

// As LAMMPS reads it back: a pointer to the kind's own class.
template <class Base, class Style>
void *create_style(void *lmp, int narg, char **arg)
{
  Base *made = new Style(static_cast<LAMMPS_NS::LAMMPS *>(lmp), narg, arg);
  return made;
}
template <class Fix>
void *create_fix(void *lmp, int narg, char **arg)
{
  return create_style<LAMMPS_NS::Fix, Fix>(lmp, narg, arg);
}

// All that do not need Kokkos.
void add_plain_styles(void *lmp, void *handle, void *regfunc);

}    // namespace lsdcd
