// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A flat mesh through which grains come.
#pragma once

#include "box/periodic_box.h"
#include "insert/random_stream.h"
#include "mesh/welded_mesh.h"

#include <array>
#include <vector>

namespace lsdcd {

class InletFace {
 public:
  // Grains are put up to `depth` (length) in front of it, along its normal. Throws InputError where the mesh is
  // not flat, or wound in both ways.
  InletFace(const WeldedMesh &mesh, Real depth);

  const Vec3 &normal() const { return normal_; }    // unit
  Real area() const { return areas_.back(); }
  Box zone() const;    // around all positions

  // Finds a position, uniformly among those at which a grain of this radius crosses no edge of the face. False: none
  // was found.
  bool draw(RandomStream &random, Real radius, Vec3 &at) const;
  bool has_room(Real radius) const;

 private:
  void check_flat(const WeldedMesh &mesh) const;
  Vec3 point(RandomStream &random) const;
  bool is_inside(const Vec3 &at, Real radius) const;    // a point of the face

  Vec3 normal_ = {0, 0, 0}, middle_ = {0, 0, 0};
  Real depth_;
  std::vector<std::array<Vec3, 3>> triangles_;
  std::vector<Real> areas_;    // of a triangle and all before it
  std::vector<std::array<Vec3, 2>> outline_;
};

}    // namespace lsdcd
