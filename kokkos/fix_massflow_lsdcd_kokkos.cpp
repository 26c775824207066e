// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "fix_massflow_lsdcd_kokkos.h"

#include "backend/owned_array.h"
#include "lammps/fix_wall_lsdcd.h"
#include "lammps/host_fixes.h"

#include "atom.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <unordered_map>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;
using lsdcd::Vec3;

namespace {

using DeviceSpace = FixMassflowLsdcdKokkos::DeviceSpace;
using Candidate = FixMassflowLsdcdKokkos::Candidate;

constexpr int kRow = FixMassflowLsdcdKokkos::kRow;
// For candidates, 8 MB: where few atoms are near none of them is waited for before LAMMPS reneighbours.
constexpr std::size_t kLeastRoom = 65536;
constexpr std::uint64_t kReadOfAtoms =
    X_MASK | V_MASK | RMASS_MASK | RADIUS_MASK | TAG_MASK | TYPE_MASK | MASK_MASK;

// Near the surface since all atoms were last looked at. A bit of an atom's flags beside those of the plain fix.
constexpr unsigned kNear = 1u << 8, kDelete = FixMassflowLsdcdKokkos::kToDelete;
// Its surface may be nearer than the atom has gone unseen. A bit of a candidate's flags.
constexpr unsigned kLost = 1u << 9;

// Looks at atoms in a step: puts into `found` those whose path may meet a triangle. An atom that finds no room there stays as it was.
template <class Number>
struct LookAtAtoms {
  lsdcd::StridedView<Number> x, v;
  const Number *rmass, *radius;    // null: none
  const tagint *tag;               // null: none
  const int *type, *mask;
  const int *of;    // the atoms; null: all
  double *places;
  unsigned *flags;
  lsdcd::FlowBoxes boxes;
  double near_within;
  bool all_were_seen;
  int *near, *counts;    // near: null, or to be filled
  Candidate *found;
  int room;
  double step, time;

  KOKKOS_INLINE_FUNCTION void operator()(const int k) const
  {
    const int i = of ? of[k] : k;
    const Vec3 at = x[i];
    double *const last = places + 3 * i;
    const Vec3 from = {last[0], last[1], last[2]};
    unsigned now = flags[i];
    const Vec3 beside = boxes.beside(from, at);
    const Vec3 lo = {fmin(at.x, beside.x), fmin(at.y, beside.y), fmin(at.z, beside.z)};
    const Vec3 hi = {fmax(at.x, beside.x), fmax(at.y, beside.y), fmax(at.z, beside.z)};
    bool is_lost = false;
    if (!(now & kNear) && !all_were_seen) {
      // Nothing was within near_within of it, and it has come here in several steps.
      const double moved = norm(at - beside);
      const Vec3 all_round = {moved, moved, moved};
      is_lost = !(moved < near_within) && boxes.may_meet(beside - all_round, beside + all_round);
    }
    if (is_lost || boxes.may_meet(lo, hi)) {
      const int place = Kokkos::atomic_fetch_add(&counts[1], 1);
      if (place >= room) return;
      Candidate &c = found[place];
      c.step = step;
      c.time = time;
      c.from = from;
      c.x = at;
      c.v = v[i];
      c.mass = rmass ? rmass[i] : 0;
      c.diameter = radius ? 2 * radius[i] : 0;
      c.id = tag ? tag[i] : 0;
      c.i = i;
      c.type = type[i];
      c.mask = mask[i];
      c.flags = now | (is_lost ? kLost : 0);
    }
    last[0] = at.x;
    last[1] = at.y;
    last[2] = at.z;
    if (!near) return;
    const Vec3 all_round = {near_within, near_within, near_within};
    const bool is_near = boxes.may_meet(at - all_round, at + all_round);
    flags[i] = is_near ? now | kNear : now & ~kNear;
    if (is_near) near[Kokkos::atomic_fetch_add(&counts[0], 1)] = i;
  }
};

// Atoms are where they are, and all are looked at next.
template <class Number>
struct BeginAtAtoms {
  lsdcd::StridedView<Number> x;
  double *places;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const
  {
    const Vec3 at = x[i];
    for (int d = 0; d < 3; d++) places[3 * i + d] = at[d];
  }
};

struct FindToDelete {
  const unsigned *flags;
  int *found, *count;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const
  {
    if (flags[i] & kDelete) found[Kokkos::atomic_fetch_add(count, 1)] = i;
  }
};

template <class Number>
struct ReadMasses {
  const int *of;
  const Number *rmass;    // null: types have masses
  const int *type;
  double *masses;
  int *types;
  KOKKOS_INLINE_FUNCTION void operator()(const int k) const
  {
    masses[k] = rmass ? rmass[of[k]] : 0;
    types[k] = type[of[k]];
  }
};

struct PackRows {
  const int *leaves, *comes;
  double *places, *rows;
  unsigned *flags;
  // Atom leaves[k] goes and atom comes[k], if that is not -1, takes its place.
  KOKKOS_INLINE_FUNCTION void operator()(const int k) const
  {
    const int i = leaves[k], j = comes[k];
    for (int d = 0; d < 3; d++) rows[kRow * k + d] = places[3 * i + d];
    rows[kRow * k + 3] = flags[i];
    if (j < 0) return;
    for (int d = 0; d < 3; d++) places[3 * i + d] = places[3 * j + d];
    flags[i] = flags[j];
  }
};

struct UnpackRows {
  const int *to;
  const double *rows;
  double *places;
  unsigned *flags;
  // Atom to[k], if that is not -1, gets row k.
  KOKKOS_INLINE_FUNCTION void operator()(const int k) const
  {
    const int i = to[k];
    if (i < 0) return;
    for (int d = 0; d < 3; d++) places[3 * i + d] = rows[kRow * k + d];
    flags[i] = static_cast<unsigned>(rows[kRow * k + 3]);
  }
};

// Sets bits of some atoms.
struct SetFlags {
  Kokkos::View<int *, DeviceSpace> of;
  Kokkos::View<unsigned *, DeviceSpace> to;
  unsigned *flags;
  KOKKOS_INLINE_FUNCTION void operator()(const int k) const { flags[of(k)] |= to(k); }
};

template <class Work>
void for_each(int n, const Work &work)
{
  if (n > 0) Kokkos::parallel_for(Kokkos::RangePolicy<DeviceSpace>(0, n), work);
}

template <class T>
Kokkos::View<T *, DeviceSpace> copied_to_device(const T *from, std::size_t n)
{
  Kokkos::View<T *, DeviceSpace> to(
      Kokkos::view_alloc("lsdcd:massflow", Kokkos::WithoutInitializing), n);
  Kokkos::deep_copy(
      to, Kokkos::View<const T *, LMPHostType, Kokkos::MemoryTraits<Kokkos::Unmanaged>>(from, n));
  return to;
}

}    // namespace

