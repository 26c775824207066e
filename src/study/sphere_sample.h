// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Spheres on which settings of the grid are tried.
#pragma once

#include "grid/triangle_grid.h"

#include <cstdint>
#include <random>
#include <vector>

namespace lsdcd {

struct SphereSample {
  std::vector<Vec3> x;         // length
  std::vector<Real> radius;    // length

  int n() const { return static_cast<int>(x.size()); }
  void add(const Vec3 &centre, Real r)
  {
    x.push_back(centre);
    radius.push_back(r);
  }
};

using Random = std::mt19937_64;

// Uniform in [0, 1), the same on every machine.
inline Real uniform_below_one(Random &random)
{
  return static_cast<Real>(random() >> 11) * 0x1p-53;
}

// Adds up to n spheres with centres uniform in the cells that have entries: the band
// within the cutoff of the wall, and half a cell more. Each radius is one of `radii`, all as
// likely. No sphere overlaps the wall by more than half its radius: there a closest point that
// enters a face over a concave edge takes force at once, and the least rounding is a jump. The
// lists of the grid must be complete.
void add_band_spheres(const TriangleGrid &grid, int n, const std::vector<Real> &radii,
                      Random &random, SphereSample &sample);

// Spheres in the order in which LAMMPS sorts atoms: by bins of this size, x fastest.
void sort_by_bins(SphereSample &sample, Real bin);

}    // namespace lsdcd
