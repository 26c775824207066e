// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/loose_ends.h"

#include "mesh/union_find.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lsdcd {

namespace {

// A connected part of the mesh, or all of it, along an edge of the box: from where to where it goes, in units of that edge, and whether
// open edges look down and up there.
struct Reach {
  Real lo = HUGE_VAL, hi = -HUGE_VAL;
  bool opens[2] = {false, false};
};

}    // namespace

LooseEnds loose_ends(const WeldedMesh &mesh, const MeshFeaturesView &wall, const PeriodicBox &box,
                     Real cutoff, Real widest)
{
  constexpr Real kTowards = 0.5;    // least cosine with the normal of the periodic face
  const PeriodicImages &own = mesh.images;
  UnionFind part(own.n_vertices);
  for (std::size_t e = 0; e < own.n_edges; e++) part.join(mesh.edges[e][0], mesh.edges[e][1]);
  const Real diagonal = norm(mesh.report.hi - mesh.report.lo);
  const Real met = std::max(mesh.report.weld_tolerance, Real(1e-9) * diagonal);
  LooseEnds loose;
  for (int k = 0; k < 3; k++) {
    if (!box.periodic[k]) continue;
    std::vector<Reach> reach(own.n_vertices + 1);    // of parts; the last of the mesh
    for (std::size_t v = 0; v < own.n_vertices; v++) {
      const Real at = box.fraction(mesh.vertices[v])[k];
      for (Reach *r : {&reach[part.of(static_cast<int>(v))], &reach.back()}) {
        r->lo = std::min(r->lo, at);
        r->hi = std::max(r->hi, at);
      }
    }
    for (std::size_t e = 0; e < own.n_edges; e++) {
      if (mesh.edge_first[e + 1] - mesh.edge_first[e] != 1) continue;
      const Vec3 out = -wall.edges[e].inward[0];    // unit, in the plane of its face, away from it
      const Real across = box.fraction(box.corner + out)[k] * box.width(k);
      if (std::fabs(across) > kTowards)
        reach[part.of(mesh.edges[e][0])].opens[across > 0] = reach.back().opens[across > 0] = true;
    }
    for (const Reach &r : reach) {
      const Real gap = (1 - (r.hi - r.lo)) * box.width(k);
      const bool is_near = std::min(r.lo, 1 - r.hi) * box.width(k) < cutoff;
      if (is_near && r.opens[0] && r.opens[1] && gap > std::max(met, loose.gap) && gap <= widest)
        loose = {gap, k};
    }
  }
  return loose;
}

}    // namespace lsdcd