FixMassflowLsdcdKokkos::FixMassflowLsdcdKokkos(LAMMPS *lmp, int narg, char **arg) :
    FixMassflowLsdcd(lsdcd::with_atoms_on_cpu(lmp, arg[0], "massflow/lsdcd", X_MASK), narg, arg),
    counts("lsdcd:massflow"), found("lsdcd:found", kLeastRoom)
{
  atomKK = static_cast<AtomKokkos *>(atom);
  lsdcd::bring_no_atoms(*this, ExecutionSpaceFromDevice<LMPDeviceType>::space);
  exchange_comm_device = sort_device = 1;
  maxexchange = kRow;
  const lsdcd::BoxTree &tree = surface->tree();
  things = copied_to_device(tree.view().things, tree.view().n_things);
  around = copied_to_device(tree.view().around, tree.n_around());
  forget_tracks();
  FixMassflowLsdcdKokkos::grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++) FixMassflowLsdcdKokkos::set_arrays(i);
}

// Candidates are counted before their atoms get other indices. Where a fix asks for the end of steps, Kokkos's integrators do not join two
// halves to one kernel: atoms are where they will be then before that, and only rows have their velocities.
int FixMassflowLsdcdKokkos::setmask()
{
  const int mask = FixMassflowLsdcd::setmask() | PRE_EXCHANGE | POST_RUN;
  return settings.file.empty() ? (mask & ~END_OF_STEP) | POST_FORCE : mask;
}

void FixMassflowLsdcdKokkos::init()
{
  FixMassflowLsdcd::init();
  if (std::strncmp(update->integrate_style, "respa", 5) == 0)
    fatal("it checks atoms in steps of run_style verlet only: use massflow/lsdcd/kk/host");
}

void FixMassflowLsdcdKokkos::post_force(int /*vflag*/)
{
  end_of_step();
}

void FixMassflowLsdcdKokkos::pre_exchange()
{
  settle();
  if (!settings.deletes) return;
  int any = may_delete;
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world);
  may_delete = false;
  if (!any) return;
  if (deletes_on_device())
    delete_on_device();
  else
    lsdcd::run_on_host(lmp, [this] { FixMassflowLsdcd::pre_exchange(); });
}

