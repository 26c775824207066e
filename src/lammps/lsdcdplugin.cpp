// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Registers the styles of this library with the LAMMPS that plugin_guard.cpp has let in; nothing else.

#include "lammps/plugin_styles.h"

extern "C" __attribute__((visibility("default"))) void lsdcd_add_styles(void *lmp, void *handle,
                                                                        void *regfunc)
{
  lsdcd::add_plain_styles(lmp, handle, regfunc);
}
