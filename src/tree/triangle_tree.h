// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A tree of a mesh's triangles for the distance of points at any range, on a CPU. Boxes and planes in
// float, eight at a time, say which triangles can be nearest. Distances to these are in double. An
// answer depends on the mesh and the point alone: not on a cutoff, nor on the order of the search.
#pragma once

#include "backend/owned_array.h"
#include "base/large_memory.h"
#include "base/progress.h"
#include "mesh/welded_mesh.h"
#include "tree/tree_view.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace lsdcd {

struct FloatBound;

class TriangleTree {
 public:
  // Borrows mesh and names.
  TriangleTree(const WeldedMesh &mesh, const TriangleTable &names,
               const ProgressListener &progress = {});
  TriangleTree(const TriangleTree &) = delete;
  TriangleTree &operator=(const TriangleTree &) = delete;

  // Returns the nearest point to q within `radius`; kAnyDistance: at any distance. `hint`: the primitive found for a
  // point that may be near q, or kNoPrimitive; it changes the time alone.
  TreeAnswer nearest(const Vec3 &q, Real radius, std::uint32_t hint) const;

  // Is anything nearer to q than `radius`? The hint becomes what was found.
  bool is_within(const Vec3 &q, Real radius, std::uint32_t &hint) const;

  // The point of a feature that nearest() found, and the unit vector from there to q; a fixed choice where
  // q is on the mesh.
  void closest(const TreeAnswer &answer, const Vec3 &q, Vec3 &point, Vec3 &normal) const
  {
    view_.closest(answer, q, point, normal);
  }

  // Are registers of 256 bits used? True where the processor has them; tests clear it.
  static bool &wide();

  std::size_t n_primitives() const { return view_.n_primitives; }
  std::size_t n_nodes() const { return nodes_.size(); }
  std::size_t n_leaves() const { return leaves_.size(); }
  const WeldedMesh &mesh() const { return mesh_; }
  // As long as the tree, its mesh and its names are.
  const TreeView &view() const { return view_; }
  // Returns for each primitive the one whose normal stands for the normals of all triangles of a flat patch; for all others
  // itself. It depends on the mesh alone, and is made when it is asked for first.
  const std::vector<std::uint32_t> &flat_patches() const;
  std::size_t bytes() const;

 private:
  struct Item {
    float centre[3];
    std::uint32_t number;
  };
  struct Bounds {
    float lo[3], hi[3];
  };

  std::uint32_t build(Item *first, Item *last, std::uint32_t start, Bounds &bounds,
                      const ProgressListener &progress);
  void make_leaf(const Item *first, const Item *last, std::uint32_t start, Bounds &bounds);
  FeatureCode primitive_code(std::uint32_t number) const;
  void find_flat_patches() const;

  void search_leaf(std::uint32_t number, const Vec3 &q, const Vec3 &at, FloatBound &bound,
                   TreeAnswer &best) const;
  void search_in_float(const Vec3 &q, const Vec3 &at, TreeAnswer &best) const;
  void search_in_double(const Vec3 &q, TreeAnswer &best) const;
  void search_in_float_plain(const Vec3 &q, const Vec3 &at, TreeAnswer &best) const;
  void search_in_float_avx2(const Vec3 &q, const Vec3 &at, TreeAnswer &best) const;

  const WeldedMesh &mesh_;
  std::vector<std::uint32_t> bare_edges_, bare_vertices_;
  std::vector<TreeNode> nodes_;
  OwnedArray<TreeLeaf, LargeMemory> leaves_;
  OwnedArray<TreeSides, LargeMemory> sides_;
  OwnedArray<TreePrimitive, LargeMemory> primitives_;
  std::vector<std::uint32_t> face_primitive_;
  mutable std::once_flag has_patches_;
  mutable std::vector<std::uint32_t> patches_;
  TreeView view_ = {};    // of all these
};

}    // namespace lsdcd
