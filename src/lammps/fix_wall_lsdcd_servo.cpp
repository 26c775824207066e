// A servo: the load of the last step moves the mesh in this one.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_words.h"
#include "input/servo_words.h"
#include "law/contact_slope.h"

#include "atom.h"
#include "group.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using lsdcd::number_text;
using lsdcd::Servo;

// What the mesh pushes the spheres with along the servo's axis. Collective.
double FixWallLsdcd::servo_push(const MeshPart &m)
{
  reduce_totals();
  return m.servo().push({m.totals[0], m.totals[1], m.totals[2]}, m.torque_at_origin);
}

// The largest radius and mass that a contact can have. Collective.
void FixWallLsdcd::look_at_servo_spheres()
{
  bool any = false;
  for (const MeshPart &m : parts) any |= m.servo().present;
  if (!any) return;
  need_on_host();
  const bool all = group->dynamic[igroup];
  double most[2] = {0, 0};
  for (int i = 0; i < atom->nlocal; i++) {
    if (!all && !(atom->mask[i] & groupbit)) continue;
    most[0] = std::max(most[0], atom->radius[i]);
    most[1] = std::max(most[1], rigid ? mass_seen[i] : atom->rmass[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, world);
  servo_radius = most[0];
  servo_mass = most[1];
}

// Of as many contacts as there were in the last step, each as steep as any of them can be.
double FixWallLsdcd::stable_gain(const MeshPart &m, double dt)
{
  const Servo &s = m.servo();
  double arm = 1;
  if (s.turns) {
    const lsdcd::Box bounds =
        lsdcd::placed_bounds(m.settings.motion.terms_at(m.clock.now()), m.bounds(servo_radius));
    arm = 0;
    lsdcd::for_corners(bounds, [&](const lsdcd::Vec3 &corner) {
      arm = std::max(arm, norm(cross(s.axis, corner - s.point)));
    });
  }
  const double overlap = m.totals[7] * servo_radius + s.fastest * arm * dt,
               contacts = std::max(1.0, m.totals[6]);
  const lsdcd::ContactSlope one =
      lsdcd::contact_slope(settings.law, overlap, servo_radius, servo_mass);
  return lsdcd::servo_gain(contacts * arm * arm * one.stiffness, contacts * arm * arm * one.damping,
                           dt);
}

// Over the time since the last step. All processes have the same sums and go the same way.
void FixWallLsdcd::advance_servo(MeshPart &m, double dt)
{
  Servo &s = m.servo();
  if (!s.present || s.holds || dt == 0) return;
  if (servo_radius == 0) look_at_servo_spheres();
  const double push = servo_push(m), gain = stable_gain(m, dt);
  if (gain < s.most_gain && std::isfinite(s.most_gain) && m.totals[6] > 0 && !m.gain_told) {
    m.gain_told = true;
    warn(of(m, "a servo's gain of " + number_text(s.most_gain) + " would not be stable with " +
                   number_text(m.totals[6]) + " contacts at the timestep " + number_text(dt) +
                   ": " + number_text(gain) +
                   " is used in its place, and less with more of them; shown once"));
  }
  if (!s.advance(push, gain, dt) || m.limit_told) return;
  m.limit_told = true;
  log(signed_text(of(m, "the servo is at its limit " + number_text(s.position) + " at step " +
                            std::to_string(update->ntimestep) + ", where it pushes with " +
                            number_text(push) + " in place of " + number_text(s.target) +
                            "; said once")));
}

// Position, velocity, push.
double FixWallLsdcd::servo_output(const MeshPart &m, int i)
{
  const Servo &s = m.servo();
  return i == 0 ? s.position : i == 1 ? s.velocity : servo_push(m);
}

// The mesh with a servo; null where several have one, or none.
MeshPart *FixWallLsdcd::only_servo()
{
  MeshPart *only = nullptr;
  for (MeshPart &m : parts) {
    if (m.servo().present && only) return nullptr;
    if (m.servo().present) only = &m;
  }
  return only;
}

// What has a servo has its outputs, after those of the rest.
void FixWallLsdcd::show_servo()
{
  for (const MeshPart &m : parts)
    if (m.servo().present) size_vector = size_array_cols = kVector + kServo;
  extlist[kVector] = extlist[kVector + 1] = 0;    // position and speed are no sums
}

// Of a servo that goes on where it is: the next step would take it inside of them at any speed.
void FixWallLsdcd::check_limits(const MeshPart &m, const std::string &command) const
{
  const Servo &s = m.servo();
  if (s.position < s.lo || s.position > s.hi)
    refuse(of(m, command + ": the servo is at " + number_text(s.position) +
                     ", outside of the limits " + number_text(s.lo) + " " + number_text(s.hi) +
                     ", which count from where it began: widen them"));
}

// The mesh stays where it is with none, and goes on from there with another. Along the same line
// the position and its limits go on, too.
int FixWallLsdcd::modify_servo(MeshPart &m, const std::vector<std::string> &words)
{
  const lsdcd::ModifiedServo read = lsdcd::read_modified_servo(words);
  Servo &s = m.servo();
  if (!read.servo.present) {
    s.holds = true;
    s.velocity = 0;
  } else if (s.has_line_of(read.servo)) {
    const double position = s.position;
    s = read.servo;
    s.position = position;
    check_limits(m, "fix_modify servo");
  } else {
    if (m.settings.motion.moves())
      refuse("fix_modify servo: a servo along another line cannot begin while '" +
             m.settings.motion_tokens + "' moves the mesh: stop that first (motion none)");
    m.settings.motion.begin_from(m.pose);
    s = read.servo;
  }
  m.settings.servo_tokens = read.text;
  m.gain_told = m.limit_told = false;
  servo_radius = 0;    // a run without setup looks then
  m.pose = m.settings.motion.pose_at(m.clock.now());
  schedule.expire();
  check_motion(m);
  make_engine_that_moves();
  show_servo();
  if (!settings.brief) log(signed_text(of(m, "servo " + read.text)));
  return static_cast<int>(read.taken);
}
