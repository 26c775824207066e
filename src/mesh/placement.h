// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Where a mesh stands in the simulation box: scale, rotate, move and matrix, in the order given.
#pragma once

#include "base/vec3.h"
#include "mesh/triangle_soup.h"

#include <vector>

namespace lsdcd {

// A part of a placement.
struct PlacementStep {
  enum Kind { scale, rotate, move, matrix };
  Kind kind;
  Vec3 vector;         // factors, an axis, or a length
  Real degrees = 0;    // of rotate
  Vec3 row[3] = {};    // of matrix
};

// An affine map x -> m x + t, built up one step at a time; later steps act on
// the result of earlier ones.
class Placement {
 public:
  // Factors per axis; none may be zero.
  void scale(const Vec3 &factors);
  // Right-handed rotation about an axis through the origin; `axis` need not be unit.
  void rotate(const Vec3 &axis, Real degrees);
  void move(const Vec3 &shift);
  // Takes x to m x + shift. Throws InputError where the determinant of m is 0 within the rounding of its numbers, or not finite.
  void matrix(const Vec3 (&m)[3], const Vec3 &shift);

  const Vec3 &row(int k) const { return row_[k]; }
  const Vec3 &shift() const { return shift_; }
  bool is_identity() const;
  // The steps it was built from, in order, for messages.
  const std::vector<PlacementStep> &steps() const { return steps_; }
  // Returns whether it changes the length of an edge along an axis of the mesh.
  bool stretches() const;
  // Returns whether it is the same map.
  bool operator==(const Placement &other) const;
  Vec3 apply(const Vec3 &x) const;

  // Applies the map to every corner. A mirror (negative determinant) also swaps
  // two corners of each triangle, so that orientation is kept.
  // Throws InputError if a coordinate overflows.
  void apply(TriangleSoup &soup) const;

 private:
  void compose(const Vec3 (&m)[3]);
  Vec3 row_[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Vec3 shift_ = {0, 0, 0};
  std::vector<PlacementStep> steps_;
};

}    // namespace lsdcd
