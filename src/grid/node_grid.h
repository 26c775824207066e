// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The grid of a mesh whose nodes move. A cell lists every primitive (a face with its edges and vertices, or a lone
// edge or vertex) whose distance from the cell is at most the cutoff and an allowance, by bounds alone: normals
// turn, so that no region of a feature decides. It takes a pass over the primitives to build, and holds until a
// node has gone the allowance:
//
//   distance of a point of the cell to the primitive now <= cutoff
//   => the same distance when the grid was built <= cutoff + way of its nodes <= cutoff + allowance
//   => the cell lists the primitive,
//
// as a point of a primitive goes no farther than the farthest of its nodes.
#pragma once

#include "grid/flat_grid.h"
#include "grid/triangle_grid.h"
#include "mesh/mesh_features.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

class NodeGrid {
 public:
  // For centres of spheres of up to this cutoff (length, > 0), until a node has gone farther than `allowance`
  // (length). Both arguments are of one mesh, with its nodes where they are. Throws InputError where the mesh spans
  // more cells than can be numbered.
  void build(const WeldedMesh &mesh, const MeshFeatures &features, Real cutoff, Real allowance);

  bool is_built() const { return cutoff_ > 0; }
  Real cutoff() const { return cutoff_; }
  Real allowance() const { return allowance_; }
  // Its records are those of `features` that it was built from, which must outlive it.
  GridView view() const;
  // Copies grid and records into a flat block, which view() is of until the next build().
  void make_flat();

  std::size_t n_candidates() const { return lists_.candidates.size(); }
  std::size_t bytes() const;

 private:
  void plan(const WeldedMesh &mesh, const MeshFeatures &features);

  const MeshFeatures *features_ = nullptr;
  Real cutoff_ = 0, allowance_ = 0, tolerance_ = 0, length_ = 0, outside_ = 1;
  Vec3 origin_ = {0, 0, 0};
  std::int32_t n_bricks_[3] = {1, 1, 1};
  CellLists lists_;
  FlatGrid flat_;
  // Memory of a build.
  std::vector<std::uint32_t> count_;    // of each cell of each brick
};

}    // namespace lsdcd
