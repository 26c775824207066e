// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// What the fix refuses and warns of.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_words.h"
#include "contact/faces_pushed.h"
#include "engine/results/sphere_error.h"
#include "law/contact_time.h"
#include "mesh/plane_cut.h"
#include "wall/mesh_name.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using lsdcd::number_text;

static constexpr double kWorse = 1.1;    // times what was warned of: warned of again

std::string FixWallLsdcd::with_fix_id(const std::string &text) const
{
  return "Fix " + std::string(id) + " wall/lsdcd: " + text;
}

std::string FixWallLsdcd::of(const MeshPart &m, const std::string &text) const
{
  return lsdcd::with_mesh_name(settings, m.index, text);
}

void FixWallLsdcd::fatal(const std::string &problem) const
{
  error->all(FLERR, with_fix_id(problem));
}

tagint FixWallLsdcd::tag_on_host(int i) const
{
  return atom->tag_enable ? atom->tag[i] : 0;
}
tagint FixWallLsdcd::tag_of(int i)
{
  return tag_on_host(i);
}

tagint FixWallLsdcd::tag_of_radius(double radius)
{
  need_on_host();
  bigint first = MAXBIGINT;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->radius[i] == radius && (group->dynamic[igroup] || (atom->mask[i] & groupbit)))
      first = std::min<bigint>(first, tag_on_host(i));
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_LMP_BIGINT, MPI_MIN, world);
  return static_cast<tagint>(first);
}

void FixWallLsdcd::stop(const std::exception &e)
{
  const auto *one = dynamic_cast<const lsdcd::SphereError *>(&e);
  if (!one) error->one(FLERR, with_fix_id(e.what()));
  error->one(FLERR,
             with_fix_id("atom " + std::to_string(tag_of(one->sphere)) + " " + one->problem));
}

void FixWallLsdcd::warn(const std::string &problem) const
{
  if (comm->me == 0) error->warning(FLERR, with_fix_id(problem));
}

void FixWallLsdcd::log(const std::string &lines) const
{
  if (comm->me == 0) utils::logmesg(lmp, lines + "\n");
}

double FixWallLsdcd::largest_radius()
{
  // Atoms may enter a dynamic group between two looks.
  const bool all = group->dynamic[igroup];
  double largest = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if (all || (atom->mask[i] & groupbit)) largest = std::max(largest, atom->radius[i]);
  return largest;
}

// A group of points feels no wall. Collective.
void FixWallLsdcd::check_points()
{
  if (points_warned) return;
  need_on_host();
  const bigint atoms = group->count(igroup);
  if (atoms == 0) return;
  points_warned = true;
  warn("all " + std::to_string(atoms) + " atoms of group " + group->names[igroup] +
       " have radius 0: the wall acts on none; set diameter");
}

void FixWallLsdcd::check_side(const MeshPart &m) const
{
  const lsdcd::MeshReport &r = m.wall.report();
  if (settings.side == lsdcd::Side::both || r.oriented) return;
  if (r.meeting_pairs > 0)
    throw lsdcd::InputError("side in and side out need shells that are apart; those of '" +
                            m.settings.file + "' cut or touch each other at " +
                            std::to_string(r.meeting_pairs) +
                            " pairs of facets: make one shell of them (a boolean union), or use "
                            "side both");
  throw lsdcd::InputError("side in and side out need a closed, oriented mesh; '" + m.settings.file +
                          "' has " + std::to_string(r.open_edges) + " open, " +
                          std::to_string(r.nonmanifold_edges) + " non-manifold and " +
                          std::to_string(r.misoriented_edges) + " misoriented edges, and " +
                          std::to_string(r.inverted_facets) +
                          " facets of closed shells that are wound against the others: repair the "
                          "mesh (lsdcd repair) or use side both");
}

// The first process has the mesh.
void FixWallLsdcd::check_surface(const MeshPart &m) const
{
  if (comm->me) return;
  const lsdcd::PushReport push = lsdcd::faces_pushed(*m.wall.mesh(), m.settings.surface);
  if (push.faces == 0) return;
  warn(of(m, "surface_vel and surface_angvel push " + std::to_string(push.faces) + " of " +
                 std::to_string(m.wall.report().facets) + " faces along their normals, by up to " +
                 number_text(push.component) + " (" + number_text(100 * push.share) +
                 " % of the speed there). That part is left out: the mesh itself stays where it "
                 "is, and lifters, blades and screws convey nothing. Where the mesh itself moves, "
                 "use the keyword motion"));
}

// Particles of a two-dimensional run feel the mesh where it cuts their plane. Collective.
void FixWallLsdcd::check_plane(const MeshPart &m)
{
  if (domain->dimension == 3) return;
  const lsdcd::MeshReport &r = m.wall.report();
  if (!(r.lo.z < 0 && r.hi.z > 0))
    fatal(of(m, "in two dimensions particles move in the plane z = 0, which the mesh does not "
                "cut: it spans z from " +
                    number_text(r.lo.z) + " to " + number_text(r.hi.z) +
                    "; draw the outline out along z" +
                    (r.lo.z < r.hi.z ? ", and put its middle at z = 0 (move 0 0 " +
                                           number_text(-(r.lo.z + r.hi.z) / 2) + ")"
                                     : "")));
  double cut[2] = {0, 0};
  if (m.wall.mesh()) {
    const lsdcd::PlaneCut mine = lsdcd::plane_cut(*m.wall.mesh());
    cut[0] = static_cast<double>(mine.leaning);
    cut[1] = mine.lean;
  }
  MPI_Allreduce(MPI_IN_PLACE, cut, 2, MPI_DOUBLE, MPI_MAX, world);
  if (cut[0] > 0)
    warn(of(m, number_text(cut[0]) + " faces lean where the mesh cuts the plane z = 0, by up to " +
                   number_text(cut[1]) +
                   " degrees: fix enforce2d throws away what they push along z; draw the outline "
                   "out along z"));
}

void FixWallLsdcd::check_timestep()
{
  if (cutoff() == 0) return;
  checked_atoms = atom->natoms;
  need_on_host();
  double shortest = INFINITY;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit)
      shortest = std::min(shortest, lsdcd::contact_time(settings.law, atom->rmass[i],
                                                        atom->radius[i], force->ftm2v));
  MPI_Allreduce(MPI_IN_PLACE, &shortest, 1, MPI_DOUBLE, MPI_MIN, world);
  const double ratio = update->dt / (shortest / lsdcd::kStepsPerContact);
  if (ratio <= worst_dt) return;
  worst_dt = kWorse * ratio;
  warn("timestep " + number_text(update->dt) +
       " is more than a tenth of the shortest contact time " + number_text(shortest) +
       (lsdcd::is_hertzian(settings.law) ? " (hertz, at an overlap of 1 % of the radius)" : "") +
       ": contacts will not be resolved");
}

// Springs of a restart file name features of the mesh it was written with, and hold what
// the law that it was written with keeps. Collective: not every process has such atoms.
void FixWallLsdcd::check_springs()
{
  history->check_restored(atom->nlocal, [this](const lsdcd::Spring &s) {
    return s.mesh < parts.size() && !parts[s.mesh].springs_are_foreign &&
           parts[s.mesh].wall.has(s.feature);
  });
}
