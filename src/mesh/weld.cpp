// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/welded_mesh.h"

#include "base/countable.h"
#include "base/input_error.h"
#include "base/input_words.h"
#include "mesh/assemble.h"
#include "mesh/cracks.h"
#include "mesh/face_plane.h"
#include "mesh/hash_index.h"
#include "mesh/measure_mesh.h"
#include "mesh/weld_map.h"
#include "mesh/weld_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace lsdcd {
namespace {

using Triple = std::array<int, 3>;
using Pair = std::array<int, 2>;

void check_tolerance(Real tolerance, Real diagonal, const std::string &source)
{
  if (std::isnan(tolerance) || (diagonal > 0 && tolerance >= diagonal))
    throw InputError(source + ": a weld tolerance of " + number_text(tolerance) +
                     " would weld the whole mesh, " + number_text(diagonal) +
                     " across, into one point; give a smaller one");
}

Triple sorted(Triple t)
{
  std::sort(t.begin(), t.end());
  return t;
}

bool are_wound_alike(const Triple &a, const Triple &b)
{
  int k = 0;
  while (b[k] != a[0]) ++k;
  return b[(k + 1) % 3] == a[1];
}

// A facet that is a face again.
struct Copy {
  int face;
  bool is_wound_alike;
};

void count_two_sided(std::vector<Copy> copies, MeshReport &report)
{
  std::sort(copies.begin(), copies.end(),
            [](const Copy &a, const Copy &b) { return a.face < b.face; });
  for (std::size_t i = 0, end = 0; i < copies.size(); i = end) {
    int alike = 1, against = 0;
    for (end = i; end < copies.size() && copies[end].face == copies[i].face; end++)
      ++(copies[end].is_wound_alike ? alike : against);
    report.two_sided_faces += against > 0;
    report.sheet_faces += against == alike;
  }
}

// Sorts facets into faces and degenerate ones, of which the edges stay.
void sort_facets(const std::vector<int> &corner_point, WeldedMesh &mesh,
                 std::vector<FacePlane> &plane, std::vector<Pair> &bare_edges)
{
  const std::size_t n_facets = corner_point.size() / 3;
  HashIndex seen;
  std::vector<Copy> copies;
  for (std::size_t facet = 0; facet < n_facets; ++facet) {
    const Triple face = {corner_point[3 * facet], corner_point[3 * facet + 1],
                         corner_point[3 * facet + 2]};
    const auto &x = mesh.vertices;
    const FacePlane its_plane = face_plane(x[face[0]], x[face[1]], x[face[2]]);
    if (its_plane.degenerate) {
      ++mesh.report.degenerate_facets;
      for (int k = 0; k < 3; ++k)
        if (face[k] != face[(k + 1) % 3]) bare_edges.push_back({face[k], face[(k + 1) % 3]});
      if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0])
        mesh.dropped.push_back(face);
      continue;
    }
    const Triple key = sorted(face);
    const int fresh = static_cast<int>(mesh.faces.size());
    const auto hash = hash_three<std::int64_t>(key[0], key[1], key[2]);
    const auto is_same = [&](int f) { return sorted(mesh.faces[f]) == key; };
    const int found = seen.find_or_insert(hash, fresh, is_same);
    if (found != fresh) {
      ++mesh.report.duplicate_facets;
      copies.push_back({found, are_wound_alike(mesh.faces[found], face)});
      mesh.dropped.push_back(face);
      continue;
    }
    mesh.faces.push_back(face);
    mesh.face_facet.push_back(facet);
    plane.push_back(its_plane);
  }
  count_two_sided(std::move(copies), mesh.report);
}

// Turns counts per row, each stored one entry further on, into first indices.
void accumulate(std::vector<int> &first)
{
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
}

// Every side of a face and every bare edge goes into the bucket of its lower vertex. Sorted by
// the higher vertex, equal sides are neighbours and make an edge.
void build_edges(WeldedMesh &mesh, const std::vector<Pair> &bare_edges)
{
  constexpr std::uint32_t kNoSide = 0xffffffff;
  const auto key = [](int higher, std::uint32_t side) {
    return static_cast<std::uint64_t>(higher) << 32 | side;
  };
  // Calls put(lower vertex, key) for all of them; side 3 f + k is side k of face f.
  const auto for_each_side = [&](auto put) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      for (int k = 0; k < 3; ++k) {
        const int a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];
        put(std::min(a, b), key(std::max(a, b), static_cast<std::uint32_t>(3 * f) + k));
      }
    for (const Pair &edge : bare_edges)
      put(std::min(edge[0], edge[1]), key(std::max(edge[0], edge[1]), kNoSide));
  };

  const std::size_t n_vertices = mesh.vertices.size();
  std::vector<int> first(n_vertices + 1, 0);
  for_each_side([&](int lower, std::uint64_t) { ++first[lower + 1]; });
  accumulate(first);
  std::vector<std::uint64_t> sides(first.back());
  std::vector<int> fill(first.begin(), first.end() - 1);
  for_each_side([&](int lower, std::uint64_t side) { sides[fill[lower]++] = side; });

  mesh.face_edges.resize(mesh.faces.size());
  mesh.edge_face.reserve(3 * mesh.faces.size());
  for (std::size_t lower = 0; lower < n_vertices; ++lower) {
    std::sort(sides.begin() + first[lower], sides.begin() + first[lower + 1]);
    int last = -1;
    for (int s = first[lower]; s < first[lower + 1]; ++s) {
      const int higher = static_cast<int>(sides[s] >> 32);
      const auto side = static_cast<std::uint32_t>(sides[s]);
      if (higher != last) {
        mesh.edge_first.push_back(static_cast<int>(mesh.edge_face.size()));
        mesh.edges.push_back({static_cast<int>(lower), higher});
        last = higher;
      }
      if (side == kNoSide) continue;
      mesh.face_edges[side / 3][side % 3] = static_cast<int>(mesh.edges.size()) - 1;
      mesh.edge_face.push_back(static_cast<int>(side / 3));
    }
  }
  mesh.edge_first.push_back(static_cast<int>(mesh.edge_face.size()));
}

