// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A sphere as queries read it.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

// Centre and radius; lengths. Aligned so that a GPU reads it at once or in two parts.
template <class T>
struct alignas(16) SphereOf {
  T x, y, z, r;

  LSDCD_FN Vec3 centre() const
  {
    return {static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z)};
  }
};
using Sphere = SphereOf<Real>;
using FloatSphere = SphereOf<float>;

}    // namespace lsdcd
