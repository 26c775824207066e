// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// A step: what the engine is given, and what it leaves behind.

#include "lammps/fix_wall_lsdcd.h"

#include "atom.h"
#include "group.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

lsdcd::StepSettings FixWallLsdcd::step_settings(lsdcd::Spheres &spheres)
{
  lsdcd::StepSettings step;
  step.dt = update->dt;
  step.update_history = !update->setupflag;
  step.per_sphere = settings.contacts;
  step.records = records || vflag_global;
  if (several() || parts.front().settings.surface_varies()) {
    surfaces.clear();
    for (const MeshPart &m : parts) surfaces.push_back(m.motion.surface());
    step.surface = surfaces.data();
  }
  if (settings.law.has_heat()) give_heat(spheres, step);
  return step;
}

lsdcd::Spheres FixWallLsdcd::spheres()
{
  lsdcd::Spheres s;
  s.n = atom->nlocal;
  if (s.n) {
    s.x = atom->x[0];
    s.v = atom->v[0];
    s.omega = atom->omega[0];
    s.force = atom->f[0];
    s.torque = atom->torque[0];
  }
  s.radius = atom->radius;
  s.mass = rigid ? mass_seen.data() : atom->rmass;
  s.mask = igroup ? atom->mask : nullptr;
  s.group_bit = groupbit;
  return s;
}

// Half the skin is for atoms, and as much again for a wall that moves.
lsdcd::SphereDrift FixWallLsdcd::sphere_drift() const
{
  lsdcd::SphereDrift drift;
  if (group->dynamic[igroup]) return drift;
  drift.distance = 0.5 * neighbor->skin;
  drift.has_begun = neighbor->ago > 0;
  if (spheres_stay_close())
    drift.kind = lsdcd::SphereDrift::bounded;
  else if (neighbor->skin > 0)
    drift.kind = lsdcd::SphereDrift::watched;
  return drift;
}

void FixWallLsdcd::choose_if_due(const lsdcd::Spheres &s)
{
  history->to_engine(atom->nlocal);
  std::vector<lsdcd::MovingMesh> moving;
  for (const MeshPart &m : parts)
    if (m.settings.motion.any()) moving.push_back({m.motion.pose(), m.bounds(cutoff())});
  const lsdcd::Choice choice =
      schedule.next(sphere_drift(), moving, [&] { return engine->has_moved(s); });
  if (!choice.is_due) return;
  engine->choose(s, choice.margin, choice.watch);
  schedule.note_choice(moving);
  search.count_choice();
}

void FixWallLsdcd::give_step()
{
  lsdcd::Spheres s = spheres();
  const lsdcd::StepSettings step = step_settings(s);
  try {
    times.begin();
    choose_if_due(s);
    times.end(lsdcd::TimeReport::choice);
    engine->start(s, step);
    if (engine->has_begun()) times.end(lsdcd::TimeReport::forces);
  } catch (const std::exception &e) {
    stop(e);
  }
}

void FixWallLsdcd::start()
{
  if (cutoff() == 0) return;    // no spheres yet
  give_step();
  running = true;
}

void FixWallLsdcd::collect()
{
  if (running) {
    const bool waits = engine->has_begun();
    times.begin();
    try {
      engine->collect();
    } catch (const std::exception &e) {
      stop(e);
    }
    times.end(waits ? lsdcd::TimeReport::waiting : lsdcd::TimeReport::forces);
    running = false;
    history->set_spheres_of_engine(atom->nlocal);
    search.count_step(update->setupflag);
  }
  keep_outputs();
}

// What steps have noted since the last look, for the log.
lsdcd::StepDiagnostics FixWallLsdcd::read_notes()
{
  lsdcd::StepDiagnostics diagnostics;
  if (cutoff() == 0) return diagnostics;
  try {
    diagnostics = engine->read_diagnostics();
  } catch (const std::exception &e) {
    stop(e);
  }
  search.add(diagnostics);
  return diagnostics;
}

void FixWallLsdcd::poll_diagnostics()
{
  overlaps.note(read_notes(), update->ntimestep);
}

// Collective.
void FixWallLsdcd::check_new_spheres()
{
  if (!may_be_new) return;
  may_be_new = false;
  overlaps.check_new(read_notes(), update->ntimestep, continued || update->ntimestep > 0);
}

// Of the step just computed.
void FixWallLsdcd::keep_outputs()
{
  totals->expire();
  if (records) add_loads();
  if (vflag_global) add_virial();
  if (settings.contacts) fill_contacts();
}

// What damping sees of an atom in a rigid body is the mass of the body.
void FixWallLsdcd::fill_masses()
{
  need_on_host();
  const int nlocal = atom->nlocal;
  mass_seen.assign(atom->rmass, atom->rmass + nlocal);
  for (int k = 0; k < modify->nfix; k++) {
    Fix *fix = modify->fix[k];
    if (!fix->rigid_flag) continue;
    int dim;
    const int *body = (const int *) fix->extract("body", dim);
    const double *mass = (const double *) fix->extract("masstotal", dim);
    if (!body || !mass) continue;
    for (int i = 0; i < nlocal; i++)
      if (body[i] >= 0 && mass[body[i]] > 0.0) mass_seen[i] = mass[body[i]];
  }
}
