// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The box of the simulation: where spheres can be, what repeats, and what changes in a run.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_words.h"
#include "lammps/host_box.h"
#include "mesh/likely_scale.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using lsdcd::number_text;

lsdcd::PeriodicBox FixWallLsdcd::simulation_box() const
{
  lsdcd::PeriodicBox box = lsdcd::host_box(*domain);
  for (int k = 0; k < 3; k++)
    box.follows[k] = domain->boundary[k][0] >= 2 || domain->boundary[k][1] >= 2;
  box.margin = std::max(neighbor->skin, farthest_out);
  return box;
}

bool FixWallLsdcd::spheres_stay_close() const
{
  return lsdcd::atoms_stay_close(*neighbor);
}

std::string FixWallLsdcd::likely_scale_text(const MeshPart &m) const
{
  const lsdcd::PeriodicBox box = simulation_box();
  // A box that follows its spheres tells nothing.
  if (box.follows[0] || box.follows[1] || box.follows[2]) return "";
  const lsdcd::Box bounds = box.bounds({0, 0, 0});
  lsdcd::Vec3 mesh = m.wall.report().hi - m.wall.report().lo, room = bounds.hi - bounds.lo;
  if (domain->dimension == 2) {    // an outline may be of any thickness
    mesh.z = mesh.x;
    room.z = room.x;
  }
  const double factor = lsdcd::likely_scale(mesh, room);
  return factor < 1 ? "; the file is probably in other units: add scale " + number_text(factor)
                    : "";
}

// Before a grid is built.
void FixWallLsdcd::check_scale(const MeshPart &m) const
{
  const lsdcd::MeshReport &r = m.wall.report();
  const lsdcd::Box box = simulation_box().bounds({0, 0, 0});
  const std::string likely = likely_scale_text(m);
  if (!likely.empty())
    warn(of(m, "the mesh is far larger than the box: it spans " +
                   lsdcd::extents_text({r.lo, r.hi}) + ", the box " + lsdcd::extents_text(box) +
                   likely));
}

void FixWallLsdcd::check_box(const MeshPart &m, double cutoff) const
{
  if (m.settings.motion.any()) return;    // it may come in later
  const lsdcd::MeshReport &r = m.wall.report();
  const std::string wrong =
      lsdcd::outside_box({r.lo, r.hi}, *domain, cutoff + simulation_box().margin);
  if (!wrong.empty()) fatal(of(m, wrong));
}

// A mesh that moves may begin outside of the box and come in. One that was in it and has left
// acts on nothing.
void FixWallLsdcd::check_gone()
{
  for (MeshPart &m : parts) {
    if (!m.settings.motion.any() || m.gone_warned) continue;
    const lsdcd::Box now = lsdcd::placed_bounds(m.motion.pose(), m.bounds(0));
    const bool in_box = lsdcd::outside_box(now, *domain, cutoff()).empty();
    m.was_in_box |= in_box;
    if (in_box || !m.was_in_box) continue;
    m.gone_warned = true;
    const lsdcd::Box box = simulation_box().bounds({0, 0, 0});
    warn(of(m, "the mesh has moved out of the box, where it acts on no atom: in step " +
                   std::to_string(update->ntimestep) + " it spans " + lsdcd::extents_text(now) +
                   ", the box " + lsdcd::extents_text(box) +
                   "; check the motion and its units. Shown once"));
  }
}

// A mesh smaller than a sphere is hardly meant to be.
void FixWallLsdcd::check_small(const MeshPart &m, double radius) const
{
  const lsdcd::MeshReport &r = m.wall.report();
  lsdcd::Vec3 size = r.hi - r.lo;
  if (domain->dimension == 2) size.z = 0;    // an outline may be of any thickness
  if (norm(size) >= radius) return;
  const std::string placed = m.settings.placement_tokens;
  warn(of(m, "the mesh is " + number_text(norm(size)) + " across, and spheres have radius " +
                 number_text(radius) + ": " +
                 (placed.find("scale") == std::string::npos
                      ? "the file is probably in other units: add a scale"
                      : "the file is probably in the deck's units, and the scale in '" + placed +
                            "' is not needed")));
}

