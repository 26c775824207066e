// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The objects behind the handles of lsdcd.h. Objects share what they are made from, so that a caller may free
// them in any order.
#pragma once

#include "api/lsdcd.h"
#include "base/made_once.h"
#include "grid/triangle_grid.h"
#include "host/host.h"
#include "mesh/welded_mesh.h"
#include "query/point_sides.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace lsdcd {

struct ApiMesh {
  WeldedMesh mesh;
  std::string report;
  std::string file;    // from which it was read; empty: none
  // The vertex and face of the mesh that each vertex and triangle of the caller became; -1: none.
  std::vector<int> welded_vertex, welded_face;

  PointSides sides{mesh};

  // Do the normals of nearest features give sides?
  bool normals_agree() const { return mesh.report.closed && mesh.report.oriented; }
};

// Cells with lists, for a GPU, for floats, for `nearest` and for contacts.
struct ApiCells {
  NodeMemory memory;    // of the flat grid
  CpuGrid grid;
  bool from_cache = false;
  bool sides_by_normals = false;
  std::string report;
};

// A tree for points on the CPU, cells for the rest; each is made by the first that needs it.
class ApiGrid {
 public:
  ApiGrid(std::shared_ptr<const ApiMesh> mesh, const lsdcd_grid_options &options,
          const ProgressListener &progress);

  bool is_limited() const { return cutoff_ > 0; }
  // HUGE_VAL where there is none.
  Real cutoff() const;
  int nearest() const { return settings_.nearest; }
  bool uses_tree() const { return settings_.nearest == 0 && !settings_.in_floats; }

  const TriangleTree &tree(const ProgressListener &progress = {}) const;
  // Returns the boxes near the tree's mesh; null without a cutoff.
  const CutoffBoxes *near(const ProgressListener &progress = {}) const;
  const ApiCells &cells(bool on_cuda = false, const ProgressListener &progress = {}) const;
  const ApiCells *cells_made() const { return cells_.made(); }
  // Can a device give sides?
  bool sides_by_normals() const;
  // Do normals give sides on the host? Otherwise winding numbers do: with a tree, and in float, where the nearest feature may be
  // of the other face of a thin plate.
  bool host_sides_by_normals() const;
  std::size_t bytes() const;    // of what is made

  std::shared_ptr<const ApiMesh> mesh;
  const TriangleTable names;
  const bool has_sides;
  std::string report;

  // Copies on CUDA devices, while any stream uses them.
  mutable std::mutex copying;
  mutable std::vector<std::pair<int, std::weak_ptr<const DeviceCopy>>> copies;

 private:
  Real cutoff_;
  QueryGridSettings settings_;
  std::string cache_;
  bool on_cuda_;
  MadeOnce<TriangleTree> tree_;
  MadeOnce<CutoffBoxes> boxes_;
  MadeOnce<ApiCells> cells_;
  MadeOnce<bool> meets_itself_;
};

}    // namespace lsdcd

struct lsdcd_mesh {
  std::shared_ptr<const lsdcd::ApiMesh> in;
};
struct lsdcd_grid {
  std::shared_ptr<const lsdcd::ApiGrid> in;
};
