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
  tracks[i] = {{x[0], x[1], x[2]}, 0, 0};
}

int FixMassflowLsdcd::pack_exchange(int i, double *buf)
{
  const Track &t = tracks[i];
  const double data[kTrackSize] = {t.last.x, t.last.y, t.last.z, t.clear, double(t.flags)};
  std::copy_n(data, kTrackSize, buf);
  return kTrackSize;
}

int FixMassflowLsdcd::unpack_exchange(int i, double *buf)
{
  tracks[i] = {{buf[0], buf[1], buf[2]}, buf[3], static_cast<unsigned>(buf[4])};
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

// In falling order, so that the last atom, which takes the place of one, is not to be deleted.
void FixMassflowLsdcd::pre_exchange()
{
  bigint n = 0;
  double mass = 0;
  for (int i = atom->nlocal - 1; i >= 0; i--) {
    if (!(flags_of(i) & kToDelete)) continue;
    n++;
    mass += mass_of(i);
    // The last atom counts until it is copied with what other fixes keep of it.
    atom->avec->copy(atom->nlocal - 1, i, 1);
    atom->nlocal--;
  }
  note_deleted(n, mass);
}

void FixMassflowLsdcd::note_deleted(bigint n, double mass)
{
  double *deleted = &mine[kColumns * size_array_rows];
  deleted[kDeleted] += n;
  deleted[kDeletedMass] += mass;
  MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (n == 0) return;
  reduced = false;
  atom->natoms -= n;
  for (Fix *fix : lsdcd::host_fixes(*modify))
    if (auto *wall = dynamic_cast<FixWallLsdcd *>(fix)) wall->note_deleted(n);
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
