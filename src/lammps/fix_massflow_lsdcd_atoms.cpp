// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The data of each atom in fix massflow/lsdcd, and deletion.

#include "lammps/fix_massflow_lsdcd.h"

#include "lammps/fix_wall_lsdcd.h"
#include "lammps/host_atom_vec.h"
#include "lammps/host_fixes.h"
#include "lammps/restart_data.h"

#include "atom.h"
#include "modify.h"

#include <algorithm>

using namespace LAMMPS_NS;

void FixMassflowLsdcd::grow_arrays(int nmax)
{
  tracks.resize(std::max(nmax, 1));
}

void FixMassflowLsdcd::copy_arrays(int i, int j, int /*delflag*/)
{
  tracks[j] = tracks[i];
}

void FixMassflowLsdcd::set_arrays(int i)
{
  const double *x = atom->x[i];
  tracks[i] = {{x[0], x[1], x[2]}, 0, settings.clumps ? unsigned{kNew} : 0u, 0};
}

int FixMassflowLsdcd::pack_exchange(int i, double *buf)
{
  const Track &t = tracks[i];
  const double data[kTrackSize] = {t.last.x, t.last.y,        t.last.z,
                                   t.clear,  double(t.flags), t.clump_mass};
  std::copy_n(data, kTrackSize, buf);
  return kTrackSize;
}

int FixMassflowLsdcd::unpack_exchange(int i, double *buf)
{
  tracks[i] = {{buf[0], buf[1], buf[2]}, buf[3], static_cast<unsigned>(buf[4]), buf[5]};
  return kTrackSize;
}

// A run begins with the positions that there are, so that none has to be in the file.
int FixMassflowLsdcd::pack_restart(int i, double *buf)
{
  buf[0] = size_restart(i);
  buf[1] = flags_of(i) & kAllFlags;
  return size_restart(i);
}

void FixMassflowLsdcd::unpack_restart(int i, int nth)
{
  constexpr const char *kWhat = "marks",
                       *kWithout = "give the fix another ID to begin without what has passed";
  const RestartRow row = restart_row(*atom, i, nth, kWhat, kWithout);
  unsigned flags = 0;
  while (flags <= kAllFlags && !(row.size == 1 && row.numbers[0] == flags)) flags++;
  if (flags > kAllFlags) fail_at_row(*atom, i, kWhat, kWithout);
  unsigned &mine = flags_of(i);
  mine = (mine & ~kAllFlags) | flags;
}

int FixMassflowLsdcd::size_restart(int /*i*/)
{
  return 2;
}

int FixMassflowLsdcd::maxsize_restart()
{
  return 2;
}

// The first atom of each clump counts for it, the one with the lowest ID. Asks for clumps with new atoms, some of which other processes
// may have. Collective.
void FixMassflowLsdcd::find_clumps()
{
  tagint range[2] = {0, 0};    // of molecules, the first one negative
  range[0] = -MAXTAGINT;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(tracks[i].flags & kNew) || atom->molecule[i] <= 0) continue;
    range[0] = std::max(range[0], -atom->molecule[i]);
    range[1] = std::max(range[1], atom->molecule[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, range, 2, MPI_LMP_TAGINT, MPI_MAX, world);
  constexpr bigint kAtOnce = 1 << 20;    // so that IDs far apart need little memory
  const bigint last = range[1];
  for (bigint first = -static_cast<bigint>(range[0]); first <= last; first += kAtOnce)
    find_clumps(static_cast<tagint>(first),
                static_cast<tagint>(std::min(first + kAtOnce - 1, last)));
  for (int i = 0; i < atom->nlocal; i++) {
    Track &t = tracks[i];
    if (!(t.flags & kNew) || atom->molecule[i] > 0) continue;
    t.flags &= ~(kFollows | kNew);
    t.clump_mass = 0;
  }
}

