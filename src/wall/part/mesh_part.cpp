// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/part/mesh_part.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

Box MeshPart::bounds(Real past) const
{
  const Box box = surface->bounds();
  const Vec3 more = {past, past, past};
  return {box.lo - more, box.hi + more};
}

// The box around it is looked at first, then each vertex.
bool MeshPart::reaches(const PeriodicBox &box, int k, Real depth, const Pose &at, Real &lo,
                       Real &hi) const
{
  const auto is_clear = [depth](Real f) { return f > depth && f < 1 - depth; };    // a NaN is not
  bool clear = true;
  for_corners(bounds(0),
              [&](const Vec3 &corner) { clear &= is_clear(box.fraction(at.to_box(corner))[k]); });
  if (clear) return false;
  Real range[2];
  if (const WeldedMesh *own = mesh()) {
    const Vec3 across = cross(box.edge[(k + 1) % 3], box.edge[(k + 2) % 3]),
               along = at.turn_to_mesh(across);
    Real least = HUGE_VAL, most = -HUGE_VAL;
    for (const Vec3 &x : own->vertices) {
      const Real way = dot(along, x);
      least = std::min(least, way);
      most = std::max(most, way);
    }
    const Real begin = dot(across, at.to_box({0, 0, 0}) - box.corner),
               whole = dot(across, box.edge[k]);
    range[0] = (begin + least) / whole;
    range[1] = (begin + most) / whole;
  }
  host_.broadcast(range, sizeof range, 0);
  lo = range[0];
  hi = range[1];
  return !(is_clear(lo) && is_clear(hi));
}

// It does where it moves across that edge and turns about nothing but it.
bool MeshPart::keeps_edge(const PeriodicBox &box, int k) const
{
  const Vec3 edge = unit_vector(box.edge[k]),
             across = unit_vector(cross(box.edge[(k + 1) % 3], box.edge[(k + 2) % 3]));
  return !nodes() && norm(cross(edge, across)) <= 1e-12 && mover.keeps(edge, norm(box.edge[k]));
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
    box.make_unlimited(k);
  }
  return box;
}

}    // namespace lsdcd
