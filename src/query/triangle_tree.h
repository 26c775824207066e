// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A tree of a mesh's triangles for the distance of points at any range, on a CPU. Boxes and planes in
// float, eight at a time, say which triangles can be nearest. Distances to these are in double. An
// answer depends on the mesh and the point alone: not on a cutoff, nor on the order of the search.
#pragma once

#include "backend/owned_array.h"
#include "base/large_memory.h"
#include "base/progress.h"
#include "geometry/wall_records.h"
#include "mesh/wall_mesh.h"
#include "query/triangle_table.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

// The nearest point of a mesh. Of several features at the same distance that with the lowest triangle is
// found, then the lowest feature.
struct TreeAnswer {
  Real distance;              // kAnyDistance: nothing is nearer than the radius
  FeatureCode feature;        // face, edge or vertex of the mesh
  std::uint32_t primitive;    // of the tree; a hint for the next point

  bool found() const { return feature != kNoFeature; }
};

class TriangleTree {
 public:
  static constexpr std::uint32_t kNoPrimitive = 0xffffffffu;

  // Borrows mesh and names.
  TriangleTree(const WallMesh &mesh, const TriangleTable &names,
               const ProgressListener &progress = {});
  TriangleTree(const TriangleTree &) = delete;
  TriangleTree &operator=(const TriangleTree &) = delete;

  // What is nearer to q than `radius`; kAnyDistance: at any distance. `hint`: the primitive of a point
  // that may be near q, or kNoPrimitive; it changes the time alone.
  TreeAnswer nearest(const Vec3 &q, Real radius, std::uint32_t hint) const;

  // Is anything nearer to q than `radius`? The hint becomes what was found.
  bool is_within(const Vec3 &q, Real radius, std::uint32_t &hint) const;

  // The point of a feature that nearest() found, and the unit vector from there to q; a fixed choice where
  // q is on the mesh.
  void closest(const TreeAnswer &answer, const Vec3 &q, Vec3 &point, Vec3 &normal) const;

  // Are registers of 256 bits used? True where the processor has them; tests clear it.
  static bool &wide();

  // From 0 to 1 along each axis within the mesh's box.
  Vec3 place_in_box(const Vec3 &q) const;
  std::size_t n_primitives() const { return exact_.size(); }
  std::size_t bytes() const;

 private:
  static constexpr int kWide = 8;

  // Boxes of the children, rounded outward. In all lanes without a child nothing is near.
  struct alignas(64) Node {
    float lo[3][kWide], hi[3][kWide];
    std::uint32_t child[kWide];    // a node, or with kLeafBit a leaf
  };
  // Of each triangle its plane and the planes through its sides, inside >= 0: the distance is at least that
  // from the plane and from the farthest side that the point is past.
  struct alignas(64) Leaf {
    float normal[3][kWide], offset[kWide];
    float side[3][3][kWide], side_offset[3][kWide];
    float origin[3], size;    // offsets are from there, and at most so large
  };
  // The sides as segments from one corner to the next, from the origin of the leaf: exact where several
  // triangles remain. `over_square`: 1 over the length squared, 0 where that is next to nothing.
  struct alignas(64) Sides {
    float corner[3][3][kWide], over_square[3][kWide];
  };
  // What a distance in double reads.
  struct Exact {
    // As in a FaceRecord; not set for an edge or a vertex of no face.
    Vec3 normal, inward[3];
    Real height;
    FeatureCode code;
    std::uint32_t vertex[3], edge[3];
  };
  struct Item {
    float centre[3];
    std::uint32_t number;
  };
  struct Bounds {
    float lo[3], hi[3];
  };

  static constexpr std::uint32_t kLeafBit = 0x80000000u;

  std::uint32_t build(Item *first, Item *last, std::uint32_t slot, Bounds &bounds,
                      const ProgressListener &progress);
  void make_leaf(const Item *first, const Item *last, std::uint32_t slot, Bounds &bounds);
  Vec3 scaled(const Vec3 &x) const { return inv_scale_ * (x - origin_); }
  FeatureCode primitive_code(std::uint32_t number) const;

  Real segment(std::uint32_t a, std::uint32_t b, std::uint32_t edge, const Vec3 &q,
               FeatureCode &feature) const;
  Real exact(std::uint32_t primitive, const Vec3 &q, FeatureCode &feature) const;
  void attempt(std::uint32_t primitive, const Vec3 &q, TreeAnswer &best) const;

  void search_near(const Vec3 &q, const Vec3 &at, TreeAnswer &best) const;
  void search_far(const Vec3 &q, const Vec3 &at, TreeAnswer &best) const;
  void search_near_plain(const Vec3 &q, const Vec3 &at, TreeAnswer &best) const;
  void search_near_avx2(const Vec3 &q, const Vec3 &at, TreeAnswer &best) const;

  const WallMesh &mesh_;
  const TriangleTable &names_;
  Vec3 origin_;
  Real scale_, inv_scale_;    // a power of two: the mesh lies within 1 of 0
  Vec3 lo_, inv_size_;        // of the mesh's box
  std::vector<std::uint32_t> bare_edges_, bare_vertices_;
  std::vector<Node> nodes_;
  OwnedArray<Leaf, LargeMemory> leaves_;
  OwnedArray<Sides, LargeMemory> sides_;    // of the leaves
  OwnedArray<Exact, LargeMemory> exact_;    // in the order of the leaves
  std::uint32_t root_ = 0;
  Bounds all_;
};

}    // namespace lsdcd
