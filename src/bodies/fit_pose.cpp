// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "bodies/fit_pose.h"

#include "base/input_error.h"
#include "bodies/read_pose.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsdcd {

namespace {

// Largest eigenvalue of a symmetric matrix and its unit eigenvector, by Jacobi's rotations.
Real largest_eigen(Real (&a)[4][4], Real (&vector)[4])
{
  Real v[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  for (int sweep = 0; sweep < 32; sweep++) {
    Real left = 0;
    for (int p = 0; p < 3; p++)
      for (int q = p + 1; q < 4; q++) {
        if (a[p][q] == 0) continue;
        left += std::fabs(a[p][q]);
        const Real theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const Real t = (theta >= 0 ? 1 : -1) / (std::fabs(theta) + std::sqrt(theta * theta + 1)),
                   c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 4; k++) {
          const Real kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < 4; k++) {
          const Real pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
        }
        for (int k = 0; k < 4; k++) {
          const Real kp = v[k][p], kq = v[k][q];
          v[k][p] = c * kp - s * kq;
          v[k][q] = s * kp + c * kq;
        }
      }
    if (left == 0) break;
  }
  int best = 0;
  for (int k = 1; k < 4; k++)
    if (a[k][k] > a[best][best]) best = k;
  for (int k = 0; k < 4; k++) vector[k] = v[k][best];
  return a[best][best];
}

}    // namespace

PosePoints::PosePoints(const std::vector<Vec3> &points)
{
  if (points.size() < 3)
    throw InputError("it has " + std::to_string(points.size()) +
                     " atoms, and only three or more, not on a line, define how it is turned");
  for (const Vec3 &x : points) centre_ += (1 / static_cast<Real>(points.size())) * x;
  Real c[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  for (const Vec3 &x : points) {
    from_centre_.push_back(x - centre_);
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) c[i][j] += from_centre_.back()[i] * from_centre_.back()[j];
  }
  const Real trace = c[0][0] + c[1][1] + c[2][2];
  Real minors = 0;    // their sum: 0 where all but one eigenvalue are
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3;
    minors += c[i][i] * c[j][j] - c[i][j] * c[j][i];
  }
  constexpr Real kThin = 1e-4;    // of widths
  if (!(minors > kThin * kThin * trace * trace))
    throw InputError("its atoms are on a line, so they do not define how it is turned");
  radius_ = std::sqrt(trace / static_cast<Real>(points.size()));
}

void PosePoints::add(std::size_t point, const Vec3 &x, const Vec3 &origin, double *sums) const
{
  const Vec3 at = x - origin, &from = from_centre_[point];
  sums[0] += 1;
  sums[1] += norm_sq(at);
  for (int i = 0; i < 3; i++) {
    sums[2 + i] += at[i];
    for (int j = 0; j < 3; j++) sums[5 + 3 * i + j] += at[i] * from[j];
  }
}

BodyPose PosePoints::fit(const double *sums, const Vec3 &origin, Real &off) const
{
  const Real n = sums[0];
  const Vec3 mean = (1 / n) * Vec3{sums[2], sums[3], sums[4]};
  const auto s = [&](int from, int to) { return sums[5 + 3 * to + from]; };    // Horn's S
  Real a[4][4] = {
      {s(0, 0) + s(1, 1) + s(2, 2), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0)},
      {0, s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2)},
      {0, 0, -s(0, 0) + s(1, 1) - s(2, 2), s(1, 2) + s(2, 1)},
      {0, 0, 0, -s(0, 0) - s(1, 1) + s(2, 2)}};
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < i; j++) a[i][j] = a[j][i];
  Real quaternion[4];
  const Real most = largest_eigen(a, quaternion);
  const Real apart = (sums[1] - n * norm_sq(mean)) + n * radius_ * radius_ - 2 * most;
  off = std::sqrt(std::max(Real(0), apart / n));
  BodyPose pose = pose_of_quaternion({0, 0, 0}, quaternion);
  pose.shift = origin + mean - pose.corner_at(centre_);
  return pose;
}

}    // namespace lsdcd
