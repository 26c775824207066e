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
    for (const MeshPart &m : parts) surfaces.push_back(m.surface);
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

// Does LAMMPS reneighbour before any atom has gone farther than half the skin? Elsewhere the
// engine looks at all atoms in every step.
bool FixWallLsdcd::list_keeps() const
{
  return spheres_stay_close() && !group->dynamic[igroup];
}

void FixWallLsdcd::choose_if_due(const lsdcd::Spheres &s)
{
  if (history) springs_to_engine();
  const bool keeps = list_keeps(),
             watches = !keeps && !group->dynamic[igroup] && neighbor->skin > 0;
  // Half the skin is for atoms. One that had gone so far since LAMMPS reneighboured may come back
  // and go as far on the other side. As much again is for a wall that moves.
  const double half = 0.5 * neighbor->skin, for_wall = any_moves() ? half : 0;
  bool wall_has_gone = false;
  for (const MeshPart &m : parts) wall_has_gone |= keeps && m.has_gone(for_wall);
  if (!list_is_old && (keeps ? !wall_has_gone : watches && !engine->has_moved(s))) return;
  const double for_atoms = keeps && neighbor->ago > 0 ? 2 * half : half;
  engine->choose(s, keeps || watches ? for_atoms + for_wall : 0.0, watches);
  for (MeshPart &m : parts) m.chosen_pose = m.pose;
  list_is_old = false;
  choices++;
}

void FixWallLsdcd::start()
{
  if (cutoff() == 0) return;    // no spheres yet

  lsdcd::Spheres s = spheres();
  const lsdcd::StepSettings step = step_settings(s);
  try {
    choose_if_due(s);
    engine->start(s, step);
  } catch (const std::exception &e) {
    stop(e);
  }
  running = true;
}

void FixWallLsdcd::collect()
{
  if (running) {
    try {
      engine->collect();
    } catch (const std::exception &e) {
      stop(e);
    }
    running = false;
    n_with_springs = atom->nlocal;
    (update->setupflag ? setups : steps_run)++;
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
  uncertified_sum += diagnostics.uncertified;
  worst_uncertain = std::max(worst_uncertain, diagnostics.uncertain);
  lists += diagnostics.lists;
  listed += diagnostics.listed;
  by_cells += diagnostics.by_cells;
  return diagnostics;
}

void FixWallLsdcd::look()
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
  reduced = false;
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
