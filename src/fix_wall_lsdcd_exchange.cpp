// Springs follow their spheres between processes, through sorting and restart files.

#include "fix_wall_lsdcd.h"

#include "atom.h"
#include "memory.h"

#include <algorithm>

using namespace LAMMPS_NS;

void FixWallLsdcd::grow_arrays(int nmax)
{
  if (history) springs.grow(nmax);
  if (settings.contacts)
    memory->grow(array_atom, nmax, size_peratom_cols, "fix_wall_lsdcd:array_atom");
}

// The contacts array is written anew every step before anything reads it.
void FixWallLsdcd::copy_arrays(int i, int j, int /*delflag*/)
{
  if (history) springs.copy(i, j);
}

void FixWallLsdcd::set_arrays(int i)
{
  if (history) springs.clear(i);
  if (settings.contacts) std::fill(array_atom[i], array_atom[i] + size_peratom_cols, 0.0);
}

int FixWallLsdcd::pack_exchange(int i, double *buf)
{
  return history ? springs.pack(i, buf) : 0;
}

int FixWallLsdcd::unpack_exchange(int i, double *buf)
{
  return history ? springs.unpack(i, buf) : 0;
}

// In restart files the first number is the size, by which other fixes skip it.
int FixWallLsdcd::size_restart(int i)
{
  return 1 + springs.packed_size(i);
}

int FixWallLsdcd::maxsize_restart()
{
  return 1 + springs.largest_packed_size();
}

int FixWallLsdcd::pack_restart(int i, double *buf)
{
  buf[0] = size_restart(i);
  return 1 + springs.pack(i, buf + 1);
}

void FixWallLsdcd::unpack_restart(int i, int nth)
{
  if (!history) return;    // the file's fix had springs, this one has none
  const double *extra = atom->extra[i];
  for (int n = 0; n < nth; n++) extra += static_cast<int>(extra[0]);
  restarted = true;
  // Another law of the file's fix may have kept more or less for each contact.
  const int count = static_cast<int>(extra[1]), size = static_cast<int>(extra[0]);
  if (size == 2 + count * springs.doubles_per_spring())
    springs.unpack(i, extra + 1);
  else
    other_law++;
}
