// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Unit quaternions as rotations.
#pragma once

#include "base/vec3.h"

#include <cmath>

namespace lsdcd {

struct Quaternion {
  Real w = 1;
  Vec3 v = {0, 0, 0};
};

// Returns the rotation `b` followed by `a`.
inline Quaternion operator*(const Quaternion &a, const Quaternion &b)
{
  return {a.w * b.w - dot(a.v, b.v), a.w * b.v + b.w * a.v + cross(a.v, b.v)};
}

inline Quaternion inverse(const Quaternion &q)
{
  return {q.w, -q.v};
}

// Right-handed, about a unit vector.
inline Quaternion rotation_about(const Vec3 &axis, Real angle)
{
  return {std::cos(angle / 2), std::sin(angle / 2) * axis};
}

inline Quaternion normalised(const Quaternion &q)
{
  const Real scale = 1 / std::sqrt(q.w * q.w + norm_sq(q.v));
  return {scale * q.w, scale * q.v};
}

inline Vec3 rotate(const Quaternion &q, const Vec3 &a)
{
  const Vec3 t = 2 * cross(q.v, a);
  return a + q.w * t + cross(q.v, t);
}

// Rows of its matrix.
inline void rows_of(const Quaternion &q, Vec3 (&row)[3])
{
  const Real x = q.v.x, y = q.v.y, z = q.v.z, w = q.w;
  row[0] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)};
  row[1] = {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)};
  row[2] = {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)};
}

}    // namespace lsdcd