// Do all data of atoms leave processes on the device?
bool FixMassflowLsdcdKokkos::deletes_on_device() const
{
  if (lmp->kokkos->exchange_comm_legacy || atom->ellipsoid_flag) return false;
  const std::vector<Fix *> fixes = lsdcd::host_fixes(*modify);
  for (int k = 0; k < atom->nextra_grow; k++)
    if (!fixes[atom->extra_grow[k]]->exchange_comm_device) return false;
  return true;
}

// As LAMMPS lets atoms leave a process, but their messages go nowhere.
void FixMassflowLsdcdKokkos::delete_on_device()
{
  const std::vector<Fix *> fixes = lsdcd::host_fixes(*modify);
  // Walls say how large the data of an atom are in their own pre_exchange(), which may come after this one.
  for (Fix *fix : fixes)
    if (dynamic_cast<FixWallLsdcd *>(fix)) fix->pre_exchange();

  change_on_device();
  const int before = atom->nlocal;
  if (near.extent(0) < static_cast<std::size_t>(before))
    near = decltype(near)("lsdcd:near", lsdcd::with_spare(before));
  for_each(before, FindToDelete{flags.view_device().data(), near.data(), counts.data()});
  int seen[2];
  read_counts(seen);
  clear_counts();
  const int n = seen[0], after = before - n;
  double mass = 0;
  if (n > 0) {
    DAT::tdual_int_1d gone("lsdcd:gone", n), comes("lsdcd:comes", n);
    const auto list = gone.view_host();
    Kokkos::deep_copy(list, Kokkos::subview(near, std::make_pair(0, n)));
    std::sort(list.data(), list.data() + n);
    // Atoms behind the last that stays go to where there are gaps.
    for (int k = 0, next = after; k < n; k++) {
      const bool is_gap = list(k) < after;
      while (is_gap && std::binary_search(list.data(), list.data() + n, next)) next++;
      comes.view_host()(k) = is_gap ? next++ : -1;
    }
    gone.modify_host();
    comes.modify_host();
    gone.sync<DeviceSpace>();
    comes.sync<DeviceSpace>();
    mass = summed_mass(gone);
    pack_away(n, gone, comes);
  }
  note_deleted(n, mass);
}

double FixMassflowLsdcdKokkos::summed_mass(DAT::tdual_int_1d &list)
{
  atomKK->sync(execution_space, RMASS_MASK | TYPE_MASK);
  const auto of_atoms = atomKK->k_rmass.view<DeviceSpace>();
  using Number = std::remove_pointer_t<decltype(of_atoms.data())>;
  const std::size_t n = list.extent(0);
  Kokkos::View<double *, DeviceSpace> masses("lsdcd:masses", n);
  Kokkos::View<int *, DeviceSpace> types("lsdcd:types", n);
  for_each(static_cast<int>(n), ReadMasses<Number>{list.view<DeviceSpace>().data(),
                                                   atom->rmass ? of_atoms.data() : nullptr,
                                                   atomKK->k_type.view<DeviceSpace>().data(),
                                                   masses.data(), types.data()});
  const auto mass = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), masses);
  const auto type = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), types);
  double sum = 0;
  for (std::size_t k = n; k-- > 0;)    // in the order of the plain fix
    sum += atom->rmass ? mass(k) : atom->mass[type(k)];
  return sum;
}

// Atom gone[k] goes and atom comes[k], if that is not -1, takes its place, in all arrays of atoms.
void FixMassflowLsdcdKokkos::pack_away(int n, DAT::tdual_int_1d &gone, DAT::tdual_int_1d &comes)
{
  constexpr int kColumnsOfBuffer = 64;
  lsdcd::ExchangeBuffer buffer("lsdcd:buffer", 1, kColumnsOfBuffer);
  lsdcd::pack_exchange(*atomKK->avecKK, n, buffer, gone, comes, execution_space);
  atom->nlocal -= n;
  const std::vector<Fix *> fixes = lsdcd::host_fixes(*modify);
  for (int k = 0; k < atom->nextra_grow; k++) {
    Fix *const fix = fixes[atom->extra_grow[k]];
    const std::size_t rows = static_cast<std::size_t>(n) * fix->maxexchange / kColumnsOfBuffer + 1;
    if (buffer.extent(0) < rows)
      buffer = lsdcd::ExchangeBuffer("lsdcd:buffer", rows, kColumnsOfBuffer);
    dynamic_cast<KokkosBase *>(fix)->pack_exchange_kokkos(n, buffer, gone, comes, execution_space);
  }
}

// ---- a step ------------------------------------------------------------------------------

void FixMassflowLsdcdKokkos::box_has_changed(const lsdcd::PeriodicBox & /*before*/)
{
  const auto n = static_cast<std::uint32_t>(things.extent(0));
  boxes.emplace(lsdcd::BoxTreeView{things.data(), around.data(), n}, surface->tree().bounds(), box);
}

