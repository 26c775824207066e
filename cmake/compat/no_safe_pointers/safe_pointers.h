// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// A header that variable.h of 2026 includes and that Debian's package leaves out. Of what
// it holds only a member of a class that we never touch is of that type.
#pragma once

#include <cstdio>

namespace LAMMPS_NS {
class SafeFilePtr {
  FILE *fp;
  bool use_pclose;
};
}    // namespace LAMMPS_NS
