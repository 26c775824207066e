// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/face_plane.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {
namespace {

using Wide = long double;    // 64 bits of mantissa or more

struct WideVec3 {
  Wide x, y, z;
};

WideVec3 difference(const Vec3 &a, const Vec3 &b)
{
  return {Wide(a.x) - b.x, Wide(a.y) - b.y, Wide(a.z) - b.z};
}

Wide length(const WideVec3 &a)
{
  return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

Real largest_coordinate(const Vec3 &a)
{
  return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
}

}    // namespace

FacePlane face_plane(const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  const WideVec3 edge[3] = {difference(b, a), difference(c, b), difference(a, c)};
  const Wide lengths[3] = {length(edge[0]), length(edge[1]), length(edge[2])};
  const int longest = static_cast<int>(std::max_element(lengths, lengths + 3) - lengths);
  // The cross product of the two shorter edges loses the fewest digits.
  const WideVec3 &u = edge[(longest + 1) % 3], &v = edge[(longest + 2) % 3];
  const WideVec3 n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  const Wide twice_area = length(n);
  const Wide height = lengths[longest] > 0 ? twice_area / lengths[longest] : 0;

  // Three points meant to be on a line miss it by the rounding of their coordinates
  // and of the placement that moved them, a few units in the last place. Below that
  // a facet's plane is noise. The second bound is for facets with exact coordinates, as far
  // from the origin as they are large: it drops those thinner than 1e-14 of their longest edge, which
  // moves the surface by no more. The error of `height` here is 1e-18 of the longest edge or less.
  const Real magnitude =
      std::max({largest_coordinate(a), largest_coordinate(b), largest_coordinate(c)});
  const bool degenerate =
      height <= std::max<Wide>(8 * kRoundoff * magnitude, 1e-14L * lengths[longest]);
  FacePlane out = {
      {0, 0, 0}, static_cast<Real>(twice_area / 2), static_cast<Real>(height), degenerate};
  if (!degenerate)
    out.normal = {static_cast<Real>(n.x / twice_area), static_cast<Real>(n.y / twice_area),
                  static_cast<Real>(n.z / twice_area)};
  return out;
}

}    // namespace lsdcd
