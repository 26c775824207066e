// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Shared by the tests of the library's queries: meshes and points in arrays of the caller, and what errors say.
#pragma once

#include "lsdcd_behind_core.h"
#include "support/meshes.h"
#include "support/says.h"

#include <cstddef>
#include <random>
#include <vector>

inline std::vector<double> numbers(const lsdcd::TriangleSoup &soup)
{
  std::vector<double> out;
  for (const lsdcd::Vec3 &p : soup.corners) out.insert(out.end(), {p.x, p.y, p.z});
  return out;
}

// Corners, sharp edges, a flat triangulated wall and a round one.
inline lsdcd::TriangleSoup box_and_cylinder()
{
  lsdcd::TriangleSoup soup = lsdcd::box_mesh({-1, -1, -1}, {1, 1, 1});
  lsdcd::append(soup, lsdcd::cylinder_mesh(24, 5, 0.5, 0.6));
  return soup;
}

// n points of a cube about the origin.
template <class T>
std::vector<T> random_points(std::size_t n, double half = 1.5, unsigned seed = 1)
{
  std::mt19937 r(seed);
  std::uniform_real_distribution<double> at(-half, half);
  std::vector<T> points(3 * n);
  for (T &x : points) x = static_cast<T>(at(r));
  return points;
}

template <class T>
lsdcd::Vec3 point(const std::vector<T> &points, std::size_t i)
{
  return {double(points[3 * i]), double(points[3 * i + 1]), double(points[3 * i + 2])};
}
