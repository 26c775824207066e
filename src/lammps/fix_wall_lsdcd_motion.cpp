// A mesh that moves: its clock, where it is in each step, and what that asks of the box.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_words.h"

#include "domain.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "variable.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using lsdcd::number_text;

void FixWallLsdcd::begin_motion(MeshPart &m)
{
  m.clock = {0, update->ntimestep, update->ntimestep, update->dt};
  m.surface = m.settings.surface;
  m.pose = m.settings.motion.pose_at(0);
  schedule.expire();
  check_motion(m);
}

bool FixWallLsdcd::any_moves() const
{
  for (const MeshPart &m : parts)
    if (m.settings.motion.any()) return true;
  return false;
}

void FixWallLsdcd::advance(StepClock &clock) const
{
  if (rerun)
    clock.jump_to(*update);
  else
    clock.advance(*update);
}

// Poses last: what servos ask for and variables may read is of where meshes were.
void FixWallLsdcd::move_wall()
{
  for (MeshPart &m : parts) {
    if (!m.moves_or_varies()) continue;
    const lsdcd::Time before = m.clock.now();
    advance(m.clock);
    const double passed = static_cast<double>(m.clock.now() - before);
    if (m.has_variables()) {
      modify->clearstep_compute();
      evaluate_variables(m, passed);
      modify->addstep_compute(update->ntimestep + 1);
    }
    if (!update->setupflag) advance_servo(m, passed);
  }
  for (MeshPart &m : parts)
    if (m.moves_or_varies()) m.pose = m.settings.motion.pose_at(m.clock.now());
}

int FixWallLsdcd::variable_of(const std::string &name) const
{
  const int variable = input->variable->find(name.c_str());
  if (variable < 0) refuse("there is no variable '" + name + "', which the wall reads");
  if (!input->variable->equalstyle(variable))
    refuse("variable '" + name + "', which the wall reads, is not of style equal");
  return variable;
}

// Where it is no number nothing would touch the wall, or a servo would run away. Equal-style
// variables are the same on all processes.
double FixWallLsdcd::value_of(const std::string &name) const
{
  const double value = input->variable->compute_equal(variable_of(name));
  if (!std::isfinite(value))
    refuse("variable '" + name + "', which the wall reads, is " + number_text(value) + " in step " +
           std::to_string(update->ntimestep) + ": it must be a finite number in every step");
  return value;
}

// `passed`: time since they were evaluated last; 0 where a run begins.
void FixWallLsdcd::evaluate_variables(MeshPart &part, double passed)
{
  for (lsdcd::MotionTerm &m : part.settings.motion.terms()) {
    if (m.kind != lsdcd::MotionKind::variable) continue;
    for (int d = 0; d < 3; d++) {
      if (m.name[d].empty()) continue;
      const double was = m.displacement[d];
      m.displacement[d] = value_of(m.name[d]);
      if (!m.name[3 + d].empty())
        m.speed[d] = value_of(m.name[3 + d]);
      else if (passed > 0)
        m.speed[d] = (m.displacement[d] - was) / passed;
    }
  }
  lsdcd::Servo &servo = part.servo();
  if (!servo.target_name.empty()) servo.target = value_of(servo.target_name);
  for (int d = 0; d < 3; d++) {
    if (!part.settings.surface_variable[d].empty())
      part.surface.velocity[d] = value_of(part.settings.surface_variable[d]);
    if (!part.settings.surface_variable[3 + d].empty())
      part.surface.angular[d] = value_of(part.settings.surface_variable[3 + d]);
  }
}

// That they are there, before a run.
void FixWallLsdcd::check_variables() const
{
  for (const MeshPart &part : parts) {
    for (const lsdcd::MotionTerm &m : part.settings.motion.terms())
      for (const std::string &name : m.name)
        if (!name.empty()) variable_of(name);
    for (const std::string &name : part.settings.surface_variable)
      if (!name.empty()) variable_of(name);
    for (const std::string &name : {part.servo().target_name, part.settings.temperature_variable})
      if (!name.empty()) variable_of(name);
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
    refuse(of(m, "the moving mesh " + std::string(ahead ? "will reach" : "reaches") +
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
    check_moving_box(m, m.pose, false);
    if (!update->setupflag || m.has_variables()) continue;
    for (int i = 1; i < kSamples; i++)
      check_moving_box(m, motion.pose_at(m.clock.now() + motion.longest_period() * i / kSamples),
                       true);
  }
}

// Particles of a two-dimensional run feel the mesh where it cuts their plane, as it did at first.
void FixWallLsdcd::check_motion(const MeshPart &m) const
{
  const lsdcd::WallMotion &motion = m.settings.motion;
  if (domain->dimension != 2 || !motion.any() || motion.keeps({0, 0, 1})) return;
  std::string words = m.settings.motion_tokens;
  if (m.servo().present) words += (words.empty() ? "servo " : " servo ") + m.settings.servo_tokens;
  refuse(of(m, "in two dimensions a mesh must move in the plane z = 0 and turn about z, not by '" +
                   words + "'"));
}
