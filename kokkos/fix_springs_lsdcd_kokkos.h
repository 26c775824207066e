// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// fix SPRINGS/LSDCD/KK: stores what pairs of granular/lsdcd/kk keep where a Kokkos LAMMPS has its atoms. The partners of the plain fix
// are filled only for restart files, and where LAMMPS moves atoms on the host.
#ifndef LMP_FIX_SPRINGS_LSDCD_KOKKOS_H
#define LMP_FIX_SPRINGS_LSDCD_KOKKOS_H

#include "host_kokkos.h"

#include "lammps/fix_springs_lsdcd.h"
#include "pair/pair_engine.h"

namespace LAMMPS_NS {

template <class DeviceType>
class PairGranularLsdcdKokkos;

template <class DeviceType>
class FixSpringsLsdcdKokkos : public FixSpringsLsdcd, public KokkosBase {
 public:
  FixSpringsLsdcdKokkos(class LAMMPS *, int, char **);

  void set_arrays(int) override;
  double memory_usage() override;

  int pack_exchange_kokkos(const int &, lsdcd::ExchangeBuffer &, DAT::tdual_int_1d,
                           DAT::tdual_int_1d, ExecutionSpace) override;
  void unpack_exchange_kokkos(lsdcd::ExchangeBuffer &, DAT::tdual_int_1d &, int, int, int,
                              ExecutionSpace) override;
  void sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &) override;

 protected:
  void set_laws(int width, int for_energy, const std::string &kinds,
                const LawsOfTypes &laws) override;
  bool note_types() override;
  void collect() override;
  void forget() override;
  int largest_packed_size() const override;
  lsdcd::Partners &of_atoms() override;
  const tagint *tags() override;
  const double *radii() override;

 private:
  friend class PairGranularLsdcdKokkos<DeviceType>;
  // Prepares for a step of the pairs in this list, as begin_step() of the plain fix does.
  void begin_step(const lsdcd::PairRows &list, bool types_changed, bool newton);
  // Returns what the pair keeps, with signs as atom i sees it; empty: the pair does not touch.
  std::vector<double> numbers_of(int i, int j);

  lsdcd::ListedGrains grains();
  void need_on_device(int n_atoms);

  class AtomKokkos *atomKK;
  lsdcd::PairEngine *engine = nullptr;    // of the pair style, which exists as long as this fix
  lsdcd::PairRows rows;                   // of the last step
  bool ghosts_too = false;                // numbers are kept for ghost atoms, too
  bool on_device = false;                 // the engine has the partners; else the plain fix has
  bool shown = false;                     // the partners are those of the pairs of the last step
};

}    // namespace LAMMPS_NS

#endif
