// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Grains that are no spheres, or spheres, on facets whose edges are as long as the radius of the sphere around a grain: on faces of a plane, on
// edges of ridges, in the folds between them, and close above a plane, where no grain touches what it has listed. Grains lie in any way, sunk by
// a hundredth of their size, and are elsewhere by some 1e-3 of it in each step. What the programs share that time or count their steps.
#pragma once

#include "contact/shape_search.h"
#include "engine/shape_engine.h"
#include "grid/flat_grid.h"
#include "shape/superellipsoid.h"
#include "support/grains.h"
#include "tree/triangle_table.h"

#include <memory>
#include <vector>

namespace lsdcd {

struct ShapeKind {
  const char *name;
  bool is_sphere;
  Vec3 half;
  Real n;
};
inline constexpr ShapeKind kShapeKinds[] = {{"sphere", true, {1, 1, 1}, 2},
                                            {"ellipsoid 2:1:1", false, {2, 1, 1}, 2},
                                            {"n = 4", false, {1, 1, 1}, 4},
                                            {"n = 8", false, {1, 1, 1}, 8}};
enum class ShapePlace { face, edge, fold, above };
inline constexpr const char *kShapePlaces[] = {"at faces", "at edges", "in folds", "above faces"};

class ShapeBed {
 public:
  static constexpr int kSteps = 20;

  // n grains of the kind at a place.
  ShapeBed(const ShapeKind &kind, ShapePlace place, int n);

  // All kSteps steps.
  void steps();
  double contacts() { return static_cast<double>(engine_->results().totals().contacts); }
  // The mean number of faces within the radius of the sphere around a grain.
  double listed() const { return listed_ / static_cast<double>(grains_.x.size()); }
  std::size_t triangles() const { return mesh_.faces.size(); }

 private:
  void lay(ShapePlace place, int n, bool is_sphere);
  Spheres at(int k);

  Superellipsoid shape_;
  WeldedMesh mesh_;
  TriangleTable names_;
  TriangleTree tree_;
  ShapeSearch search_;
  FlatOf<StepGrid> flat_;
  std::unique_ptr<WallEngine> engine_;
  Grains grains_;
  std::vector<Quaternion> turns_;
  std::vector<Vec3> x_;    // of all grains, step after step
  std::vector<GrainShape> shapes_;
  double listed_ = 0;
};

}    // namespace lsdcd
