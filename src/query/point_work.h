// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The work for each point of a query that asks for more than a distance, with arrays of any layout. All
// backends share this source.
#pragma once

#include "contact/find_contacts.h"
#include "query/barycentric.h"
#include "query/grid_work.h"
#include "tree/triangle_table.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

// The points and answers of a query, borrowed, in memory of the backend that answers. Null arrays are not asked
// for. T: float or double.
template <class T>
struct PointArrays {
  std::size_t n = 0;
  StridedView<const T> points;
  Column<const T> radii;    // null: all points have `radius`
  Real radius = 0;          // nothing farther away is searched for
  Column<T> distance;       // infinite if nothing is found
  Column<T> signed_distance;
  StridedView<T> closest, normal, barycentric;
  std::uint32_t *triangle = nullptr, *feature = nullptr;
  std::int8_t *side = nullptr;
  std::uint8_t *status = nullptr;

  bool only_distance() const
  {
    return !signed_distance.at && !closest.at && !normal.at && !barycentric.at && !triangle &&
           !feature && !side;
  }
  // Writes what is asked for of the nearest point. `found` is kNoFeature if there is none. Parts: MeshParts.
  template <class Parts>
  LSDCD_FN void store(std::size_t i, FeatureCode found, const Vec3 &at, const Vec3 &along,
                      const Parts &parts) const
  {
    if (closest.at) closest.put(i, at);
    if (normal.at) normal.put(i, along);
    if (feature) feature[i] = found;
    if (triangle) triangle[i] = found != kNoFeature ? parts.names.of(found) : kNoTriangle;
    if (barycentric.at) barycentric.put(i, parts.barycentric(found, at));
  }
  LSDCD_FN bool needs_side() const { return side || signed_distance.at; }
  LSDCD_FN void store_side(std::size_t i, Real away, std::int8_t s) const
  {
    if (side) side[i] = s;
    if (signed_distance.at) signed_distance[i] = static_cast<T>(lsdcd::signed_distance(away, s));
  }
};

// The feature of the wall that an answer found, and its closest point to q; in double even if it was found in
// float.
struct Nearest {
  FeatureCode feature;
  Vec3 point, normal;    // normal: unit, point -> q; a fixed one if q is on the wall
};

LSDCD_FN Nearest at_closest(FeatureCode feature, const Vec3 &q, const ClosestPoint &closest)
{
  return {feature, q - closest.distance * closest.normal, closest.normal};
}

// Returns the wall's code for a code in a list.
template <bool kFloats>
LSDCD_FN FeatureCode feature_of_wall(const GridView &grid, FeatureCode listed)
{
  if (!kFloats) return listed;
  const FeatureKind kind = feature_kind(listed);
  const std::uint32_t *of = kind == FeatureKind::face   ? grid.records.face_of
                            : kind == FeatureKind::edge ? grid.records.edge_of
                                                        : grid.records.vertex_of;
  return feature_code(kind, of[feature_index(listed)]);
}

// Orders features at the same distance: the one with the lowest triangle is found, then the lowest code,
// because the lists of two cells have them in different orders.
template <bool kFloats>
struct LowestTriangle {
  static constexpr bool kOrders = true;
  const GridView &grid;
  const TriangleNames &names;

  LSDCD_FN bool operator()(FeatureCode listed_a, FeatureCode listed_b) const
  {
    const FeatureCode a = feature_of_wall<kFloats>(grid, listed_a),
                      b = feature_of_wall<kFloats>(grid, listed_b);
    const std::uint32_t of_a = names.of(a), of_b = names.of(b);
    return of_a < of_b || (of_a == of_b && a < b);
  }
};

template <bool kFloats>
LSDCD_FN Nearest nearest_of(const GridView &grid, const Answer &a, const Vec3 &q)
{
  FeatureCode feature = feature_of_wall<kFloats>(grid, a.feature);
  ClosestPoint closest = closest_point_on(grid.wall, feature, q, grid.tolerance);
  // A triangle of nearest lists also stands for its edges and vertices.
  if (a.primitive && feature_kind(feature) == FeatureKind::face) {
    const FaceParts &parts = grid.wall.face_parts[feature_index(feature)];
    for (FeatureCode part : parts.part) {
      if (part == kNoFeature) continue;
      const ClosestPoint other = closest_point_on(grid.wall, part, q, grid.tolerance);
      if (!other.found || (closest.found && !(other.distance < closest.distance))) continue;
      closest = other;
      feature = part;
    }
  }
  if (closest.found) return at_closest(feature, q, closest);
  // It is not a local minimum of distance: a neighbour outside the list is nearer, or float has rounded.
  Vec3 point;
  switch (feature_kind(feature)) {
    case FeatureKind::face:
      point = nearest_on_triangle(grid.wall, feature_index(feature), q);
      break;
    case FeatureKind::edge: {
      const EdgeVertices &v = grid.wall.edge_vertex[feature_index(feature)];
      point = nearest_on_segment(grid.wall.vertices[v.v[0]].position,
                                 grid.wall.vertices[v.v[1]].position, q);
      break;
    }
    default:
      point = grid.wall.vertices[feature_index(feature)].position;
  }
  const Vec3 apart = q - point;
  const Real distance = norm(apart);
  if (distance > kNoDistance) return {feature, point, (1 / distance) * apart};
  return {feature, point, any_perpendicular({0, 0, 0})};
}

