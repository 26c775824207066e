// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A body's mesh against a wall's mesh, with triangles by their numbers in the files.
#pragma once

#include "bodies/body_collision.h"
#include "mesh/welded_mesh.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

struct MeshCollisionSettings {
  Real cell = 0;                     // length; 0: chosen, as collision_grid() does
  std::string cell_name = "grid";    // for messages: what the caller calls it
  int nearest = 0;                   // 0: exact; N: the paper's lists
  std::size_t memory = 0;            // bytes of the wall's grid; 0: the default
  Device device = Device::cpu;
  ProgressListener progress;    // of the grid
};

// Instead of a triangle of the wall without area, of which welding left no face.
constexpr std::uint32_t kNoWallTriangle = 0xffffffff;

class MeshCollision {
 public:
  // The body's triangles without area are left out. Throws InputError.
  MeshCollision(const WeldedMesh &wall, const WeldedMesh &body,
                const MeshCollisionSettings &settings);
  // Another body against the same wall, with a common grid, on the same device.
  MeshCollision(const MeshCollision &same_wall, const WeldedMesh &body);

  Collision collide(const BodyPose &pose, bool with_segments = false)
  {
    return collision_->collide(pose, with_segments);
  }
  // In their files, from 0.
  std::uint32_t wall_triangle(const BodyPair &pair) const
  {
    return feature_kind(pair.wall) == FeatureKind::face ? (*wall_facet_)[feature_index(pair.wall)]
                                                        : kNoWallTriangle;
  }
  std::uint32_t body_triangle(const BodyPair &pair) const { return body_facet_[pair.triangle]; }

  const GridReport &grid() const { return grid_; }
  std::size_t n_triangles() const { return body_facet_.size(); }
  std::size_t n_pieces() const { return collision_->n_pieces(); }
  std::string device() const { return collision_->device(); }

 private:
  void set_body(const WeldedMesh &body);

  std::unique_ptr<BodyCollision> collision_;
  std::shared_ptr<const std::vector<std::uint32_t>> wall_facet_;
  std::vector<std::uint32_t> body_facet_;
  GridReport grid_;
};

}    // namespace lsdcd
