// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// fix gravity/lsdcd/kk: LAMMPS's fix gravity on a Kokkos device. It computes the potential energy only when something asks
// for it; LAMMPS's gravity/kk adds it up in each step, so that the CPU has to wait.
#ifndef LMP_FIX_GRAVITY_LSDCD_KOKKOS_H
#define LMP_FIX_GRAVITY_LSDCD_KOKKOS_H

#include "host_kokkos.h"
#include "variable_reads.h"

#include "fix_gravity.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

template <class DeviceType>
class FixGravityLsdcdKokkos : public FixGravity {
 public:
  FixGravityLsdcdKokkos(class LAMMPS *, int narg, char **arg);

  void setup(int) override;
  void post_force(int) override;
  void post_run() override;
  double compute_scalar() override;

  // Public because nvcc takes no device lambda from a private function.
  void add_forces(double x, double y, double z);
  double own_energy() const;

 private:
  AtomKokkos *atomKK;
  lsdcd::VariableAtoms atoms_of_variables;

  std::vector<std::string> variables() const;
};

}    // namespace LAMMPS_NS

#endif
