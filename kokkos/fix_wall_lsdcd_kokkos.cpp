// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "fix_wall_lsdcd_kokkos.h"

#include "host_kokkos.h"

#include "base/input_words.h"
#include "lammps/fix_massflow_lsdcd.h"
#include "lammps/host_fixes.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "lammps.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;

// What a step reads of atoms.
static constexpr std::uint64_t kReadOfSpheres =
    X_MASK | V_MASK | OMEGA_MASK | RADIUS_MASK | RMASS_MASK | MASK_MASK | TYPE_MASK;

template <class DeviceType>
FixWallLsdcdKokkos<DeviceType>::FixWallLsdcdKokkos(LAMMPS *lmp, int narg, char **arg) :
    FixWallLsdcd(
        lsdcd::with_atoms_on_cpu(lmp, arg[0], "wall/lsdcd", RADIUS_MASK | MASK_MASK | TYPE_MASK),
        narg, arg,
        lsdcd::WallBackend{
            [this](const lsdcd::EngineSettings &settings) { return make_engine(settings); }, true,
            [this](const lsdcd::HostSpheres &, lsdcd::CpuArrays arrays) { return to_cpu(arrays); }})
{
  atomKK = static_cast<AtomKokkos *>(atom);
  lsdcd::bring_no_atoms(*this, ExecutionSpaceFromDevice<DeviceType>::space);
  exchange_comm_device = sort_device = std::is_same<DeviceType, LMPDeviceType>::value;
}

