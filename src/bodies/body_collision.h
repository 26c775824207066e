// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The triangles of a rigid body that meet triangles of the wall, pose by pose, on the CPU or a GPU.
#pragma once

#include "bodies/meeting_segment.h"
#include "engine/engine.h"
#include "grid/triangle_grid.h"
#include "mesh/triangle_soup.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

// The pose of a body: its point x is at rotation x + shift in the wall's frame. corner_at() rounds the
// corners of a body in a pose. For these rounded corners, answers are exact.
struct BodyPose {
  Vec3 row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};    // of the rotation matrix
  Vec3 shift = {0, 0, 0};                             // length

  LSDCD_FN Vec3 corner_at(const Vec3 &x) const
  {
    return Vec3{dot(row[0], x), dot(row[1], x), dot(row[2], x)} + shift;
  }
};

// A triangle of the body by its number, and a primitive of the wall: a face, or an edge or vertex that
// welding left without a face.
struct BodyPair {
  std::uint32_t triangle;
  FeatureCode wall;

  bool operator==(const BodyPair &b) const { return triangle == b.triangle && wall == b.wall; }
  bool operator<(const BodyPair &b) const
  {
    return triangle != b.triangle ? triangle < b.triangle : wall < b.wall;
  }
};

struct Collision {
  std::vector<BodyPair> pairs;             // ascending, each once
  std::vector<MeetingSegment> segments;    // of each pair, in the wall's frame, if asked for
  // Pieces of the body in cells with shortened lists, where `nearest N` may have missed pairs. 0: the
  // answer is exact.
  std::uint64_t uncertain = 0;

  bool any() const { return !pairs.empty(); }
};

// Wall and body stay on its device between poses.
class BodyCollision {
 public:
  virtual ~BodyCollision() = default;

  // With every triangle in the lists answers are exact, with the N nearest they are those of the paper's method. Throws
  // InputError where the wall has periodic images.
  virtual void set_wall(const BodyGrid &grid) = 0;
  // Cuts the triangles into pieces; call it after set_wall(). Throws InputError, also if there are too
  // many pieces for the grid's cells.
  virtual void set_body(const TriangleSoup &body) = 0;
  virtual std::size_t n_pieces() const = 0;
  // Returns a new one without a body that shares this one's copy of the wall, on the same device.
  virtual std::unique_ptr<BodyCollision> with_same_wall() const = 0;

  // Throws InputError if the pose is no rigid motion, or so far away that coordinates have too few
  // digits.
  virtual Collision collide(const BodyPose &pose, bool with_segments = false) = 0;

  virtual bool on_cuda() const = 0;
  virtual std::string device() const = 0;
};

// Device::automatic takes a GPU if there is one. Throws InputError if the device does not
// exist.
std::unique_ptr<BodyCollision> make_body_collision(Device device);

// Settings of a wall's grid for bodies. `length` 0: cells are as long as the median edge of the body, or
// longer until the memory budget holds.
BodyGridSettings collision_grid(const TriangleSoup &body, Real length = 0, int nearest = 0);

}    // namespace lsdcd
