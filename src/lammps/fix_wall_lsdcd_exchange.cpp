// Springs and rows of the contacts array follow their spheres between processes and through
// sorting, springs into restart files, too.

#include "lammps/fix_wall_lsdcd.h"

#include "engine/step/law_job.h"

#include "atom.h"
#include "memory.h"
#include "modify.h"

#include <algorithm>

using namespace LAMMPS_NS;

void FixWallLsdcd::springs_to_host()
{
  if (!history || springs_are == Where::host) return;
  engine->springs_to(springs, n_with_springs);
  springs.grow(atom->nmax);
  springs_are = Where::host;
}

void FixWallLsdcd::springs_to_engine()
{
  if (springs_are == Where::engine) return;
  engine->springs_from(springs, atom->nlocal);
  n_with_springs = atom->nlocal;
  springs_are = Where::engine;
}

// Springs of a restart file are checked on the host.
void FixWallLsdcd::prepare_springs()
{
  if (!springs_checked) springs_to_host();
}

void FixWallLsdcd::grow_arrays(int nmax)
{
  if (history) springs.grow(nmax);
  if (settings.contacts)
    memory->grow(array_atom, nmax, size_peratom_cols, "fix_wall_lsdcd:array_atom");
}

// A fix may read the contacts array before this one writes it anew, and a dump after atoms
// were deleted or displaced.
void FixWallLsdcd::copy_arrays(int i, int j, int /*delflag*/)
{
  springs_to_host();
  if (history) springs.copy(i, j);
  if (settings.contacts) std::copy_n(array_atom[i], size_peratom_cols, array_atom[j]);
}

void FixWallLsdcd::set_arrays(int i)
{
  springs_to_host();
  if (history) springs.clear(i);
  if (settings.contacts) std::fill(array_atom[i], array_atom[i] + size_peratom_cols, 0.0);
}

int FixWallLsdcd::pack_exchange(int i, double *buf)
{
  springs_to_host();
  const int n = history ? springs.pack(i, buf) : 0;
  if (settings.contacts) std::copy_n(array_atom[i], size_peratom_cols, buf + n);
  return n + row_size();
}

int FixWallLsdcd::unpack_exchange(int i, double *buf)
{
  springs_to_host();
  const int n = history ? springs.unpack(i, buf) : 0;
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
  ask_for_room(history ? 2 + springs.doubles_per_spring() * lsdcd::kMostContacts : 0);
}

// In restart files the first number is the size, by which other fixes skip it.
int FixWallLsdcd::size_restart(int i)
{
  springs_to_host();
  return 1 + springs.packed_size(i);
}

// Of all processes: LAMMPS writes what the first one says, and makes rows that wide. Collective.
int FixWallLsdcd::maxsize_restart()
{
  springs_to_host();
  int largest = 1 + springs.largest_packed_size();
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, world);
  return largest;
}

// The images of another run may have other numbers.
int FixWallLsdcd::pack_restart(int i, double *buf)
{
  springs_to_host();
  buf[0] = size_restart(i);
  springs.pack(i, buf + 1);
  for (int k = 0; cutoff() > 0 && k < springs.count(i); k++) {
    lsdcd::Spring s = springs.of(i)[k];
    const lsdcd::SharedWall &wall = parts[s.mesh].wall;
    if (wall.has_images()) s.feature = lsdcd::own_feature(wall.view().wall, s.feature);
    buf[2 + k * springs.doubles_per_spring()] = lsdcd::packed_place(s);
  }
  return static_cast<int>(buf[0]);
}

void FixWallLsdcd::unpack_restart(int i, int nth)
{
  springs_to_host();
  const double *extra = atom->extra[i];
  for (int n = 0; n < nth; n++) extra += static_cast<int>(extra[0]);
  // Another law of the file's fix may have kept other numbers for each contact, and this one none.
  const int count = static_cast<int>(extra[1]), size = static_cast<int>(extra[0]);
  if (count == 0) return;
  if (!history || !springs_mean_same || size != 2 + count * springs.doubles_per_spring()) {
    other_law++;
    return;
  }
  springs.unpack(i, extra + 1);
}
