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
  for_bare_parts(mesh, add);
  return soup;
}

}    // namespace lsdcd
