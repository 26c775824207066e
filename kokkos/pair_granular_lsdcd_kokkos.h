// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// pair_style granular/lsdcd/kk: the pair style for a Kokkos LAMMPS, on the device that has the atoms. It only passes pointers;
// src/pair does the work.
#ifndef LMP_PAIR_GRANULAR_LSDCD_KOKKOS_H
#define LMP_PAIR_GRANULAR_LSDCD_KOKKOS_H

#include "host_kokkos.h"

#include "lammps/pair_granular_lsdcd.h"
#include "pair/pair_engine.h"

namespace LAMMPS_NS {

template <class DeviceType>
class PairGranularLsdcdKokkos : public PairGranularLsdcd {
 public:
  explicit PairGranularLsdcdKokkos(class LAMMPS *);

  void init_style() override;
  void compute(int, int) override;
  double memory_usage() override;

  bool has_larger();    // public for nvcc

 protected:
  std::string springs_style() const override;
  void request_list() override;
  std::vector<double> kept_numbers(int, int) override;
  bool lists_are_by_types() const override
  {
    return full || PairGranularLsdcd::lists_are_by_types();
  }

 private:
  void check_radii_where_they_are();
  void share_atoms_of_host();
  lsdcd::PairInput step();
  void tally(const double *sums);

  class AtomKokkos *atomKK;
  std::unique_ptr<lsdcd::PairEngine> engine;
  bool full = false;    // lists have each pair twice, and no two threads add to one force
  Kokkos::View<double *, DeviceType>
      d_masses;    // masses of atoms, or of the rigid bodies that they belong to
  Kokkos::View<double *, DeviceType> d_limits, d_listed;
  std::vector<double> of_grains;
};

// The style for scripts with granular and -sf kk, if LAMMPS has no granular/kk.
template <class DeviceType>
class PairAsGranularKokkos : public PairGranularLsdcdKokkos<DeviceType> {
 public:
  explicit PairAsGranularKokkos(class LAMMPS *lmp) : PairGranularLsdcdKokkos<DeviceType>(lmp)
  {
    this->log("stands for granular/kk, which this LAMMPS does not have");
  }
};

}    // namespace LAMMPS_NS

#endif
