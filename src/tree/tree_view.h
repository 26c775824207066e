// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A tree of triangles as a search reads it, and what is computed in double of the triangles that it finds: one
// source for the CPU and a GPU, so that both give the same answers.
#pragma once

#include "base/vec3.h"
#include "geometry/closest_point.h"
#include "geometry/feature_code.h"
#include "tree/triangle_table.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

constexpr int kTreeWidth = 8;    // children of a node, triangles of a leaf
constexpr std::uint32_t kTreeLeaf = 0x80000000u;
constexpr std::uint32_t kNoPrimitive = 0xffffffffu;

// Lengths are in units of the mesh's size, from its centre. With u = 2^-24, the rounding of float, a box's distance is
// off by at most sqrt(3) u max|x_k| = 1.04e-7 max|x_k|, and a plane's by 2 * 6 u t = 7.2e-7 t for terms of at most t.
// These constants are larger.
constexpr float kBoxRounding = 2e-7f, kPlaneRounding = 1.2e-6f, kWiden = 1 + 2e-6f;
// Its square, 1e36, is in the range of float.
constexpr float kTreeHuge = 1e18f;
// The square of a longer length, in the unit of the mesh or in its size, may leave the range of Real.
constexpr Real kFarthest = 1e150;
// Farther than this the rounding of float would leave too many triangles.
constexpr Real kFarInUnits = 16;
// Share of the mesh's box that is more than the rounding of share_of_box().
constexpr Real kBoxMargin = 1e-12;
constexpr float kNoBox = 3.402823466e+38f;    // both bounds of a child that is not there
// Room of a search's stack: 7 a level, and 8^12 leaves are more than 32 bits number, so 7 * 12 = 84 is enough.
constexpr int kTreeStack = 128;

// Boxes of the children, rounded outward. The box of a child that is not there is far from all points.
struct alignas(64) TreeNode {
  float lo[3][kTreeWidth], hi[3][kTreeWidth];
  std::uint32_t child[kTreeWidth];    // a node, or with kTreeLeaf a leaf
};
// The plane of each triangle and the planes through its sides, >= 0 inside. With the height h over the plane and p, the
// most that the point is past a side (or 0), the distance d has d^2 >= h^2 + p^2.
struct alignas(64) TreeLeaf {
  float normal[3][kTreeWidth], offset[kTreeWidth];
  float side[3][3][kTreeWidth], side_offset[3][kTreeWidth];
  float origin[3], size;    // offsets are from there, and at most so large
};
// The sides as segments from one corner to the next, from the origin of the leaf, for more than one triangle
// that remains. `over_square`: 1 over the length squared, 0 where that is next to nothing.
struct alignas(64) TreeSides {
  float corner[3][3][kTreeWidth], over_square[3][kTreeWidth];
};
// The record that a distance in double reads: a face, or an edge or a vertex of no face.
struct TreePrimitive {
  // As in a FaceRecord; not set for an edge or a vertex.
  Vec3 normal, inward[3];
  Real height;
  FeatureCode code;
  std::uint32_t vertex[3], edge[3];
};

// The nearest point of a mesh. Features at the same distance are ordered by their triangles, then by their
// codes, and the lowest is found.
struct TreeAnswer {
  Real distance;              // kAnyDistance: nothing is nearer than the radius
  FeatureCode feature;        // face, edge or vertex of the mesh
  std::uint32_t primitive;    // of the tree; a hint for the next point

  LSDCD_FN bool found() const { return feature != kNoFeature; }
};

// The bounds that a point's search uses: in float, or in double where the point is far away. A point that is not a
// number is not searched for: it is far from everything.
enum class TreeSearch { in_float, in_double, none };

struct TreeView {
  const TreeNode *nodes;
  const TreeLeaf *leaves;
  const TreeSides *sides;             // of the leaves
  const TreePrimitive *primitives;    // in the order of the leaves
  std::uint32_t n_primitives, root;
  Vec3 origin;
  Real inv_scale;       // a power of two: the mesh lies within 1 of 0
  Vec3 lo, inv_size;    // of the mesh's box

  // As in WeldedMesh, one number after the other.
  const Vec3 *vertices;
  const int *edges, *edge_first, *edge_face, *faces, *vertex_first, *vertex_edge;
  const std::uint32_t *face_primitive;
  TriangleNames names;
  Real outside;    // sign of the side to which normals point

