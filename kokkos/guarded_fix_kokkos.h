// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Fixes that keep data of atoms on the device, as LAMMPS makes them: see lammps/guarded_styles.h.
#ifndef LMP_GUARDED_FIX_KOKKOS_H
#define LMP_GUARDED_FIX_KOKKOS_H

#include "host_kokkos.h"

#include "lammps/guarded_styles.h"

#include <cstring>

namespace LAMMPS_NS {

// A fix without data of atoms on the device. Restart files store its data under the name of its style, which is the same for all forms
// of the fix, so that each form can continue from the data of another one.
template <class Style>
class GuardedFixOnHost : public GuardedFix<Style> {
 public:
  using GuardedFix<Style>::GuardedFix;

  void post_constructor() override
  {
    GuardedFix<Style>::post_constructor();
    char *const suffix = std::strstr(this->style, "/kk");
    if (suffix) *suffix = 0;
  }
};

template <class Style>
class GuardedFixKokkos : public GuardedFixOnHost<Style> {
  using typename Style::BinOp, typename Style::KeyViewType;

 public:
  using GuardedFixOnHost<Style>::GuardedFixOnHost;

  void post_run() override
  {
    GuardedFix<Style>::post_run();
    lsdcd::leave_atoms_to_host(this->lmp);
  }

  // Packs the data of atoms that leave this process. It is called on one process, whatever the others do.
  int pack_exchange_kokkos(const int &n, lsdcd::ExchangeBuffer &buffer, DAT::tdual_int_1d which,
                           DAT::tdual_int_1d from, ExecutionSpace space) override
  {
    return this->run_core_here(
        [&] { return Style::pack_exchange_kokkos(n, buffer, which, from, space); });
  }
  void unpack_exchange_kokkos(lsdcd::ExchangeBuffer &buffer, DAT::tdual_int_1d &to, int n,
                              int n_first, int second, ExecutionSpace space) override
  {
    this->run_core_here(
        [&] { Style::unpack_exchange_kokkos(buffer, to, n, n_first, second, space); });
  }
  void sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &sorter) override
  {
    this->run_core_here([&] { Style::sort_kokkos(sorter); });
  }
};

}    // namespace LAMMPS_NS

#endif
