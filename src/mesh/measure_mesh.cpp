// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/measure_mesh.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "mesh/orient_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsdcd {
namespace {

constexpr Real kDegrees = 180 / kPi;
constexpr Real kFeatureFold = 30;    // degrees

void measure_edge_lengths(WeldedMesh &mesh)
{
  if (mesh.edges.empty()) return;
  MeshReport &report = mesh.report;
  std::vector<Real> lengths;
  lengths.reserve(mesh.edges.size());
  for (const auto &edge : mesh.edges)
    lengths.push_back(norm(mesh.vertices[edge[1]] - mesh.vertices[edge[0]]));
  const auto ends = std::minmax_element(lengths.begin(), lengths.end());
  report.smallest_edge = *ends.first;
  report.largest_edge = *ends.second;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  report.median_edge = *middle;
}

void measure_faces(WeldedMesh &mesh, const std::vector<FacePlane> &plane)
{
  if (mesh.faces.empty()) return;
  MeshReport &report = mesh.report;
  // Relative to the middle of the box: far from the origin the terms would be large and cancel.
  const Vec3 middle = 0.5 * report.lo + 0.5 * report.hi;
  long double area = 0, volume = 0;
  report.smallest_height = plane[0].height;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    area += plane[f].area;
    volume += plane[f].area * dot(plane[f].normal, mesh.vertices[mesh.faces[f][0]] - middle) / 3;
    report.smallest_height = std::min(report.smallest_height, plane[f].height);
  }
  report.area = static_cast<Real>(area);
  report.volume = static_cast<Real>(volume);
}

void measure_adjacency(WeldedMesh &mesh, const std::vector<FacePlane> &plane)
{
  MeshReport &report = mesh.report;
  bool even = true;
  for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e) {
    const int n_faces = mesh.edge_first[e + 1] - mesh.edge_first[e];
    if (n_faces == 1) ++report.open_edges;
    if (n_faces > 2) {
      ++report.nonmanifold_edges;
      if (n_faces % 2 == 0 && !runs_balance(mesh, e)) ++report.misoriented_edges;
    }
    even = even && n_faces % 2 == 0;
    if (n_faces != 2) continue;
    const int f = mesh.edge_face[mesh.edge_first[e]], g = mesh.edge_face[mesh.edge_first[e] + 1];
    const bool misoriented = runs_along(mesh, f, e) == runs_along(mesh, g, e);
    if (misoriented) ++report.misoriented_edges;
    const Vec3 n = misoriented ? -plane[g].normal : plane[g].normal;
    const Real fold =
        std::atan2(norm(cross(plane[f].normal, n)), dot(plane[f].normal, n)) * kDegrees;
    report.largest_fold = std::max(report.largest_fold, fold);
    if (fold > kFeatureFold) ++report.feature_edges;
  }
  report.closed = !mesh.faces.empty() && even;
  if (!report.closed || report.misoriented_edges > 0) return;
  const ShellFaults faults = faults_of_shells(mesh);
  report.inverted_facets = faults.inverted_faces;
  report.meeting_pairs = faults.meetings.pairs;
  report.oriented =
      report.inverted_facets == 0 && report.meeting_pairs == 0 && report.two_sided_faces == 0;
}

}    // namespace

void set_bounds(WeldedMesh &mesh)
{
  MeshReport &report = mesh.report;
  report.lo = report.hi = mesh.vertices[0];
  for (const Vec3 &x : mesh.vertices)
    for (int i = 0; i < 3; ++i) {
      report.lo[i] = std::min(report.lo[i], x[i]);
      report.hi[i] = std::max(report.hi[i], x[i]);
    }
}

bool runs_along(const WeldedMesh &mesh, int face, int edge)
{
  int k = 0;
  while (mesh.face_edges[face][k] != edge) ++k;
  return mesh.faces[face][k] == mesh.edges[edge][0];
}

bool runs_balance(const WeldedMesh &mesh, int edge)
{
  int sum = 0;
  for (int i = mesh.edge_first[edge]; i < mesh.edge_first[edge + 1]; i++)
    sum += runs_along(mesh, mesh.edge_face[i], edge) ? 1 : -1;
  return sum == 0;
}

void note_meetings(WeldedMesh &mesh, const SelfMeetings &meetings)
{
  if (!mesh.report.oriented) return;
  mesh.report.meeting_pairs = meetings.pairs;
  mesh.report.oriented = mesh.report.meeting_pairs == 0;
}

void check_has_area(const WeldedMesh &mesh)
{
  if (!mesh.faces.empty()) return;
  throw InputError(mesh.source + ": its " +
                   counted(mesh.report.facets, "facet has", "facets have") +
                   " no area, so there is no wall; export the mesh again, or, "
                   "where facets are small, give a smaller weld tolerance");
}

void measure_mesh(WeldedMesh &mesh, const std::vector<FacePlane> &plane)
{
  mesh.report.vertices = mesh.vertices.size();
  mesh.report.edges = mesh.edges.size();
  set_bounds(mesh);
  measure_edge_lengths(mesh);
  measure_faces(mesh, plane);
  measure_adjacency(mesh, plane);
}

void measure_again(WeldedMesh &mesh)
{
  MeshReport &report = mesh.report;
  report.open_edges = report.nonmanifold_edges = report.misoriented_edges = report.feature_edges =
      0;
  report.inverted_facets = report.meeting_pairs = 0;
  report.largest_fold = 0;
  report.oriented = false;
  std::vector<FacePlane> plane;
  plane.reserve(mesh.faces.size());
  for (const auto &f : mesh.faces)
    plane.push_back(face_plane(mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]));
  measure_mesh(mesh, plane);
}

Real checked_diagonal(const TriangleSoup &soup)
{
  if (soup.corners.empty())
    throw InputError(soup.source + ": the mesh has no facets; give a mesh with triangles");
  if (soup.corners.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw InputError(soup.source + ": " + std::to_string(soup.n_triangles()) +
                     " facets are more than vertex numbers can count (715 million); use a coarser "
                     "mesh");
  Vec3 lo = soup.corners[0], hi = lo;
  for (std::size_t c = 0; c < soup.corners.size(); ++c)
    for (int i = 0; i < 3; ++i) {
      const Real x = soup.corners[c][i];
      if (!(std::fabs(x) <= kLargestLength))    // also false for NaN
        throw InputError(soup.source + ", facet " + std::to_string(c / 3 + 1) + ": coordinate " +
                         "xyz"[i] + " is " + number_text(x) +
                         ", beyond 1e100; repair the mesh or give a smaller scale");
      lo[i] = std::min(lo[i], x);
      hi[i] = std::max(hi[i], x);
    }
  const Real diagonal = std::hypot(hi.x - lo.x, hi.y - lo.y, hi.z - lo.z);
  if (diagonal > 0 && diagonal < 1 / kLargestLength)
    throw InputError(soup.source + ": the mesh is only " + number_text(diagonal) +
                     " across; give a larger scale");
  return diagonal;
}

}    // namespace lsdcd
