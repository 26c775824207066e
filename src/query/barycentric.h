// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The closest point of an answer as shares of the corners of its triangle. The CPU and a GPU use the same source.
#pragma once

#include "base/vec3.h"
#include "tree/triangle_table.h"

#include <cmath>

namespace lsdcd {

LSDCD_FN Real from_0_to_1(Real x)
{
  return fmin(fmax(x, Real(0)), Real(1));
}

// Returns the share of b in the point of the segment from a to b that is nearest to p.
LSDCD_FN Real share_of_end(const Vec3 &a, const Vec3 &b, const Vec3 &p)
{
  const Vec3 along = b - a;
  const Real length_sq = norm_sq(along);
  return length_sq > 0 ? from_0_to_1(dot(along, p - a) / length_sq) : 0;
}

// Returns the shares of the corners of a triangle, which has an area, in its point p: each from 0 to 1, with the sum 1,
// up to one rounding each. The point that they give is off by roundings of the triangle's size, even if the triangle is
// thin: shares are solved for along the longest side after the direction across it, and so correct its rounding. If p
// is past a side by rounding, they are the shares of the nearest point of that side.
LSDCD_FN Vec3 shares_in_triangle(const Vec3 *corner, const Vec3 &p)
{
  int a = 0;
  Real longest_sq = -1;
  for (int k = 0; k < 3; k++) {
    const Real length_sq = norm_sq(corner[k < 2 ? k + 1 : 0] - corner[k]);
    if (length_sq > longest_sq) {
      longest_sq = length_sq;
      a = k;
    }
  }
  const int b = a < 2 ? a + 1 : 0, c = b < 2 ? b + 1 : 0;
  const Vec3 along = corner[b] - corner[a], to_c = corner[c] - corner[a], to_p = p - corner[a];
  const Real per_sq = 1 / longest_sq, c_along = dot(to_c, along) * per_sq,
             p_along = dot(to_p, along) * per_sq;
  const Vec3 c_across = to_c - c_along * along, p_across = to_p - p_along * along;
  const Real of_c = dot(p_across, c_across) / norm_sq(c_across), of_b = p_along - of_c * c_along;
  Vec3 share = {0, 0, 0};
  if ((of_c > 0) & (of_b > 0) & (of_b + of_c < 1)) {
    share[c] = of_c;
    share[b] = of_b;
    share[a] = 1 - (of_b + of_c);
    return share;
  }
  const int from = ((of_c > 0) & (of_b > 0)) ? b : a, to = of_c > 0 ? c : b;
  share[to] = share_of_end(corner[from], corner[to], p);
  share[from] = 1 - share[to];
  return share;
}

// The corners of the triangles of a mesh. Position returns the position of a vertex by its number.
template <class Position>
struct MeshParts {
  TriangleNames names;
  const int *face_vertex, *edge_vertex;    // 3 for each face, 2 for each edge
  Position position;

  // Returns the shares of the corners of the triangle that the table names for this feature, in the order of the file.
  // `point`: the closest point on the feature. They are not numbers if there is no such triangle.
  LSDCD_FN Vec3 barycentric(FeatureCode feature, const Vec3 &point) const
  {
    const std::uint32_t triangle = feature == kNoFeature ? kNoTriangle : names.of(feature);
    if (triangle == kNoTriangle) return {NAN, NAN, NAN};
    const FeatureKind kind = feature_kind(feature);
    const std::uint32_t i = feature_index(feature),
                        face = kind == FeatureKind::face ? i : names.face_of(triangle);
    const int *of_face = face_vertex + 3 * std::size_t(face);
    if (kind == FeatureKind::face) {
      const Vec3 corner[3] = {position(of_face[0]), position(of_face[1]), position(of_face[2])};
      return shares_in_triangle(corner, point);
    }
    int from = static_cast<int>(i), to = from;
    Real share = 0;
    if (kind == FeatureKind::edge) {
      from = edge_vertex[2 * std::size_t(i)];
      to = edge_vertex[2 * std::size_t(i) + 1];
      share = share_of_end(position(from), position(to), point);
    }
    Vec3 shares;
    for (int k = 0; k < 3; k++)
      shares[k] = of_face[k] == from ? 1 - share : of_face[k] == to ? share : 0;
    return shares;
  }
};

// Returns the signed distance, > 0 outside. Not a number if the side is not known; a distance of 0 has no sign.
LSDCD_FN Real signed_distance(Real distance, std::int8_t side)
{
  if (side == 0) return NAN;
  return side < 0 && distance > 0 ? -distance : distance;
}

}    // namespace lsdcd
