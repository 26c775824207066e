// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/periodic_images.h"

#include "box/images_in_reach.h"
#include "mesh/assemble.h"
#include "mesh/union_find.h"
#include "mesh/weld_points.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lsdcd {

namespace {

constexpr int kNoImage = -1;

// The input of welding: the points of the mesh and then those of images.
struct Copies {
  std::vector<Vec3> points;
  std::vector<int> first;        // point of the mesh, and of its image by each shift
  std::vector<int> vertex_of;    // of the mesh, of each point
  std::vector<int> corners;      // three points for each facet, the mesh's first
  std::vector<int> face_of;      // of the mesh, of each facet
  std::vector<std::array<int, 2>> bare_edges;
  std::vector<int> bare_edge_of;    // of the mesh
};

void copy_part(const FacetPart &part, const std::array<int, 3> &points, Copies &out)
{
  if (part.face != kNoPart) {
    out.corners.insert(out.corners.end(), points.begin(), points.end());
    out.face_of.push_back(part.face);
  } else if (part.edge != kNoPart) {
    out.bare_edges.push_back({points[0], points[1]});
    out.bare_edge_of.push_back(part.edge);
  }
}

Copies copies_of(const WeldedMesh &mesh, const PeriodicBox &box, Real depth)
{
  Copies out;
  out.points = mesh.vertices;
  out.first = {0};
  const std::size_t n_vertices = mesh.vertices.size();
  for (std::size_t v = 0; v < n_vertices; v++) out.vertex_of.push_back(static_cast<int>(v));
  const std::vector<FacetPart> parts = parts_of(mesh);
  for (const FacetPart &part : parts) copy_part(part, part.vertex, out);

  std::vector<int> point_of(n_vertices, kNoImage);
  std::size_t first_of_shift = n_vertices;    // of the points
  std::array<int, 3> by = {0, 0, 0};
  Vec3 shift = {0, 0, 0};
  for (const PartImage &image : images_in_reach(mesh, parts, box, depth)) {
    if (image.by != by) {
      by = image.by;
      shift = Real(by[0]) * box.edge[0] + Real(by[1]) * box.edge[1] + Real(by[2]) * box.edge[2];
      for (std::size_t p = first_of_shift; p < out.points.size(); p++)
        point_of[out.vertex_of[p]] = kNoImage;
      first_of_shift = out.points.size();
      out.first.push_back(static_cast<int>(first_of_shift));
    }
    const FacetPart &part = parts[image.part];
    std::array<int, 3> points;
    for (int k = 0; k < 3; k++) {
      const int v = part.vertex[k];
      if (point_of[v] == kNoImage) {
        point_of[v] = static_cast<int>(out.points.size());
        out.points.push_back(mesh.vertices[v] + shift);
        out.vertex_of.push_back(v);
      }
      points[k] = point_of[v];
    }
    copy_part(part, points, out);
  }
  return out;
}

// Returns new numbers for the edges of `whole`: those that `mesh` has, too, get their number there,
// the others follow. The edges of `whole` ascend in their vertices.
std::vector<int> keep_edge_numbers(const WeldedMesh &mesh, WeldedMesh &whole)
{
  std::vector<int> number(whole.edges.size(), -1);
  int next = 0;
  for (const auto &edge : mesh.edges) {
    const auto found = std::lower_bound(whole.edges.begin(), whole.edges.end(), edge);
    number[found - whole.edges.begin()] = next++;
  }
  for (int &e : number)
    if (e < 0) e = next++;
  number_edges(whole, number);
  return number;
}

}    // namespace

WeldedMesh with_images(const WeldedMesh &mesh, const PeriodicBox &box, Real depth)
{
  if (!box.any_periodic()) return mesh;
  const Copies copies = copies_of(mesh, box, depth);
  const std::size_t n_vertices = mesh.vertices.size();
  if (copies.points.size() == n_vertices) return mesh;

  WeldedPoints welded = weld_copies(copies.points, copies.first, mesh.report.weld_tolerance);
  const std::vector<int> &point = welded.corner_point;    // of every copy
  std::vector<int> corners(copies.corners.size());
  for (std::size_t c = 0; c < corners.size(); c++) corners[c] = point[copies.corners[c]];
  std::vector<std::array<int, 2>> bare_edges;
  for (const auto &e : copies.bare_edges)
    if (point[e[0]] != point[e[1]]) bare_edges.push_back({point[e[0]], point[e[1]]});

  WeldedMesh whole = assemble(std::move(welded.points), corners, bare_edges);
  whole.source = mesh.source;
  const std::vector<std::array<int, 2>> ascending = whole.edges;
  const std::vector<int> number = keep_edge_numbers(mesh, whole);
  connect_vertices(whole);

  PeriodicImages &images = whole.images;
  images.n_faces = mesh.faces.size();
  images.n_edges = mesh.edges.size();
  images.n_vertices = n_vertices;
  for (std::size_t &facet : whole.face_facet) {
    const int face = copies.face_of[facet];
    if (facet >= images.n_faces) images.face_of.push_back(face);
    facet = mesh.face_facet[face];
  }
  images.vertex_of.assign(whole.vertices.size() - n_vertices, 0);
  UnionFind same(whole.vertices.size());
  for (std::size_t p = n_vertices; p < copies.points.size(); p++) {
    const int v = point[p];
    if (v >= static_cast<int>(n_vertices)) images.vertex_of[v - n_vertices] = copies.vertex_of[p];
    same.join(v, copies.vertex_of[p]);
  }
  for (std::size_t v = 0; v < whole.vertices.size(); v++)
    images.same_vertex.push_back(same.of(static_cast<int>(v)));

  // The edge of an image with these vertices.
  images.edge_of.assign(whole.edges.size() - images.n_edges, 0);
  const auto name_edge = [&](int a, int b, int edge) {
    const std::array<int, 2> ends = {std::min(a, b), std::max(a, b)};
    const auto found = std::lower_bound(ascending.begin(), ascending.end(), ends);
    if (found == ascending.end() || *found != ends) return;
    const int e = number[found - ascending.begin()];
    if (e >= static_cast<int>(images.n_edges)) images.edge_of[e - images.n_edges] = edge;
  };
  for (std::size_t f = images.n_faces; f < copies.face_of.size(); f++)
    for (int k = 0; k < 3; k++)
      name_edge(corners[3 * f + k], corners[3 * f + (k + 1) % 3],
                mesh.face_edges[copies.face_of[f]][k]);
  for (std::size_t e = 0; e < copies.bare_edges.size(); e++)
    name_edge(point[copies.bare_edges[e][0]], point[copies.bare_edges[e][1]],
              copies.bare_edge_of[e]);

  whole.report = mesh.report;
  for (const Vec3 &x : whole.vertices)
    for (int k = 0; k < 3; k++) {
      whole.report.lo[k] = std::min(whole.report.lo[k], x[k]);
      whole.report.hi[k] = std::max(whole.report.hi[k], x[k]);
    }
  return whole;
}

}    // namespace lsdcd
