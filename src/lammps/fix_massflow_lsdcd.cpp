// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/fix_massflow_lsdcd.h"

#include "base/input_words.h"
#include "box/likely_scale.h"
#include "box/outside_box.h"
#include "lammps/host_box.h"
#include "lammps/host_fixes.h"
#include "lammps/mpi_host.h"
#include "lammps/mpi_mesh.h"
#include "lammps/other_fixes.h"

#include "atom.h"
#if __has_include("atom_masks.h")
#include "atom_masks.h"
#endif
#include "domain.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using lsdcd::number_text;
using lsdcd::Vec3;

FixMassflowLsdcd::FixMassflowLsdcd(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), OwnMessages(lmp, "Fix", id, "massflow/lsdcd"),
    variables(lmp, std::string("f_") + id)
{
  run_core([&] {
    settings = lsdcd::parse_massflow(words_of(arg + 3, arg + narg));
    const lsdcd::WeldedMesh mesh = read_mesh();
    surface = std::make_unique<lsdcd::FlowSurface>(mesh);
    log(settings.brief ? lsdcd::counted(mesh.faces.size(), "triangle")
                       : describe(mesh.report, settings.surface.file));
    if (mesh.report.misoriented_edges > 0)
      warn(lsdcd::counted(mesh.report.misoriented_edges, "edge of the mesh joins",
                          "edges of the mesh join") +
           " facets that are wound in opposite ways: forward is not the same "
           "side everywhere; turn the facets over");
    if (mesh.report.two_sided_faces > 0)
      warn(std::to_string(mesh.report.two_sided_faces) + " of " +
           std::to_string(mesh.faces.size()) +
           " facets of the mesh are there in both windings: forward is along the normal of the "
           "first; keep one of each pair");
    const std::string outside = lsdcd::outside_box({mesh.report.lo, mesh.report.hi},
                                                   lsdcd::host_box(*domain), neighbor->skin);
    if (!outside.empty()) throw lsdcd::InputError(outside);
    check_size(mesh);
  });
  if (settings.deletes && atom->molecular)
    fatal("delete yes leaves bonds without their atoms: use an atom style without bonds");
  if (settings.clumps && (!atom->molecule_flag || !atom->tag_enable))
    fatal(
        "clumps yes counts atoms with one ID of their molecule as one grain, and atoms have none: "
        "write 'fix ID all property/atom mol ghost yes' before this fix");

#if __has_include("atom_masks.h")
  // All that a host with its atoms on a GPU has to bring for counting; deletion takes everything.
  if (!settings.deletes) {
    datamask_read = X_MASK | TYPE_MASK | MASK_MASK | RMASS_MASK | TAG_MASK;
    if (!settings.file.empty()) datamask_read |= V_MASK | RADIUS_MASK;
    datamask_modify = EMPTY_MASK;
  }
#endif
  nevery = 1;
  vector_flag = array_flag = 1;
  size_vector = kColumns + 2 + kAfterTypes;    // net mass and rate between the two
  size_array_rows = atom->ntypes;
  size_array_cols = kColumns;
  extvector = extarray = 0;    // what has passed is no property of the atoms that there are now
  global_freq = 1;
  create_attribute = 1;
  dynamic_group_allow = 1;
  restart_global = 1;
  restart_peratom = settings.once || settings.deletes;
  maxexchange = kTrackSize;
  mine.assign(kColumns * atom->ntypes + kAfterTypes, 0.0);
  totals = mine;
  time_seen = simulated_time();    // for a run without setup
  step_seen = update->ntimestep;

  // Last: Atom would call a fix that was refused after this.
  FixMassflowLsdcd::grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++) FixMassflowLsdcd::set_arrays(i);
  atom->add_callback(Atom::GROW);
  if (restart_peratom) atom->add_callback(Atom::RESTART);
  callbacks = true;
}

FixMassflowLsdcd::~FixMassflowLsdcd()
{
  if (!callbacks) return;    // refused
  atom->delete_callback(id, Atom::GROW);
  if (restart_peratom) atom->delete_callback(id, Atom::RESTART);
}

// Every process keeps the whole surface.
lsdcd::WeldedMesh FixMassflowLsdcd::read_mesh()
{
  lsdcd::MpiHost mpi(world);
  lsdcd::WeldedMesh mesh = lsdcd::read_together(mpi, settings.surface);
  if (mesh.faces.empty())
    throw lsdcd::InputError(settings.surface.file +
                            ": none of its triangles has an area, so nothing can pass; "
                            "check the file, or make weld smaller");
  return mesh;
}

