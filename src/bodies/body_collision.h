// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Which triangles of a rigid body meet which of the wall, pose by pose, on the CPU or a GPU.
#pragma once

#include "bodies/meeting_segment.h"
#include "engine/wall_engine.h"
#include "grid/triangle_grid.h"
#include "mesh/triangle_soup.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

// Where a body is: a point x of it is at rotation x + shift in the wall's frame. Corners of a
// body in a pose are what corner_at() rounds them to; for these, answers are exact.
struct BodyPose {
  Vec3 row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};    // of the rotation matrix
  Vec3 shift = {0, 0, 0};                             // length

  LSDCD_FN Vec3 corner_at(const Vec3 &x) const
  {
    return Vec3{dot(row[0], x), dot(row[1], x), dot(row[2], x)} + shift;
  }
};

// A triangle of the body by its number, and a primitive of the wall: a face, or where welding
// left an edge or a vertex without one, that.
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
  std::vector<MeetingSegment> segments;    // of each pair, in the wall's frame, where asked for
  // Pieces of the body in cells whose lists were cut short: there `nearest N` may have missed
  // pairs. 0: the answer is exact.
  std::uint64_t uncertain = 0;

  bool any() const { return !pairs.empty(); }
};

// Keeps wall and body on its device between poses.
class BodyCollision {
 public:
  virtual ~BodyCollision() = default;

  // A grid whose lists hold whole triangles: of kEveryTriangle, which is exact, or of the N
  // nearest, the paper's method. Throws InputError where they do not.
  virtual void set_wall(const TriangleGrid &grid) = 0;
  // Cuts the triangles into pieces; after set_wall(). Throws InputError, too, where these are too
  // many for the grid's cells.
  virtual void set_body(const TriangleSoup &body) = 0;
  virtual std::size_t n_pieces() const = 0;
  // Another with the same wall, of which there is one copy, and no body yet; on the same device.
  virtual std::unique_ptr<BodyCollision> with_same_wall() const = 0;

  // Throws InputError where the pose is no rigid motion, or so far off that the cells have too few
  // digits.
  virtual Collision collide(const BodyPose &pose, bool with_segments = false) = 0;

  virtual bool on_cuda() const = 0;
  virtual std::string device() const = 0;
};

// Device::automatic takes a GPU where there is one. Throws InputError where the device is not
// there.
std::unique_ptr<BodyCollision> make_body_collision(Device device);

// Settings of a wall's grid for bodies: cells of `length`, or where that is 0 as long as the median
// edge of the body, and longer until the memory holds them.
GridSettings collision_grid(const TriangleSoup &body, Real length = 0,
                            int nearest = kEveryTriangle);

}    // namespace lsdcd
