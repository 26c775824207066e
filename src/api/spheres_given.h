// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Spheres in arrays of the caller, checked. Functions throw ApiError, which names the array and the first sphere.
#pragma once

#include "api/lsdcd.h"
#include "backend/gpu_arrays.h"
#include "box/periodic_box.h"
#include "engine/engine.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsdcd {

// Are the arrays where the wall computes? Before anything is read or written there. `gpu`: null, on the host.
void check_positions(const lsdcd_spheres &spheres, const GpuArrays *gpu);
// `has_heat`, `has_types`: of the law, which then needs these arrays.
Spheres spheres_of(const lsdcd_spheres &spheres, bool has_heat, bool has_types);

// The rows of grains that may be no spheres, and radii of spheres around them, for Spheres of a wall with shapes.
class GrainRows {
 public:
  // Makes `spheres`, which are of `given`, read them. They hold until the next call.
  void put(const lsdcd_spheres &given, Spheres &spheres);

 private:
  std::vector<GrainShape> shapes_;
  std::vector<Real> radius_;
};
// Refuses arrays that a wall without shapes does not read.
void refuse_shapes(const lsdcd_spheres &given);

// Checks of arrays of the host:
void check_types(const Spheres &spheres);
void check_sizes(const Spheres &spheres);
void check_motion(const Spheres &spheres);
// Returns the box around the centres.
Box checked_extents(const Spheres &spheres);

// How many centres are outside of a box that neither repeats nor follows them, and the first.
struct Outside {
  std::size_t n = 0;
  int first = 0;
};

Outside outside(const PeriodicBox &box, const Spheres &spheres, const Box &extents);

}    // namespace lsdcd
