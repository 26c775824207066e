// fix wall/lsdcd/kk: the same wall where a Kokkos LAMMPS has its particles.
#ifndef LMP_FIX_WALL_LSDCD_KOKKOS_H
#define LMP_FIX_WALL_LSDCD_KOKKOS_H

#include "host_kokkos.h"

#include "lammps/fix_wall_lsdcd.h"

namespace LAMMPS_NS {

template <class DeviceType>
class FixWallLsdcdKokkos : public FixWallLsdcd, public KokkosBase {
 public:
  FixWallLsdcdKokkos(class LAMMPS *, int, char **);

  // schedule
  int setmask() override;
  void setup(int) override;
  void setup_pre_exchange() override { pre_exchange(); }
  void pre_exchange() override;
  void pre_force(int) override;
  void pre_reverse(int, int) override;
  void post_run() override;

  // springs on the host
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

#if LSDCD_DEVICE_EXCHANGE
  // springs on the device
  int pack_exchange_kokkos(const int &, lsdcd::ExchangeBuffer &, DAT::tdual_int_1d,
                           DAT::tdual_int_1d, ExecutionSpace) override;
  void unpack_exchange_kokkos(lsdcd::ExchangeBuffer &, DAT::tdual_int_1d &, int, int, int,
                              ExecutionSpace) override;
  void sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &) override;
#endif

 protected:
  void start() override;
  void collect() override;
  void fill_masses() override;
  double largest_radius() override;
  void need_on_host() override;
  void before_rebuild() override;
  tagint tag_of(int) override;

 private:
  lsdcd::ResidentEngine &resident()
  {
    return static_cast<lsdcd::ResidentEngine &>(*engine);
  }
  lsdcd::Spheres spheres();
  void choose_if_due(const lsdcd::Spheres &);
  bool list_keeps() const;
  void look();
  void prepare_springs();
  void springs_to_host();
  void springs_to_device();
  static bool sends_from_host(ExecutionSpace);
  int pack_rows(int, const int *, const int *, double *);
  void unpack_rows(int, const int *, const double *);

  enum class Where { host, device };
  Where springs_are = Where::host;
  int n_with_springs = 0;    // atoms whose springs are on the device

  bool list_is_old = true;
  bigint steps_run = 0, lists_made = 0;
  Kokkos::View<double *, DeviceType> d_mass_seen;
};

}    // namespace LAMMPS_NS

#endif
