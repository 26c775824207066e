#include "fix_wall_lsdcd_kokkos.h"

#include "comm.h"
#include "error.h"
#include "group.h"
#include "lammps.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <string>

using namespace LAMMPS_NS;
using namespace FixConst;

static AtomKokkos *kokkos_atoms(Atom *atom)
{
  return static_cast<AtomKokkos *>(atom);
}

// The plain fix looks at atoms as soon as it is made.
static LAMMPS *with_atoms_on_host(LAMMPS *lmp, const char *id)
{
  if (!lmp->kokkos)
    lmp->error->all(FLERR, "Fix " + std::string(id) +
                               " wall/lsdcd/kk: LAMMPS runs without Kokkos: "
                               "start it with -k on, or use wall/lsdcd");
  kokkos_atoms(lmp->atom)->sync(Host, RADIUS_MASK | MASK_MASK);
  return lmp;
}

template <class DeviceType>
FixWallLsdcdKokkos<DeviceType>::FixWallLsdcdKokkos(LAMMPS *lmp, int narg, char **arg) :
    FixWallLsdcd(with_atoms_on_host(lmp, arg[0]), narg, arg, lsdcd::make_engine_on<DeviceType>)
{
  kokkosable = 1;
  atomKK = kokkos_atoms(atom);
  execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  // What is read and changed is named where it is.
  datamask_read = EMPTY_MASK;
  datamask_modify = EMPTY_MASK;
#if LSDCD_DEVICE_EXCHANGE
  exchange_comm_device = sort_device = std::is_same<DeviceType, LMPDeviceType>::value;
#endif
}

