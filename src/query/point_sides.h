// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Sides of points, by the nearest feature's normal or by winding numbers.
#pragma once

#include "base/made_once.h"
#include "mesh/winding_number.h"
#include "query/point_query.h"
#include "query/tree_query.h"

#include <memory>

namespace lsdcd {

// The winding numbers of a mesh, borrowed, made when a point needs them. Any number of threads may ask.
class PointSides {
 public:
  explicit PointSides(const WallMesh &mesh) : mesh_(mesh) {}

  const WindingNumber &winding() const
  {
    return winding_.get([&] { return std::make_unique<WindingNumber>(mesh_); });
  }

 private:
  const WallMesh &mesh_;
  MadeOnce<WindingNumber> winding_;
};

// answer_points(), and the sides of all points. `by_normals`: the grid has sides, which nearest features
// tell where one is found. All other sides are of winding numbers, at any distance. The mesh must have an
// inside where sides are asked for.
void answer_with_sides(const HostGrid &grid, const TriangleTable &names, const PointSides &sides,
                       bool by_normals, const PointArrays<float> &io);
void answer_with_sides(const HostGrid &grid, const TriangleTable &names, const PointSides &sides,
                       bool by_normals, const PointArrays<double> &io);

// The same by a tree. All sides are of winding numbers.
void answer_with_sides(const TriangleTree &tree, const NearBoxes *near, const TriangleTable &names,
                       const PointSides &sides, Real cutoff, const PointArrays<float> &io);
void answer_with_sides(const TriangleTree &tree, const NearBoxes *near, const TriangleTable &names,
                       const PointSides &sides, Real cutoff, const PointArrays<double> &io);

// Of points whose `side` is 0; at[0, n) are packed coordinates.
void fill_sides(const PointSides &sides, std::size_t n, const double *at, std::int8_t *side);

}    // namespace lsdcd
