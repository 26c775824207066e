// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Meshes with their trees, and points that are hard for these.
#pragma once

#include "support/meshes.h"
#include "support/random_mesh.h"

#include "base/input_error.h"
#include "mesh/welded_mesh.h"
#include "tree/triangle_tree.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace lsdcd {

struct TreeCase {
  TriangleSoup soup;
  WeldedMesh mesh;
  TriangleTable names;
  TriangleTree tree;
  Real diagonal, size;    // of the mesh; its largest coordinate

  explicit TreeCase(TriangleSoup given) :
      soup(std::move(given)), mesh(weld(soup, 0)), names(mesh), tree(mesh, names),
      diagonal(norm(mesh.report.hi - mesh.report.lo)), size(0)
  {
    for (const Vec3 &x : mesh.vertices)
      size = std::fmax(size, std::fmax(std::fabs(x.x), std::fmax(std::fabs(x.y), std::fabs(x.z))));
  }
  // Near the mesh, on it, and up to 1e4 diagonals from it.
  std::vector<Vec3> points(std::size_t n, std::uint64_t seed) const
  {
    Numbers r(seed);
    std::vector<Vec3> out;
    for (std::size_t i = 0; i < n; i++)
      out.push_back(random_centre(r, soup.corners.data(), int(soup.n_triangles()), mesh.report.lo,
                                  mesh.report.hi, diagonal * r.log_in(1e-4, 1e4)));
    return out;
  }
};

// Cases of the soups given, and of n random ones: with facets without area, doubled ones, and many that meet.
template <class Case>
std::vector<std::unique_ptr<Case>> cases_of(const std::vector<TriangleSoup> &soups, int n)
{
  std::vector<std::unique_ptr<Case>> out;
  for (const TriangleSoup &soup : soups) out.push_back(std::make_unique<Case>(soup));
  for (int i = 0; i < n; i++) {
    try {
      out.push_back(std::make_unique<Case>(random_mesh(100 + i).soup));
    } catch (const InputError &) {
      continue;    // nothing but points closer than the tolerance
    }
  }
  return out;
}

}    // namespace lsdcd
