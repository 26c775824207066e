// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/counted_facets.h"

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

// Facets that became no face have one with the same corners, or no area.
std::vector<Corners> counted_facets(const WallMesh &mesh, bool with_no_area)
{
  std::vector<Corners> counted = mesh.faces;
  if (mesh.dropped.empty()) return counted;
  struct Wound {
    Corners corners;
    int turned;
    bool is_face;
  };
  std::vector<Wound> all;
  for (const auto *some : {&mesh.faces, &mesh.dropped})
    for (const Corners &c : *some) {
      Wound w = {c, 0, some == &mesh.faces};
      w.corners = ascending(c, w.turned);
      all.push_back(w);
    }
  std::sort(all.begin(), all.end(),
            [](const Wound &a, const Wound &b) { return a.corners < b.corners; });
  counted.clear();
  for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
    int sum = 0;
    bool has_face = false;
    for (end = i; end < all.size() && all[end].corners == all[i].corners; end++) {
      sum += all[end].turned;
      has_face = has_face || all[end].is_face;
    }
    Corners c = all[i].corners;
    if (sum < 0) std::swap(c[1], c[2]);
    if (sum != 0 && (has_face || with_no_area)) counted.push_back(c);
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

CountedFacets::CountedFacets(const WallMesh &mesh) : facets(counted_facets(mesh, false))
{
  if (is_known_closed(mesh)) return;
  loose = loose_edges(facets);
  if (loose.empty() || mesh.report.degenerate_facets == 0) return;
  std::vector<Corners> more = counted_facets(mesh, true);
  if (!loose_edges(more).empty()) return;
  facets = std::move(more);
  loose.clear();
}

bool is_known_closed(const WallMesh &mesh)
{
  return mesh.dropped.empty() && mesh.report.closed && mesh.report.misoriented_edges == 0;
}

std::vector<Triangle> triangles_of(const WallMesh &mesh,
                                   const std::vector<std::array<int, 3>> &facets)
{
  std::vector<Triangle> triangles;
  triangles.reserve(facets.size());
  for (const Corners &c : facets)
    triangles.push_back({{mesh.vertices[c[0]], mesh.vertices[c[1]], mesh.vertices[c[2]]}});
  return triangles;
}

}    // namespace lsdcd
