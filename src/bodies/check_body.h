// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Whether a body and its pose can be used.
#pragma once

#include "base/input_error.h"
#include "base/input_words.h"
#include "bodies/body_collision.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace lsdcd {

constexpr std::uint64_t kMaxPieces = std::uint64_t(1) << 28;

[[noreturn]] inline void throw_too_many_pieces(const std::string &source, Real n)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", n);
  throw InputError(source + ": in cells of the wall's grid the body has " + text +
                   " pieces, more than 2^28: give longer cells");
}

// A quick bound before pieces are counted: none has a larger area than one with equal sides.
inline void check_body(const TriangleSoup &body, Real longest)
{
  constexpr Real kLargestLength = 1e100;
  if (body.corners.empty()) throw InputError(body.source + ": the body has no triangles");
  Real n = 0;
  for (std::size_t c = 0; c < body.corners.size(); c++) {
    const Vec3 &x = body.corners[c];
    for (int k = 0; k < 3; k++)
      if (!(std::fabs(x[k]) <= kLargestLength))
        throw InputError(body.source + ", triangle " + std::to_string(c / 3 + 1) + ": coordinate " +
                         "xyz"[k] + " is " + number_text(x[k]) + ", beyond 1e100; repair the mesh");
    if (c % 3 != 2) continue;
    const Vec3 u = (1 / longest) * (body.corners[c - 1] - body.corners[c - 2]),
               v = (1 / longest) * (x - body.corners[c - 2]);
    constexpr Real kLargestArea = 0.4330127018922194;    // sqrt(3) / 4
    n += std::max(Real(1), norm(cross(u, v)) / (2 * kLargestArea));
    n = std::max(n, std::max(norm(u), norm(v)));
  }
  if (!(n <= Real(kMaxPieces))) throw_too_many_pieces(body.source, n);
}
// Are rows unit vectors at right angles?
inline bool is_orthogonal(const BodyPose &pose, Real tolerance)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j <= i; j++)
      if (!(std::fabs(dot(pose.row[i], pose.row[j]) - (i == j)) <= tolerance)) return false;
  return true;
}
inline void check_rotation(const BodyPose &pose, Real tolerance = 1e-8)
{
  if (!is_orthogonal(pose, tolerance))
    throw InputError(
        "the pose's matrix is not a rotation: its rows are not perpendicular unit vectors, to " +
        number_text(tolerance));
  if (!(dot(pose.row[0], cross(pose.row[1], pose.row[2])) > 0))
    throw InputError("the pose's matrix mirrors the body: its determinant is -1");
}

}    // namespace lsdcd
