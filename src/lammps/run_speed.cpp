// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/run_speed.h"

#include "lammps/host_box.h"
#include "lammps/host_fixes.h"
#include "lammps/mpi_host.h"
#include "lammps/run_advice.h"

#include "atom.h"
#include "lammps.h"
#include "neighbor.h"
#include "timer.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

namespace lsdcd {

namespace {

constexpr bigint kLeastSteps = 1000;    // of a run that says how fast it was

bool begins_with(const Fix *fix, const char *style)
{
  return std::strncmp(fix->style, style, std::strlen(style)) == 0;
}

// Returns the fix that speaks for all of ours; null: there is none.
const Fix *speaker(const std::vector<Fix *> &fixes)
{
  for (const char *style : {"wall/lsdcd", "SPRINGS/LSDCD"})
    for (const Fix *fix : fixes)
      if (begins_with(fix, style)) return fix;
  return nullptr;
}

double smallest_diameter(const Atom &atom)
{
  const double *const radius = atom.radius;
  return atom.nlocal > 0 ? 2 * *std::min_element(radius, radius + atom.nlocal) : INFINITY;
}

}    // namespace

void RunSpeed::see_new_list()
{
  const bigint now = lmp_->update->ntimestep;
  bool is_forced = due_ == now;
  bigint next = -1;
  for (const Fix *fix : host_fixes(*lmp_->modify)) {
    if (!fix->force_reneighbor) continue;
    is_forced = is_forced || fix->next_reneighbor == now;    // it has not set its next step yet
    if (fix->next_reneighbor > now && (next < 0 || fix->next_reneighbor < next))
      next = fix->next_reneighbor;
  }
  due_ = next;
  if (is_forced && !lmp_->update->setupflag) forced_++;
}

std::vector<std::string> RunSpeed::end_run(const Fix *fix)
{
  const Update &update = *lmp_->update;
  const std::vector<Fix *> fixes = host_fixes(*lmp_->modify);
  constexpr int kDynamics = 1;
  if (speaker(fixes) != fix || update.whichflag != kDynamics ||
      update.ntimestep - update.firststep < kLeastSteps)
    return {};
  MpiHost host(lmp_->world);
  std::vector<std::string> said;
  const auto say_once = [&](bool &told, const std::string &words) {
    if (words.empty()) return;
    told = true;
    said.push_back(words);
  };
  // Beside a GPU times of sections are those of other work that it still had, and fix balance copies all atoms.
  const Timer &timer = *lmp_->timer;
  if (!wait_told_ && !lmp_->kokkos && timer.has_normal()) {
    double busy = 0;
    for (const Timer::ttype section : {Timer::PAIR, Timer::BOND, Timer::NEIGH, Timer::MODIFY})
      busy += timer.get_wall(section);
    const bool balanced = std::any_of(fixes.begin(), fixes.end(),
                                      [](const Fix *f) { return begins_with(f, "balance"); });
    say_once(wait_told_, waiting_advice(host, busy, timer.get_wall(Timer::TOTAL), balanced));
  }
  const Neighbor &neighbor = *lmp_->neighbor;
  if (!skin_told_ && atoms_stay_close(neighbor) && lmp_->atom->radius)
    say_once(skin_told_,
             skin_advice(host, {update.ntimestep - update.firststep, neighbor.ncalls, forced_,
                                neighbor.skin, smallest_diameter(*lmp_->atom)}));
  return said;
}

}    // namespace lsdcd
