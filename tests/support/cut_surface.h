// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Surfaces of a few triangles, which are cut into many.
#pragma once

#include "base/quaternion.h"
#include "mesh/triangle_soup.h"

#include <cmath>
#include <vector>

namespace lsdcd {

// Turns and moves a surface to where coordinates are rounded.
inline const Quaternion kTurn = normalised({0.6, {0.31, -0.52, 0.4}});
inline Vec3 placed(const Vec3 &p)
{
  return rotate(kTurn, p) + Vec3{0.17, -0.29, 0.11};
}

// Each triangle of a surface in pieces * pieces triangles of it.
inline TriangleSoup cut(const std::vector<Vec3> &corners, int pieces)
{
  TriangleSoup soup;
  for (std::size_t t = 0; t < corners.size(); t += 3) {
    const auto at = [&](int i, int j) {
      return placed((1.0 / pieces) *
                    ((pieces - i - j) * corners[t] + i * corners[t + 1] + j * corners[t + 2]));
    };
    for (int i = 0; i < pieces; i++)
      for (int j = 0; i + j < pieces; j++) {
        soup.corners.insert(soup.corners.end(), {at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < pieces)
          soup.corners.insert(soup.corners.end(), {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }
  return soup;
}

// A strip from x = 0, along y, in the direction of an angle over the plane z = 0.
inline std::vector<Vec3> half_plane(Real degrees)
{
  const Vec3 out = {10 * std::cos(degrees * kPi / 180), 0, 10 * std::sin(degrees * kPi / 180)},
             side = {0, 10, 0};
  return {-side, out - side, side, out - side, out + side, side};
}

inline std::vector<Vec3> fold(Real degrees)
{
  std::vector<Vec3> corners = half_plane(180);
  const std::vector<Vec3> other = half_plane(degrees);
  corners.insert(corners.end(), other.begin(), other.end());
  return corners;
}

// A pyramid that opens upwards, of n faces.
inline std::vector<Vec3> bowl(int n)
{
  std::vector<Vec3> corners;
  const auto rim = [n](int k) {
    return Vec3{6 * std::cos(2 * kPi * k / n), 6 * std::sin(2 * kPi * k / n), 4};
  };
  for (int k = 0; k < n; k++) corners.insert(corners.end(), {{0, 0, 0}, rim(k), rim(k + 1)});
  return corners;
}

// A drum along y, of n sides, with its lowest corner at the origin.
inline std::vector<Vec3> drum(int n)
{
  std::vector<Vec3> corners;
  const auto rim = [n](int k, Real y) {
    return Vec3{5 * std::sin(2 * kPi * k / n), y, 5 - 5 * std::cos(2 * kPi * k / n)};
  };
  for (int k = 0; k < n; k++)
    corners.insert(corners.end(), {rim(k, -6), rim(k + 1, -6), rim(k, 6), rim(k + 1, -6),
                                   rim(k + 1, 6), rim(k, 6)});
  return corners;
}

}    // namespace lsdcd
