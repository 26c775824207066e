// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/mesh_part.h"

#include <algorithm>

using namespace LAMMPS_NS;

lsdcd::Box MeshPart::bounds(double past) const
{
  const lsdcd::MeshReport &r = wall.report();
  const lsdcd::Vec3 more = {past, past, past};
  return {r.lo - more, r.hi + more};
}

void MeshPart::find_range(const lsdcd::PeriodicBox &box, int k, const lsdcd::WallPose &at,
                          double &lo, double &hi)
{
  double range[2];
  if (wall.mesh()) {
    if (!vertices) vertices = std::make_unique<lsdcd::PointTree>(wall.mesh()->vertices);
    const lsdcd::Vec3 along = at.turn_to_mesh(cross(box.edge[(k + 1) % 3], box.edge[(k + 2) % 3]));
    range[0] = box.fraction(at.to_box(vertices->farthest_along(-1 * along)))[k];
    range[1] = box.fraction(at.to_box(vertices->farthest_along(along)))[k];
  }
  MPI_Bcast(range, 2, MPI_DOUBLE, 0, wall.shared().world());
  lo = range[0];
  hi = range[1];
}

// It does where it moves across that edge and turns about nothing but it.
bool MeshPart::keeps_edge(const lsdcd::PeriodicBox &box, int k) const
{
  const lsdcd::Vec3 edge = lsdcd::unit_vector(box.edge[k]),
                    across =
                        lsdcd::unit_vector(cross(box.edge[(k + 1) % 3], box.edge[(k + 2) % 3]));
  return norm(cross(edge, across)) <= 1e-12 && settings.motion.keeps(edge);
}

// Where its motion keeps an edge, that is the edge, and periodic images are what they are for a
// mesh at rest. Along the others spheres can be anywhere, and nothing repeats: check_moving_box()
// sees to it that nothing acts through them.
lsdcd::PeriodicBox MeshPart::box_seen(const lsdcd::PeriodicBox &real) const
{
  lsdcd::PeriodicBox box = real;
  if (!settings.motion.any()) return box;
  for (int k = 0; k < 3; k++) {
    if (keeps_edge(real, k)) continue;
    double lo = 0, hi = 1;
    lsdcd::for_corners(bounds(0), [&](const lsdcd::Vec3 &corner) {
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
