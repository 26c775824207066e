// The space near a wall in cubes of one size, to try a grid in some of them.
#pragma once

#include "grid/triangle_grid.h"
#include "mesh/wall_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace lsdcd {

class WallParts {
 public:
  // Every cube that a sphere of radius `cutoff` can touch the wall from; some more,
  // where a triangle's box is larger than the triangle. The cubes are larger than `side`
  // where a large wall would have millions of them. None lies outside `within`.
  WallParts(const WallMesh &mesh, Real cutoff, Real side, const Box &within = kNoLimit);

  int n() const { return static_cast<int>(key_.size()); }
  Real side() const { return side_; }    // length
  Box box(int part) const;
  int part_of(const Vec3 &x) const;    // -1: in none

 private:
  using Key = std::array<std::int32_t, 3>;
  void cover(const Vec3 &lo, const Vec3 &hi, const Vec3 &normal, Real offset);

  Vec3 origin_;
  Real side_, cutoff_;
  Box within_;
  std::vector<Key> key_;    // place in the lattice, ascending
};

}    // namespace lsdcd
