// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "engine/candidate_schedule.h"

#include "motion/motion.h"

namespace lsdcd {

bool CandidateSchedule::any_has_gone(Real farther_than, const std::vector<MovingMesh> &moving) const
{
  if (moving.size() != chosen_.size()) return true;
  for (std::size_t k = 0; k < moving.size(); k++)
    if (farthest_between(chosen_[k], moving[k].pose, moving[k].bounds) > farther_than) return true;
  return false;
}

CandidateUpdate CandidateSchedule::next(const SphereDrift &drift,
                                        const std::vector<MovingMesh> &moving,
                                        const std::function<bool()> &has_moved) const
{
  const bool bounded = drift.kind == SphereDrift::bounded,
             watched = drift.kind == SphereDrift::watched;
  // A wall that moves may go as far as spheres do.
  const Real of_spheres = bounded && drift.has_begun ? 2 * drift.distance : drift.distance,
             of_wall = moving.empty() ? 0 : drift.distance;
  // The margin has a part for spheres and one for the wall, so that neither has gone beyond its own.
  const bool host_knows =
      watched && drift.host_has_looked && chosen_at_zero_ && !any_has_gone(of_wall, moving);
  CandidateUpdate choice;
  choice.is_due = expired_ || (bounded      ? any_has_gone(of_wall, moving)
                               : host_knows ? false
                               : watched    ? has_moved()
                                            : true);
  choice.margin = bounded || watched ? of_spheres + of_wall : 0;
  choice.watch = watched;
  return choice;
}

void CandidateSchedule::note_update(const SphereDrift &drift, const std::vector<MovingMesh> &moving)
{
  expired_ = false;
  chosen_at_zero_ = !drift.has_begun;
  chosen_.clear();
  for (const MovingMesh &m : moving) chosen_.push_back(m.pose);
}

}    // namespace lsdcd
