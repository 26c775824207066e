// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Grains where others are put, and whether another one overlaps any of them.
#pragma once

#include "box/periodic_box.h"
#include "clump/ball.h"
#include "shape/placed_grain.h"

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace lsdcd {

// What a grain that is no sphere is beside the sphere around it.
struct PackedShape {
  PlacedGrain grain;    // its centre is that of the sphere
  // Radius of the sphere as which it touches others in a host whose grains touch each other as spheres, in which such spheres, too, must
  // not overlap; 0: grains touch each other by their shapes.
  Real touch = 0;
  // Of a clump, in place of `grain`: its spheres about the centre of the sphere around it.
  std::vector<Ball> balls = {};
};

struct PackedSphere {
  Vec3 at;
  Real radius;
  std::shared_ptr<const PackedShape> shape = nullptr;    // null: the grain is this sphere
};

// The images of a sphere that may touch a grain, up to `largest` in radius, whose centre is in `zone`. Without a
// periodic box that is the sphere itself, if anything.
std::vector<PackedSphere> images_in(const PackedSphere &sphere, const Box &zone, Real largest,
                                    const PeriodicBox &box);

// Grains come one by one, each up to `largest` in radius, and count with their images.
class Packing {
 public:
  // `there`: images_in() of the spheres that are there already. `largest_sphere`: radius of the spheres of clumps that come, where
  // clumps do.
  Packing(const std::vector<PackedSphere> &there, const Box &zone, Real largest,
          const PeriodicBox &box, Real largest_sphere = 0);

  // Exactly touching is no overlap of spheres.
  bool overlaps(const PackedSphere &grain) const;
  void add(const PackedSphere &grain);

 private:
  static constexpr int kNone = -1;
  std::uint64_t cell(const Vec3 &x, int i, int j, int k) const;
  void list(const PackedSphere &sphere);
  bool meets(const PackedSphere &grain) const;    // one that is no clump

  Box zone_;
  Real largest_, cell_;
  PeriodicBox box_;
  std::vector<PackedSphere> spheres_;
  std::vector<int> next_;                           // in the same cell; kNone: the last
  std::unordered_map<std::uint64_t, int> first_;    // of a cell
};

}    // namespace lsdcd
