// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The base class of input commands, for packages that ship LAMMPS's headers without it.
#pragma once

#include "pointers.h"

namespace LAMMPS_NS {

class Command : protected Pointers {
 public:
  explicit Command(class LAMMPS *lmp) : Pointers(lmp) {}
  virtual void command(int, char **) = 0;
};

}    // namespace LAMMPS_NS