  LSDCD_FN Vec3 scaled(const Vec3 &x) const { return inv_scale * (x - origin); }
  // `at`: scaled.
  LSDCD_FN static TreeSearch search_for(const Vec3 &at)
  {
    if (!(at.x - at.x == 0 && at.y - at.y == 0 && at.z - at.z == 0)) return TreeSearch::none;
    const Real largest = fmax(fabs(at.x), fmax(fabs(at.y), fabs(at.z)));
    return largest <= kFarInUnits ? TreeSearch::in_float : TreeSearch::in_double;
  }
  // The factor t by which a point beyond kFarthest is brought nearer, to q / t: the mesh is a point from there, so that
  // d(q) = t d(q / t). 1 for all other points.
  LSDCD_FN Real times_nearer(const Vec3 &q) const
  {
    const Real largest = fmax(fabs(q.x), fmax(fabs(q.y), fabs(q.z))),
               most = kFarthest / fmax(inv_scale, Real(1));
    return largest > most && largest - largest == 0 ? largest / most : 1;
  }
  // From 0 to 1 along each axis within the mesh's box.
  LSDCD_FN Vec3 share_of_box(const Vec3 &q) const
  {
    return {(q.x - lo.x) * inv_size.x, (q.y - lo.y) * inv_size.y, (q.z - lo.z) * inv_size.z};
  }

  // Tells that q is outside of the mesh's box, by more than rounding.
  LSDCD_FN bool is_outside_box(const Vec3 &q) const
  {
    const Vec3 share = share_of_box(q);
    return fmin(share.x, fmin(share.y, share.z)) < -kBoxMargin ||
           fmax(share.x, fmax(share.y, share.z)) > 1 + kBoxMargin;
  }

  // An edge has one direction, a < b, so that all its triangles get the same bits.
  LSDCD_FN Real segment(std::uint32_t a, std::uint32_t b, std::uint32_t edge, const Vec3 &q,
                        FeatureCode &feature) const
  {
    if (b < a) {
      const std::uint32_t c = a;
      a = b;
      b = c;
    }
    const Vec3 &from = vertices[a], &to = vertices[b];
    const Vec3 along = to - from, d = q - from;
    const Real length_sq = norm_sq(along), t = dot(along, d);
    if (!(t > 0) || !(length_sq > 0)) {
      feature = feature_code(FeatureKind::vertex, a);
      return norm(d);
    }
    if (t >= length_sq) {
      feature = feature_code(FeatureKind::vertex, b);
      return norm(q - to);
    }
    feature = feature_code(FeatureKind::edge, edge);
    return norm(d - (t / length_sq) * along);
  }

  // The nearest point of a triangle is on its plane where that is inside all sides, else on a side that the
  // point is past.
  LSDCD_FN Real exact(std::uint32_t primitive, const Vec3 &q, FeatureCode &feature) const
  {
    const TreePrimitive &p = primitives[primitive];
    if (feature_kind(p.code) == FeatureKind::face) {
      const Vec3 d = q - vertices[p.vertex[0]];
      const Real side[3] = {dot(p.inward[0], d), dot(p.inward[1], d) + p.height,
                            dot(p.inward[2], d)};
      if ((side[0] >= 0) & (side[1] >= 0) & (side[2] >= 0)) {
        feature = p.code;
        return fabs(dot(p.normal, d));
      }
      Real least = kAnyDistance;
      for (int k = 0; k < 3; k++) {
        if (side[k] >= 0) continue;
        FeatureCode here = kNoFeature;
        const Real distance = segment(p.vertex[k], p.vertex[k < 2 ? k + 1 : 0], p.edge[k], q, here);
        if (!(distance < least) && !(distance == least && here < feature)) continue;
        least = distance;
        feature = here;
      }
      return least;
    }
    if (feature_kind(p.code) == FeatureKind::edge)
      return segment(p.vertex[0], p.vertex[1], p.edge[0], q, feature);
    feature = p.code;
    return norm(q - vertices[p.vertex[0]]);
  }

  // Does `a` replace `b`? An order of all answers, so that the order of a search changes nothing.
  LSDCD_FN bool is_before(const TreeAnswer &a, const TreeAnswer &b) const
  {
    if (!(a.distance <= b.distance)) return false;
    if (a.distance < b.distance) return true;
    if (!b.found() || a.feature == b.feature) return false;
    const std::uint32_t of_a = names.of(a.feature), of_b = names.of(b.feature);
    return of_a < of_b || (of_a == of_b && a.feature < b.feature);
  }
  LSDCD_FN void attempt(std::uint32_t primitive, const Vec3 &q, TreeAnswer &best) const
  {
    TreeAnswer a = {0, kNoFeature, primitive};
    a.distance = exact(primitive, q, a.feature);
    if (is_before(a, best)) best = a;
  }

  // The closest point of a feature that was found, and the unit vector from there to q; a fixed choice where
  // q is on the mesh.
  LSDCD_FN void closest(const TreeAnswer &answer, const Vec3 &q, Vec3 &point, Vec3 &normal) const;

