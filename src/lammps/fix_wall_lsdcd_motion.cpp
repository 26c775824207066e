// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// A mesh that moves: its clock, where it is in each step, and what that asks of the box.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_words.h"

#include "domain.h"
#include "update.h"

using namespace LAMMPS_NS;
using lsdcd::number_text;

lsdcd::Step FixWallLsdcd::step_now() const
{
  return {update->ntimestep, update->dt,
          rerun               ? lsdcd::Step::snapshot
          : update->setupflag ? lsdcd::Step::setup
                              : lsdcd::Step::step};
}

bool FixWallLsdcd::any_moves() const
{
  for (const MeshPart &m : parts)
    if (m.settings.motion.any()) return true;
  return false;
}

// Poses last: what servos ask for and variables may read is of where meshes were.
void FixWallLsdcd::move_wall()
{
  for (MeshPart &m : parts) {
    if (!m.motion.moves_or_varies()) continue;
    const double passed = m.motion.advance(step_now());
    if (!update->setupflag) advance_servo(m, passed);
  }
  for (MeshPart &m : parts)
    if (m.motion.moves_or_varies()) m.motion.place();
}

// That they are there, before a run.
void FixWallLsdcd::check_variables() const
{
  for (const MeshPart &m : parts) {
    for (const std::string &name : m.motion.variables()) host.find_variable(name);
    const std::string &temperature = m.settings.temperature_variable;
    if (!temperature.empty()) host.find_variable(temperature);
  }
}

// Of a pose: a mesh may act through a periodic face only where its images move as it does. Collective.
void FixWallLsdcd::check_moving_box(MeshPart &m, const lsdcd::WallPose &at, bool ahead) const
{
  const lsdcd::PeriodicBox box = simulation_box();
  if (!box.any_periodic()) return;
  for (int k = 0; k < 3; k++) {
    if (!box.periodic[k] || m.keeps_edge(box, k)) continue;
    const double depth = (cutoff() + box.margin) / box.width(k);
    const auto is_clear = [depth](double f) {
      return f > depth && f < 1 - depth;
    };    // a NaN is not
    bool clear = true;
    lsdcd::for_corners(m.bounds(0), [&](const lsdcd::Vec3 &corner) {
      clear &= is_clear(box.fraction(at.to_box(corner))[k]);
    });
    if (clear) continue;
    double lo, hi;
    m.find_range(box, k, at, lo, hi);
    if (is_clear(lo) && is_clear(hi)) continue;
    const std::string axis(1, "xyz"[k]);
    fatal(of(m, "the moving mesh " + std::string(ahead ? "will reach" : "reaches") +
                    " the periodic face in " + axis +
                    (ahead ? "" : " at step " + std::to_string(update->ntimestep)) +
                    ": it goes from " + number_text(lo) + " to " + number_text(hi) +
                    " of the box and must stay " + number_text(depth) +
                    " away from 0 and 1. A mesh acts through a periodic face only where it moves "
                    "across " +
                    axis + " and turns about nothing but " + axis +
                    ": make the boundary fixed, or the box larger"));
  }
}

// In all of the longest period, where a run begins; in later steps only where it is.
void FixWallLsdcd::check_moving_box()
{
  constexpr int kSamples = 256;
  for (MeshPart &m : parts) {
    const lsdcd::WallMotion &motion = m.settings.motion;
    if (!motion.any()) continue;
    check_moving_box(m, m.motion.pose(), false);
    if (!update->setupflag || m.motion.has_variables()) continue;
    for (int i = 1; i < kSamples; i++)
      check_moving_box(m, m.motion.pose_in(motion.longest_period() * i / kSamples), true);
  }
}

// Particles of a two-dimensional run feel the mesh where it cuts their plane, as it did at first.
void FixWallLsdcd::check_motion(const MeshPart &m) const
{
  const lsdcd::WallMotion &motion = m.settings.motion;
  if (domain->dimension != 2 || !motion.any() || motion.keeps({0, 0, 1})) return;
  std::string words = m.settings.motion_tokens;
  if (m.servo().present) words += (words.empty() ? "servo " : " servo ") + m.settings.servo_tokens;
  fatal(of(m, "in two dimensions a mesh must move in the plane z = 0 and turn about z, not by '" +
                  words + "'"));
}
