// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Sides of points, by the nearest feature's normal or by winding numbers.
#pragma once

#include "base/made_once.h"
#include "mesh/generalized_winding.h"
#include "mesh/winding_number.h"
#include "query/point_query.h"
#include "query/tree_query.h"

#include <memory>

namespace lsdcd {

// The winding numbers of a mesh, borrowed, made when a point needs them. Any number of threads may ask.
class PointSides {
 public:
  explicit PointSides(const WeldedMesh &mesh) : mesh_(mesh) {}

  const WindingNumber &winding(const ProgressListener &progress = {}) const
  {
    return winding_.get([&] { return std::make_unique<WindingNumber>(mesh_, progress); });
  }
  const GeneralizedWinding &generalized(const ProgressListener &progress = {}) const
  {
    return generalized_.get([&] { return std::make_unique<GeneralizedWinding>(mesh_, progress); });
  }

 private:
  const WeldedMesh &mesh_;
  MadeOnce<WindingNumber> winding_;
  MadeOnce<GeneralizedWinding> generalized_;
};

// answer_points(), and the sides of all points. `by_normals`: the grid has sides, which nearest features
// tell where one is found. All other sides are of winding numbers, at any distance. The mesh must have an
// inside where sides are asked for.
void answer_with_sides(const HostGrid &grid, const TriangleTable &names, const PointSides &sides,
                       bool by_normals, const PointArrays<float> &io);
void answer_with_sides(const HostGrid &grid, const TriangleTable &names, const PointSides &sides,
                       bool by_normals, const PointArrays<double> &io);

// The same by a tree. All sides are of winding numbers.
void answer_with_sides(const TriangleTree &tree, const NearBoxes *near, const PointSides &sides,
                       Real cutoff, const PointArrays<float> &io);
void answer_with_sides(const TriangleTree &tree, const NearBoxes *near, const PointSides &sides,
                       Real cutoff, const PointArrays<double> &io);

// Generalised winding numbers of any mesh, and the sides that are probable by them, which are not certified:
// `status` gets kSideEstimated. What is null is not asked for. Where a coordinate is no number, neither is the
// winding number, and the side is 0.
void estimate_sides(const PointSides &sides, std::size_t n, const StridedView<const float> &points,
                    const Column<float> &number, std::int8_t *side, std::uint8_t *status);
void estimate_sides(const PointSides &sides, std::size_t n, const StridedView<const double> &points,
                    const Column<double> &number, std::int8_t *side, std::uint8_t *status);

// Of points whose `side` is 0; at[0, n) are packed coordinates.
void fill_sides(const PointSides &sides, std::size_t n, const double *at, std::int8_t *side);

}    // namespace lsdcd