void FixMassflowLsdcdKokkos::begin_at_atoms()
{
  lsdcd::bring_after_commands(lmp, execution_space, kReadOfAtoms);
  change_on_device();
  const auto x = lsdcd::rows_of(atomKK->k_x.view<DeviceSpace>());
  using Number = std::remove_pointer_t<decltype(x.at)>;
  for_each(atom->nlocal, BeginAtAtoms<Number>{x, places.view_device().data()});
  may_delete = true;    // atoms have come from other processes, or a restart file
}

// Where all atoms are looked at, the number of candidates has no bound but theirs. If some are without room, all are looked at once
// more with room for them: for those that are counted already that is a path of length 0.
void FixMassflowLsdcdKokkos::look_at_atoms()
{
  if (!look_at_all) {
    if (most_found + n_near > static_cast<int>(found.extent(0))) settle();
    run_kernel(near.data(), n_near);
    most_found += n_near;
    return;
  }
  settle();
  const auto n = static_cast<std::size_t>(atom->nlocal);
  if (near.extent(0) < n) near = decltype(near)("lsdcd:near", lsdcd::with_spare(n));
  int seen[2];
  bool has_all = false;
  while (!has_all) {
    run_kernel(nullptr, atom->nlocal);
    read_counts(seen);
    const auto n_found = static_cast<std::size_t>(seen[1]);
    has_all = n_found <= found.extent(0);
    count_found(static_cast<int>(std::min<std::size_t>(n_found, found.extent(0))));
    if (!has_all) found = decltype(found)("lsdcd:found", lsdcd::with_spare(n_found));
  }
  n_near = seen[0];
  constexpr std::size_t kSteps = 8;    // after which candidates are counted at the latest
  const std::size_t room = std::max(kLeastRoom, kSteps * n_near);
  if (found.extent(0) < room) found = decltype(found)("lsdcd:found", lsdcd::with_spare(room));
}

void FixMassflowLsdcdKokkos::run_kernel(const int *of, int n)
{
  atomKK->sync(execution_space, kReadOfAtoms);
  change_on_device();
  const auto x = lsdcd::rows_of(atomKK->k_x.view<DeviceSpace>()),
             v = lsdcd::rows_of(atomKK->k_v.view<DeviceSpace>());
  using Number = std::remove_pointer_t<decltype(x.at)>;
  for_each(n,
           LookAtAtoms<Number>{
               x, v, atom->rmass ? atomKK->k_rmass.view<DeviceSpace>().data() : nullptr,
               atom->radius ? atomKK->k_radius.view<DeviceSpace>().data() : nullptr,
               atom->tag_enable ? atomKK->k_tag.view<DeviceSpace>().data() : nullptr,
               atomKK->k_type.view<DeviceSpace>().data(), atomKK->k_mask.view<DeviceSpace>().data(),
               of, places.view_device().data(), flags.view_device().data(), *boxes, near_within,
               all_were_seen, of ? nullptr : near.data(), counts.data(), found.data(),
               static_cast<int>(found.extent(0)), static_cast<double>(update->ntimestep),
               simulated_time()});
}

// Waits for the kernels.
void FixMassflowLsdcdKokkos::read_counts(int (&to)[2]) const
{
  Kokkos::deep_copy(Kokkos::View<int[2], LMPHostType, Kokkos::MemoryTraits<Kokkos::Unmanaged>>(to),
                    counts);
}

// Behind the kernels, without waiting.
void FixMassflowLsdcdKokkos::clear_counts()
{
  Kokkos::deep_copy(DeviceSpace(), counts, 0);
}

void FixMassflowLsdcdKokkos::settle()
{
  if (most_found == 0) return;
  int seen[2];
  read_counts(seen);
  count_found(seen[1]);
}