  // Returns on which side of the mesh q is, which must be closed and oriented and must not meet itself: 1 outside
  // and on it, -1 inside; 0 where an edge or a corner of no face is nearest. `point`, `normal`: of closest(). Outside
  // of the box all that counts of the feature is that it has a face: from far away others are as near, up to rounding.
  LSDCD_FN std::int8_t side(const TreeAnswer &answer, const Vec3 &q, const Vec3 &point,
                            const Vec3 &normal) const
  {
    if (point == q) return 1;
    const Vec3 out = outward(answer);
    if (out == Vec3{0, 0, 0}) return 0;
    if (is_outside_box(q)) return 1;
    return outside * dot(out, normal) < 0 ? -1 : 1;
  }

 private:
  LSDCD_FN const Vec3 &face_normal(int face) const
  {
    return primitives[face_primitive[face]].normal;
  }
  // Returns a sum of the normals of a feature's faces, at a vertex by their angles (Baerentzen and Aanaes 2005).
  LSDCD_FN Vec3 outward(const TreeAnswer &answer) const
  {
    const std::uint32_t i = feature_index(answer.feature);
    Vec3 out = {0, 0, 0};
    switch (feature_kind(answer.feature)) {
      case FeatureKind::face:
        return face_normal(static_cast<int>(i));
      case FeatureKind::edge:
        for (int k = edge_first[i]; k < edge_first[i + 1]; k++) out += face_normal(edge_face[k]);
        return out;
      default:
        // Each face is there by two edges.
        for (int e = vertex_first[i]; e < vertex_first[i + 1]; e++)
          for (int k = edge_first[vertex_edge[e]]; k < edge_first[vertex_edge[e] + 1]; k++)
            out += angle_at(edge_face[k], static_cast<int>(i)) * face_normal(edge_face[k]);
        return out;
    }
  }
  LSDCD_FN Real angle_at(int face, int vertex) const
  {
    const int *corner = faces + 3 * face;
    int c = 0;
    while (c < 2 && corner[c] != vertex) c++;
    const Vec3 a = vertices[corner[c < 2 ? c + 1 : 0]] - vertices[vertex],
               b = vertices[corner[c > 0 ? c - 1 : 2]] - vertices[vertex];
    return atan2(norm(cross(a, b)), dot(a, b));
  }
};

LSDCD_FN void TreeView::closest(const TreeAnswer &answer, const Vec3 &q, Vec3 &point,
                                Vec3 &normal) const
{
  const std::uint32_t i = feature_index(answer.feature);
  if (feature_kind(answer.feature) == FeatureKind::face) {
    const TreePrimitive &p = primitives[answer.primitive];
    normal = dot(p.normal, q - vertices[p.vertex[0]]) < 0 ? -p.normal : p.normal;
    point = q - answer.distance * normal;
    return;
  }
  const bool is_edge = feature_kind(answer.feature) == FeatureKind::edge;
  Vec3 along = {0, 0, 0};
  if (is_edge) {
    const Vec3 &from = vertices[edges[2 * i]];
    along = vertices[edges[2 * i + 1]] - from;
    point = from + (dot(along, q - from) / norm_sq(along)) * along;
  } else {
    point = vertices[i];
  }
  const Vec3 apart = q - point;
  const Real distance = norm(apart);
  if (distance > kNoDistance) {
    normal = (1 / distance) * apart;
    return;
  }
  // q is there: the normal points away from the faces of the edge, or from the edges of the vertex.
  Vec3 away = {0, 0, 0};
  if (is_edge) {
    for (int k = edge_first[i]; k < edge_first[i + 1]; k++)
      for (int c = 0; c < 3; c++) {
        const int v = faces[3 * edge_face[k] + c];
        if (v == edges[2 * i] || v == edges[2 * i + 1]) continue;
        Vec3 to = vertices[v] - point;
        to -= (dot(to, along) / norm_sq(along)) * along;
        const Real length = norm(to);
        if (length > 0) away -= (1 / length) * to;
      }
  } else {
    for (int k = vertex_first[i]; k < vertex_first[i + 1]; k++) {
      const int *ends = edges + 2 * vertex_edge[k];
      along = vertices[ends[ends[0] == static_cast<int>(i)]] - point;
      const Real length = norm(along);
      if (length > 0) away -= (1 / length) * along;
    }
  }
  const Real length = norm(away);
  if (length > Real(1e-6)) {
    normal = (1 / length) * away;
    return;
  }
  // Its faces are flat there: the normal is that of one of them.
  normal = any_perpendicular(along);
  if (!is_edge && vertex_first[i] == vertex_first[i + 1]) return;
  const int edge = is_edge ? static_cast<int>(i) : vertex_edge[vertex_first[i]];
  if (edge_first[edge] < edge_first[edge + 1]) normal = face_normal(edge_face[edge_first[edge]]);
}

}    // namespace lsdcd
