// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// fix massflow/lsdcd/kk: the fix for a Kokkos LAMMPS, on the device that has the atoms. A kernel records the atoms whose path
// comes near a triangle; the CPU decides which of them have passed, when something asks for it.
#ifndef LMP_FIX_MASSFLOW_LSDCD_KOKKOS_H
#define LMP_FIX_MASSFLOW_LSDCD_KOKKOS_H

#include "host_kokkos.h"

#include "lammps/fix_massflow_lsdcd.h"

#include <optional>

namespace LAMMPS_NS {

class FixMassflowLsdcdKokkos : public FixMassflowLsdcd, public KokkosBase {
 public:
  FixMassflowLsdcdKokkos(class LAMMPS *, int, char **);

  int setmask() override;
  void init() override;
  void post_force(int) override;
  void pre_exchange() override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  double memory_usage() override;

  int pack_exchange_kokkos(const int &, lsdcd::ExchangeBuffer &, DAT::tdual_int_1d,
                           DAT::tdual_int_1d, ExecutionSpace) override;
  void unpack_exchange_kokkos(lsdcd::ExchangeBuffer &, DAT::tdual_int_1d &, int, int, int,
                              ExecutionSpace) override;
  void sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &) override;

  // Kernels use these names.
  using FixMassflowLsdcd::kToDelete;
  using DeviceSpace = LMPDeviceType;
#if defined(KOKKOS_ENABLE_CUDA)
  using SharedMemory = std::conditional_t<lsdcd::kOnCpu<LMPDeviceType>, Kokkos::HostSpace,
                                          Kokkos::CudaHostPinnedSpace>;
#else
  using SharedMemory = Kokkos::HostSpace;
#endif
  static constexpr int kRow = 4;    // numbers of an atom in messages
  // An atom that may have passed the surface between its place in the last step and its present one.
  struct Candidate {
    double step, time;
    lsdcd::Vec3 from, x, v;
    double mass, diameter;
    std::int64_t id;
    int i, type, mask;
    unsigned flags;
  };

 protected:
  void begin_at_atoms() override;
  void box_has_changed(const lsdcd::PeriodicBox &before) override;
  void look_at_atoms() override;
  void settle() override;
  unsigned &flags_of(int) override;

 private:
  // For each atom: its place when it was last checked, and flags.
  using Places = Kokkos::DualView<double *[3], Kokkos::LayoutRight, DeviceSpace>;
  using Flags = Kokkos::DualView<unsigned *, DeviceSpace>;
  Places places;
  Flags flags;

  Kokkos::View<lsdcd::Box *, DeviceSpace> things, around;    // boxes of the surface's tree
  std::optional<lsdcd::FlowBoxes> boxes;
  Kokkos::View<int *, DeviceSpace> near;
  int n_near = 0;
  Kokkos::View<int[2], DeviceSpace> counts;    // atoms near the surface, and candidates
  Kokkos::View<Candidate *, SharedMemory> found;
  int most_found = 0;         // the most candidates since they were counted
  bool may_delete = false;    // may this process have to delete an atom?

  void on_host();
  void change_on_host();
  void change_on_device();
  void run_kernel(const int *of, int n);
  void read_counts(int (&)[2]) const;
  void clear_counts();
  void count_found(int);
  bool deletes_on_device() const;
  void delete_on_device();
  double summed_mass(DAT::tdual_int_1d &);
  void pack_away(int, DAT::tdual_int_1d &, DAT::tdual_int_1d &);
};

}    // namespace LAMMPS_NS

#endif
