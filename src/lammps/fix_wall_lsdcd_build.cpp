// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The engine, and the grids of the meshes: made when there are spheres, and again for larger ones
// or another box.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_words.h"
#include "law/contact_slope.h"

#include <vector>

using namespace LAMMPS_NS;
using lsdcd::number_text;

static constexpr double kHeadroom = 1.1;    // in cutoff, once radii are known to grow

lsdcd::EngineSettings FixWallLsdcd::engine_settings() const
{
  lsdcd::EngineSettings want;
  want.law = settings.law;
  want.corner = settings.corner;
  want.side = settings.side;
  want.precision = settings.precision;
  want.meshes = static_cast<int>(parts.size());
  want.moves = several();
  for (const MeshPart &m : parts) {
    want.moves |= m.motion.moves_or_varies();
    if (!want.surface.moves()) want.surface = m.settings.surface;
  }
  want.records = settings.has_loads() || thermo_virial;
  want.wear = settings.wear.model;
  want.device = settings.device;
  want.device_rank = parts.front().wall.shared().node_rank();
  return want;
}

// Collective.
void FixWallLsdcd::make_engine()
{
  const lsdcd::EngineSettings want = engine_settings();
  engine_moves = want.moves;
  engine_records = want.records;
  lsdcd::run_collectively(world, true, [&] { engine = new_engine(want); });
  history->set_engine(*engine);
}

// For other settings, with the springs that there are.
void FixWallLsdcd::make_engine_anew()
{
  if (cutoff() > 0) poll_diagnostics();
  springs_on_host();
  make_engine();
  for (const MeshPart &m : parts)
    if (cutoff() > 0) give_grid(m);
  schedule.expire();
}

// Builds the grid when the first spheres come, and again when larger ones do or the box has
// changed.
void FixWallLsdcd::update_cutoff()
{
  double most[2] = {largest_radius(), overlaps.worst()};
  MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, world);
  overlaps.check_sunk(most[1]);

  const double radius = most[0], old = cutoff();
  const auto cutoff_of = [this](double r) { return lsdcd::cutoff_of(settings.law, r); };
  if (radius == 0) {
    check_points();
    return;
  }
  if (cutoff_of(radius) <= old) {
    follow_box();
    return;
  }
  if (settings.rmax > 0 && radius > settings.rmax)
    fatal("atom " + std::to_string(tag_of_radius(radius)) + " has radius " +
          lsdcd::number_text(radius) + ", more than rmax " + lsdcd::number_text(settings.rmax) +
          ": raise rmax or use rmax auto");

  if (old == 0)
    for (const MeshPart &m : parts) check_small(m, radius);
  rebuild(cutoff_of(settings.rmax > 0 ? settings.rmax : (old > 0 ? kHeadroom * radius : radius)));
}

// A wall acts through periodic faces by images of its triangles, and its grid is there where
// spheres can be: both are those of a box. Collective where the box has changed.
void FixWallLsdcd::follow_box()
{
  if (cutoff() == 0) return;
  for (const MeshPart &m : parts)
    if (!m.wall.fits(m.box_seen(simulation_box()))) {
      rebuild(cutoff());
      return;
    }
}

void FixWallLsdcd::give_grid(const MeshPart &m)
{
  lsdcd::run_collectively(world, true, [&] { engine->set_grid(m.wall.view(), m.index); });
}

// What overlaps rounded to floats make of the pull-off force, of itself; 0 where none are or
// nothing holds. `radius`: the largest.
static double pull_off_rounding(const lsdcd::WallSettings &settings, const lsdcd::GridView &grid,
                                double radius)
{
  if (settings.precision == lsdcd::Precision::double_) return 0;
  return lsdcd::pull_off_slope(settings.law, radius) * 1e-6 * (radius + 14 * grid.length);
}

// The grids that are too small, or for another box.
void FixWallLsdcd::rebuild(double wanted)
{
  times.begin();
  const double old = cutoff();
  schedule.expire();
  std::vector<MeshPart *> anew;
  for (MeshPart &m : parts)
    if (wanted != old || !m.wall.fits(m.box_seen(simulation_box()))) anew.push_back(&m);
  if (old > 0) {
    springs_on_host();
    // Images get other numbers: a spring on one goes to what that is an image of.
    for (const MeshPart *m : anew)
      history->rename_features([&](int mesh, lsdcd::FeatureCode f) {
        return mesh == m->index ? without_image(mesh, f) : f;
      });
  }
  for (const MeshPart *m : anew) check_box(*m, wanted);
  try {
    for (MeshPart *m : anew) {
      m->wall.progress = build_progress(*m);
      m->wall.build(wanted, m->box_seen(simulation_box()));
      give_grid(*m);
    }
  } catch (const lsdcd::InputError &e) {
    fatal(e.what());
  }
  times.end(lsdcd::TimeReport::grids);
  if (wanted == old) box_rebuilds++;
  for (MeshPart *m : anew) {
    check_within_cutoff(*m);
    log_build(*m, old);
    check_ends(*m, wanted == old);
    const double rounding = pull_off_rounding(settings, m->wall.view(), wanted);
    if (old == 0 && m == anew.front() && rounding > 0.1)
      warn("with precision mixed overlaps are rounded so that forces may be wrong by " +
           number_text(rounding) +
           " of the pull-off force: use precision double, or softer particles");
  }
}
