// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Repairs a mesh without inventing anything: no hole is filled.
#pragma once

#include "mesh/welded_mesh.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace lsdcd {

constexpr char kOpenEdges[] = "open edges";

// The faults that repair() cannot mend.
struct Unmended {
  std::string what;          // kOpenEdges and so on
  std::size_t count = 0;     // at least 1
  Vec3 place = {0, 0, 0};    // position of the first one, length
};

struct RepairReport {
  std::size_t welded_corners = 0;       // corners that were moved to another's position
  std::size_t degenerate_facets = 0;    // dropped
  std::size_t lost_facets = 0;          // of these, lines that no remaining edge follows
  std::size_t duplicate_facets = 0;     // dropped
  std::size_t split_facets = 0;         // cut at corners of neighbours,
  std::size_t junctions = 0;            // of which there were so many
  std::size_t turned_facets = 0;
  std::size_t shells = 0;        // closed parts of the result
  std::size_t cavities = 0;      // of these, cavities: their normals point into them
  std::size_t boundaries = 0;    // connected parts of the open edges of the result
  Real tolerance = 0;            // length, of welding and of junctions

  // Lengths. No point of the old surface is farther from the new one than moved(), and the other way
  // round.
  Real welding_moved = 0;
  Real splitting_moved = 0;
  Real dropping_moved = 0;    // by what was dropped
  Real moved() const { return welding_moved + std::max(splitting_moved, dropping_moved); }

  std::vector<Unmended> left;
};

struct RepairedMesh {
  TriangleSoup soup;    // corners are those of the old one, to the last bit
  WeldedMesh mesh;      // the same welded
  RepairReport report;
};

// Welds corners within the tolerance (see weld()), drops degenerate and duplicate facets, cuts
// facets if corners of neighbours lie on their open edges, and makes windings agree, with the normals
// of closed parts out. Throws InputError as weld() does, and if no facet is left. Calls `progress`
// with the name of each step before it begins.
RepairedMesh repair(const TriangleSoup &soup, Real tolerance,
                    const std::function<void(const std::string &)> &progress = {});

}    // namespace lsdcd
