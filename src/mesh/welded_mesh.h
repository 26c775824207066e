// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The wall as faces, edges and vertices that know their neighbours.
#pragma once

#include "base/vec3.h"
#include "mesh/triangle_soup.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace lsdcd {

// The findings and deeds of welding. The fix and `lsdcd inspect` print it.
struct MeshReport {
  std::size_t facets = 0;               // triangles in the file
  std::size_t corners = 0;              // 3 * facets
  std::size_t vertices = 0;             // after welding
  std::size_t degenerate_facets = 0;    // dropped as faces; their edges and points stay
  std::size_t duplicate_facets = 0;     // dropped, either winding
  std::size_t two_sided_faces = 0;      // that are there in both windings
  std::size_t sheet_faces = 0;          // of these: as often in one as in the other
  std::size_t edges = 0;
  std::size_t open_edges = 0;           // one face
  std::size_t nonmanifold_edges = 0;    // more than two faces
  std::size_t misoriented_edges = 0;    // along which windings disagree
  std::size_t inverted_facets = 0;      // of closed shells that point in while others point out
  // Pairs of facets that cut, overlap or touch each other: of different closed shells, or, after
  // note_meetings(), of any.
  std::size_t meeting_pairs = 0;
  bool closed = false;    // every edge has an even number of faces, most have two
  // Closed, no misoriented edge, inverted facet, meeting pair or two-sided face.
  bool oriented = false;
  Real weld_tolerance = 0;             // length; by default kDefaultWeld of the largest part
  std::size_t closed_cracks = 0;       // corners on open edges that the default moved to another,
  Real widest_crack = 0;               // so far at most: length
  std::size_t coarse_corners = 0;      // on open edges, where facets are as small as
  Real coordinate_step = 0;            // two such steps of the file's coordinates: length
  std::size_t collapsed_facets = 0;    // of the degenerate ones, those that welding made so,
  Real collapsed_area = 0;             // with so much area before: length^2
  Real area = 0;                       // length^2
  Real volume = 0;                     // length^3, signed; > 0 when normals point out
  Vec3 lo = {0, 0, 0}, hi = {0, 0, 0};    // bounding box
  Real smallest_edge = 0, largest_edge = 0, median_edge = 0;
  Real smallest_height = 0;         // thinnest face: its area * 2 / longest edge
  Real largest_fold = 0;            // degrees between neighbouring face planes, 0 = flat
  std::size_t feature_edges = 0;    // folds above 30 degrees
};

// The parts of a mesh that are periodic images (box/periodic_images.h): those with numbers from
// n_faces, n_edges and n_vertices on. Empty if there are none.
struct PeriodicImages {
  std::size_t n_faces = 0, n_edges = 0, n_vertices = 0;    // of the mesh itself
  std::vector<int> face_of, edge_of, vertex_of;            // what each is an image of
  // For every vertex, one vertex that stands for it and all its images.
  std::vector<int> same_vertex;

  bool any() const { return !same_vertex.empty(); }
};

// Faces are proper triangles: three distinct welded vertices, not collinear.
// Edges and vertices of dropped facets remain, so that nothing becomes a hole.
struct WeldedMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> faces;         // vertices, in the file's winding
  std::vector<std::array<int, 3>> face_edges;    // edge k joins corners k and (k+1) % 3
  std::vector<std::size_t> face_facet;           // facet of the file, from 0
  std::vector<std::array<int, 2>> edges;         // vertices, lower index first
  std::vector<int> edge_first,
      edge_face;    // faces of edge e: edge_face[edge_first[e] .. edge_first[e+1])
  std::vector<int> vertex_first, vertex_edge;    // edges of vertex v, as edge_face
  // Facets with three vertices that are no face: of faces that are there already, in either winding, and
  // those without area. Winding numbers need them (winding_number.h).
  std::vector<std::array<int, 3>> dropped;
  MeshReport report;
  std::string source;
  PeriodicImages images;
};

constexpr Real kDefaultWeld = 1e-6;      // of the diagonal of a part
constexpr Real kMostCollapsed = 1e-6;    // of the area

// Welds equal corners, and those closer than `tolerance` (a length); < 0: those that find_cracks() finds
// (mesh/cracks.h). Builds edges and adjacency. Throws InputError when no proper face, edge or vertex is left, and when
// facets collapse that have more than kMostCollapsed of the area.
WeldedMesh weld(const TriangleSoup &soup, Real tolerance);

// The facets with three vertices that welding has dropped because they lie on one line. They have an area once these move.
std::vector<std::array<int, 3>> facets_without_area(const WeldedMesh &mesh);

// What the log warns of, after the name of the mesh; empty: nothing.
std::string weld_warning(const MeshReport &report);

// Returns the report as the block of lines that the log shows; no trailing newline.
std::string describe(const MeshReport &report, const std::string &source);

}    // namespace lsdcd
