// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// fix wall/lsdcd/kk: the wall for a Kokkos LAMMPS, on the device that has the particles.
#ifndef LMP_FIX_WALL_LSDCD_KOKKOS_H
#define LMP_FIX_WALL_LSDCD_KOKKOS_H

#include "host_kokkos.h"
#include "variable_reads.h"

#include "lammps/fix_wall_lsdcd.h"

#include <set>
#include <string>

namespace LAMMPS_NS {

template <class DeviceType>
class FixWallLsdcdKokkos : public FixWallLsdcd, public KokkosBase {
 public:
  FixWallLsdcdKokkos(class LAMMPS *, int, char **);

  // schedule
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override { pre_exchange(); }
  void setup(int) override;
  void pre_reverse(int, int) override;
  void post_force(int) override;
  void post_run() override;

  // springs on the device
  int pack_exchange_kokkos(const int &, lsdcd::ExchangeBuffer &, DAT::tdual_int_1d,
                           DAT::tdual_int_1d, ExecutionSpace) override;
  void unpack_exchange_kokkos(lsdcd::ExchangeBuffer &, DAT::tdual_int_1d &, int, int, int,
                              ExecutionSpace) override;
  void sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &) override;

 protected:
  void begin_step(lsdcd::StepInput &) override;
  void finish_step() override;
  void fill_masses() override;
  void need_on_cpu() override;
  void need_masses() override;
  void need_positions() override;
  void need_nodes() override;
  void need_inputs() override;
  void need_ids() override;
  void add_node_forces() override;
  lsdcd::HostSpheres spheres() override;
  void make_exchange_room() override;

 private:
  std::unique_ptr<lsdcd::WallEngine> make_engine(const lsdcd::EngineSettings &);
  lsdcd::HostSpheres to_cpu(lsdcd::CpuArrays);
  void write_files();
  void log_rounding();
  void warn_of_rounding();
  bool others_only_add() const;
  bool atoms_are_packed() const;
  int pack_rows(int, const int *, const int *, double *);
  void unpack_rows(int, const int *, const double *);

  template <class To>
  void put_atoms(To &);
  template <class To>
  void put_forces(To &);

  Kokkos::View<double *, DeviceType> d_damping_mass;
  // When the wall does its step. If the fixes before this one only add forces, its forces are added
  // right after those between atoms.
  lsdcd::When when = lsdcd::When::beside;
  lsdcd::VariableAtoms atoms_of_inputs;
  std::set<std::string> inputs_told;    // inputs that the log has named
  // The arrays of spheres if atoms are in float:
  lsdcd::FloatSpheres float_spheres;
  bool rounding_logged = false, rounding_warned = false;
};

}    // namespace LAMMPS_NS

#endif
