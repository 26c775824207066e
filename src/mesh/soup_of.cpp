// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/soup_of.h"

namespace lsdcd {

TriangleSoup soup_of(const WeldedMesh &mesh)
{
  TriangleSoup soup;
  soup.source = mesh.source;
  const auto add = [&](int a, int b, int c) {
    for (const int v : {a, b, c}) soup.corners.push_back(mesh.vertices[v]);
  };
  for (const auto &f : mesh.faces) add(f[0], f[1], f[2]);
  for (const auto &f : mesh.dropped) add(f[0], f[1], f[2]);
  for (std::size_t e = 0; e < mesh.edges.size(); e++)
    if (mesh.edge_first[e] == mesh.edge_first[e + 1])
      add(mesh.edges[e][0], mesh.edges[e][1], mesh.edges[e][1]);
  for (std::size_t v = 0; v < mesh.vertices.size(); v++)
    if (mesh.vertex_first[v] == mesh.vertex_first[v + 1]) {
      const int point = static_cast<int>(v);
      add(point, point, point);
    }
  return soup;
}

}    // namespace lsdcd
