// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A mesh with what is wrong with it mended as far as that needs no invention: nothing is filled.
#pragma once

#include "mesh/wall_mesh.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace lsdcd {

constexpr char kOpenEdges[] = "open edges";

// What is left that repair() cannot mend.
struct Unmended {
  std::string what;          // kOpenEdges and so on
  std::size_t count = 0;     // at least 1
  Vec3 place = {0, 0, 0};    // of the first of them, length
};

struct RepairReport {
  std::size_t welded_corners = 0;       // that went to another's place
  std::size_t degenerate_facets = 0;    // dropped
  std::size_t lost_facets = 0;          // of these, lines that no edge of what is left follows
  std::size_t duplicate_facets = 0;     // dropped
  std::size_t split_facets = 0;         // cut at corners of neighbours,
  std::size_t junctions = 0;            // of which there were so many
  std::size_t turned_facets = 0;
  std::size_t shells = 0;        // closed parts of the result
  std::size_t cavities = 0;      // of these, with normals into what others are round
  std::size_t boundaries = 0;    // parts that the open edges of the result hang together in
  Real tolerance = 0;            // length, of welding and of junctions

  // Lengths. No point of the old surface is farther from the new one, or the other way round, than
  // moved().
  Real welding_moved = 0;
  Real splitting_moved = 0;
  Real dropping_moved = 0;    // by what was dropped
  Real moved() const { return welding_moved + std::max(splitting_moved, dropping_moved); }

  std::vector<Unmended> left;
};

struct RepairedMesh {
  TriangleSoup soup;    // corners are those of the old one, to the last bit
  WallMesh mesh;        // the same welded
  RepairReport report;
};

// Welds corners within the tolerance (as weld() takes it), drops degenerate and duplicate facets,
// cuts facets where corners of neighbours lie on their open edges, and winds facets as their
// neighbours, closed parts with normals out. Throws InputError as weld() does, and where no facet
// is left. `progress` is told what comes next.
RepairedMesh repair(const TriangleSoup &soup, Real tolerance,
                    const std::function<void(const std::string &)> &progress = {});

}    // namespace lsdcd
