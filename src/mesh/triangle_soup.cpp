// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/triangle_soup.h"

#include <algorithm>
#include <limits>

namespace lsdcd {

namespace {

// Beyond its range a float would be infinite, and the conversion undefined.
bool is_float(Real x)
{
  return x >= -std::numeric_limits<float>::max() && x <= std::numeric_limits<float>::max() &&
         static_cast<Real>(static_cast<float>(x)) == x;
}

}    // namespace

FileRounding known_rounding(const TriangleSoup &soup)
{
  if (soup.rounding.step > 0) return soup.rounding;
  const bool floats = std::all_of(soup.corners.begin(), soup.corners.end(), [](const Vec3 &x) {
    return is_float(x.x) && is_float(x.y) && is_float(x.z);
  });
  FileRounding rounding;
  rounding.step =
      floats ? Real(std::numeric_limits<float>::epsilon()) : std::numeric_limits<Real>::epsilon();
  return rounding;
}

}    // namespace lsdcd