// Where LAMMPS does not look in every step how far atoms have moved, they may go further past a
// face than the images and the grid were made for. Before atoms are wrapped. Collective.
void FixWallLsdcd::check_wrapping()
{
  const lsdcd::PeriodicBox box = simulation_box();
  if (cutoff() == 0 || update->setupflag || !box.any_periodic() || spheres_stay_close()) return;
  need_on_host();
  double out = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double *x = atom->x[i];
    const lsdcd::Vec3 at = box.fraction({x[0], x[1], x[2]});
    for (int k = 0; k < 3; k++)
      if (box.periodic[k]) out = std::max({out, -at[k] * box.width(k), (at[k] - 1) * box.width(k)});
  }
  MPI_Allreduce(MPI_IN_PLACE, &out, 1, MPI_DOUBLE, MPI_MAX, world);
  if (out <= box.margin) return;
  farthest_out = std::min({1.5 * out, box.width(0), box.width(1), box.width(2)});
  bool reaches = false;
  for (const MeshPart &m : parts) reaches |= !m.wall.fits(m.box_seen(simulation_box()));
  if (out_warned || !reaches) return;    // nothing of the wall is there
  out_warned = true;
  warn(
      "a particle was " + number_text(out) +
      " past a periodic face before it was wrapped, more than the skin " + number_text(box.margin) +
      ": contacts there may have been missed; use neigh_modify delay 0 every 1 check yes. The grid "
      "now reaches further; shown once");
}

// Images of what lies past a face act inside the box, which may not be what the mesh was drawn for.
// Where its motion allows no images check_moving_box() refuses it.
void FixWallLsdcd::check_periodic(const MeshPart &m) const
{
  if (settings.periodic || comm->me) return;
  const lsdcd::PeriodicBox box = simulation_box();
  const double tolerance = m.wall.report().weld_tolerance;
  std::string axes;
  for (int k = 0; k < 3; k++) {
    if (!box.periodic[k] || (m.settings.motion.any() && !m.keeps_edge(box, k))) continue;
    double past = 0;
    for (const lsdcd::Vec3 &x : m.wall.mesh()->vertices) {
      const double at = box.fraction(x)[k];
      past = std::max({past, -at * box.width(k), (at - 1) * box.width(k)});
    }
    if (past > tolerance)
      axes += (axes.empty() ? "" : ", ") + std::string(1, "xyz"[k]) + " by " + number_text(past);
  }
  if (axes.empty()) return;
  warn(of(m, "the mesh reaches past the periodic boundary in " + axes +
                 ": what lies there acts inside the box as well, by its periodic images. Add the "
                 "keyword periodic if that is meant, or make the boundary fixed"));
}

void FixWallLsdcd::check_within_cutoff(MeshPart &m)
{
  if (!m.wall.out_of_reach()) return;
  const lsdcd::PeriodicBox box = simulation_box();
  const lsdcd::MeshReport &r = m.wall.report();
  const lsdcd::Box b = box.bounds({0, 0, 0});
  const std::string what = of(m, "no particle in the box can touch the mesh: it spans " +
                                     lsdcd::extents_text({r.lo, r.hi}) + ", the box " +
                                     lsdcd::extents_text(b) + likely_scale_text(m));
  if (!box.follows[0] && !box.follows[1] && !box.follows[2]) fatal(what + "; check scale and move");
  if (!m.out_of_reach_warned) warn(what);
  m.out_of_reach_warned = true;
}

// A mesh that was to continue itself must not open while the box grows.
void FixWallLsdcd::check_ends(MeshPart &m, bool box_changed)
{
  if (m.wall.ends_warning().empty() || m.ends_warned) return;
  if (settings.periodic && box_changed)
    fatal(of(m, "the box has changed, and " + m.wall.ends_warning()));
  m.ends_warned = true;
  warn(of(m, m.wall.ends_warning()));
}

void FixWallLsdcd::log_rebuilds()
{
  if (box_rebuilds > 1 && !settings.brief)
    log(with_fix_id("the grid was rebuilt " + std::to_string(box_rebuilds) +
                    " times in this run, as the box changed"));
  box_rebuilds = 0;
}