// For molecules of these IDs.
void FixMassflowLsdcd::find_clumps(tagint first, tagint last)
{
  const std::size_t n = static_cast<std::size_t>(last - first) + 1;
  std::vector<tagint> lowest(n, MAXTAGINT);
  std::vector<double> mass(n, 0);
  const auto is_new = [&](int i) {
    return (tracks[i].flags & kNew) && atom->molecule[i] >= first && atom->molecule[i] <= last;
  };
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_new(i)) continue;
    tagint &id = lowest[atom->molecule[i] - first];
    id = std::min(id, atom->tag[i]);
    mass[atom->molecule[i] - first] += mass_of(i);
  }
  MPI_Allreduce(MPI_IN_PLACE, lowest.data(), static_cast<int>(n), MPI_LMP_TAGINT, MPI_MIN, world);
  MPI_Allreduce(MPI_IN_PLACE, mass.data(), static_cast<int>(n), MPI_DOUBLE, MPI_SUM, world);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_new(i)) continue;
    const std::size_t k = static_cast<std::size_t>(atom->molecule[i] - first);
    Track &t = tracks[i];
    t.flags &= ~(kFollows | kNew);
    t.clump_mass = lowest[k] == atom->tag[i] ? mass[k] : 0;
    if (lowest[k] != atom->tag[i]) t.flags |= kFollows;
  }
}

// Returns the molecules of all processes whose first atom has passed, in rising order. Collective.
std::vector<tagint> FixMassflowLsdcd::molecules_to_delete() const
{
  std::vector<tagint> mine_here, all;
  for (int i = 0; i < atom->nlocal; i++)
    if ((tracks[i].flags & kToDelete) && atom->molecule[i] > 0)
      mine_here.push_back(atom->molecule[i]);
  int n = static_cast<int>(mine_here.size()), n_processes = 0;
  MPI_Comm_size(world, &n_processes);
  std::vector<int> counts(n_processes), starts(n_processes, 0);
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int p = 1; p < n_processes; p++) starts[p] = starts[p - 1] + counts[p - 1];
  all.resize(starts.back() + counts.back());
  MPI_Allgatherv(mine_here.data(), n, MPI_LMP_TAGINT, all.data(), counts.data(), starts.data(),
                 MPI_LMP_TAGINT, world);
  std::sort(all.begin(), all.end());
  return all;
}

// In falling order, so that the last atom, which takes the place of one, is not to be deleted.
void FixMassflowLsdcd::pre_exchange()
{
  bigint n = 0, n_atoms = 0;
  double mass = 0;
  std::vector<tagint> molecules;
  if (settings.clumps) molecules = molecules_to_delete();
  for (int i = atom->nlocal - 1; i >= 0; i--) {
    const unsigned flags = flags_of(i);
    const bool in_clump = settings.clumps && atom->molecule[i] > 0 &&
                          std::binary_search(molecules.begin(), molecules.end(), atom->molecule[i]);
    if (!(flags & kToDelete) && !in_clump) continue;
    n_atoms++;
    if (!(flags & kFollows)) n++;
    mass += mass_of(i);
    // The last atom counts until it is copied with what other fixes keep of it.
    atom->avec->copy(atom->nlocal - 1, i, 1);
    atom->nlocal--;
  }
  note_deleted(n, mass, n_atoms);
}

void FixMassflowLsdcd::note_deleted(bigint n, double mass, bigint n_atoms)
{
  double *deleted = &mine[kColumns * size_array_rows];
  deleted[kDeleted] += n;
  deleted[kDeletedMass] += mass;
  MPI_Allreduce(MPI_IN_PLACE, &n_atoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (n_atoms == 0) return;
  reduced = false;
  atom->natoms -= n_atoms;
  for (Fix *fix : lsdcd::host_fixes(*modify))
    if (auto *wall = dynamic_cast<FixWallLsdcd *>(fix)) wall->note_deleted(n_atoms);
  if (atom->map_style == Atom::MAP_NONE) return;
  atom->nghost = 0;    // the map must not name ghosts that are gone
  atom->map_init();
  atom->map_set();
}

double FixMassflowLsdcd::memory_usage()
{
  return surface->bytes() + tracks.capacity() * sizeof(Track) + near.capacity() * sizeof(int) +
         passages.capacity() * sizeof passages[0];
}
