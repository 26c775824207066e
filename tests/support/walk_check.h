// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// One sphere on a random walk inside the margin of its list of the wall: what has to hold in every
// step.
#pragma once

#include "engine/step/narrow_phase.h"
#include "support/pair_check.h"

namespace lsdcd {

template <class T>
struct WalkMesh {
  PairMesh<T> pairs;
  const FeatureCode *features;    // all that can hold a contact, ascending
  int n_features;
  // Lists are gathered for this share of the margin that is walked: 1, or less to show that the
  // check can fail.
  Real gathered;
};

// Counts of one sphere or, added up, of many.
struct Walks {
  long spheres = 0, with_list = 0, steps = 0, touching = 0;    // the last two are of lists
  long missed = 0;                                             // contacts of all features alone
  long extra = 0;                                              // contacts of the list alone
  long pruned = 0;      // steps that touch, of spheres that a choice with this margin leaves out
  long by_cells = 0;    // contacts that cells give and no listed feature does
  long wrong = 0;       // nearest contacts that are not at the distance to all triangles
  Real error = 0;       // largest of these distances, over the tolerance

  LSDCD_FN void add(const Walks &o)
  {
    spheres += o.spheres;
    with_list += o.with_list;
    steps += o.steps;
    touching += o.touching;
    missed += o.missed;
    extra += o.extra;
    pruned += o.pruned;
    by_cells += o.by_cells;
    wrong += o.wrong;
    if (!(o.error <= error)) error = o.error;
  }
  LSDCD_FN bool failed() const { return missed + extra + pruned + by_cells + wrong > 0; }
};

// A sphere, how far from its centre it feels the wall, and where its walk goes first.
struct Walker {
  Sphere sphere;
  Real cutoff;
  Vec3 aim;
};

// Every other sphere starts so that its whole margin takes it just into the region of a feature:
// through its rim, or from a distance of cutoff and margin.
template <class T>
LSDCD_FN Walker walker_of(const WalkMesh<T> &mesh, std::uint64_t i)
{
  const GridView &grid = mesh.pairs.grid;
  const Sphere s = sphere_of(mesh.pairs, i);
  Numbers r(mesh.pairs.seed + 0x9e3779b97f4aull * (i + 1));
  const Real cutoff = r.below(4) ? s.radius : r.in(s.radius, grid.cutoff);
  if (r.below(2)) return {s, cutoff, s.x + s.radius * r.direction()};

  const Real most = kSkinFraction * s.radius, margin = most < grid.length ? most : grid.length;
  const Real in = Real(1e-3) * margin, side = r.below(2) ? 1 : -1;
  const FeatureCode code = mesh.features[r.below(mesh.n_features)];
  const std::uint32_t at = feature_index(code);
  Vec3 point, up, through;
  if (feature_kind(code) == FeatureKind::face) {
    const FaceRecord &f = grid.wall.faces[at];
    const int k = r.below(3);
    const Vec3 a = grid.wall.vertices[grid.wall.face_vertex[at].v[k]].position,
               b = grid.wall.vertices[grid.wall.face_vertex[at].v[(k + 1) % 3]].position;
    point = a + r.in(0, 1) * (b - a) + in * f.inward[k];
    up = side * f.normal;
    through = f.inward[k];
  } else if (feature_kind(code) == FeatureKind::edge) {
    const EdgeRecord &e = grid.wall.edges[at];
    up = any_perpendicular(e.direction);
    if (e.n_faces > 0) up = -e.inward[0];
    const bool end = r.below(2);
    point = e.anchor + (end ? in : r.in(0, 1) * e.length) * e.direction;
    through = end ? e.direction : cross(e.direction, up);
  } else {
    const VertexRecord &v = grid.wall.vertices[at];
    const Vec3 along =
        v.count > 0 ? grid.wall.vertex_direction[v.first + r.below(v.count)] : r.direction();
    point = v.position;
    up = any_perpendicular(along);
    through = -along;
    if (r.below(2)) up = -along;
  }
  const bool over_rim = r.below(2);
  const Vec3 aim = point + (over_rim ? r.in(0, cutoff) : cutoff - in) * up;
  const Vec3 from = aim - (1 - Real(2e-6)) * margin * (over_rim ? through : -up);
  return {{from, s.radius}, cutoff, aim};
}

// The point q, or where the list still holds on the way to it: at the very margin.
LSDCD_FN Vec3 within_margin(const FeatureLists &lists, const Vec3 &from, const Vec3 &q, Real cutoff)
{
  if (lists.holds(0, q, cutoff)) return q;
  const Vec3 way = q - from;
  for (Real less = 1e-12; less < 1; less *= 4) {
    const Vec3 at = from + ((1 - less) * lists.margin(0) / norm(way)) * way;
    if (lists.holds(0, at, cutoff)) return at;
  }
  return from;
}

template <int kMost>
LSDCD_FN bool has_contact(const ContactSet<kMost> &set, FeatureCode feature, const Vec3 &normal,
                          Real distance)
{
  for (int k = 0; k < set.n; k++)
    if (set.feature[k] == feature && set.distance[k] == distance && set.normal[k] == normal)
      return true;
  return false;
}

template <int kMost>
LSDCD_FN long not_in(const ContactSet<kMost> &a, const ContactSet<kMost> &b)
{
  long n = a.overflow;
  for (int k = 0; k < a.n; k++) n += !has_contact(b, a.feature[k], a.normal[k], a.distance[k]);
  return n;
}

// No more answer than a list has room for.
using WalkSet = ContactSet<FeatureList::kMax + 1>;

// Against every feature of the wall: the same contacts to the bit.
LSDCD_FN void compare_with_all(const GridView &grid, const FeatureCode *features, int n_features,
                               const Vec3 &q, Real cutoff, const WalkSet &set, Walks &out)
{
  WalkSet all;
  const MeshGeometry geometry(grid, q);
  for (int i = 0; i < n_features && !all.overflow; i++)
    add_feature(geometry, features[i], cutoff, all);
  out.missed += not_in(all, set);
  out.extra += not_in(set, all);
}

// Contacts of cells that no listed feature has. Which of several near points
// stands for all of them may depend on their order, which is another one in cells: the points of all
// listed features count.
LSDCD_FN long not_listed(const GridView &grid, const FeatureLists &lists, const Vec3 &q,
                         Real cutoff, const WalkSet &cells)
{
  const MeshGeometry geometry(grid, q);
  WalkSet listed;
  for (int k = 0; k < lists.size(0); k++) {
    const ClosestPoint closest = geometry.closest_point(lists.code(0, k), cutoff);
    if (closest.found) listed.add(lists.code(0, k), closest.normal, closest.distance);
  }
  return not_in(cells, listed);
}

constexpr int kWalkSteps = 16;

template <class T>
LSDCD_FN Walks check_walk(const WalkMesh<T> &mesh, std::uint64_t i)
{
  const GridView &grid = mesh.pairs.grid;
  const Walker w = walker_of(mesh, i);
  const Vec3 from = w.sphere.x;
  Walks out;
  out.spheres = 1;
  FeatureList made;
  const QuerySphere sphere = {from, w.sphere.radius, w.cutoff, nullptr, 0};
  const Warp<1> alone;
  if (!gather(alone, true, grid, sphere, kAnyDistance, made)) return out;
  out.with_list = 1;
  if (mesh.gathered < 1) {
    const Real margin = made.margin;
    gather_within(alone, true, grid, from, w.cutoff, mesh.gathered * margin, made);
    made.margin = margin;
  }
  Real reals[FeatureLists::kReals];
  std::int32_t ints[FeatureLists::kInts];
  const FeatureLists lists = {reals, reinterpret_cast<float *>(reals + 3), ints, 1, grid.length};
  lists.put(0, made, grid.wall);

  Numbers r(mesh.pairs.seed + 0xd1342543de82ull * (i + 1));
  const Real margin = lists.margin(0);
  const bool chosen = can_touch(alone, true, grid, sphere, mesh.gathered * margin);
  Vec3 q = from;
  for (int step = 0; step < kWalkSteps; step++) {
    if (step == 0)
      q = w.aim;
    else
      q += margin * (r.below(2) ? r.in(0, 2) : r.log_in(1e-9, 1)) * r.direction();
    q = within_margin(lists, from, q, w.cutoff);
    WalkSet set, cells;
    find_in_list(grid, {lists, 0}, q, w.cutoff, set);
    out.steps++;
    out.touching += set.n > 0;
    compare_with_all(grid, mesh.features, mesh.n_features, q, w.cutoff, set, out);
    find_contacts_in<PackedEntries>(grid, q, w.cutoff, cells);
    out.pruned += cells.n > 0 && !chosen;
    out.by_cells += not_listed(grid, lists, q, w.cutoff, cells);
    if (step > 0) continue;
    const PairMesh<T> &pairs = mesh.pairs;
    const Real d = long_distance(pairs.triangle, pairs.n_triangles, q);
    if (set.n == 0) {
      out.wrong += d < w.cutoff - pairs.tolerance;
      continue;
    }
    Real nearest = set.distance[0];
    for (int k = 1; k < set.n; k++)
      if (set.distance[k] < nearest) nearest = set.distance[k];
    out.error = fabs(nearest - d) / pairs.tolerance;
    out.wrong += !(out.error <= 1);
  }
  return out;
}

}    // namespace lsdcd
