// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// fix wall/lsdcd/kk as LAMMPS makes it: see lammps/guarded_styles.h.
#ifndef LMP_GUARDED_FIX_KOKKOS_H
#define LMP_GUARDED_FIX_KOKKOS_H

#include "fix_wall_lsdcd_kokkos.h"

#include "lammps/guarded_styles.h"

namespace LAMMPS_NS {

template <class DeviceType>
class GuardedFixKokkos : public GuardedFix<FixWallLsdcdKokkos<DeviceType>> {
  using Style = FixWallLsdcdKokkos<DeviceType>;

 public:
  GuardedFixKokkos(class LAMMPS *lmp, int narg, char **arg) : GuardedFix<Style>(lmp, narg, arg) {}

  // On one process, whatever the others do.
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
  void sort_kokkos(Kokkos::BinSort<KokkosBase::KeyViewType, KokkosBase::BinOp> &sorter) override
  {
    this->run_core_here([&] { Style::sort_kokkos(sorter); });
  }
};

}    // namespace LAMMPS_NS

#endif
