// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Registers the styles of this library with the LAMMPS that loads this file; nothing else.

#include "lammps/plugin_styles.h"

extern "C" __attribute__((visibility("default"))) void lammpsplugin_init(void *lmp, void *handle,
                                                                         void *regfunc)
{
  if (lsdcd::host_matches(lmp)) lsdcd::add_plain_styles(lmp, handle, regfunc);
}
