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

lsdcd::Box FixWallLsdcd::mesh_bounds(double past) const
{
  const lsdcd::MeshReport &r = wall->report();
  const lsdcd::Vec3 more = {past, past, past};
  return {r.lo - more, r.hi + more};
}

void FixWallLsdcd::begin_motion()
{
  clock = {0, update->ntimestep, update->ntimestep, update->dt};
  surface = settings.surface;
  pose = settings.motion.pose_at(0);
  list_is_old = true;
  check_motion();
}

void FixWallLsdcd::Clock::advance(const Update &update)
{
  const bigint elapsed = update.setupflag ? 0 : 1;
  if (update.ntimestep != step + elapsed || update.dt != dt) {
    base = now();
    base_step = update.ntimestep - elapsed;
    dt = update.dt;
  }
  step = update.ntimestep;
}

void FixWallLsdcd::move_wall()
{
  if (!moves_or_varies()) return;
  const lsdcd::Time before = clock.now();
  clock.advance(*update);
  const double passed = static_cast<double>(clock.now() - before);
  if (has_variables()) {
    modify->clearstep_compute();
    evaluate_variables(passed);
    modify->addstep_compute(update->ntimestep + 1);
  }
  if (!update->setupflag) advance_servo(passed);
  pose = settings.motion.pose_at(clock.now());
}

bool FixWallLsdcd::moves_or_varies() const
{
  return settings.motion.any() || settings.surface_varies();
}

bool FixWallLsdcd::has_variables() const
{
  if (settings.surface_varies() || !settings.motion.servo().target_name.empty()) return true;
  for (const lsdcd::MotionTerm &m : settings.motion.terms())
    if (m.kind == lsdcd::MotionKind::variable) return true;
  return false;
}

int FixWallLsdcd::variable_of(const std::string &name) const
{
  const int variable = input->variable->find(name.c_str());
  if (variable < 0) refuse("there is no variable '" + name + "', by which the wall moves");
  if (!input->variable->equalstyle(variable))
    refuse("variable '" + name + "', by which the wall moves, is not of style equal");
  return variable;
}

double FixWallLsdcd::value_of(const std::string &name) const
{
  return input->variable->compute_equal(variable_of(name));
}

