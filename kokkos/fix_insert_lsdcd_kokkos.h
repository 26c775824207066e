// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// fix insert/lsdcd/kk: the fix for a Kokkos LAMMPS. In steps that insert it copies all atoms to the host and back.
#ifndef LMP_FIX_INSERT_LSDCD_KOKKOS_H
#define LMP_FIX_INSERT_LSDCD_KOKKOS_H

#include "host_kokkos.h"

#include "lammps/fix_insert_lsdcd.h"

namespace LAMMPS_NS {

class FixInsertLsdcdKokkos : public FixInsertLsdcd {
 public:
  FixInsertLsdcdKokkos(class LAMMPS *lmp, int narg, char **arg) :
      FixInsertLsdcd(lsdcd::with_atoms_on_cpu(lmp, arg[0], "insert/lsdcd", EMPTY_MASK), narg, arg)
  {
    lsdcd::bring_no_atoms(*this, Host);
  }

  void pre_exchange() override
  {
    if (is_due()) lsdcd::run_on_host(lmp, [this] { FixInsertLsdcd::pre_exchange(); });
  }
};

}    // namespace LAMMPS_NS

#endif
