// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The images of the facets of a mesh that come near a periodic box.
#pragma once

#include "box/periodic_box.h"
#include "mesh/welded_mesh.h"

#include <array>
#include <tuple>
#include <vector>

namespace lsdcd {

constexpr int kNoPart = -1;

// A facet of the mesh, or what is left of one: an edge without a face, a point without an edge.
struct FacetPart {
  std::array<int, 3> vertex;    // of the mesh; with fewer the last is repeated
  int face, edge;               // of the mesh; kNoPart: none
};

std::vector<FacetPart> parts_of(const WeldedMesh &mesh);

// A part, moved by a sum of periodic edges.
struct PartImage {
  std::array<int, 3> by;
  int part;

  // The last edge first.
  bool operator<(const PartImage &other) const
  {
    return std::tie(by[2], by[1], by[0], part) <
           std::tie(other.by[2], other.by[1], other.by[0], other.part);
  }
};

// Returns the images within `depth` (length) of the box, ascending. Throws InputError if there are more than vertex
// numbers can count.
std::vector<PartImage> images_in_reach(const WeldedMesh &mesh, const std::vector<FacetPart> &parts,
                                       const PeriodicBox &box, Real depth);

}    // namespace lsdcd
