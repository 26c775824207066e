// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/counted_facets.h"

#include "mesh/soup_of.h"

#include <algorithm>
#include <utility>

namespace lsdcd {

namespace {

using Corners = std::array<int, 3>;

// Corners in ascending order; `turned` becomes 1 or -1, as that keeps the winding or not.
Corners ascending(Corners c, int &turned)
{
  turned = 1;
  for (const int k : {0, 1, 0})
    if (c[k] > c[k + 1]) {
      std::swap(c[k], c[k + 1]);
      turned = -turned;
    }
  return c;
}

// Facets that became no face have one with the same corners, or no area. `sheets` becomes the faces that
// do not count.
std::vector<Corners> counted_facets(const WeldedMesh &mesh, bool with_no_area,
                                    std::vector<int> &sheets)
{
  sheets.clear();
  std::vector<Corners> counted = mesh.faces;
  if (mesh.dropped.empty()) return counted;
  constexpr int kNoFace = -1;
  struct Wound {
    Corners corners;
    int turned, face;
  };
  std::vector<Wound> all;
  const auto add = [&](const Corners &c, int face) {
    Wound w = {c, 0, face};
    w.corners = ascending(c, w.turned);
    all.push_back(w);
  };
  for (std::size_t f = 0; f < mesh.faces.size(); f++) add(mesh.faces[f], static_cast<int>(f));
  for (const Corners &c : mesh.dropped) add(c, kNoFace);
  std::sort(all.begin(), all.end(),
            [](const Wound &a, const Wound &b) { return a.corners < b.corners; });
  counted.clear();
  for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
    int sum = 0, face = kNoFace;
    for (end = i; end < all.size() && all[end].corners == all[i].corners; end++) {
      sum += all[end].turned;
      face = std::max(face, all[end].face);
    }
    Corners c = all[i].corners;
    if (sum < 0) std::swap(c[1], c[2]);
    if (sum != 0 && (face != kNoFace || with_no_area)) counted.push_back(c);
    if (sum == 0 && face != kNoFace) sheets.push_back(face);
  }
  return counted;
}

std::vector<LooseEdge> loose_edges(const std::vector<Corners> &facets)
{
  struct Run {
    std::array<int, 2> edge;
    int way;
  };
  std::vector<Run> runs;
  runs.reserve(3 * facets.size());
  for (const Corners &c : facets)
    for (int k = 0; k < 3; k++) {
      const int a = c[k], b = c[(k + 1) % 3];
      runs.push_back({{std::min(a, b), std::max(a, b)}, a < b ? 1 : -1});
    }
  std::sort(runs.begin(), runs.end(), [](const Run &a, const Run &b) { return a.edge < b.edge; });
  std::vector<LooseEdge> loose;
  for (std::size_t i = 0, end = 0; i < runs.size(); i = end) {
    int sum = 0;
    for (end = i; end < runs.size() && runs[end].edge == runs[i].edge; end++) sum += runs[end].way;
    const std::array<int, 2> &e = runs[i].edge;
    const int facets_here = static_cast<int>(end - i);
    if (sum > 0) loose.push_back({e[0], e[1], sum, facets_here});
    if (sum < 0) loose.push_back({e[1], e[0], -sum, facets_here});
  }
  return loose;
}

}    // namespace

CountedFacets::CountedFacets(const WeldedMesh &mesh)
{
  facets = counted_facets(mesh, false, sheets);
  if (is_known_closed(mesh)) return;
  loose = loose_edges(facets);
  if (loose.empty() || mesh.report.degenerate_facets == 0) return;
  std::vector<Corners> more = counted_facets(mesh, true, sheets);
  if (!loose_edges(more).empty()) return;
  facets = std::move(more);
  loose.clear();
}

bool is_known_closed(const WeldedMesh &mesh)
{
  return mesh.dropped.empty() && mesh.report.closed && mesh.report.misoriented_edges == 0;
}

// Faces with an edge that no other has are taken away until there are none. The faces that are left enclose a space.
bool enclose(const WeldedMesh &mesh, const std::vector<int> &faces)
{
  std::vector<char> is_left(mesh.faces.size(), 0);
  std::vector<int> left_at(mesh.edges.size(), 0);
  for (const int f : faces) {
    is_left[f] = 1;
    for (const int e : mesh.face_edges[f]) left_at[e]++;
  }
  std::vector<int> loose;
  for (std::size_t e = 0; e < left_at.size(); e++)
    if (left_at[e] == 1) loose.push_back(static_cast<int>(e));
  std::size_t n_left = faces.size();
  while (!loose.empty()) {
    const int at = loose.back();
    loose.pop_back();
    for (int k = mesh.edge_first[at]; k < mesh.edge_first[at + 1]; k++) {
      const int f = mesh.edge_face[k];
      if (!is_left[f]) continue;
      is_left[f] = 0;
      n_left--;
      for (const int e : mesh.face_edges[f])
        if (--left_at[e] == 1) loose.push_back(e);
    }
  }
  return n_left > 0;
}

std::vector<Triangle> whole_surface(const WeldedMesh &mesh, const CountedFacets &counted)
{
  std::vector<Triangle> triangles;
  triangles.reserve(counted.facets.size() + 2 * counted.sheets.size());
  const auto add = [&](int a, int b, int c) {
    triangles.push_back({{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}});
  };
  for (const Corners &c : counted.facets) add(c[0], c[1], c[2]);
  for (const int f : counted.sheets) {
    const Corners &c = mesh.faces[f];
    add(c[0], c[1], c[2]);
    add(c[0], c[2], c[1]);
  }
  for_bare_parts(mesh, add);
  return triangles;
}

}    // namespace lsdcd
