// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The paper's distance from a point to a triangle, for the study of its accuracy.
#pragma once

#include "query/nearest_distance.h"

namespace lsdcd {

// Which test says that a point lies over a triangle.
enum class InsideTest {
  exact,
  formula_five    // the paper's
};

// Formula (5): q is said to project into the triangle if, for each side, it lies between
// the two planes across that side's ends. Neither necessary nor sufficient: points outside
// can pass, and in a triangle with an obtuse angle points inside can fail.
LSDCD_FN bool formula_five_inside(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &q)
{
  return dot(q - a, c - a) >= 0 && dot(q - a, b - a) >= 0 && dot(q - b, a - b) >= 0 &&
         dot(q - b, c - b) >= 0 && dot(q - c, a - c) >= 0 && dot(q - c, b - c) >= 0;
}

// The distance to the plane if formula (5) says inside, else to the nearest side.
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

  // It can put a triangle nearer than the bound in its list.
  static constexpr bool kBounded = false;

  LSDCD_FN Real primitive(FeatureCode code, Real) const
  {
    return formula_five_distance(grid_.wall, code, q_);
  }
};

// No grid: every face of the wall, the paper's N = all. Its edges and vertices without a
// face are left out.
template <class Distances>
LSDCD_FN Answer nearest_of_all(const GridView &grid, std::uint32_t n_faces, const Vec3 &q,
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
