// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Where a body is from where points of it are: against the motion that put them there.
#include "base/input_error.h"
#include "bodies/fit_pose.h"
#include "bodies/read_pose.h"
#include "support/random_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lsdcd::test_fit_pose {
namespace {

std::vector<Vec3> some_points(Numbers &r, int n)
{
  std::vector<Vec3> points;
  for (int k = 0; k < n; k++) points.push_back(r.log_in(0.3, 1) * r.direction() + Vec3{5, -3, 2});
  return points;
}

BodyPose random_motion(Numbers &r, Real far)
{
  const Vec3 u = r.direction(), v = any_perpendicular(u), w = cross(u, v);
  BodyPose pose;
  pose.row[0] = u, pose.row[1] = v, pose.row[2] = w;
  pose.shift = far * r.direction();
  return pose;
}

// Sums of products of numbers near 1 are right to some 1e-14, where the points are 6 from their
// mesh's origin; how they are turned about their longest axis is less sure by the square of how much
// thinner they are, here not above 1e3.
constexpr Real kRounding = 1e-11;

TEST(fit_pose, the_motion_of_points_is_found)
{
  for (long seed = 1; seed <= 200; seed++) {
    Numbers r(seed);
    const std::vector<Vec3> points = some_points(r, 4 + r.below(20));
    const PosePoints body(points);
    const BodyPose motion = random_motion(r, 10);
    const Vec3 origin = motion.corner_at(points[0]);
    double sums[PosePoints::kSums] = {0};
    for (std::size_t k = 0; k < points.size(); k++)
      body.add(k, motion.corner_at(points[k]), origin, sums);
    Real off = -1;
    const BodyPose found = body.fit(sums, origin, off);
    for (const Vec3 &x : points)
      EXPECT_LT(norm(found.corner_at(x) - motion.corner_at(x)), kRounding) << seed;
    EXPECT_LT(off, 1e-6);    // the root of a rounding
  }
}

// Where one of many is moved, it is off by that, and by its share of the mean.
TEST(fit_pose, points_that_are_no_rigid_copy_are_off)
{
  Numbers r(7);
  const std::vector<Vec3> points = some_points(r, 100);
  const PosePoints body(points);
  const BodyPose motion = random_motion(r, 10);
  double sums[PosePoints::kSums] = {0};
  for (std::size_t k = 0; k < points.size(); k++)
    body.add(k, motion.corner_at(points[k]) + (k == 3 ? Vec3{0.5, 0, 0} : Vec3{0, 0, 0}),
             motion.shift, sums);
  Real off = 0;
  body.fit(sums, motion.shift, off);
  // Not fitted: 0.5 / sqrt(100). Fitting takes six of 300 numbers' share off at most, and with one
  // point moved less than 1/5 of it.
  EXPECT_LT(off, 0.05);
  EXPECT_GT(off, 0.04);
}

// A mirrored body is none that was moved: the best rotation leaves the points off.
TEST(fit_pose, a_mirrored_body_is_off)
{
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  const PosePoints body(points);
  double sums[PosePoints::kSums] = {0};
  for (std::size_t k = 0; k < points.size(); k++)
    body.add(k, {-points[k].x, points[k].y, points[k].z}, {0, 0, 0}, sums);
  Real off = 0;
  const BodyPose pose = body.fit(sums, {0, 0, 0}, off);
  EXPECT_GT(off, 0.1);
  EXPECT_NEAR(dot(pose.row[0], cross(pose.row[1], pose.row[2])), 1, 1e-12);
}

TEST(fit_pose, points_that_do_not_tell_the_turn_are_refused)
{
  EXPECT_THROW(PosePoints({{0, 0, 0}, {1, 0, 0}}), InputError);
  EXPECT_THROW(PosePoints({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {5, 5, 0}}), InputError);
  EXPECT_THROW(PosePoints({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}), InputError);
  EXPECT_NO_THROW(PosePoints({{0, 0, 0}, {1, 1, 0}, {2, 2.1, 0}}));
}

}    // namespace
}    // namespace lsdcd::test_fit_pose
