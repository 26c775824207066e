// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "pair_granular_lsdcd_kokkos.h"

#include "fix_springs_lsdcd_kokkos.h"

#include "force.h"
#include "neigh_list_kokkos.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

template <class DeviceType>
PairGranularLsdcdKokkos<DeviceType>::PairGranularLsdcdKokkos(LAMMPS *lmp) :
    PairGranularLsdcd(lmp), atomKK(static_cast<AtomKokkos *>(atom))
{
  if (!lmp->kokkos)
    fatal("LAMMPS runs without Kokkos: start it with -k on, or use granular/lsdcd without /kk");
  if (lsdcd::kFloatAtoms)
    fatal("atoms are in float (KOKKOS_PREC of this LAMMPS), and forces between grains are computed "
          "in double: use a LAMMPS with "
          "KOKKOS_PREC double, or write 'suffix off' before pair_style granular/lsdcd");
  kokkosable = 1;
  execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  datamask_read = datamask_modify = EMPTY_MASK;    // each place names what it reads and changes
  engine = lsdcd::make_pair_engine_on<DeviceType>();
}

template <class DeviceType>
std::string PairGranularLsdcdKokkos<DeviceType>::springs_style() const
{
  return std::is_same<DeviceType, LMPDeviceType>::value ? "SPRINGS/LSDCD/KK/DEVICE"
                                                        : "SPRINGS/LSDCD/KK/HOST";
}

template <class DeviceType>
void PairGranularLsdcdKokkos<DeviceType>::init_style()
{
  atomKK->sync(Host, TAG_MASK | RADIUS_MASK | RMASS_MASK | TYPE_MASK | MASK_MASK);
  full = lmp->kokkos->neighflag == FULL;
  PairGranularLsdcd::init_style();
  if (has_impacts())
    fatal("compute lsdcd/impacts records impacts between grains that the CPU computes without "
          "Kokkos: write 'suffix off' before pair_style granular/lsdcd");
  lsdcd::to_device(limits, d_limits);
  if (has_heat && !lsdcd::kOnCpu<DeviceType>)
    fatal("the sub-model heat does not work for atoms on a GPU, where LAMMPS keeps no temperature: "
          "write 'suffix off' before "
          "pair_style granular/lsdcd, or use granular/lsdcd/kk/host");
  if (springs) static_cast<FixSpringsLsdcdKokkos<DeviceType> *>(springs)->engine = engine.get();
  engine->set_laws({numbers, law_of, n_types + 1, kept_width(), kept,
                    springs && static_cast<FixSpringsLsdcdKokkos<DeviceType> *>(springs)->by_law});
}

template <class DeviceType>
void PairGranularLsdcdKokkos<DeviceType>::request_list()
{
  if (full)
    neighbor->add_request(this, NeighConst::REQ_FULL);
  else
    PairGranularLsdcd::request_list();
  NeighRequest *const request = neighbor->find_request(this);
  constexpr bool device = std::is_same<DeviceType, LMPDeviceType>::value;
  request->set_kokkos_host(!device);
  request->set_kokkos_device(device);
}

// Returns whether an atom is larger than lists hold it; where these are new it is listed.
template <class DeviceType>
bool PairGranularLsdcdKokkos<DeviceType>::has_larger()
{
  const int n = atom->nlocal;
  const bool are_new = neighbor->ago == 0;
  if (are_new && d_listed.extent(0) < std::size_t(n))
    d_listed = decltype(d_listed)("lsdcd:listed", lsdcd::with_spare(n));
  const auto radius = atomKK->k_radius.template view<DeviceType>();
  const auto type = atomKK->k_type.template view<DeviceType>();
  const auto mask = atomKK->k_mask.template view<DeviceType>();
  const auto limit = d_limits, listed = d_listed;
  const int bit = frozen;
  const double spare = neighbor->skin / 4;
  int larger = 0;
  Kokkos::parallel_reduce(
      Kokkos::RangePolicy<DeviceType>(0, n),
      KOKKOS_LAMBDA(const int i, int &sum) {
        if (are_new) listed(i) = radius(i);
        if (radius(i) > spare + listed(i) ||
            radius(i) > spare + limit(2 * type(i) + (mask(i) & bit ? 1 : 0)))
          sum++;
      },
      larger);
  return larger > 0;
}

// Radii stay on the device, unless fix adapt changes them on the host.
template <class DeviceType>
void PairGranularLsdcdKokkos<DeviceType>::check_radii_where_they_are()
{
  if (!radii_are_due()) return;
  atomKK->sync(execution_space, RADIUS_MASK | TYPE_MASK | MASK_MASK);
  if (!adapts && !has_larger()) return;
  atomKK->sync(Host, RADIUS_MASK | TYPE_MASK | MASK_MASK | TAG_MASK);
  if (!adapts) lsdcd::from_device(d_listed, atom->nlocal, listed_radius);
  check_radii();
}

