// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What the handles of lsdcd.h hold. Objects share what they are made from, so that a caller may free
// them in any order.
#pragma once

#include "api/lsdcd.h"
#include "grid/flat_grid.h"
#include "mesh/wall_mesh.h"
#include "query/point_sides.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace lsdcd {

struct ApiMesh {
  WallMesh mesh;
  std::string report;

  PointSides sides{mesh};

  // May the normals of nearest features tell sides?
  bool normals_agree() const { return mesh.report.closed && mesh.report.oriented; }
};

struct ApiGrid {
  FlatGrid flat;
  HostGrid grid;
  TriangleTable names;
  std::shared_ptr<const ApiMesh> mesh;
  bool has_sides = false, from_cache = false;
  bool sides_by_normals = false;    // also on a device
  std::string report;

  // Copies on CUDA devices, while any stream uses them.
  mutable std::mutex copying;
  mutable std::vector<std::pair<int, std::weak_ptr<const DeviceGrid>>> copies;

  explicit ApiGrid(std::shared_ptr<const ApiMesh> of) : names(of->mesh), mesh(std::move(of)) {}
};

}    // namespace lsdcd

struct lsdcd_mesh {
  std::shared_ptr<const lsdcd::ApiMesh> in;
};
struct lsdcd_grid {
  std::shared_ptr<const lsdcd::ApiGrid> in;
};
