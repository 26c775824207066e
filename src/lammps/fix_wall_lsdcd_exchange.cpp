// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Springs and rows of the contacts array follow their spheres between processes and through
// sorting, springs into restart files, too.

#include "lammps/fix_wall_lsdcd.h"

#include "atom.h"
#include "memory.h"
#include "modify.h"

#include <algorithm>

using namespace LAMMPS_NS;

lsdcd::ContactHistory &FixWallLsdcd::springs_on_host()
{
  return history->on_host(atom->nmax);
}

lsdcd::FeatureCode FixWallLsdcd::without_image(int mesh, lsdcd::FeatureCode feature) const
{
  const lsdcd::SharedWall &wall = parts[mesh].wall;
  return wall.has_images() ? lsdcd::own_feature(wall.view().wall, feature) : feature;
}

// Springs of a restart file are checked on the host.
void FixWallLsdcd::prepare_springs()
{
  if (!history->is_checked()) springs_on_host();
}

void FixWallLsdcd::grow_arrays(int nmax)
{
  if (history->is_kept() && !history->is_with_engine()) springs_on_host().grow(nmax);
  if (settings.contacts)
    memory->grow(array_atom, nmax, size_peratom_cols, "fix_wall_lsdcd:array_atom");
}

// A fix may read the contacts array before this one writes it anew, and a dump after atoms
// were deleted or displaced.
void FixWallLsdcd::copy_arrays(int i, int j, int /*delflag*/)
{
  if (history->is_kept()) springs_on_host().copy(i, j);
  if (settings.contacts) std::copy_n(array_atom[i], size_peratom_cols, array_atom[j]);
}

void FixWallLsdcd::set_arrays(int i)
{
  if (history->is_kept()) springs_on_host().clear(i);
  if (settings.contacts) std::fill(array_atom[i], array_atom[i] + size_peratom_cols, 0.0);
}

int FixWallLsdcd::pack_exchange(int i, double *buf)
{
  const int n = history->is_kept() ? springs_on_host().pack(i, buf) : 0;
  if (settings.contacts) std::copy_n(array_atom[i], size_peratom_cols, buf + n);
  return n + row_size();
}

int FixWallLsdcd::unpack_exchange(int i, double *buf)
{
  const int n = history->is_kept() ? springs_on_host().unpack(i, buf) : 0;
  if (settings.contacts) std::copy_n(buf + n, size_peratom_cols, array_atom[i]);
  return n + row_size();
}

// `springs_take`: numbers that the springs of one atom take at most. LAMMPS's Irregular has room
// for what the fix with the largest maxexchange packs and not for all of them, so each
// wall asks for the room of all.
void FixWallLsdcd::ask_for_room(int springs_take)
{
  room = springs_take + row_size();
  int all = room;
  std::vector<FixWallLsdcd *> walls = {this};
  for (int k = 0; k < modify->nfix; k++) {
    Fix *fix = modify->fix[k];
    if (!fix || fix == this) continue;    // LAMMPS replaces one by this
    FixWallLsdcd *other = dynamic_cast<FixWallLsdcd *>(fix);
    if (other) walls.push_back(other);
    all += other ? other->room : fix->maxexchange;
  }
  for (FixWallLsdcd *one : walls) one->maxexchange = all;
}

// For atoms that LAMMPS moves to other processes whenever it likes: outside of runs, and in
// the pre_exchange() of a fix before this one. No sphere has more contacts than this.
void FixWallLsdcd::ask_for_most_room()
{
  ask_for_room(history->is_kept() ? 1 + history->max_packed_size() : 0);
}

// In restart files the first number is the size, by which other fixes skip it.
int FixWallLsdcd::size_restart(int i)
{
  return 1 + springs_on_host().packed_size(i);
}

// Of all processes: LAMMPS writes what the first one says, and makes rows that wide. Collective.
int FixWallLsdcd::maxsize_restart()
{
  int largest = 1 + springs_on_host().largest_packed_size();
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, world);
  return largest;
}

// The images of another run may have other numbers.
int FixWallLsdcd::pack_restart(int i, double *buf)
{
  springs_on_host();
  buf[0] = 1 + history->pack_restart(i, buf + 1, [this](int mesh, lsdcd::FeatureCode feature) {
    return cutoff() > 0 ? without_image(mesh, feature) : feature;
  });
  return static_cast<int>(buf[0]);
}

void FixWallLsdcd::unpack_restart(int i, int nth)
{
  const double *extra = atom->extra[i];
  for (int n = 0; n < nth; n++) extra += static_cast<int>(extra[0]);
  springs_on_host();
  history->unpack_restart(i, extra + 1, static_cast<int>(extra[0]) - 1);
}
