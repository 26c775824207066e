// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "grid/loose_ends.h"

#include "geometry/primitive_distance.h"
#include "mesh/union_find.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lsdcd {

namespace {

// At most so many tests of an edge against a triangle; with more edges a part is tested.
constexpr double kMaxTests = 2e8;

// An open edge that looks along an edge of the box.
struct End {
  int edge;
  int axis;
  Vec3 middle, out;    // out: unit, in the plane of its face, away from it
};

std::vector<End> ends_of(const WeldedMesh &mesh, const MeshFeaturesView &wall,
                         const PeriodicBox &box)
{
  constexpr Real kTowards = 0.5;    // least cosine with the normal of the periodic face
  std::vector<End> ends;
  for (std::size_t e = 0; e < mesh.images.n_edges; e++) {
    if (mesh.edge_first[e + 1] - mesh.edge_first[e] != 1) continue;
    const Vec3 a = mesh.vertices[mesh.edges[e][0]], b = mesh.vertices[mesh.edges[e][1]];
    const Vec3 out = -wall.edges[e].inward[0];
    for (int k = 0; k < 3; k++) {
      const Real across = box.fraction(out + box.corner)[k] * box.width(k);
      if (box.periodic[k] && std::fabs(across) > kTowards)
        ends.push_back({static_cast<int>(e), k, Real(0.5) * (a + b), out});
    }
  }
  return ends;
}

// Along which axes a connected part of the mesh meets an image, at any of its vertices.
class Meetings {
 public:
  Meetings(const WeldedMesh &mesh, const PeriodicBox &box) :
      part_(mesh.images.n_vertices), meets_(mesh.images.n_vertices, {false, false, false})
  {
    for (std::size_t e = 0; e < mesh.images.n_edges; e++)
      part_.join(mesh.edges[e][0], mesh.edges[e][1]);
    for (std::size_t v = 0; v < mesh.images.n_vertices; v++) {
      const int twin = mesh.images.same_vertex[v];
      if (twin == static_cast<int>(v)) continue;
      const Vec3 apart = box.fraction(mesh.vertices[v]) - box.fraction(mesh.vertices[twin]);
      for (int k = 0; k < 3; k++)
        if (std::fabs(apart[k]) > 0.5) {
          add(static_cast<int>(v), k);
          add(twin, k);
        }
    }
  }
  void add(int vertex, int axis) { meets_[part_.of(vertex)][axis] = true; }
  bool has(int vertex, int axis) { return meets_[part_.of(vertex)][axis]; }

 private:
  UnionFind part_;
  std::vector<std::array<bool, 3>> meets_;
};

}    // namespace

LooseEnds loose_ends(const WeldedMesh &mesh, const MeshFeaturesView &wall, const PeriodicBox &box,
                     Real widest)
{
  LooseEnds loose;
  if (!mesh.images.any()) return loose;
  const std::vector<End> ends = ends_of(mesh, wall, box);
  const std::size_t first = mesh.images.n_faces, n_images = mesh.faces.size() - first;
  const std::size_t stride =
      static_cast<std::size_t>(std::ceil(double(ends.size()) * double(n_images) / kMaxTests));
  // Ends that overlap an image meet it, too.
  const Real diagonal = norm(mesh.report.hi - mesh.report.lo);
  const Real met = std::max(mesh.report.weld_tolerance, Real(1e-9) * diagonal);

  Meetings meetings(mesh, box);
  std::vector<Real> gap(ends.size(), HUGE_VAL);
  for (std::size_t i = 0; i < ends.size(); i += std::max<std::size_t>(1, stride)) {
    const End &end = ends[i];
    for (std::size_t f = first; f < mesh.faces.size(); f++) {
      const Real distance = triangle_distance(wall, static_cast<std::uint32_t>(f), end.middle);
      if (distance <= met) meetings.add(mesh.edges[end.edge][0], end.axis);
      if (distance > widest || distance >= gap[i]) continue;
      bool beyond = true;
      for (int v : mesh.faces[f])
        beyond = beyond && dot(mesh.vertices[v] - end.middle, end.out) > 0;
      if (beyond) gap[i] = distance;
    }
  }
  for (std::size_t i = 0; i < ends.size(); i++) {
    if (gap[i] > widest || meetings.has(mesh.edges[ends[i].edge][0], ends[i].axis)) continue;
    loose.edges++;
    if (gap[i] <= loose.widest) continue;
    loose.widest = gap[i];
    loose.axis = ends[i].axis;
  }
  return loose;
}

}    // namespace lsdcd