void FixMassflowLsdcd::check_size(const lsdcd::WeldedMesh &mesh) const
{
  const lsdcd::PeriodicBox now = lsdcd::host_box(*domain);
  const lsdcd::Box spans = {mesh.report.lo, mesh.report.hi};
  const std::string wrong = lsdcd::too_large_text(spans.hi - spans.lo, spans, now);
  if (!wrong.empty()) warn(wrong);
  const lsdcd::Box size = in_fractions(spans, now);
  for (int k = 0; k < 3; k++) {
    const double more = (size.hi[k] - size.lo[k] - 1) * now.width(k);
    if (now.periodic[k] && more > mesh.report.weld_tolerance)
      warn("the mesh is longer than the periodic box in " + std::string(1, "xyz"[k]) + ", by " +
           number_text(more) +
           ": its images overlap it, and what passes there is counted twice; cut it to the box's " +
           number_text(now.width(k)));
  }
}

std::vector<lsdcd::RunFile> FixMassflowLsdcd::files() const
{
  std::vector<lsdcd::RunFile> all = {{"mesh", settings.surface.file}};
  if (!settings.file.empty()) all.push_back({"file", settings.file, 0, true});
  return all;
}

int FixMassflowLsdcd::setmask()
{
  return END_OF_STEP | (settings.deletes ? PRE_EXCHANGE : 0) |
         (settings.file.empty() ? 0 : POST_RUN);
}

void FixMassflowLsdcd::init()
{
  watch.init(*update);
  if (settings.clumps && kokkosable)
    fatal("clumps are counted on a CPU alone: use massflow/lsdcd without /kk, between 'suffix off' "
          "and "
          "'suffix on'");
  lsdcd::MpiHost mpi(world);
  check_files_apart(*this, *lmp, mpi);
  const std::string late = settings.deletes ? late_pair_springs(*this, *modify) : "";
  if (!late.empty()) fatal(late);
  for (const Fix *fix : lsdcd::host_fixes(*modify))
    if (settings.deletes && fix->rigid_flag &&
        !(settings.clumps && std::strstr(fix->style, "rigid") && std::strstr(fix->style, "/small")))
      warn(
          "delete yes removes atoms without telling fix " + std::string(fix->id) +
          ", whose rigid bodies they belong to: leave these atoms out of the group, or move bodies "
          "by fix rigid/small and give 'clumps yes', with which all atoms of a molecule go at "
          "once");
}

// Between runs atoms may be put anywhere: only time steps let them pass. The file is opened here and not before, so that a run
// that is refused leaves the one that there is alone.
void FixMassflowLsdcd::setup(int /*vflag*/)
{
  if (watch.sees_snapshot(*update))
    fatal("a rerun has no steps, and what passes between its snapshots is not counted: unfix " +
          std::string(id) + " before it");
  open_rows();
  near_within = neighbor->skin > 0 ? 2 * neighbor->skin : 1e150;
  far = 8 * near_within;
  time_seen = simulated_time();
  step_seen = update->ntimestep;
  follow_box();
  all_were_seen = look_at_all = true;
  if (settings.clumps) {
    for (int i = 0; i < atom->nlocal; i++) tracks[i].flags |= kNew;
    find_clumps();
  }
  begin_at_atoms();
}

void FixMassflowLsdcd::begin_at_atoms()
{
  for (int i = 0; i < atom->nlocal; i++) {
    Track &t = tracks[i];
    const Vec3 x = {atom->x[i][0], atom->x[i][1], atom->x[i][2]};
    t.clear -= norm(x - t.last);
    t.last = x;
  }
}

// At the end of a step dt may be that of the next one already, as fix dt/reset sets it there.
double FixMassflowLsdcd::simulated_time() const
{
  return update->atime + (update->ntimestep - update->atimestep) * update->dt;
}

// Images of the surface move with the box.
void FixMassflowLsdcd::follow_box()
{
  settle();
  const lsdcd::PeriodicBox before = box;
  box = lsdcd::host_box(*domain);
  box_has_changed(before);
}

void FixMassflowLsdcd::box_has_changed(const lsdcd::PeriodicBox &before)
{
  const double moved = surface->images_move(before, box);
  for (int i = 0; moved > 0 && i < atom->nlocal; i++) tracks[i].clear -= moved;
}

