// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A surface that exerts no force and counts what passes it.
#pragma once

#include "flow/flow_boxes.h"
#include "flow/path.h"
#include "mesh/box_tree.h"
#include "mesh/welded_mesh.h"

#include <array>
#include <cstddef>
#include <vector>

namespace lsdcd {

struct Passes {
  int forward = 0, backward = 0;    // along the facets' normals, and against them

  int net() const { return forward - backward; }
};

// In a periodic box all images of the surface are there.
class FlowSurface {
 public:
  explicit FlowSurface(const WeldedMesh &mesh);

  // Whole numbers of box edges that bring `from` next to `to`.
  static Vec3 cells_between(const Vec3 &from, const Vec3 &to, const PeriodicBox &box);

  // Triangles that the straight path from one point to the other passes.
  Passes passes(const WrappedPoint &from, const Vec3 &to, const PeriodicBox &box) const;

  // Returns a lower bound of the distance to the surface. It is at most `most` and at most half the smallest periodic
  // width.
  Real clearance(const Vec3 &x, const PeriodicBox &box, Real most = 1e150) const;

  // Returns how far images have moved at most because the box has changed; clearances change by that.
  Real images_move(const PeriodicBox &before, const PeriodicBox &now) const;

  const BoxTree &tree() const { return tree_; }    // of the boxes around faces

  std::size_t bytes() const
  {
    return tree_.bytes() + vertices_.capacity() * sizeof(Vec3) +
           faces_.capacity() * sizeof faces_[0];
  }

 private:
  std::array<Vec3, 3> corners(int face) const;
  template <class F>
  void for_images(const Box &near, const PeriodicBox &box, F &&f) const;

  std::vector<Vec3> vertices_;
  std::vector<std::array<int, 3>> faces_;
  BoxTree tree_;
};

}    // namespace lsdcd
