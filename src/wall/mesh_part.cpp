// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/mesh_part.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

Box MeshPart::bounds(Real past) const
{
  const MeshReport &r = grid.report();
  const Box box = nodes ? nodes->bounds() : Box{r.lo, r.hi};
  const Vec3 more = {past, past, past};
  return {box.lo - more, box.hi + more};
}

void MeshPart::find_range(const PeriodicBox &box, int k, const Pose &at, Real &lo, Real &hi) const
{
  Real range[2];
  if (nodes) {
    range[0] = HUGE_VAL;
    range[1] = -HUGE_VAL;
    for (const Vec3 &x : nodes->mesh().vertices) {
      const Real part = box.fraction(x)[k];
      range[0] = std::min(range[0], part);
      range[1] = std::max(range[1], part);
    }
  } else if (grid.mesh()) {
    if (!vertices_) vertices_ = std::make_unique<PointTree>(grid.mesh()->vertices);
    const Vec3 along = at.turn_to_mesh(cross(box.edge[(k + 1) % 3], box.edge[(k + 2) % 3]));
    range[0] = box.fraction(at.to_box(vertices_->farthest_along(-1 * along)))[k];
    range[1] = box.fraction(at.to_box(vertices_->farthest_along(along)))[k];
  }
  host_.broadcast(range, sizeof range, 0);
  lo = range[0];
  hi = range[1];
}

// It does where it moves across that edge and turns about nothing but it.
bool MeshPart::keeps_edge(const PeriodicBox &box, int k) const
{
  const Vec3 edge = unit_vector(box.edge[k]),
             across = unit_vector(cross(box.edge[(k + 1) % 3], box.edge[(k + 2) % 3]));
  if (nodes) return false;
  const bool keeps = body ? body->body().keeps(edge, norm(box.edge[k])) : spec.motion.keeps(edge);
  return norm(cross(edge, across)) <= 1e-12 && keeps;
}

// Where its motion keeps an edge, that is the edge, and periodic images are what they are for a
// mesh at rest. Along the others spheres can be anywhere, and nothing repeats: BoxChecks::check_moving()
// sees to it that nothing acts through them. Points of a coat can be anywhere but past a periodic face.
PeriodicBox MeshPart::effective_box(const PeriodicBox &real) const
{
  PeriodicBox box = real;
  if (!moves() && !coat_feels_it) return box;
  for (int k = 0; k < 3; k++) {
    const bool keeps = !moves() || keeps_edge(real, k);
    if (keeps && (real.periodic[k] || !coat_feels_it)) continue;
    Real lo = 0, hi = 1;
    for_corners(bounds(0), [&](const Vec3 &corner) {
      const Real at = real.fraction(corner)[k];
      lo = std::min(lo, at);
      hi = std::max(hi, at);
    });
    box.corner += lo * real.edge[k];
    box.edge[k] = (hi - lo) * real.edge[k];
    box.periodic[k] = false;
    box.face_follows[k][0] = box.face_follows[k][1] = true;    // no limit for the grid
  }
  return box;
}

}    // namespace lsdcd
