// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Motions by which tests move meshes.
#pragma once

#include "motion/motion.h"

#include <vector>

namespace lsdcd {

inline MotionTerm linear(const Vec3 &v)
{
  MotionTerm m;
  m.velocity = v;
  return m;
}

// Goes along as well, where a velocity is given.
inline MotionTerm turning(const Vec3 &point, const Vec3 &axis, Real period,
                          const Vec3 &v = {0, 0, 0})
{
  MotionTerm m;
  m.kind = v == Vec3{0, 0, 0} ? MotionKind::rotate : MotionKind::transrot;
  m.point = point;
  m.axis = unit_vector(axis);
  m.period = period;
  m.velocity = v;
  return m;
}

inline RigidMotion motion_of(const std::vector<MotionTerm> &terms)
{
  RigidMotion motion;
  for (const MotionTerm &m : terms) motion.add(m);
  return motion;
}

}    // namespace lsdcd
