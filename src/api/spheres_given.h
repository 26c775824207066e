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

namespace lsdcd {

// Are the arrays where the wall computes? Before anything is read or written there. `gpu`: null, on the host.
void check_positions(const lsdcd_spheres &spheres, const GpuArrays *gpu);
// `has_heat`, `has_types`: of the law, which then needs these arrays.
Spheres spheres_of(const lsdcd_spheres &spheres, bool has_heat, bool has_types);

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
