// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The paper's distance from a point to a triangle, and the study's own search of a cell's list: it counts the entries
// that it reads, and it takes distances that may be below the bounds of a list.
#pragma once

#include "query/nearest_distance.h"

#include <cstdint>
#include <type_traits>

namespace lsdcd {

// Formula (5): q is said to project into the triangle if, for each side, it lies between
// the two planes across that side's ends. Neither necessary nor sufficient: points outside
// can pass, and in a triangle with an obtuse angle points inside can fail.
LSDCD_FN bool formula_five_inside(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &q)
{
  return dot(q - a, c - a) >= 0 && dot(q - a, b - a) >= 0 && dot(q - b, a - b) >= 0 &&
         dot(q - b, c - b) >= 0 && dot(q - c, a - c) >= 0 && dot(q - c, b - c) >= 0;
}

// Returns the distance to the plane if formula (5) says inside, else to the nearest side.
LSDCD_FN Real formula_five_distance(const MeshFeaturesView &wall, FeatureCode primitive,
                                    const Vec3 &q)
{
  if (feature_kind(primitive) != FeatureKind::face) return primitive_distance(wall, primitive, q);
  const FaceRecord &face = wall.faces[feature_index(primitive)];
  const FaceVertices &corner = wall.face_vertex[feature_index(primitive)];
  const Vec3 a = wall.vertices[corner.v[0]].position, b = wall.vertices[corner.v[1]].position,
             c = wall.vertices[corner.v[2]].position;
  if (formula_five_inside(a, b, c, q)) return fabs(dot(face.normal, q - face.anchor));
  return fmin(segment_distance(a, b, q),
              fmin(segment_distance(b, c, q), segment_distance(c, a, q)));
}

class FormulaFiveDistances : public MeshDistances {
 public:
  LSDCD_FN FormulaFiveDistances(const GridView &grid, const Vec3 &q, const CellAddress &at) :
      MeshDistances(grid, q, at)
  {
  }

  LSDCD_FN Real primitive(FeatureCode code, Real) const
  {
    return formula_five_distance(grid_.wall, code, q_);
  }
};

struct CountedAnswer {
  Real distance;            // from the centre to the wall; kAnyDistance: not within the radius
  bool certified;           // nothing that the list leaves out can be nearer
  std::uint32_t entries;    // that were read

  LSDCD_FN std::uint8_t status() const
  {
    return (distance < kAnyDistance ? kFound : 0) | (certified ? kCertified : 0);
  }
};

// Returns the nearest entry of the list of q's cell within `radius`. The library's search (nearest_in_cell) reads the
// same entries; it ends at the first bound above the nearest distance. Where formula (5) is used no bound ends the
// search, because its distances can be below theirs; a list that is read to its end is certified, and so is one whose
// next entry is farther than the sphere.
template <bool kComplete, class Distances>
LSDCD_FN CountedAnswer search_counted(const GridView &grid, const Vec3 &q, Real radius)
{
  CellAddress at;
  Cell cell;
  if (!find_cell(grid, q, at, cell)) return {kAnyDistance, true, 0};
  const Distances distances(grid, q, at);
  Real nearest = radius;
  bool found = false;
  const auto attempt = [&](FeatureCode code) {
    const Real distance =
        kComplete ? distances.feature(code, nearest) : distances.primitive(code, nearest);
    if (!(distance < nearest)) return;
    nearest = distance;
    found = true;
  };
  const auto answer = [&](bool certified, std::uint32_t entries) -> CountedAnswer {
    return {found ? nearest : kAnyDistance, certified, entries};
  };
  if (cell.count == 1) {    // the entry is in the cell itself
    attempt(cell.first);
    return answer(true, 1);
  }
  const std::uint32_t most = kComplete ? kWholeList : grid.list_kind.most();
  const Real off_centre = norm(at.from_centre);
  for (std::uint32_t k = 0; k < cell.count; k++) {
    const CellEntry entry = grid.lists.entries[cell.first + k];
    constexpr bool kBounded = !std::is_same_v<Distances, FormulaFiveDistances>;
    const bool past = entry.bound > (kBounded ? nearest : radius) + off_centre;
    if (k == most || (kBounded && past)) return answer(past, k + 1);
    attempt(entry.feature);
  }
  return answer(true, cell.count);
}

// Without a grid: every face of the wall, the paper's N = all. Edges and vertices without a face are left out.
template <class Distances>
LSDCD_FN CountedAnswer search_every_face(const GridView &grid, std::uint32_t n_faces, const Vec3 &q,
                                         Real radius)
{
  const Distances distances(grid, q, {nullptr, 0, {0, 0, 0}});
  Real nearest = radius;
  bool found = false;
  for (std::uint32_t face = 0; face < n_faces; face++) {
    const Real distance = distances.primitive(feature_code(FeatureKind::face, face), nearest);
    if (!(distance < nearest)) continue;
    nearest = distance;
    found = true;
  }
  return {found ? nearest : kAnyDistance, true, n_faces};
}

}    // namespace lsdcd