// Counts what has passed among n candidates, in the order of the plain fix.
void FixMassflowLsdcdKokkos::count_found(int n)
{
  std::vector<Candidate> all(found.data(), found.data() + n);
  std::sort(all.begin(), all.end(), [](const Candidate &a, const Candidate &b) {
    return a.step < b.step || (a.step == b.step && a.i < b.i);
  });
  std::unordered_map<int, unsigned> changed;
  for (const Candidate &c : all) {
    if (c.flags & kLost) lost_sight(c.id);
    const lsdcd::WrappedPoint from = {c.from, lsdcd::FlowSurface::cells_between(c.from, c.x, box)};
    const lsdcd::Passes passes = surface->passes(from, c.x, box);
    if (passes.forward + passes.backward == 0) continue;
    const auto before = changed.find(c.i);
    const unsigned was = before == changed.end() ? c.flags : before->second;
    unsigned now = was;
    count({{c.step, c.time, static_cast<double>(c.id), static_cast<double>(c.type), c.diameter, c.x,
            c.v, 0},
           atom->rmass ? c.mass : atom->mass[c.type],
           c.mask},
          passes, now);
    if (now != was) changed[c.i] = now & (kCounted | kToDelete);
    may_delete = may_delete || (now & kToDelete);
  }
  clear_counts();
  most_found = 0;
  if (changed.empty()) return;
  std::vector<int> of;
  std::vector<unsigned> to;
  for (const auto &[i, now] : changed) {
    of.push_back(i);
    to.push_back(now);
  }
  change_on_device();
  for_each(static_cast<int>(of.size()),
           SetFlags{copied_to_device(of.data(), of.size()), copied_to_device(to.data(), to.size()),
                    flags.view_device().data()});
}

// ---- what goes with an atom --------------------------------------------------------------

void FixMassflowLsdcdKokkos::on_host()
{
  settle();
  places.sync_host();
  flags.sync_host();
}

void FixMassflowLsdcdKokkos::change_on_host()
{
  on_host();
  places.modify_host();
  flags.modify_host();
}

void FixMassflowLsdcdKokkos::change_on_device()
{
  places.sync_device();
  flags.sync_device();
  places.modify_device();
  flags.modify_device();
}

void FixMassflowLsdcdKokkos::grow_arrays(int nmax)
{
  places.resize(std::max(nmax, 1));
  flags.resize(std::max(nmax, 1));
}

void FixMassflowLsdcdKokkos::copy_arrays(int i, int j, int /*delflag*/)
{
  change_on_host();
  for (int d = 0; d < 3; d++) places.view_host()(j, d) = places.view_host()(i, d);
  flags.view_host()(j) = flags.view_host()(i);
}

// As if it had been looked at: a new atom may be anywhere.
void FixMassflowLsdcdKokkos::set_arrays(int i)
{
  change_on_host();
  for (int d = 0; d < 3; d++) places.view_host()(i, d) = atom->x[i][d];
  flags.view_host()(i) = kNear;
}

unsigned &FixMassflowLsdcdKokkos::flags_of(int i)
{
  change_on_host();
  return flags.view_host()(i);
}

int FixMassflowLsdcdKokkos::pack_exchange(int i, double *buf)
{
  on_host();
  for (int d = 0; d < 3; d++) buf[d] = places.view_host()(i, d);
  buf[3] = flags.view_host()(i);
  return kRow;
}

int FixMassflowLsdcdKokkos::unpack_exchange(int i, double *buf)
{
  change_on_host();
  for (int d = 0; d < 3; d++) places.view_host()(i, d) = buf[d];
  flags.view_host()(i) = static_cast<unsigned>(buf[3]);
  return kRow;
}

int FixMassflowLsdcdKokkos::pack_exchange_kokkos(const int &n, lsdcd::ExchangeBuffer &buffer,
                                                 DAT::tdual_int_1d which, DAT::tdual_int_1d from,
                                                 ExecutionSpace space)
{
  settle();    // another fix may delete atoms before this one has looked at its candidates
  change_on_device();
  return lsdcd::pack_on_device<DeviceSpace>(
      which, from, buffer, space, [&](const int *leaves, const int *comes, double *to) {
        for_each(n, PackRows{leaves, comes, places.view_device().data(), to,
                             flags.view_device().data()});
        return n * kRow;
      });
}

void FixMassflowLsdcdKokkos::unpack_exchange_kokkos(lsdcd::ExchangeBuffer &buffer,
                                                    DAT::tdual_int_1d &to, int n, int /*n_first*/,
                                                    int /*second*/, ExecutionSpace space)
{
  change_on_device();
  lsdcd::unpack_on_device<DeviceSpace>(to, buffer, space, [&](const int *at, const double *from) {
    for_each(n, UnpackRows{at, from, places.view_device().data(), flags.view_device().data()});
  });
}

void FixMassflowLsdcdKokkos::sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &sorter)
{
  change_on_device();
  sorter.sort(LMPDeviceType(), places.view_device());
  sorter.sort(LMPDeviceType(), flags.view_device());
}

double FixMassflowLsdcdKokkos::memory_usage()
{
  const double of_atom = 3 * sizeof(double) + sizeof(unsigned);
  return FixMassflowLsdcd::memory_usage() + places.extent(0) * of_atom +
         found.extent(0) * sizeof(Candidate) + near.extent(0) * sizeof(int);
}