// A larger angle between the normals of two faces in one plane does not come from rounding.
constexpr Real kFlatFold = 1e-12;    // radian

// Do its two faces lie in one plane, up to the rounding of normals?
bool seems_flat(const WeldedMesh &mesh, const std::vector<FacePlane> &plane, int e)
{
  if (mesh.edge_first[e + 1] - mesh.edge_first[e] != 2) return false;
  const int f = mesh.edge_face[mesh.edge_first[e]], g = mesh.edge_face[mesh.edge_first[e] + 1];
  const Vec3 &a = plane[f].normal, &b = plane[g].normal;
  return norm(runs_along(mesh, f, e) == runs_along(mesh, g, e) ? a + b : a - b) <= kFlatFold;
}

// Flat edges hold no contact. They get the last numbers, so that they need no records (mesh_features.h).
void number_flat_edges_last(WeldedMesh &mesh, const std::vector<FacePlane> &plane)
{
  const int n = static_cast<int>(mesh.edges.size());
  std::vector<int> number(n, -1);
  int next = 0;
  for (int e = 0; e < n; ++e)
    if (!seems_flat(mesh, plane, e)) number[e] = next++;
  for (int &k : number)
    if (k < 0) k = next++;
  number_edges(mesh, number);
}

void build_vertex_edges(WeldedMesh &mesh)
{
  check_edge_number(mesh.edges.size(), mesh.source);
  mesh.vertex_first.assign(mesh.vertices.size() + 1, 0);
  for (const Pair &edge : mesh.edges)
    for (const int v : edge) ++mesh.vertex_first[v + 1];
  accumulate(mesh.vertex_first);
  mesh.vertex_edge.resize(mesh.vertex_first.back());
  std::vector<int> fill(mesh.vertex_first.begin(), mesh.vertex_first.end() - 1);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    for (const int v : mesh.edges[e]) mesh.vertex_edge[fill[v]++] = static_cast<int>(e);
}

// Faces and edges over mesh.vertices. `plane` becomes those of the faces.
void connect(const std::vector<int> &corner_vertex, WeldedMesh &mesh, std::vector<FacePlane> &plane,
             std::vector<Pair> bare_edges = {})
{
  sort_facets(corner_vertex, mesh, plane, bare_edges);
  build_edges(mesh, bare_edges);
}

// Counts the facets that had an area, and have none where their corners are now.
void measure_collapsed(const TriangleSoup &soup, const std::vector<int> &corner_vertex,
                       WeldedMesh &mesh)
{
  const auto plane_of = [](const std::vector<Vec3> &x, std::size_t a, std::size_t b,
                           std::size_t c) { return face_plane(x[a], x[b], x[c]); };
  for (std::size_t c = 0; c < soup.corners.size(); c += 3) {
    const int *v = &corner_vertex[c];
    const auto moved = [&](int k) { return !(soup.corners[c + k] == mesh.vertices[v[k]]); };
    if (!moved(0) && !moved(1) && !moved(2)) continue;
    if (!plane_of(mesh.vertices, v[0], v[1], v[2]).degenerate) continue;
    const FacePlane before = plane_of(soup.corners, c, c + 1, c + 2);
    if (before.degenerate) continue;
    mesh.report.collapsed_facets++;
    mesh.report.collapsed_area += before.area;
  }
}

