// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a step finds for one sphere.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

// What the wall does to a sphere, in the frame of a mesh. n_contacts counts the contacts that bear, and the springs.
struct alignas(16) SphereResult {
  Vec3 force, torque;
  Real energy;
  Real overlap_ratio;     // largest overlap / radius
  Vec3 weighted_point;    // sum of |normal force| * contact point
  Real weight;            // sum of |normal force|
  int n_contacts;
  int pad;    // keeps the record free of indeterminate bytes
};

}    // namespace lsdcd