// Called by the constructor of the plain fix, too, before members of this one are there.
template <class DeviceType>
std::unique_ptr<lsdcd::WallEngine>
FixWallLsdcdKokkos<DeviceType>::make_engine(const lsdcd::EngineSettings &settings)
{
  return lsdcd::make_engine_on<DeviceType>(settings);
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::need_on_cpu()
{
  atomKK->sync(Host, X_MASK | RADIUS_MASK | RMASS_MASK | MASK_MASK | TAG_MASK | TYPE_MASK);
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::need_masses()
{
  atomKK->sync(Host, RMASS_MASK);
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::need_positions()
{
  atomKK->sync(execution_space, X_MASK | MASK_MASK);
}

// To bring the tags of a million atoms takes a third of a millisecond, and the rest ten times as long.
template <class DeviceType>
lsdcd::HostSpheres FixWallLsdcdKokkos<DeviceType>::to_cpu(lsdcd::CpuArrays arrays)
{
  if (arrays == lsdcd::CpuArrays::tags)
    atomKK->sync(Host, TAG_MASK);
  else
    need_on_cpu();
  return spheres_in_atom();
}

// Does LAMMPS, or mass flow, pack atoms in a run? A process on its own packs none else.
template <class DeviceType>
bool FixWallLsdcdKokkos<DeviceType>::atoms_are_packed() const
{
  const std::vector<Fix *> fixes = lsdcd::host_fixes(*modify);
  return comm->nprocs > 1 || std::any_of(fixes.begin(), fixes.end(), [](const Fix *fix) {
           const auto *const flow = dynamic_cast<const FixMassflowLsdcd *>(fix);
           return flow && flow->deletes();
         });
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::make_exchange_room()
{
  if (wall->history().is_with_engine()) {
    // As the form without /kk, which a process takes that has its history on the CPU. Where no atom is packed, nobody need look at all.
    const int n = wall->history().spheres_of_engine();
    int largest = atoms_are_packed() ? wall->history().in_engine(n).largest_packed_size(n)
                                     : wall->history().max_packed_size();
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, world);
    ask_for_room(1 + largest);
    return;
  }
  FixWallLsdcd::make_exchange_room();
}

template <class DeviceType>
lsdcd::HostSpheres FixWallLsdcdKokkos<DeviceType>::spheres()
{
  lsdcd::HostSpheres s = spheres_in_atom();    // temperatures stay there
  if constexpr (lsdcd::kFloatAtoms) {
    s.x = s.v = s.omega = nullptr;
    s.radius = s.mass = nullptr;
    s.force = s.torque = nullptr;
    s.in_float = &float_spheres;
    put_atoms(float_spheres);
  } else {
    put_atoms(s);
  }
  if constexpr (lsdcd::kFloatForces)
    put_forces(float_spheres);
  else
    put_forces(s);
  if (rigid) s.mass = d_damping_mass.data();
  s.mask = igroup ? atomKK->k_mask.template view<DeviceType>().data() : nullptr;
  s.type = atomKK->k_type.template view<DeviceType>().data();
  return s;
}

// These put views of the atoms into spheres, or into those in float.
template <class DeviceType>
template <class To>
void FixWallLsdcdKokkos<DeviceType>::put_atoms(To &to)
{
  to.x = lsdcd::rows_of(atomKK->k_x.template view<DeviceType>());
  to.v = lsdcd::rows_of(atomKK->k_v.template view<DeviceType>());
  to.omega = lsdcd::rows_of(atomKK->k_omega.template view<DeviceType>());
  to.radius = atomKK->k_radius.template view<DeviceType>().data();
  to.mass = atomKK->k_rmass.template view<DeviceType>().data();
}
template <class DeviceType>
template <class To>
void FixWallLsdcdKokkos<DeviceType>::put_forces(To &to)
{
  to.force = lsdcd::rows_of(atomKK->k_f.template view<DeviceType>());
  to.torque = lsdcd::rows_of(atomKK->k_torque.template view<DeviceType>());
}

// LAMMPS calls pre_reverse() once the GPU has been given the forces between atoms, and before the next
// kernel, for which Kokkos may wait until they are done. Where a fix asks for the end of steps, Kokkos's integrators do not
// join two halves to one kernel; the wall has all that it writes before that.
template <class DeviceType>
int FixWallLsdcdKokkos<DeviceType>::setmask()
{
  return (FixWallLsdcd::setmask() & ~END_OF_STEP) | (lsdcd::kOnCpu<DeviceType> ? 0 : PRE_REVERSE);
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::write_files()
{
  if (wall->files_every() > 0 && update->ntimestep % wall->files_every() == 0) end_of_step();
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::setup(int vflag)
{
  lsdcd::bring_after_commands(lmp, execution_space, kReadOfSpheres);
  FixWallLsdcd::setup(vflag);
  if (rerun) write_files();
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::post_force(int vflag)
{
  FixWallLsdcd::post_force(vflag);
  write_files();
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::init()
{
  FixWallLsdcd::init();
  when = others_only_add() ? lsdcd::When::beside_adding_early : lsdcd::When::beside;
  if (lsdcd::kFloatAtoms) log_rounding();
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::post_run()
{
  FixWallLsdcd::post_run();
  atoms_of_inputs.look_again();
  if (lsdcd::kFloatAtoms) warn_of_rounding();
}

// Half a unit in the last of 24 places: what a number loses in float, as a share of it.
static constexpr double kFloatRounds = 1.0 / (1 << 24);

// The coordinate of the box that is farthest from 0.
static double farthest_coordinate(const Domain &domain)
{
  double most = 0;
  for (int d = 0; d < 3; d++)
    most = std::max({most, std::abs(domain.boxlo[d]), std::abs(domain.boxhi[d])});
  return most;
}

// A step that is shorter than what a position loses does not change it.
template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::log_rounding()
{
  if (rounding_logged || spec().brief) return;
  rounding_logged = true;
  const double most = farthest_coordinate(*domain), lost = kFloatRounds * most;
  log("atoms are in float (KOKKOS_PREC of this LAMMPS): positions up to " +
      lsdcd::number_text(most) + " from 0 are rounded by up to " + lsdcd::number_text(lost) +
      ", which is 1 % of an overlap of " + lsdcd::number_text(100 * lost) +
      ", and an atom there that is slower than " + lsdcd::number_text(lost / update->dt) +
      " stands still; contacts and forces are exact for the rounded positions");
}

// After a run its deepest overlap is known. That of most contacts is smaller.
template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::warn_of_rounding()
{
  double deepest = wall->deepest_overlap();
  MPI_Allreduce(MPI_IN_PLACE, &deepest, 1, MPI_DOUBLE, MPI_MAX, world);
  const double most = farthest_coordinate(*domain), lost = kFloatRounds * most;
  if (rounding_warned || deepest == 0 || lost <= 0.01 * deepest) return;
  rounding_warned = true;
  warn("atoms are in float (KOKKOS_PREC of this LAMMPS), which rounds positions up to " +
       lsdcd::number_text(most) + " from 0 by up to " + lsdcd::number_text(lost) + ": " +
       lsdcd::number_text(100 * lost / deepest) + " % of the deepest overlap of this run, " +
       lsdcd::number_text(deepest) +
       ", and more of others. Use a LAMMPS with KOKKOS_PREC double, a softer contact (a smaller "
       "kn), or a box around 0; this warning is shown once");
}

// Do fixes before this one in the script only add forces, or look at atoms, so that their order does not matter?
template <class DeviceType>
bool FixWallLsdcdKokkos<DeviceType>::others_only_add() const
{
  for (Fix *fix : lsdcd::host_fixes(*modify)) {
    if (fix == this) break;
    const std::string style = fix->style;
    const bool only_adds =
        style.rfind("gravity", 0) == 0 || style.rfind("wall/", 0) == 0 || style == "massflow/lsdcd";
    if ((modify->get_fix_mask(fix) & POST_FORCE) && !only_adds) return false;
  }
  return true;
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::begin_step(lsdcd::StepInput &input)
{
  atomKK->sync(execution_space, kReadOfSpheres);
  if (!lsdcd::kOnCpu<DeviceType> && input.step.kind == lsdcd::Step::step) input.when = when;
  wall->begin(spheres(), input);
}

// The GPU is at the forces between atoms, and finds the wall's beside them.
template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::pre_reverse(int /*eflag*/, int /*vflag*/)
{
  if (wall->step_state() != lsdcd::StepState::begun) return;
  const bool adds_early = when == lsdcd::When::beside_adding_early;
  if (adds_early) atomKK->sync(execution_space, F_MASK | TORQUE_MASK);
  wall->submit(spheres());
  if (adds_early) atomKK->modified(execution_space, F_MASK | TORQUE_MASK);
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::finish_step()
{
  const bool runs = wall->step_state() != lsdcd::StepState::none || !node_atoms.empty();
  if (runs) atomKK->sync(execution_space, kReadOfSpheres | F_MASK | TORQUE_MASK);
  FixWallLsdcd::finish_step();
  if (runs) atomKK->modified(execution_space, F_MASK | TORQUE_MASK);
}

// Nodes are read, and pushed, where LAMMPS's other styles have atoms.
template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::need_nodes()
{
  atomKK->sync(Host, X_MASK | V_MASK | MASK_MASK | TAG_MASK | IMAGE_MASK);
}

// The log says which variable makes a GPU's step long.
template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::need_inputs()
{
  atoms_of_inputs.bring(lmp, spec().inputs, [this](const std::string &name) {
    if (inputs_told.insert(name).second && !spec().brief)
      log("variable '" + name +
          "' may read atoms, so all are copied to LAMMPS's arrays on the CPU in each step that "
          "reads it");
  });
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::need_ids()
{
  atomKK->sync(Host, TAG_MASK);
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::add_node_forces()
{
  if (node_atoms.empty()) return;
  atomKK->modified(execution_space, F_MASK);
  atomKK->sync(Host, F_MASK);
  FixWallLsdcd::add_node_forces();
  atomKK->modified(Host, F_MASK);
  atomKK->sync(execution_space, F_MASK);
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::fill_masses()
{
  FixWallLsdcd::fill_masses();
  lsdcd::to_device(damping_mass, d_damping_mass);
}

template class LAMMPS_NS::FixWallLsdcdKokkos<LMPDeviceType>;
#if defined(LMP_KOKKOS_GPU)
template class LAMMPS_NS::FixWallLsdcdKokkos<LMPHostType>;
#endif
