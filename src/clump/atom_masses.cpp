// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "clump/atom_masses.h"

#include "base/input_error.h"

#include <array>
#include <cmath>

namespace lsdcd {

namespace {

constexpr int kSums = 10;    // mass, three of the centre, six of the second moments
constexpr int kExact = 4;    // of these: mass and centre
using Row = std::array<Real, kSums>;

Real product(const Row &a, const Row &b)
{
  Real sum = 0;
  for (int k = 0; k < kSums; k++) sum += a[k] * b[k];
  return sum;
}

// Masses w exp(row.x) with the sums `wanted`, by the minimum of the convex function sum of w exp(row.x) - wanted.x.
class MassFit {
 public:
  // `softness`: the second moments may be off by this times the function's numbers; 0: by nothing.
  MassFit(const std::vector<Real> &shares, const std::vector<Row> &rows, const Row &wanted,
          Real softness) :
      shares_(shares),
      rows_(rows), wanted_(wanted), softness_(softness), mass_(shares)
  {
  }

  // False: no masses above 0 have these sums.
  bool solve()
  {
    constexpr int kMostSteps = 200;
    Real value = set(x_);
    for (int step = 0; step < kMostSteps; step++) {
      const Row slope = slope_at();
      if (is_zero(slope)) return true;
      const Row way = newton_step(slope);
      const Real fall = product(slope, way);
      Real share = 1;
      Row next;
      Real there;
      do {
        for (int k = 0; k < kSums; k++) next[k] = x_[k] + share * way[k];
        there = set(next);
        if (there <= value + 1e-4 * share * fall) break;
        share *= 0.5;
      } while (share > 1e-12);
      x_ = next;
      value = there;
    }
    return is_zero(slope_at());
  }
  const std::vector<Real> &mass() const { return mass_; }

 private:
  static bool is_zero(const Row &slope)
  {
    for (const Real s : slope)
      if (!(std::fabs(s) < 1e-12)) return false;
    return true;
  }
  Real set(const Row &x)
  {
    Real value = -product(wanted_, x);
    for (std::size_t i = 0; i < rows_.size(); i++) {
      mass_[i] = shares_[i] * std::exp(product(rows_[i], x));
      value += mass_[i];
    }
    for (int k = kExact; k < kSums; k++) value += 0.5 * softness_ * x[k] * x[k];
    return std::isfinite(value) ? value : HUGE_VAL;
  }
  Row slope_at() const
  {
    Row slope;
    for (int k = 0; k < kSums; k++) {
      slope[k] = -wanted_[k] + (k < kExact ? 0 : softness_ * x_[k]);
      for (std::size_t i = 0; i < rows_.size(); i++) slope[k] += mass_[i] * rows_[i][k];
    }
    return slope;
  }
  // Sums that depend on each other, as of spheres in a line, take no part in the step.
  Row newton_step(const Row &slope) const
  {
    constexpr Real kNone = 1e-13;
    Real bend[kSums][kSums] = {}, axis[kSums][kSums], largest = 0;
    for (std::size_t i = 0; i < rows_.size(); i++)
      for (int k = 0; k < kSums; k++)
        for (int l = 0; l < kSums; l++) bend[k][l] += mass_[i] * rows_[i][k] * rows_[i][l];
    for (int k = kExact; k < kSums; k++) bend[k][k] += softness_;
    diagonalise(bend, axis);
    for (int m = 0; m < kSums; m++) largest = std::fmax(largest, bend[m][m]);
    Row step = {};
    for (int m = 0; m < kSums; m++) {
      if (!(bend[m][m] > kNone * largest)) continue;
      Real along = 0;
      for (int k = 0; k < kSums; k++) along += axis[k][m] * slope[k];
      for (int k = 0; k < kSums; k++) step[k] -= along / bend[m][m] * axis[k][m];
    }
    return step;
  }

  const std::vector<Real> &shares_;
  const std::vector<Row> &rows_;
  const Row wanted_;
  const Real softness_;
  Row x_ = {};
  std::vector<Real> mass_;
};

MassProperties sums_of(const std::vector<Ball> &balls, const std::vector<Real> &mass)
{
  MassProperties p;
  Vec3 first = {0, 0, 0};
  for (std::size_t i = 0; i < balls.size(); i++) {
    p.mass += mass[i];
    first += mass[i] * (balls[i].centre - balls[0].centre);
  }
  p.centre = balls[0].centre + (1 / p.mass) * first;
  for (std::size_t i = 0; i < balls.size(); i++) {
    p.inertia += mass[i] * inertia_of_point(balls[i].centre - p.centre);
    p.inertia += 0.4 * mass[i] * balls[i].radius * balls[i].radius * unit_matrix();
  }
  return p;
}

}    // namespace

AtomMasses atom_masses(const std::vector<Ball> &balls, const MassProperties &clump)
{
  // In units of the mass and of a length of the clump.
  const Real square = clump.inertia.trace() / (2 * clump.mass), length = std::sqrt(square);
  const auto second = [&](Real trace_share, Real element) {
    return (trace_share - element) / (clump.mass * square);
  };
  const SymmetricMatrix &inertia = clump.inertia;
  const Real half = 0.5 * inertia.trace();
  const Row wanted = {1,
                      0,
                      0,
                      0,
                      second(half, inertia.xx),
                      second(half, inertia.yy),
                      second(half, inertia.zz),
                      second(0, inertia.xy),
                      second(0, inertia.xz),
                      second(0, inertia.yz)};
  std::vector<Row> rows;
  std::vector<Real> shares;
  Real volume = 0;
  for (const Ball &b : balls) {
    const Vec3 d = (1 / length) * (b.centre - clump.centre);
    const Real own = b.radius * b.radius / square / 5;
    rows.push_back({1, d.x, d.y, d.z, d.x * d.x + own, d.y * d.y + own, d.z * d.z + own, d.x * d.y,
                    d.x * d.z, d.y * d.z});
    shares.push_back(b.radius * b.radius * b.radius);
    volume += shares.back();
  }
  for (Real &s : shares) s /= volume;
  // Exact masses that are much less than their shares are at the edge of what is possible.
  constexpr Real kLeastShare = 1e-6;
  for (const Real softness : {0.0, 1e-4, 1e-2, 1.0}) {
    MassFit fit(shares, rows, wanted, softness);
    if (!fit.solve()) continue;
    AtomMasses masses;
    bool is_small = false;
    for (std::size_t i = 0; i < balls.size(); i++) {
      is_small = is_small || fit.mass()[i] < kLeastShare * shares[i];
      masses.mass.push_back(fit.mass()[i] * clump.mass);
    }
    if (is_small && softness == 0) continue;
    masses.sums = sums_of(balls, masses.mass);
    return masses;
  }
  throw InputError(
      "no masses above 0 of the spheres have the centre of mass of the clump; leave out spheres "
      "that hardly stand out of others");
}

}    // namespace lsdcd
