// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "study/cylinder.h"

#include "base/input_error.h"

#include <cmath>
#include <string>

namespace lsdcd {

namespace {

void triangle(TriangleSoup &soup, const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  soup.corners.insert(soup.corners.end(), {a, b, c});
}

void check(const char *what, int value, int least)
{
  if (value < least)
    throw InputError("a cylinder with " + std::to_string(value) + " " + what +
                     " is none; give at least " + std::to_string(least));
}

}    // namespace

TriangleSoup make_cylinder(const CylinderMesh &shape)
{
  const int n = shape.segments, rows = shape.along;
  check("segments", n, 3);
  check("rows along", rows, 1);
  check("rows of slant", shape.slant, 0);
  TriangleSoup soup;
  soup.source = "cylinder";
  const auto rim = [&](int i, int k) {
    const Real a = 2 * kPi * (i % n) / n;
    return Vec3{shape.radius * std::cos(a), shape.radius * std::sin(a), shape.height * k / rows};
  };
  for (int i = 0; i < n; i++) {
    // Goes up both sides of a strip; the right one is ahead by a row and the slant.
    int left = 0, right = 0;
    while (left < rows || right < rows) {
      if (right < rows && right - left <= shape.slant) {
        triangle(soup, rim(i, left), rim(i + 1, right), rim(i + 1, right + 1));
        right++;
      } else {
        triangle(soup, rim(i, left), rim(i + 1, right), rim(i, left + 1));
        left++;
      }
    }
    if (shape.caps == Caps::centre) {
      triangle(soup, {0, 0, 0}, rim(i + 1, 0), rim(i, 0));
      triangle(soup, {0, 0, shape.height}, rim(i, rows), rim(i + 1, rows));
    } else if (i > 0 && i + 1 < n) {
      triangle(soup, rim(0, 0), rim(i + 1, 0), rim(i, 0));
      triangle(soup, rim(0, rows), rim(i, rows), rim(i + 1, rows));
    }
  }
  return soup;
}

}    // namespace lsdcd
