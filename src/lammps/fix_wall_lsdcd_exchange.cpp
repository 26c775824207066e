// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The history of contacts and the rows of the contacts array between processes, and the state of the wall in restart
// files.
#include "lammps/fix_wall_lsdcd.h"

#include "base/input_error.h"
#include "lammps/host_fixes.h"
#include "lammps/restart_data.h"

#include "atom.h"
#include "comm.h"
#include "memory.h"
#include "modify.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

using namespace LAMMPS_NS;

// ---- history and rows follow their atoms --------------------------------------------------

void FixWallLsdcd::grow_arrays(int nmax)
{
  wall->history().grow(nmax);
  if (spec().contacts)
    memory->grow(array_atom, nmax, size_peratom_cols, "fix_wall_lsdcd:array_atom");
}

// A fix may read the contacts array before this one writes it again, and a dump after atoms
// were deleted or displaced.
void FixWallLsdcd::copy_arrays(int i, int j, int /*delflag*/)
{
  if (has_history()) history_on_cpu().copy(i, j);
  if (spec().contacts) std::copy_n(array_atom[i], size_peratom_cols, array_atom[j]);
}

void FixWallLsdcd::set_arrays(int i)
{
  if (has_history()) history_on_cpu().clear(i);
  if (spec().contacts) std::fill(array_atom[i], array_atom[i] + size_peratom_cols, 0.0);
}

int FixWallLsdcd::pack_exchange(int i, double *buf)
{
  const int n = has_history() ? history_on_cpu().pack(i, buf) : 0;
  if (spec().contacts) std::copy_n(array_atom[i], size_peratom_cols, buf + n);
  return n + row_size();
}

int FixWallLsdcd::unpack_exchange(int i, double *buf)
{
  const int n = has_history() ? history_on_cpu().unpack(i, buf) : 0;
  if (spec().contacts) std::copy_n(buf + n, size_peratom_cols, array_atom[i]);
  return n + row_size();
}

// An atom that arrives may leave again in the next direction: room for the
// largest of all processes.
void FixWallLsdcd::make_exchange_room()
{
  int largest = has_history() ? history_on_cpu().largest_packed_size() : 0;
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, world);
  ask_for_room(has_history() ? 1 + largest : 0);    // and its offset, which messages of Kokkos tell
}

// `history_takes`: numbers that the history of one atom takes at most. LAMMPS's Irregular has room
// for what the fix with the largest maxexchange packs and not for all of them, so each
// wall asks for the room of all.
void FixWallLsdcd::ask_for_room(int history_takes)
{
  room = history_takes + row_size();
  int all = room;
  std::vector<FixWallLsdcd *> walls = {this};
  for (Fix *fix : lsdcd::host_fixes(*modify)) {
    if (!fix || fix == this) continue;    // LAMMPS replaces one by this
    FixWallLsdcd *other = dynamic_cast<FixWallLsdcd *>(fix);
    if (other) walls.push_back(other);
    all += other ? other->room : fix->maxexchange;
  }
  for (FixWallLsdcd *one : walls) one->maxexchange = all;
}

// For atoms that LAMMPS moves to other processes whenever it likes: in commands that do not begin with init(), and in
// the pre_exchange() of a fix before this one. No sphere has more contacts than this.
void FixWallLsdcd::ask_for_most_room()
{
  ask_for_room(has_history() ? 1 + wall->history().max_packed_size() : 0);
}

// ---- restart files -----------------------------------------------------------------------

// In restart files the first number is the size, by which other fixes skip it.
int FixWallLsdcd::size_restart(int i)
{
  return 1 + history_on_cpu().packed_size(i);
}

// The largest size of all processes: LAMMPS takes the first one's, and makes rows that wide. Collective.
int FixWallLsdcd::maxsize_restart()
{
  int largest = 1 + history_on_cpu().largest_packed_size();
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, world);
  return largest;
}

int FixWallLsdcd::pack_restart(int i, double *buf)
{
  buf[0] = 1 + wall->pack_saved(i, buf + 1);
  return static_cast<int>(buf[0]);
}

void FixWallLsdcd::unpack_restart(int i, int nth)
{
  constexpr const char *kWhat = "springs",
                       *kWithout = "give the fix another ID to begin without them";
  const RestartRow row = restart_row(*atom, i, nth, kWhat, kWithout);
  if (!lsdcd::HistoryExchange::is_sound(row.numbers, row.size))
    fail_at_row(*atom, i, kWhat, kWithout);
  history_on_cpu();
  wall->history().unpack_saved(i, row.numbers, row.size);
}

// LAMMPS since 3Nov2022 writes names without the suffix that is on, and looks for numbers of atoms by whole names: it would not
// find the springs again.
void FixWallLsdcd::check_suffix() const
{
#if LSDCD_HOST_VERSION >= 20221103
  const bool cut =
      lmp->suffix_enable && ((lmp->suffix && std::strcmp(lmp->suffix, "lsdcd") == 0) ||
                             (lmp->suffix2 && std::strcmp(lmp->suffix2, "lsdcd") == 0));
  if (cut && has_springs())
    throw lsdcd::InputError(
        "with the suffix lsdcd LAMMPS writes the name of this fix into a restart file as 'wall', "
        "and does not find its springs "
        "there again: write 'suffix off' before the fix, in the script that goes on, too");
#endif
}

void FixWallLsdcd::write_restart(FILE *file)
{
  check_suffix();
  const lsdcd::WallState all = wall->save();
  if (comm->me == 0) run_core_here([&] { write_state(file, all.blocks()); });
}

void FixWallLsdcd::restart(char *buffer)
{
  try {
    const lsdcd::State state(lsdcd::WallState::kKind, reinterpret_cast<const double *>(buffer),
                             kAllNumbers);
    wall->restore(lsdcd::WallState::from(state), step_now());
  } catch (const lsdcd::StateError &e) {
    throw lsdcd::InputError(unusable_state(e, "springs, motion, loads and wear"));
  }
}