// `passed`: time since they were evaluated last; 0 where a run begins.
void FixWallLsdcd::evaluate_variables(double passed)
{
  for (lsdcd::MotionTerm &m : settings.motion.terms()) {
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
  lsdcd::Servo &servo = settings.motion.servo();
  if (!servo.target_name.empty()) servo.target = value_of(servo.target_name);
  for (int d = 0; d < 3; d++) {
    if (!settings.surface_variable[d].empty())
      surface.velocity[d] = value_of(settings.surface_variable[d]);
    if (!settings.surface_variable[3 + d].empty())
      surface.angular[d] = value_of(settings.surface_variable[3 + d]);
  }
}

// That they are there, before a run.
void FixWallLsdcd::check_variables() const
{
  for (const lsdcd::MotionTerm &m : settings.motion.terms())
    for (const std::string &name : m.name)
      if (!name.empty()) variable_of(name);
  for (const std::string &name : settings.surface_variable)
    if (!name.empty()) variable_of(name);
  const std::string &target = settings.motion.servo().target_name;
  if (!target.empty()) variable_of(target);
}

// Has any point of the wall that a sphere can touch gone farther than this since near atoms were
// chosen?
bool FixWallLsdcd::wall_has_gone(double farther_than) const
{
  return settings.motion.any() &&
         lsdcd::farthest_between(chosen_pose, pose, mesh_bounds(wall->cutoff())) > farther_than;
}

// Whether the wall looks the same from each of its images across the faces that edge k joins: it
// moves across that edge and turns about nothing but it.
static bool keeps_edge(const lsdcd::WallMotion &motion, const lsdcd::PeriodicBox &box, int k)
{
  const lsdcd::Vec3 edge = lsdcd::unit_vector(box.edge[k]),
                    across =
                        lsdcd::unit_vector(cross(box.edge[(k + 1) % 3], box.edge[(k + 2) % 3]));
  return norm(cross(edge, across)) <= 1e-12 && motion.keeps(edge);
}

// The box as a mesh sees it from its own frame. Where its motion keeps an edge, that is the edge,
// and periodic images are what they are for a mesh at rest. Along the others spheres can be
// anywhere, and nothing repeats: check_moving_box() sees to it that nothing acts through them.
lsdcd::PeriodicBox FixWallLsdcd::mesh_box() const
{
  lsdcd::PeriodicBox box = simulation_box();
  if (!settings.motion.any()) return box;
  const lsdcd::PeriodicBox real = box;
  const lsdcd::Box bounds = mesh_bounds(0);
  for (int k = 0; k < 3; k++) {
    if (keeps_edge(settings.motion, real, k)) continue;
    double lo = 0, hi = 1;
    lsdcd::for_corners(bounds, [&](const lsdcd::Vec3 &corner) {
      const double at = real.fraction(corner)[k];
      lo = std::min(lo, at);
      hi = std::max(hi, at);
    });
    box.corner += lo * real.edge[k];
    box.edge[k] = (hi - lo) * real.edge[k];
    box.periodic[k] = false;
    box.follows[k] = true;    // no limit for the grid
  }
  return box;
}

// Of a pose: a mesh may act through a periodic face only where its images move as it does.
void FixWallLsdcd::check_moving_box(const lsdcd::WallPose &at, bool ahead) const
{
  const lsdcd::PeriodicBox box = simulation_box();
  if (!box.any_periodic()) return;
  const lsdcd::Box bounds = mesh_bounds(0);
  for (int k = 0; k < 3; k++) {
    if (!box.periodic[k] || keeps_edge(settings.motion, box, k)) continue;
    const double depth = (wall->cutoff() + box.margin) / box.width(k);
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    lsdcd::for_corners(bounds, [&](const lsdcd::Vec3 &corner) {
      const double f = box.fraction(at.to_box(corner))[k];
      lo = std::min(lo, f);
      hi = std::max(hi, f);
    });
    if (lo > depth && hi < 1 - depth) continue;
    const std::string axis(1, "xyz"[k]);
    refuse("the moving mesh " + std::string(ahead ? "will reach" : "reaches") +
           " the periodic face in " + axis +
           (ahead ? "" : " at step " + std::to_string(update->ntimestep)) +
           ": its bounds go from " + number_text(lo) + " to " + number_text(hi) +
           " of the box, and must stay " + number_text(depth) +
           " away from 0 and 1. A mesh acts through a periodic face only where "
           "it moves across " +
           axis + " and turns about nothing but " + axis +
           ": make the boundary "
           "fixed, or the box larger");
  }
}

// In all of the longest period, where a run begins; in later steps only where it is.
void FixWallLsdcd::check_moving_box() const
{
  if (!settings.motion.any()) return;
  constexpr int kSamples = 256;
  check_moving_box(pose, false);
  if (!update->setupflag || has_variables()) return;
  for (int i = 1; i < kSamples; i++)
    check_moving_box(
        settings.motion.pose_at(clock.now() + settings.motion.longest_period() * i / kSamples),
        true);
}

// Particles of a two-dimensional run feel the mesh where it cuts their plane, as it did at first.
void FixWallLsdcd::check_motion() const
{
  if (domain->dimension != 2 || !settings.motion.any() || settings.motion.keeps({0, 0, 1})) return;
  std::string words = settings.motion_tokens;
  if (settings.motion.servo().present)
    words += (words.empty() ? "servo " : " servo ") + settings.servo_tokens;
  refuse("in two dimensions a mesh must move in the plane z = 0 and turn about z, not by '" +
         words + "'");
}

// A line for the log.
std::string FixWallLsdcd::motion_text() const
{
  if (!settings.motion.moves())
    return settings.motion.start().placed ? "none; the mesh stays where it is" : "";
  constexpr int kSamples = 64;
  std::string text = settings.motion_tokens;
  bool differences = false;
  for (const lsdcd::MotionTerm &m : settings.motion.terms())
    for (int d = 0; d < 3; d++) differences |= !m.name[d].empty() && m.name[3 + d].empty();
  if (differences) text += "; where v_v is NULL velocities are differences over a step";
  if (has_variables()) return text;
  double most = 0;
  for (int i = 0; i < kSamples; i++)
    most = std::max(most, lsdcd::fastest_in(settings.motion.pose_at(
                                                settings.motion.longest_period() * i / kSamples),
                                            mesh_bounds(0)));
  return text + "; corners of its bounds go at up to " + number_text(most);
}