// LAMMPS sends them to ghost atoms on the host.
template <class DeviceType>
void PairGranularLsdcdKokkos<DeviceType>::share_atoms_of_host()
{
  if (!ghosts_are_due()) return;
  atomKK->sync(Host, TYPE_MASK | RADIUS_MASK | RMASS_MASK);
  execution_space = Host;
  share_atoms();
  execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  if (atoms_changed()) atomKK->modified(Host, TYPE_MASK | RADIUS_MASK | RMASS_MASK);
  if (rigid) lsdcd::to_device(masses, d_masses);
}

template <class DeviceType>
lsdcd::PairInput PairGranularLsdcdKokkos<DeviceType>::step()
{
  lsdcd::PairInput s;
  if constexpr (!lsdcd::kFloatAtoms) {
    s.x = lsdcd::rows_of(atomKK->k_x.template view<DeviceType>());
    s.v = lsdcd::rows_of(atomKK->k_v.template view<DeviceType>());
    s.omega = lsdcd::rows_of(atomKK->k_omega.template view<DeviceType>());
    s.radius = atomKK->k_radius.template view<DeviceType>().data();
    s.mass = rigid ? d_masses.data() : atomKK->k_rmass.template view<DeviceType>().data();
    s.force = lsdcd::rows_of(atomKK->k_f.template view<DeviceType>());
    s.torque = lsdcd::rows_of(atomKK->k_torque.template view<DeviceType>());
  }
  s.type = atomKK->k_type.template view<DeviceType>().data();
  if (frozen) s.mask = atomKK->k_mask.template view<DeviceType>().data();
  s.frozen = frozen;
  if (has_heat) {
    s.temperature = atom->temperature;
    s.heat = atom->heatflow;
  }
  s.n_own = atom->nlocal;
  s.n_all = atom->nlocal + atom->nghost;
  s.both_sides = force->newton_pair && !full;
  const auto &neighbors = *static_cast<NeighListKokkos<DeviceType> *>(list);
  s.list.rows = list->inum;
  s.list.grain = neighbors.d_ilist.data();
  s.list.length = neighbors.d_numneigh.data();
  s.list.neighbor = neighbors.d_neighbors.data();
  s.list.row = static_cast<std::ptrdiff_t>(neighbors.d_neighbors.stride(0));
  s.list.place = static_cast<std::ptrdiff_t>(neighbors.d_neighbors.stride(1));
  s.list.longest = static_cast<int>(neighbors.d_neighbors.extent(1));
  s.list.mask = NEIGHMASK;
  s.list.factor_shift = SBBITS;
  s.list.full = full;
  std::copy_n(force->special_lj, 4, s.factor);
  s.dt = time_step();
  s.update = time_passes();
  return s;
}

template <class DeviceType>
void PairGranularLsdcdKokkos<DeviceType>::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  check_radii_where_they_are();
  share_atoms_of_host();
  atomKK->sync(execution_space, X_MASK | V_MASK | OMEGA_MASK | RADIUS_MASK | RMASS_MASK |
                                    TYPE_MASK | MASK_MASK | F_MASK | TORQUE_MASK);
  const lsdcd::PairInput now = step();
  if (kept_width() > 0)
    static_cast<FixSpringsLsdcdKokkos<DeviceType> *>(springs)->begin_step(now.list, atoms_changed(),
                                                                          force->newton_pair);
  double sums[lsdcd::kPairSums];
  engine->run(now, evflag ? sums : nullptr);
  if (books) {
    lsdcd::EnergyRows rows;
    engine->book(rows);
    add_booked(rows, !now.update, now.dt);
  }
  atomKK->modified(execution_space, F_MASK | TORQUE_MASK);
  if (evflag) tally(sums);
}

template <class DeviceType>
void PairGranularLsdcdKokkos<DeviceType>::tally(const double *sums)
{
  if (eflag_global) eng_vdwl += sums[0];
  if (vflag_global)
    for (int k = 0; k < 6; k++) virial[k] += sums[1 + k];
  if (!eflag_atom && !vflag_atom) return;
  const int n = atom->nlocal + (force->newton_pair && !full ? atom->nghost : 0);
  engine->sums_of_grains(n, of_grains);
  for (int i = 0; i < n; i++) {
    if (eflag_atom) eatom[i] += of_grains[i];
    if (vflag_atom)
      for (int k = 0; k < 6; k++) vatom[i][k] += of_grains[std::size_t(1 + k) * n + i];
  }
}

template <class DeviceType>
std::vector<double> PairGranularLsdcdKokkos<DeviceType>::kept_numbers(int i, int j)
{
  if (kept_width() == 0) return {};
  return static_cast<FixSpringsLsdcdKokkos<DeviceType> *>(springs)->numbers_of(i, j);
}

template <class DeviceType>
double PairGranularLsdcdKokkos<DeviceType>::memory_usage()
{
  const double springs_too = PairGranularLsdcd::memory_usage();
  return springs_too + (springs ? 0.0 : static_cast<double>(engine->bytes()));
}

template class LAMMPS_NS::PairGranularLsdcdKokkos<LMPDeviceType>;
#if defined(LMP_KOKKOS_GPU)
template class LAMMPS_NS::PairGranularLsdcdKokkos<LMPHostType>;
#endif
