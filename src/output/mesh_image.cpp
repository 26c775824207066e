// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "output/mesh_image.h"

#include <cmath>

namespace lsdcd {

namespace {

constexpr Real kFoldCosine = 0.8660254037844387;    // 30 degrees
constexpr int kLongCuts = 9;    // across the longest side; one across the others

Vec3 unit_normal(const WeldedMesh &mesh, int face)
{
  const auto &f = mesh.faces[face];
  const Vec3 n =
      cross(mesh.vertices[f[1]] - mesh.vertices[f[0]], mesh.vertices[f[2]] - mesh.vertices[f[0]]);
  const Real length = norm(n);
  return length > 0 ? (1 / length) * n : n;
}

bool is_feature(const WeldedMesh &mesh, std::size_t edge)
{
  const int first = mesh.edge_first[edge];
  const int n_faces = mesh.edge_first[edge + 1] - first;
  if (n_faces != 2) return true;
  // For either winding: the sign of one normal must not make a flat pair a fold.
  const Real cosine =
      dot(unit_normal(mesh, mesh.edge_face[first]), unit_normal(mesh, mesh.edge_face[first + 1]));
  return std::fabs(cosine) < kFoldCosine;
}

void add_contour(const WeldedMesh &mesh, int axis, Real level, std::vector<ImageObject> &strokes)
{
  for (const auto &face : mesh.faces) {
    Vec3 cut[3];
    int n = 0;
    for (int k = 0; k < 3; k++) {
      const Vec3 &a = mesh.vertices[face[k]], &b = mesh.vertices[face[(k + 1) % 3]];
      const Real da = a[axis] - level, db = b[axis] - level;
      if ((da < 0) != (db < 0)) cut[n++] = a + (da / (da - db)) * (b - a);
    }
    if (n == 2) strokes.push_back({{cut[0], cut[1], cut[1]}});
  }
}

void add_contours(const WeldedMesh &mesh, std::vector<ImageObject> &strokes)
{
  const Vec3 lo = mesh.report.lo, side = mesh.report.hi - mesh.report.lo;
  int longest = 2;    // level cuts where sides are about equal
  for (int axis = 0; axis < 2; axis++)
    if (side[axis] > Real(1.01) * side[longest]) longest = axis;
  for (int axis = 0; axis < 3; axis++) {
    const int cuts = axis == longest ? kLongCuts : 1;
    for (int k = 0; k < cuts; k++)
      add_contour(mesh, axis, lo[axis] + side[axis] * (k + Real(0.5)) / cuts, strokes);
  }
}

}    // namespace

std::vector<ImageObject> draw_mesh(const WeldedMesh &mesh, Draw what)
{
  std::vector<ImageObject> strokes;
  if (what == Draw::faces)
    for (const auto &f : mesh.faces)
      strokes.push_back({{mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]}});
  if (what == Draw::edges)
    for (std::size_t e = 0; e < mesh.edges.size(); e++)
      if (is_feature(mesh, e)) {
        const Vec3 &a = mesh.vertices[mesh.edges[e][0]], &b = mesh.vertices[mesh.edges[e][1]];
        strokes.push_back({{a, b, b}});
      }
  if (strokes.empty()) add_contours(mesh, strokes);
  return strokes;
}

}    // namespace lsdcd