WeldedMesh join(const TriangleSoup &soup, Real tolerance, std::vector<int> &corner_vertex,
                std::vector<FacePlane> &plane)
{
  countable(soup.corners.size(), "corners of triangles of " + soup.source, "use a coarser mesh");
  const Real diagonal = checked_diagonal(soup);
  const bool by_default = tolerance < 0;
  if (!by_default) check_tolerance(tolerance, diagonal, soup.source);
  const auto start = [&](std::vector<Vec3> points) {
    WeldedMesh mesh;
    mesh.source = soup.source;
    mesh.report.facets = soup.n_triangles();
    mesh.report.corners = soup.corners.size();
    mesh.report.weld_tolerance = tolerance;
    mesh.vertices = std::move(points);
    return mesh;
  };
  WeldedPoints welded = weld_points(soup.corners, by_default ? 0 : tolerance);
  corner_vertex = std::move(welded.corner_point);
  WeldedMesh mesh = start(std::move(welded.points));
  connect(corner_vertex, mesh, plane);
  if (by_default) {
    const Cracks cracks = find_cracks(mesh, known_rounding(soup));
    if (cracks.closed > 0) {
      welded = move_points({std::move(mesh.vertices), std::move(corner_vertex)}, cracks.onto);
      corner_vertex = std::move(welded.corner_point);
      mesh = start(std::move(welded.points));
      plane.clear();
      connect(corner_vertex, mesh, plane);
    }
    mesh.report.weld_tolerance = cracks.tolerance;
    mesh.report.closed_cracks = cracks.closed;
    mesh.report.widest_crack = cracks.widest;
    mesh.report.coarse_corners = cracks.coarse;
    mesh.report.coordinate_step = cracks.step;
  }
  if (tolerance > 0 || mesh.report.closed_cracks > 0) measure_collapsed(soup, corner_vertex, mesh);
  return mesh;
}

void check_collapsed(const WeldedMesh &mesh, bool by_default)
{
  const MeshReport &r = mesh.report;
  const Real share = r.collapsed_area / (r.area + r.collapsed_area);
  if (!(share > kMostCollapsed)) return;
  throw InputError(mesh.source + ": " +
                   (by_default ? std::string("closing its cracks")
                               : "a weld tolerance of " + number_text(r.weld_tolerance)) +
                   " takes away " + std::to_string(r.collapsed_facets) + " of " +
                   std::to_string(r.facets) + " facets, with " + number_text(100 * share) +
                   " % of the area; give a smaller " +
                   (by_default ? "weld tolerance, or 0" : "one") +
                   ", or let lsdcd repair weld it, which says how far the surface moves");
}

}    // namespace

void check_edge_number(std::size_t n, const std::string &source)
{
  if (n > static_cast<std::size_t>(std::numeric_limits<int>::max()) / 2)
    throw InputError(source + ": " + std::to_string(n) +
                     " edges are more than numbers of their ends can count (1073 million); use a "
                     "coarser mesh");
}

WeldedMesh weld(const TriangleSoup &soup, Real tolerance)
{
  std::vector<int> corner_vertex;
  return weld(soup, tolerance, corner_vertex);
}

WeldedMesh weld(const TriangleSoup &soup, Real tolerance, std::vector<int> &corner_vertex)
{
  std::vector<FacePlane> plane;
  WeldedMesh mesh = join(soup, tolerance, corner_vertex, plane);
  number_flat_edges_last(mesh, plane);
  build_vertex_edges(mesh);
  measure_mesh(mesh, plane);
  check_collapsed(mesh, tolerance < 0);
  // They grew by doubling, and live as long as the wall.
  mesh.vertices.shrink_to_fit();
  mesh.faces.shrink_to_fit();
  mesh.face_facet.shrink_to_fit();
  return mesh;
}

WeldedMesh assemble(std::vector<Vec3> vertices, const std::vector<int> &corners,
                    std::vector<std::array<int, 2>> bare_edges)
{
  WeldedMesh mesh;
  mesh.vertices = std::move(vertices);
  std::vector<FacePlane> plane;
  connect(corners, mesh, plane, std::move(bare_edges));
  return mesh;
}

WeldedMesh join_corners(const TriangleSoup &soup, Real tolerance, std::vector<int> &corner_vertex)
{
  std::vector<FacePlane> plane;
  return join(soup, tolerance, corner_vertex, plane);
}

void number_edges(WeldedMesh &mesh, const std::vector<int> &number)
{
  const std::size_t n = mesh.edges.size();
  std::vector<int> old(n), first, faces;
  for (std::size_t e = 0; e < n; ++e) old[number[e]] = static_cast<int>(e);
  std::vector<Pair> edges;
  edges.reserve(n);
  first.reserve(n + 1);
  faces.reserve(mesh.edge_face.size());
  for (const int e : old) {
    edges.push_back(mesh.edges[e]);
    first.push_back(static_cast<int>(faces.size()));
    faces.insert(faces.end(), mesh.edge_face.begin() + mesh.edge_first[e],
                 mesh.edge_face.begin() + mesh.edge_first[e + 1]);
  }
  first.push_back(static_cast<int>(faces.size()));
  mesh.edges = std::move(edges);
  mesh.edge_first = std::move(first);
  mesh.edge_face = std::move(faces);
  for (auto &face : mesh.face_edges)
    for (int &e : face) e = number[e];
}

std::vector<std::array<int, 3>> facets_without_area(const WeldedMesh &mesh)
{
  const std::vector<Vec3> &x = mesh.vertices;
  std::vector<Triple> all;
  for (const Triple &facet : mesh.dropped)
    if (face_plane(x[facet[0]], x[facet[1]], x[facet[2]]).degenerate) all.push_back(facet);
  return all;
}

void connect_vertices(WeldedMesh &mesh)
{
  build_vertex_edges(mesh);
}

}    // namespace lsdcd