template <class DeviceType>
int FixWallLsdcdKokkos<DeviceType>::setmask()
{
  return FixWallLsdcd::setmask() | (lsdcd::kOnHost<DeviceType> ? 0 : PRE_REVERSE);
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::need_on_host()
{
  atomKK->sync(Host, X_MASK | RADIUS_MASK | RMASS_MASK | MASK_MASK | TAG_MASK);
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::before_rebuild()
{
  springs_to_host();
  list_is_old = true;
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::setup(int vflag)
{
  prepare_springs();
  list_is_old = true;
  FixWallLsdcd::setup(vflag);
}

// Tuning makes another engine, and springs of a restart file are checked on the host.
template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::prepare_springs()
{
  if (!springs_checked || (settings.tune >= 0 && wall->reach() == 0)) springs_to_host();
}

// Before atoms move to other places in memory, and to other processes.
template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::pre_exchange()
{
  look();
  check_wrapping();
  if (!history) return;
#if LSDCD_DEVICE_EXCHANGE
  if (springs_are == Where::device) {
    // One more for the place of an atom's numbers in the message. A process on its own packs
    // hardly any atom, those that leave a fixed box, and need not look at all of them.
    int largest = 1 + (comm->nprocs > 1 ? resident().largest_packed_size(n_with_springs)
                                        : resident().most_packed_size());
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, world);
    ask_for_room(largest);
    return;
  }
#endif
  springs_to_host();
  FixWallLsdcd::pre_exchange();
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::pre_force(int vflag)
{
  if (neighbor->ago == 0) {
    list_is_old = true;
    prepare_springs();
  }
  FixWallLsdcd::pre_force(vflag);
}

// Once the forces between atoms are under way: Kokkos's next kernel may make the host wait for
// them, and contacts are to be searched for meanwhile.
template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::pre_reverse(int, int)
{
  if (!running) return;
  lsdcd::Spheres s = spheres();
  const lsdcd::StepSettings step = step_settings(s);
  try {
    resident().search(s, step);
  } catch (const std::exception &e) {
    stop(e);
  }
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::post_run()
{
  look();
  FixWallLsdcd::post_run();
  if (steps_run > 0 && !settings.brief)
    log("Fix " + std::string(id) + " wall/lsdcd/kk: " + std::to_string(steps_run) + " steps with " +
        std::to_string(lists_made) + " lists of near atoms" +
        (list_keeps() ? "" : " (neigh_modify delay 0 every 1 check yes lets a list be kept)"));
  steps_run = lists_made = 0;
}

template <class DeviceType>
lsdcd::Spheres FixWallLsdcdKokkos<DeviceType>::spheres()
{
  lsdcd::Spheres s;
  s.n = atom->nlocal;
  s.x = lsdcd::rows_of(atomKK->k_x.template view<DeviceType>());
  s.v = lsdcd::rows_of(atomKK->k_v.template view<DeviceType>());
  s.omega = lsdcd::rows_of(atomKK->k_omega.template view<DeviceType>());
  s.force = lsdcd::rows_of(atomKK->k_f.template view<DeviceType>());
  s.torque = lsdcd::rows_of(atomKK->k_torque.template view<DeviceType>());
  s.radius = lsdcd::numbers_of(atomKK->k_radius.template view<DeviceType>());
  s.mass =
      rigid ? d_mass_seen.data() : lsdcd::numbers_of(atomKK->k_rmass.template view<DeviceType>());
  s.mask = igroup ? atomKK->k_mask.template view<DeviceType>().data() : nullptr;
  s.group_bit = groupbit;
  return s;
}

template <class DeviceType>
bool FixWallLsdcdKokkos<DeviceType>::list_keeps() const
{
  return spheres_stay_close() && !group->dynamic[igroup];
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::choose_if_due(const lsdcd::Spheres &s)
{
  if (history) springs_to_device();
  if (!list_is_old && list_keeps()) return;
  resident().choose(s, list_keeps() ? 0.5 * neighbor->skin : 0.0);
  list_is_old = false;
  lists_made++;
}

// Before the forces between atoms, beside which a GPU searches for contacts.
template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::start()
{
  if (lsdcd::kOnHost<DeviceType> || wall->reach() == 0) return;
  atomKK->sync(execution_space, X_MASK | RADIUS_MASK | MASK_MASK);
  lsdcd::Spheres s = spheres();
  try {
    choose_if_due(s);
    resident().mark_places();
  } catch (const std::exception &e) {
    stop(e);
  }
  running = true;
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::collect()
{
  if (wall->reach() > 0) {
    atomKK->sync(execution_space, X_MASK | V_MASK | OMEGA_MASK | RADIUS_MASK | RMASS_MASK |
                                      MASK_MASK | F_MASK | TORQUE_MASK);
    lsdcd::Spheres s = spheres();
    const lsdcd::StepSettings step = step_settings(s);
    try {
      if (!running) choose_if_due(s);
      engine->start(s, step, nullptr);
      engine->collect();
    } catch (const std::exception &e) {
      stop(e);
    }
    atomKK->modified(execution_space, F_MASK | TORQUE_MASK);
    n_with_springs = atom->nlocal;
    steps_run++;
    running = false;
  }
  keep_outputs();
}

template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::fill_masses()
{
  FixWallLsdcd::fill_masses();
  const std::size_t n = mass_seen.size();
  if (d_mass_seen.extent(0) < n) d_mass_seen = decltype(d_mass_seen)("lsdcd:mass_seen", n + n / 8);
  const Kokkos::View<double *, LMPHostType, Kokkos::MemoryTraits<Kokkos::Unmanaged>> host(
      mass_seen.data(), n);
  Kokkos::deep_copy(Kokkos::subview(d_mass_seen, std::make_pair(std::size_t(0), n)), host);
}

template <class DeviceType>
double FixWallLsdcdKokkos<DeviceType>::largest_radius()
{
  atomKK->sync(execution_space, RADIUS_MASK | MASK_MASK);
  lsdcd::Spheres s = spheres();
  // Atoms may enter a dynamic group between two looks.
  if (group->dynamic[igroup]) s.mask = nullptr;
  return resident().largest_radius(s);
}

// What steps have noted, for the warnings of the plain fix.
template <class DeviceType>
void FixWallLsdcdKokkos<DeviceType>::look()
{
  if (wall->reach() == 0) return;
  try {
    const lsdcd::StepNotes notes = resident().look();
    uncertified_sum += notes.uncertified;
    worst_uncertain = std::max(worst_uncertain, notes.uncertain);
    if (notes.deepest <= worst_overlap) return;
    worst_overlap = notes.deepest;
    worst_step = update->ntimestep;
    if (!overlap_warned && notes.deepest > kLargeOverlap) worst_tag = tag_of(notes.deepest_sphere);
  } catch (const std::exception &e) {
    stop(e);
  }
}

// Of one atom: to bring all tags to the host takes a third of a millisecond for a million.
template <class DeviceType>
tagint FixWallLsdcdKokkos<DeviceType>::tag_of(int i)
{
  if (!atom->tag_enable) return 0;
  atomKK->sync(execution_space, TAG_MASK);
  tagint tag = 0;
  Kokkos::deep_copy(tag, Kokkos::subview(atomKK->k_tag.template view<DeviceType>(), i));
  return tag;
}

template class LAMMPS_NS::FixWallLsdcdKokkos<LMPDeviceType>;
#if defined(LMP_KOKKOS_GPU)
template class LAMMPS_NS::FixWallLsdcdKokkos<LMPHostType>;
#endif
