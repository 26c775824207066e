// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Finds sides of points, by the normal of the nearest feature or by winding numbers.
#pragma once

#include "base/made_once.h"
#include "mesh/generalized_winding.h"
#include "mesh/winding_number.h"
#include "query/point_query.h"
#include "query/tree_query.h"

#include <memory>

namespace lsdcd {

// The winding numbers of a mesh, which is borrowed. They are made when a point needs them. Any number of
// threads may ask for them.
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

// T is float or double.

// Does the work of query_grid(), and finds the sides of all points. `by_normals`: the grid has sides, which
// nearest features give if one is found. All other sides are those of winding numbers, at any distance. The
// mesh must have an inside if sides are asked for.
template <class T>
void query_with_sides(const CpuGrid &grid, const TriangleTable &names, const PointSides &sides,
                      bool by_normals, const PointArrays<T> &io);

// Answers the query of the function above by query_tree(). All sides are those of winding numbers.
template <class T>
void query_with_sides(const TriangleTree &tree, const CutoffBoxes *boxes, const PointSides &sides,
                      Real cutoff, const PointArrays<T> &io);

// Finds the generalised winding numbers of any mesh, and the sides that are probable by them, which are not
// certified: `status` gets kSideEstimated. Null arrays are not asked for. If a coordinate is not a number,
// neither is the winding number, and the side is 0.
template <class T>
void estimate_sides(const PointSides &sides, std::size_t n, const StridedView<const T> &points,
                    const Column<T> &number, std::int8_t *side, std::uint8_t *status);

// Finds the sides, by winding numbers, of points whose `side` is 0; it stays 0 if a coordinate is not a number.
template <class T>
void fill_sides(const PointSides &sides, std::size_t n, const StridedView<const T> &points,
                std::int8_t *side);

}    // namespace lsdcd
