// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/repair.h"

#include "base/input_error.h"
#include "base/number_words.h"
#include "mesh/assemble.h"
#include "mesh/corners_on_edge.h"
#include "mesh/face_plane.h"
#include "mesh/measure_mesh.h"
#include "mesh/orient_faces.h"
#include "mesh/split_faces.h"
#include "mesh/union_find.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsdcd {

namespace {

Real distance(const Vec3 &a, const Vec3 &b)
{
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

int n_faces(const WeldedMesh &mesh, std::size_t edge)
{
  return mesh.edge_first[edge + 1] - mesh.edge_first[edge];
}

bool has_face_with(const WeldedMesh &mesh, int a, int b)
{
  for (int i = mesh.vertex_first[a]; i < mesh.vertex_first[a + 1]; i++) {
    const int e = mesh.vertex_edge[i];
    const auto &ends = mesh.edges[e];
    if ((ends[0] == b || ends[1] == b) && n_faces(mesh, e) > 0) return true;
  }
  return false;
}

// Bounds the distance of dropped degenerate facets from the mesh that is left. A point of a facet of height h is
// within h of its longest side. Edges of the mesh may follow that side. If no edge follows a piece of it of length
// l, each point of the piece is within l / 2 of one of its ends, and the end is as far from the mesh as from the
// nearest corner of it.
void measure_dropped(const WeldedMesh &mesh, const std::vector<int> &old_corners, Real tolerance,
                     RepairReport &report)
{
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const auto &face : mesh.faces)
    for (const int v : face) used[v] = 1;
  const CornersOnEdge corners(mesh.vertices, used);
  const auto off = [&](int v) { return used[v] ? 0 : corners.distance(mesh.vertices[v]); };

  for (std::size_t c = 0; c < old_corners.size(); c += 3) {
    const int v[3] = {old_corners[c], old_corners[c + 1], old_corners[c + 2]};
    const FacePlane plane =
        face_plane(mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]);
    if (!plane.degenerate) continue;
    int a = v[0], b = v[1];
    for (int k = 1; k < 3; k++) {
      const int p = v[k], q = v[(k + 1) % 3];
      if (distance(mesh.vertices[p], mesh.vertices[q]) >
          distance(mesh.vertices[a], mesh.vertices[b])) {
        a = p;
        b = q;
      }
    }
    std::vector<int> along = {a};
    Real moved = 0;
    if (!has_face_with(mesh, a, b))
      for (const CornersOnEdge::On &on : corners.on(a, b, tolerance)) {
        along.push_back(on.corner);
        moved = std::max(moved, on.off);
      }
    along.push_back(b);
    bool lost = false;
    for (std::size_t i = 1; i < along.size(); i++) {
      const int p = along[i - 1], q = along[i];
      if (p == q ? used[p] : has_face_with(mesh, p, q)) continue;
      lost = true;
      moved = std::max(moved, (distance(mesh.vertices[p], mesh.vertices[q]) + off(p) + off(q)) / 2);
    }
    report.lost_facets += lost;
    report.dropping_moved = std::max(report.dropping_moved, moved + plane.height);
  }
}

void name_what_is_left(const WeldedMesh &mesh, RepairReport &report)
{
  Unmended open = {kOpenEdges}, many = {"edges of more than two facets"},
           against = {"edges along which windings disagree"};
  UnionFind together(mesh.vertices.size());
  std::vector<int> ends;
  const auto count = [&](Unmended &one, std::size_t e) {
    if (one.count++ > 0) return;
    one.place = 0.5 * mesh.vertices[mesh.edges[e][0]] + 0.5 * mesh.vertices[mesh.edges[e][1]];
  };
  for (std::size_t e = 0; e < mesh.edges.size(); e++) {
    const int n = n_faces(mesh, e), first = mesh.edge_first[e];
    if (n == 1) {
      count(open, e);
      together.join(mesh.edges[e][0], mesh.edges[e][1]);
      ends.push_back(mesh.edges[e][0]);
    }
    if (n > 2 && (n % 2 == 1 || !runs_balance(mesh, static_cast<int>(e)))) count(many, e);
    if (n == 2 && runs_along(mesh, mesh.edge_face[first], e) ==
                      runs_along(mesh, mesh.edge_face[first + 1], e))
      count(against, e);
  }
  for (int &v : ends) v = together.of(v);
  std::sort(ends.begin(), ends.end());
  report.boundaries = std::unique(ends.begin(), ends.end()) - ends.begin();
  for (const Unmended &one : {open, many, against})
    if (one.count > 0) report.left.push_back(one);
}

TriangleSoup soup_of(const WeldedMesh &mesh, const std::vector<char> &turned)
{
  TriangleSoup soup;
  soup.source = mesh.source;
  soup.corners.reserve(3 * mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); f++)
    for (int k = 0; k < 3; k++)
      soup.corners.push_back(mesh.vertices[mesh.faces[f][turned[f] ? (3 - k) % 3 : k]]);
  return soup;
}

}    // namespace

RepairedMesh repair(const TriangleSoup &soup, Real tolerance,
                    const std::function<void(const std::string &)> &progress)
{
  const auto tell = [&](const char *what) {
    if (progress) progress(what);
  };
  tell("welding corners");
  RepairedMesh out;
  RepairReport &report = out.report;
  std::vector<int> old_corners;
  WeldedMesh mesh = join_corners(soup, tolerance, old_corners);
  tolerance = report.tolerance = mesh.report.weld_tolerance;
  for (std::size_t c = 0; c < soup.corners.size(); c++) {
    const Real moved = distance(soup.corners[c], mesh.vertices[old_corners[c]]);
    report.welded_corners += moved > 0;
    report.welding_moved = std::max(report.welding_moved, moved);
  }
  report.degenerate_facets = mesh.report.degenerate_facets;
  report.duplicate_facets = mesh.report.duplicate_facets;

  // Pieces may lay open edges bare that others lie on. A piece that equals a face is dropped, so that
  // open edges may come back; this ends because no face is cut twice and vertices stay the same.
  CutBefore cut_before;
  for (;;) {
    tell("cutting facets at corners of neighbours");
    const SplitFaces split = split_faces(mesh, tolerance, cut_before);
    if (split.junctions == 0) break;
    report.junctions += split.junctions;
    report.splitting_moved += split.moved;
    report.split_facets += split.faces;
    mesh = assemble(std::move(mesh.vertices), split.corners, {});
    report.duplicate_facets += mesh.report.duplicate_facets;
  }
  if (mesh.faces.empty())
    throw InputError(soup.source + ": its " +
                     counted(soup.n_triangles(), "facet has", "facets have") +
                     " no area, so nothing is left; give a smaller --weld");
  mesh.source = soup.source;
  if (report.degenerate_facets > 0) {
    connect_vertices(mesh);
    measure_dropped(mesh, old_corners, tolerance, report);
  }
  tell("winding facets");
  const OrientedFaces oriented = orient_faces(mesh);
  report.turned_facets = oriented.faces;
  report.shells = oriented.shells;
  report.cavities = oriented.cavities;
  out.soup = soup_of(mesh, oriented.turned);
  out.mesh = weld(out.soup, 0);    // its corners are apart, or equal
  out.mesh.report.weld_tolerance = tolerance;
  name_what_is_left(out.mesh, report);
  return out;
}

}    // namespace lsdcd
