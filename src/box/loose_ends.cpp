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

// Of the mesh itself, which comes before its images.
std::size_t own_vertices(const WeldedMesh &mesh)
{
  return mesh.images.any() ? mesh.images.n_vertices : mesh.vertices.size();
}
std::size_t own_edges(const WeldedMesh &mesh)
{
  return mesh.images.any() ? mesh.images.n_edges : mesh.edges.size();
}

// Returns the reach along edge k of the box of each part, by its vertex in `part`, and of the mesh as the last one.
std::vector<Reach> reaches(const WeldedMesh &mesh, const MeshFeaturesView &wall,
                           const PeriodicBox &box, int k, UnionFind &part)
{
  constexpr Real kTowards = 0.5;    // least cosine with the normal of the periodic face
  const std::size_t n = own_vertices(mesh), n_edges = own_edges(mesh);
  std::vector<Reach> reach(n + 1);
  for (std::size_t v = 0; v < n; v++) {
    const Real at = box.fraction(mesh.vertices[v])[k];
    for (Reach *r : {&reach[part.of(static_cast<int>(v))], &reach.back()}) {
      r->lo = std::min(r->lo, at);
      r->hi = std::max(r->hi, at);
    }
  }
  for (std::size_t e = 0; e < n_edges; e++) {
    if (mesh.edge_first[e + 1] - mesh.edge_first[e] != 1) continue;
    const Vec3 out = -wall.edges[e].inward[0];    // unit, in the plane of its face, away from it
    const Real across = box.fraction(box.corner + out)[k] * box.width(k);
    if (std::fabs(across) > kTowards)
      reach[part.of(mesh.edges[e][0])].opens[across > 0] = reach.back().opens[across > 0] = true;
  }
  return reach;
}

UnionFind parts(const WeldedMesh &mesh)
{
  UnionFind part(own_vertices(mesh));
  for (std::size_t e = 0; e < own_edges(mesh); e++) part.join(mesh.edges[e][0], mesh.edges[e][1]);
  return part;
}

// Ends nearer than this meet (length).
Real tolerance(const WeldedMesh &mesh)
{
  const Real diagonal = norm(mesh.report.hi - mesh.report.lo);
  return std::max(mesh.report.weld_tolerance, Real(1e-9) * diagonal);
}

}    // namespace

LooseEnds loose_ends(const WeldedMesh &mesh, const MeshFeaturesView &wall, const PeriodicBox &box,
                     Real cutoff, Real widest)
{
  UnionFind part = parts(mesh);
  const Real met = tolerance(mesh);
  LooseEnds loose;
  for (int k = 0; k < 3; k++) {
    if (!box.periodic[k]) continue;
    for (const Reach &r : reaches(mesh, wall, box, k, part)) {
      const Real gap = (1 - (r.hi - r.lo)) * box.width(k);
      const bool is_near = std::min(r.lo, 1 - r.hi) * box.width(k) < cutoff;
      if (is_near && r.opens[0] && r.opens[1] && gap > std::max(met, loose.gap) && gap <= widest)
        loose = {gap, k};
    }
  }
  return loose;
}

LooseEnds parted_ends(const WeldedMesh &mesh, const MeshFeaturesView &wall,
                      const PeriodicBox &before, const PeriodicBox &box)
{
  UnionFind part = parts(mesh);
  const Real met = tolerance(mesh);
  LooseEnds loose;
  for (int k = 0; k < 3; k++) {
    if (!before.periodic[k] || !box.periodic[k] || before.edge[k] == box.edge[k]) continue;
    const std::vector<Reach> then = reaches(mesh, wall, before, k, part),
                             now = reaches(mesh, wall, box, k, part);
    for (std::size_t n = 0; n < now.size(); n++) {
      const Real gap = (1 - (now[n].hi - now[n].lo)) * box.width(k),
                 was = (1 - (then[n].hi - then[n].lo)) * before.width(k);
      if (now[n].opens[0] && now[n].opens[1] && was <= met && gap > std::max(met, loose.gap))
        loose = {gap, k};
    }
  }
  return loose;
}

}    // namespace lsdcd
