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
using Wide = long double;

struct Determinant {
  Wide value;
  Wide of_sizes;    // the sum of the sizes of its six products
};

Determinant determinant(const Vec3 *row)
{
  Determinant d = {0, 0};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Wide plus = Wide(row[0][i]) * row[1][j] * row[2][k],
               minus = Wide(row[0][i]) * row[1][k] * row[2][j];
    d.value += plus - minus;
    d.of_sizes += std::fabs(plus) + std::fabs(minus);
  }
  return d;
}

void check_determinant(const Vec3 *row)
{
  const std::string of = "the determinant of the rows " + vector_text(row[0]) + ", " +
                         vector_text(row[1]) + ", " + vector_text(row[2]) + " is ";
  const Determinant d = determinant(row);
  // Each of the three numbers in a product has been rounded to double.
  const Wide rounding = 3 * Wide(0x1p-53) * d.of_sizes;
  if (!(std::fabs(d.value) > rounding))
    throw InputError(of + (d.value == 0 ? "0" : "0 within rounding") +
                     ", so that it would make the mesh flat: give three rows that lie in no plane");
  if (!std::isfinite(static_cast<Real>(d.value)))
    throw InputError(of + "not finite: give smaller numbers");
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

  compose(turn);
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

void Placement::matrix(const Vec3 (&m)[3], const Vec3 &shift)
{
  for (const Vec3 &row : m)
    if (!is_finite(row))
      throw InputError("matrix with the row " + vector_text(row) +
                       ": a number is not finite; give finite numbers");
  if (!is_finite(shift))
    throw InputError("matrix with the shift " + vector_text(shift) +
                     ": a component is not finite; give three lengths");
  check_determinant(m);
  compose(m);
  shift_ += shift;
  steps_.push_back({PlacementStep::matrix, shift, 0, {m[0], m[1], m[2]}});
}

// Acts on the result of all steps so far.
void Placement::compose(const Vec3 (&m)[3])
{
  Vec3 row[3];
  for (int i = 0; i < 3; ++i) row[i] = m[i].x * row_[0] + m[i].y * row_[1] + m[i].z * row_[2];
  shift_ = {dot(m[0], shift_), dot(m[1], shift_), dot(m[2], shift_)};
  for (int i = 0; i < 3; ++i) row_[i] = row[i];
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

bool Placement::stretches() const
{
  constexpr Real kRounding = 1e-9;
  for (int k = 0; k < 3; ++k)
    if (std::fabs(norm(Vec3{row_[0][k], row_[1][k], row_[2][k]}) - 1) > kRounding) return true;
  return false;
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
  if (determinant(row_).value < 0)
    for (std::size_t t = 0; t < soup.n_triangles(); ++t)
      std::swap(soup.corners[3 * t + 1], soup.corners[3 * t + 2]);
}

}    // namespace lsdcd