void FixMassflowLsdcd::end_of_step()
{
  if (domain->box_change) follow_box();
  look_at_all = look_at_all || neighbor->ago == 0 || domain->box_change ||
                !lsdcd::atoms_stay_close(*neighbor);
  if (settings.clumps && neighbor->ago == 0) find_clumps();
  look_at_atoms();
  all_were_seen = look_at_all;
  look_at_all = false;
  reduced = false;
  const double now = simulated_time();
  // Before a run without setup reset_timestep may have given the step another number, and LAMMPS another time.
  window.time += update->ntimestep == step_seen + 1 ? now - time_seen : update->dt;
  time_seen = now;
  step_seen = update->ntimestep;
  // A restart file may bring more steps than this fix averages over.
  if (++window.steps >= settings.every) end_window();
}

void FixMassflowLsdcd::look_at_atoms()
{
  if (look_at_all) {
    near.clear();
    for (int i = 0; i < atom->nlocal; i++) {
      if (tracks[i].flags & kFollows) continue;
      look(i);
      if (tracks[i].clear < near_within) near.push_back(i);
    }
  } else {
    for (const int i : near) look(i);
  }
}

// An atom that is not near was last looked at when its clearance was two skins or more, and LAMMPS
// has reneighboured in every step in which one had moved by half a skin.
void FixMassflowLsdcd::look(int i)
{
  Track &t = tracks[i];
  const Vec3 x = {atom->x[i][0], atom->x[i][1], atom->x[i][2]};
  const bool was_near = t.clear < near_within;
  double moved = norm(x - t.last);
  lsdcd::WrappedPoint from = {t.last};
  if (moved >= t.clear && box.any_periodic()) {
    from.cells = lsdcd::FlowSurface::cells_between(t.last, x, box);
    Vec3 way = x - t.last;
    for (int k = 0; k < 3; k++) way += -from.cells[k] * box.edge[k];
    moved = norm(way);
  }
  if (moved >= t.clear) {
    if (!was_near && !all_were_seen) lost_sight(atom->tag_enable ? atom->tag[i] : 0);
    const lsdcd::Passes passes = surface->passes(from, x, box);
    if (passes.forward + passes.backward > 0) count(passer(i), passes, t.flags);
    t.clear = 0;
  } else {
    t.clear -= moved;
  }
  t.last = x;
  if (t.clear <= 0 || (!was_near && t.clear < near_within))
    t.clear = surface->clearance(x, box, far);
}

void FixMassflowLsdcd::lost_sight(std::int64_t id) const
{
  fatal_here("atom " + std::to_string(id) + " moved by more than the skin " +
             number_text(neighbor->skin) +
             " in one step, and whether it passed is not known: make the timestep "
             "smaller or the skin larger (neighbor), or let the fix check all atoms in every "
             "step by neigh_modify check no");
}

double FixMassflowLsdcd::mass_of(int i) const
{
  return atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
}

FixMassflowLsdcd::Passer FixMassflowLsdcd::passer(int i) const
{
  const double *x = atom->x[i], *v = atom->v[i];
  return {{static_cast<double>(update->ntimestep),
           simulated_time(),
           static_cast<double>(atom->tag_enable ? atom->tag[i] : 0),
           static_cast<double>(atom->type[i]),
           atom->radius ? 2 * atom->radius[i] : 0,
           {x[0], x[1], x[2]},
           {v[0], v[1], v[2]},
           0},
          tracks[i].clump_mass > 0 ? tracks[i].clump_mass : mass_of(i),
          atom->mask[i]};
}

void FixMassflowLsdcd::count(const Passer &passer, lsdcd::Passes passes, unsigned &flags)
{
  if (!(passer.mask & groupbit)) return;
  const int net = passes.net();
  if (settings.deletes && net > 0) flags |= kToDelete;
  if (settings.once) {
    if (net == 0 || (flags & kCounted)) return;
    flags |= kCounted;
    passes = {net > 0, net < 0};
  }
  double *row = &mine[kColumns * (static_cast<int>(passer.row.type) - 1)];
  row[kForward] += passes.forward;
  row[kForwardMass] += passes.forward * passer.mass;
  row[kBackward] += passes.backward;
  row[kBackwardMass] += passes.backward * passer.mass;
  if (rows) keep_row(passer.row, passes);
}
