// The paper's distance from a point to a triangle, kept for its study.
#pragma once

#include "geometry/primitive_distance.h"

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

// The plane's distance where formula (5) says inside, elsewhere the nearest side's.
LSDCD_FN Real formula_five_distance(const WallFeaturesView &wall, FeatureCode primitive,
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

}    // namespace lsdcd
