// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// A servo: the load of the last step moves the mesh in this one.

#include "lammps/fix_wall_lsdcd.h"

#include "atom.h"
#include "group.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using lsdcd::Servo;

// Collective.
lsdcd::ServoLoad FixWallLsdcd::servo_load(const MeshPart &m)
{
  reduce_totals();
  const lsdcd::MeshTotals &t = totals->mesh(m.index);
  return {t.force, t.torque_at_origin, t.contacts, t.overlap, servo_radius, servo_mass};
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

// Over the time since the last step. All processes have the same sums and go the same way.
void FixWallLsdcd::advance_servo(MeshPart &m, double dt)
{
  if (!m.servo_controller.acts() || dt == 0) return;
  if (servo_radius == 0) look_at_servo_spheres();
  m.servo_controller.advance(servo_load(m), m.motion.pose_without_servo(), dt, update->ntimestep);
}

// Position, velocity, push.
double FixWallLsdcd::servo_output(const MeshPart &m, int i)
{
  const Servo &s = m.servo();
  return i == 0 ? s.position : i == 1 ? s.velocity : m.servo_controller.push(servo_load(m));
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
