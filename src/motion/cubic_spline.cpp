// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "motion/cubic_spline.h"

#include <cstddef>

namespace lsdcd {

namespace {

// below x(i-1) + diagonal x(i) + above x(i+1) = right, for each i.
struct Tridiagonal {
  std::vector<Real> below, diagonal, above;

  explicit Tridiagonal(std::size_t n) : below(n), diagonal(n), above(n) {}

  // Without pivots: the rows of splines need none.
  std::vector<Real> solve(std::vector<Real> right) const
  {
    const std::size_t n = diagonal.size();
    std::vector<Real> pivot = diagonal;
    for (std::size_t i = 1; i < n; i++) {
      const Real times = below[i] / pivot[i - 1];
      pivot[i] -= times * above[i - 1];
      right[i] -= times * right[i - 1];
    }
    right[n - 1] /= pivot[n - 1];
    for (std::size_t i = n - 1; i-- > 0;)
      right[i] = (right[i] - above[i] * right[i + 1]) / pivot[i];
    return right;
  }
};

// The second derivative is the same on both sides of a knot between a piece and the next one.
void join(Tridiagonal &rows, std::vector<Real> &right, std::size_t i, Real length, Real mean,
          Real next_length, Real next_mean)
{
  rows.below[i] = next_length;
  rows.diagonal[i] = 2 * (length + next_length);
  rows.above[i] = length;
  right[i] = 3 * (next_length * mean + length * next_mean);
}

// The third derivative is the same in the two pieces next to an end. Right side of the end's row.
Real end_row(Real first, Real first_mean, Real second, Real second_mean)
{
  const Real both = first + second;
  return ((first + 2 * both) * second * first_mean + first * first * second_mean) / both;
}

}    // namespace

std::vector<Real> spline_slopes(const std::vector<Real> &length, const std::vector<Real> &mean)
{
  const std::size_t n = length.size();
  if (n == 1) return {mean[0], mean[0]};
  if (n == 2) {
    const Real middle = (length[1] * mean[0] + length[0] * mean[1]) / (length[0] + length[1]);
    return {2 * mean[0] - middle, middle, 2 * mean[1] - middle};
  }
  Tridiagonal rows(n + 1);
  std::vector<Real> right(n + 1);
  rows.diagonal[0] = length[1];
  rows.above[0] = length[0] + length[1];
  right[0] = end_row(length[0], mean[0], length[1], mean[1]);
  for (std::size_t i = 1; i < n; i++)
    join(rows, right, i, length[i - 1], mean[i - 1], length[i], mean[i]);
  rows.below[n] = length[n - 1] + length[n - 2];
  rows.diagonal[n] = length[n - 2];
  right[n] = end_row(length[n - 1], mean[n - 1], length[n - 2], mean[n - 2]);
  return rows.solve(right);
}

// The corners of the matrix by the formula of Sherman and Morrison, which needs three rows at least.
std::vector<Real> periodic_spline_slopes(std::vector<Real> length, std::vector<Real> mean)
{
  const std::size_t period = length.size();
  while (length.size() < 3)
    for (std::size_t i = 0; i < period; i++) {
      length.push_back(length[i]);
      mean.push_back(mean[i]);
    }
  const std::size_t n = length.size(), last = n - 1;
  Tridiagonal rows(n);
  std::vector<Real> right(n), corner(n);
  for (std::size_t i = 0; i < n; i++) {
    const std::size_t before = i == 0 ? last : i - 1;
    join(rows, right, i, length[before], mean[before], length[i], mean[i]);
  }
  const Real top = rows.below[0], bottom = rows.above[last], gamma = -rows.diagonal[0];
  rows.diagonal[0] -= gamma;
  rows.diagonal[last] -= bottom * top / gamma;
  corner[0] = gamma;
  corner[last] = bottom;
  std::vector<Real> slopes = rows.solve(right);
  const std::vector<Real> of_corner = rows.solve(corner);
  const Real part =
      (slopes[0] + top / gamma * slopes[last]) / (1 + of_corner[0] + top / gamma * of_corner[last]);
  for (std::size_t i = 0; i < n; i++) slopes[i] -= part * of_corner[i];
  slopes.resize(period);
  return slopes;
}

}    // namespace lsdcd
