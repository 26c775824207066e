// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "fix_gravity_lsdcd_kokkos.h"

#include "atom_masks.h"
#include "error.h"

#include <mpi.h>
#include <type_traits>

using namespace LAMMPS_NS;

template <class DeviceType>
FixGravityLsdcdKokkos<DeviceType>::FixGravityLsdcdKokkos(LAMMPS *lmp, int narg, char **arg) :
    FixGravity(lsdcd::with_atoms_on_cpu(lmp, arg[0], "gravity/lsdcd", EMPTY_MASK), narg, arg),
    atomKK(static_cast<AtomKokkos *>(atom))
{
  lsdcd::bring_no_atoms(*this, ExecutionSpaceFromDevice<DeviceType>::space);
  if (!variables().empty()) xacc = yacc = zacc = 0;    // until a run evaluates them
  if (!atom->rmass)
    error->all(FLERR,
               "Fix {} gravity/lsdcd/kk: atoms have no masses of their own (atom_style "
               "sphere): use fix gravity",
               id);
}

template <class DeviceType>
std::vector<std::string> FixGravityLsdcdKokkos<DeviceType>::variables() const
{
  std::vector<std::string> names;
  for (const char *name : {mstr, vstr, pstr, tstr, xstr, ystr, zstr})
    if (name) names.push_back(name);
  return names;
}

template <class DeviceType>
void FixGravityLsdcdKokkos<DeviceType>::post_run()
{
  FixGravity::post_run();
  atoms_of_variables.look_again();
}

template <class DeviceType>
void FixGravityLsdcdKokkos<DeviceType>::setup(int vflag)
{
  lsdcd::bring_after_commands(lmp, execution_space, RMASS_MASK | MASK_MASK);
  FixGravity::setup(vflag);
}

template <class DeviceType>
void FixGravityLsdcdKokkos<DeviceType>::post_force(int vflag)
{
  atoms_of_variables.bring(lmp, variables(), [](const std::string &) {});
  // With `disable` LAMMPS's fix only brings its acceleration up to date.
  const int was_disabled = disable;
  disable = 1;
  FixGravity::post_force(vflag);
  disable = was_disabled;
  if (!disable) add_forces(xacc, yacc, zacc);
}

template <class DeviceType>
void FixGravityLsdcdKokkos<DeviceType>::add_forces(double x, double y, double z)
{
  atomKK->sync(execution_space, F_MASK | RMASS_MASK | MASK_MASK);
  const auto f = atomKK->k_f.view<DeviceType>();
  const auto mass = atomKK->k_rmass.view<DeviceType>();
  const auto mask = atomKK->k_mask.view<DeviceType>();
  using Number = std::remove_const_t<std::remove_reference_t<decltype(mass(0))>>;
  using Force = std::remove_reference_t<decltype(f(0, 0))>;
  const Number g[3] = {static_cast<Number>(x), static_cast<Number>(y), static_cast<Number>(z)};
  const int bit = groupbit;
  Kokkos::parallel_for(
      Kokkos::RangePolicy<DeviceType>(0, atom->nlocal), KOKKOS_LAMBDA(const int i) {
        if (!(mask(i) & bit)) return;
        for (int d = 0; d < 3; d++) f(i, d) += static_cast<Force>(mass(i) * g[d]);
      });
  atomKK->modified(execution_space, F_MASK);
}

template <class DeviceType>
double FixGravityLsdcdKokkos<DeviceType>::own_energy() const
{
  atomKK->sync(execution_space, X_MASK | RMASS_MASK | MASK_MASK);
  const auto x = atomKK->k_x.view<DeviceType>();
  const auto mass = atomKK->k_rmass.view<DeviceType>();
  const auto mask = atomKK->k_mask.view<DeviceType>();
  const double gx = xacc, gy = yacc, gz = zacc;
  const int bit = groupbit;
  double energy = 0;
  Kokkos::parallel_reduce(
      Kokkos::RangePolicy<DeviceType>(0, atom->nlocal),
      KOKKOS_LAMBDA(const int i, double &sum) {
        if (mask(i) & bit) sum -= mass(i) * (gx * x(i, 0) + gy * x(i, 1) + gz * x(i, 2));
      },
      energy);
  return energy;
}

// The potential energy of all grains of the group, 0 at the origin.
template <class DeviceType>
double FixGravityLsdcdKokkos<DeviceType>::compute_scalar()
{
  double energy = disable ? 0 : own_energy();
  MPI_Allreduce(MPI_IN_PLACE, &energy, 1, MPI_DOUBLE, MPI_SUM, world);
  return energy;
}

template class LAMMPS_NS::FixGravityLsdcdKokkos<LMPDeviceType>;
#if defined(LMP_KOKKOS_GPU)
template class LAMMPS_NS::FixGravityLsdcdKokkos<LMPHostType>;
#endif