// Returns the side relative to a closed wall: 1 outside and on the wall, -1 inside, 0 if it is not known. The
// edges and vertices that remain of a facet without area have no outward direction.
LSDCD_FN std::int8_t side_of(const GridView &grid, const Answer &a, const Vec3 &q,
                             const Nearest &nearest)
{
  if (!a.found() || !a.certified) return 0;
  if (nearest.point == q) return 1;
  const Vec3 out = outward(grid.wall, nearest.feature);
  if (out == Vec3{0, 0, 0}) return 0;
  return grid.outside * dot(out, nearest.normal) < 0 ? -1 : 1;
}

// Does the work for each point. It has the functions of GridWork, so that the same loops run it. `table` is for
// loops that use cells.
template <class Search, class T>
struct PointWork {
  using Item = SphereOf<T>;
  static constexpr bool kFloats = Search::Distances::kFloats;

  GridView grid;
  BrickTable table;
  PointArrays<T> io;
  TriangleNames names;
  TooLarge<Item> too_large;
  bool only_distance;

  LSDCD_FN Item sphere(std::size_t i) const
  {
    const T *at = io.points.of(i);
    return {at[0], at[io.points.column], at[2 * io.points.column],
            io.radii.at ? io.radii[i] : static_cast<T>(io.radius)};
  }
  LSDCD_FN void check(std::size_t i, const Item &s) const
  {
    if (io.radii.at) too_large.note(i, s);
  }
  LSDCD_FN void find_nearest(std::size_t i, const Item &s) const
  {
    check(i, s);
    store(i, s, nearest_distance<Search>(grid, s.centre(), radius(s), lowest_triangle()));
  }

  LSDCD_FN const Cell *list(std::uint32_t cell) const { return grid.lists.cells + cell; }
  LSDCD_FN void far(std::size_t i, const Item &s) const { store(i, s, far_answer()); }
  LSDCD_FN void search_list(std::size_t i, const Item &s, const Cell &cell) const
  {
    const Vec3 q = s.centre();
    store(
        i, s,
        nearest_from<Search>(grid, q, radius(s), address_inside(grid, q), cell, lowest_triangle()));
  }

 private:
  LSDCD_FN LowestTriangle<kFloats> lowest_triangle() const { return {grid, names}; }
  LSDCD_FN Real radius(const Item &s) const
  {
    return io.radii.at ? static_cast<Real>(s.r) : io.radius;
  }
  LSDCD_FN void store(std::size_t i, const Item &s, const Answer &a) const
  {
    if (io.status) io.status[i] = status_of(a);
    if (io.distance.at) io.distance[i] = static_cast<T>(a.found() ? a.distance : HUGE_VAL);
    if (!only_distance) store_nearest(i, s.centre(), a);
  }
  LSDCD_FN void store_nearest(std::size_t i, const Vec3 &q, const Answer &a) const
  {
    Nearest nearest = {kNoFeature, q, {0, 0, 0}};
    if (a.found()) nearest = nearest_of<kFloats>(grid, a, q);
    io.store(i, nearest.feature, nearest.point, nearest.normal, parts());
    if (io.needs_side()) io.store_side(i, a.distance, side_of(grid, a, q, nearest));
  }
  struct Position {
    const VertexRecord *vertices;
    LSDCD_FN Vec3 operator()(int v) const { return vertices[v].position; }
  };
  LSDCD_FN MeshParts<Position> parts() const
  {
    const MeshFeaturesView &wall = grid.wall;
    return {names, wall.face_vertex->v, wall.edge_vertex->v, {wall.vertices}};
  }
};

// Calls run(work) with the work that the grid's lists and records need.
template <class T, class Run>
void with_point_work(const GridView &grid, const BrickTable &table, const PointArrays<T> &io,
                     const TriangleNames &names, std::uint64_t *too_large, const Run &run)
{
  const TooLarge<SphereOf<T>> check = {static_cast<T>(grid.cutoff), too_large};
  with_list_search(grid, [&](auto search) {
    run(PointWork<decltype(search), T>{grid, table, io, names, check, io.only_distance()});
  });
}

}    // namespace lsdcd
