// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Forces of the levels of run_style respa: atom->f to those of a level, and back.
#ifndef LSDCD_HOST_RESPA_H
#define LSDCD_HOST_RESPA_H

#if __has_include("respa.h")
#include "respa.h"
#else
// LAMMPS does not install respa.h. These two functions have had this name since
// 2005 and no data of the class is touched. It may go when the oldest host that is
// built against (29Sep2021) installs respa.h with its other headers.
namespace LAMMPS_NS {
class Respa {
 public:
  void copy_f_flevel(int);
  void copy_flevel_f(int);
};
}    // namespace LAMMPS_NS
#endif

#endif
