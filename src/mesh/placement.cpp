// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/placement.h"

#include "base/input_error.h"
#include "base/vector_text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace lsdcd {
namespace {

bool is_finite(const Vec3 &a)
{
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// Quarter turns are exact, so that a box turned by 90 degrees stays a box.
void sine_cosine(Real degrees, Real &sine, Real &cosine)
{
  const Real turn = std::fmod(degrees, 360.0);
  const Real quarters = turn / 90;
  if (quarters == std::floor(quarters)) {
    constexpr Real kSine[] = {0, 1, 0, -1};
    const int i = (static_cast<int>(quarters) + 4) % 4;
    sine = kSine[i];
    cosine = kSine[(i + 1) % 4];
    return;
  }
  const Real radians = turn * (kPi / 180);
  sine = std::sin(radians);
  cosine = std::cos(radians);
}

// In long double the product of three factors of 1e-150 does not underflow.
bool is_mirror(const Vec3 *row)
{
  using Wide = long double;
  const Wide x = Wide(row[1].y) * row[2].z - Wide(row[1].z) * row[2].y;
  const Wide y = Wide(row[1].z) * row[2].x - Wide(row[1].x) * row[2].z;
  const Wide z = Wide(row[1].x) * row[2].y - Wide(row[1].y) * row[2].x;
  return row[0].x * x + row[0].y * y + row[0].z * z < 0;
}

}    // namespace

void Placement::scale(const Vec3 &factors)
{
  if (!is_finite(factors) || factors.x == 0 || factors.y == 0 || factors.z == 0)
    throw InputError("scale " + vector_text(factors) +
                     ": a factor is zero or not finite; give three finite factors, none zero");
  for (int i = 0; i < 3; ++i) {
    row_[i] = factors[i] * row_[i];
    shift_[i] *= factors[i];
  }
  steps_.push_back({PlacementStep::scale, factors});
}

void Placement::rotate(const Vec3 &axis, Real degrees)
{
  const Real largest = std::max({std::fabs(axis.x), std::fabs(axis.y), std::fabs(axis.z)});
  if (!is_finite(axis) || largest == 0)
    throw InputError("rotate about " + vector_text(axis) +
                     ": the axis is zero or not finite; give a direction such as 0 0 1");
  if (!std::isfinite(degrees))
    throw InputError("rotate by " + std::to_string(degrees) +
                     ": the angle is not finite; give degrees");
  // Divided by its largest component first, (0, 0, a) becomes exactly (0, 0, 1).
  const Vec3 scaled = {axis.x / largest, axis.y / largest, axis.z / largest};
  const Real length = norm(scaled);
  const Vec3 k = {scaled.x / length, scaled.y / length, scaled.z / length};
  Real s, c;
  sine_cosine(degrees, s, c);
  const auto diagonal = [&](Real a) { return a * a + c * (1 - a * a); };
  const Vec3 turn[3] = {
      {diagonal(k.x), (1 - c) * k.x * k.y - s * k.z, (1 - c) * k.x * k.z + s * k.y},
      {(1 - c) * k.y * k.x + s * k.z, diagonal(k.y), (1 - c) * k.y * k.z - s * k.x},
      {(1 - c) * k.z * k.x - s * k.y, (1 - c) * k.z * k.y + s * k.x, diagonal(k.z)}};

  Vec3 row[3];
  for (int i = 0; i < 3; ++i)
    row[i] = turn[i].x * row_[0] + turn[i].y * row_[1] + turn[i].z * row_[2];
  shift_ = {dot(turn[0], shift_), dot(turn[1], shift_), dot(turn[2], shift_)};
  for (int i = 0; i < 3; ++i) row_[i] = row[i];
  steps_.push_back({PlacementStep::rotate, axis, degrees});
}

void Placement::move(const Vec3 &shift)
{
  if (!is_finite(shift))
    throw InputError("move " + vector_text(shift) +
                     ": a component is not finite; give three lengths");
  shift_ += shift;
  steps_.push_back({PlacementStep::move, shift});
}

void Placement::set(const Vec3 (&row)[3], const Vec3 &shift)
{
  for (int i = 0; i < 3; ++i) row_[i] = row[i];
  shift_ = shift;
  steps_.clear();
}

bool Placement::is_identity() const
{
  return row_[0] == Vec3{1, 0, 0} && row_[1] == Vec3{0, 1, 0} && row_[2] == Vec3{0, 0, 1} &&
         shift_ == Vec3{0, 0, 0};
}

bool Placement::operator==(const Placement &other) const
{
  return row_[0] == other.row_[0] && row_[1] == other.row_[1] && row_[2] == other.row_[2] &&
         shift_ == other.shift_;
}

Vec3 Placement::apply(const Vec3 &x) const
{
  return Vec3{dot(row_[0], x), dot(row_[1], x), dot(row_[2], x)} + shift_;
}

void Placement::apply(TriangleSoup &soup) const
{
  if (is_identity()) return;
  soup.rounding.origin = apply(soup.rounding.origin);
  for (std::size_t i = 0; i < soup.corners.size(); ++i) {
    const Vec3 placed = apply(soup.corners[i]);
    if (!is_finite(placed))
      throw InputError(soup.source + ", facet " + std::to_string(i / 3 + 1) + ": the corner " +
                       vector_text(soup.corners[i]) +
                       " overflows when it is placed; use a smaller scale or shift");
    soup.corners[i] = placed;
  }
  if (is_mirror(row_))
    for (std::size_t t = 0; t < soup.n_triangles(); ++t)
      std::swap(soup.corners[3 * t + 1], soup.corners[3 * t + 2]);
}

}    // namespace lsdcd
