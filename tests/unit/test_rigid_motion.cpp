// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Poses and velocities of moving meshes against closed forms in long double.
#include "support/motions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace lsdcd::test_rigid_motion {
namespace {

using Wide = long double;
using WideVec = Vec3Of<Wide>;
constexpr Wide kWidePi = 3.14159265358979323846264338327950288L;

MotionTerm wave(MotionKind kind, const Vec3 &amplitude, Real period)
{
  MotionTerm m;
  m.kind = kind;
  m.amplitude = amplitude;
  m.period = period;
  return m;
}
MotionTerm swinging(const Vec3 &point, const Vec3 &axis, Real angle, Real period)
{
  MotionTerm m = turning(point, axis, period);
  m.kind = MotionKind::riggle;
  m.angle = angle;
  return m;
}

// Where the words of fix move put a point, term after term: an axis and an angle (Rodrigues).
WideVec where(const std::vector<MotionTerm> &terms, const Vec3 &point, Wide t)
{
  WideVec x = vec_cast<Wide>(point);
  for (const MotionTerm &m : terms) {
    Wide angle = m.period > 0 ? 2 * kWidePi * t / m.period : 0;
    if (m.kind == MotionKind::riggle) angle = m.angle * std::sin(angle);
    if (m.kind == MotionKind::wiggle) x += std::sin(angle) * vec_cast<Wide>(m.amplitude);
    if (m.kind == MotionKind::cosine) x += (1 - std::cos(angle)) * vec_cast<Wide>(m.amplitude);
    if (m.turns()) {
      const WideVec p = vec_cast<Wide>(m.point), k = vec_cast<Wide>(m.axis), d = x - p;
      x = p + std::cos(angle) * d + std::sin(angle) * cross(k, d) +
          ((1 - std::cos(angle)) * dot(k, d)) * k;
    }
    x += t * vec_cast<Wide>(m.velocity);
  }
  return x;
}

// Differences of fourth order: with a period of 0.7 and more errors are (2 pi h/0.7)^4/30 of a
// velocity, 2e-16 at h = 3e-5, and 5e-20/h of a place of size 10, 2e-14.
WideVec speed(const std::vector<MotionTerm> &terms, const Vec3 &x, Wide t)
{
  const Wide h = 3e-5L;
  const auto at = [&](int k) { return where(terms, x, t + k * h); };
  return (1 / (12 * h)) * (8 * (at(1) - at(-1)) - (at(2) - at(-2)));
}

const Vec3 kPoint = {0.3, -1.7, 0.9};
const std::vector<std::vector<MotionTerm>> kMotions = {
    {linear({1, -2, 0.5})},
    {wave(MotionKind::wiggle, {0.2, 0, -0.1}, 0.7)},
    {wave(MotionKind::cosine, {0.2, 0, -0.1}, 0.7)},
    {turning({1, 2, 3}, {1, -1, 0.5}, 1.3)},
    {turning({1, 2, 3}, {1, -1, 0.5}, 1.3, {0.1, 0.2, -0.3})},
    {swinging({1, 2, 3}, {1, -1, 0.5}, 0.8, 1.3), linear({1, -2, 0.5})},
    // A screen that wiggles on a rotating frame, on a truck.
    {wave(MotionKind::wiggle, {0.2, 0, -0.1}, 0.7), turning({1, 2, 3}, {0, 1, 0}, 1.3),
     linear({1, -2, 0.5})},
    {turning({1, 2, 3}, {0, 1, 0}, 1.3), turning({-2, 0, 1}, {1, 1, 1}, 0.9),
     wave(MotionKind::cosine, {0, 0.4, 0}, 2.1)},
};

// Rounding: places are of size 10, speeds of 100, in some 30 operations.
TEST(wall_motion, puts_points_where_the_words_say)
{
  for (const auto &terms : kMotions)
    for (const Real t : {0.0, 0.1, 0.55, 1.0, 3.7})
      EXPECT_LE(norm(vec_cast<Wide>(motion_of(terms).pose_at(t).to_box(kPoint)) -
                     where(terms, kPoint, t)),
                30 * 10 * 2.3e-16);
}

TEST(wall_motion, velocities_are_the_derivatives)
{
  for (const auto &terms : kMotions)
    for (const Real t : {0.0, 0.1, 0.55, 1.0, 3.7}) {
      const Pose pose = motion_of(terms).pose_at(t);
      const Vec3 v = pose.turn_to_box(pose.velocity_in_mesh(kPoint));
      EXPECT_LE(norm(vec_cast<Wide>(v) - speed(terms, kPoint, t)), 30 * 100 * 2.3e-16);
    }
}

TEST(wall_motion, the_frame_of_the_mesh_is_the_inverse)
{
  const Pose pose = motion_of(kMotions[6]).pose_at(0.61);
  // Rounding of 20 operations on numbers of size 3.
  EXPECT_LE(norm(pose.to_mesh(pose.to_box(kPoint)) - kPoint), 1e-14);
  EXPECT_LE(norm(pose.turn_to_mesh(pose.turn_to_box(kPoint)) - kPoint), 1e-14);
}

void expect_same_place(const Pose &a, const Pose &b)
{
  for (int i = 0; i < 3; i++) EXPECT_EQ(a.row[i], b.row[i]);
  EXPECT_EQ(a.shift, b.shift);
}

TEST(wall_motion, a_whole_turn_gives_the_bits_of_none)
{
  const RigidMotion motion = motion_of(
      {turning({0.3, 0.2, 0.1}, {1, 2, 3}, 0.7), wave(MotionKind::wiggle, {1, 2, 3}, 0.35)});
  expect_same_place(motion.pose_at(0.7), Pose());
  expect_same_place(motion.pose_at(0.7L * 12345), Pose());
  expect_same_place(motion_of({wave(MotionKind::cosine, {1, 2, 3}, 0.35)}).pose_at(0.7), Pose());
}

// 1e-6 is not a double, and a million of it is 1 + 4.8e-17.
TEST(wall_motion, a_million_steps_of_a_millionth_are_a_whole_turn)
{
  const RigidMotion motion = motion_of({turning({0.3, 0.2, 0.1}, {1, 2, 3}, 1)});
  expect_same_place(motion.pose_at(Time(1000000) * 1e-6), Pose());
  expect_same_place(motion.pose_at(Time(1000000) * 1e-6 * 1000), Pose());
  // A step earlier it is a step earlier.
  EXPECT_GT(norm(motion.pose_at(Time(999999) * 1e-6).shift), 1e-7);
}

TEST(wall_motion, quarter_turns_are_exact)
{
  const RigidMotion motion = motion_of({turning({0, 0, 0}, {0, 0, 3}, 2)});
  EXPECT_EQ(motion.pose_at(0.5).to_box({1, 2, 3}), (Vec3{-2, 1, 3}));
  EXPECT_EQ(motion.pose_at(1).to_box({1, 2, 3}), (Vec3{-1, -2, 3}));
  EXPECT_EQ(motion.pose_at(1.5).to_box({1, 2, 3}), (Vec3{2, -1, 3}));
}

// The time of 1e9 steps is exact to 2^-64 of itself, a phase of 1e6 periods to 1e-13.
TEST(wall_motion, does_not_drift_in_1e9_steps)
{
  const std::vector<MotionTerm> terms = {turning({1, 2, 3}, {1, -1, 0.5}, 1)};
  const Real dt = 0.0009765625;    // 2^-10: the phase is known exactly
  const Time t = Time(1000000123) * dt;
  const Wide phase = std::fmod(Wide(t), Wide(1));
  EXPECT_LE(norm(vec_cast<Wide>(motion_of(terms).pose_at(t).to_box(kPoint)) -
                 where(terms, kPoint, phase)),
            30 * 10 * 2.3e-16 + 2 * kPi * 5 * 1e-13);
}

TEST(wall_motion, begins_from_where_it_stands)
{
  RigidMotion motion = motion_of({turning({0, 0, 0}, {0, 0, 1}, 4)});
  motion.begin_from(motion.pose_at(1));
  EXPECT_EQ(motion.pose_at(0).to_box({1, 0, 0}), (Vec3{0, 1, 0}));
  EXPECT_EQ(motion.pose_at(1).to_box({1, 0, 0}), (Vec3{-1, 0, 0}));
  motion.stop();
  EXPECT_EQ(motion.pose_at(7).to_box({1, 0, 0}), (Vec3{0, 1, 0}));
  EXPECT_EQ(motion.pose_at(7).velocity_in_mesh({1, 0, 0}), (Vec3{0, 0, 0}));
  motion.begin_from(Pose());
  EXPECT_TRUE(motion.any());    // it moved, and is known to stand
  EXPECT_FALSE(RigidMotion().any());
}

TEST(wall_motion, knows_which_directions_it_keeps)
{
  const Vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
  const RigidMotion drum = motion_of({turning({1, 2, 3}, z, 1)});
  EXPECT_TRUE(drum.keeps(z));
  EXPECT_FALSE(drum.keeps(x));
  const RigidMotion belt = motion_of({linear({1, 0, 1})});
  EXPECT_TRUE(belt.keeps(y));
  EXPECT_FALSE(belt.keeps(z));
  EXPECT_FALSE(motion_of({turning({1, 2, 3}, z, 1, {0, 0, 1})}).keeps(z));
  EXPECT_FALSE(motion_of({wave(MotionKind::wiggle, {0, 1, 0}, 1)}).keeps(y));
  MotionTerm variable;
  variable.kind = MotionKind::variable;
  variable.input[1] = 0;
  EXPECT_TRUE(motion_of({variable}).keeps(x));
  EXPECT_FALSE(motion_of({variable}).keeps(y));
}

// At a corner of the box: an eighth of a turn moves a point at distance 5 by 10 sin(pi/8).
TEST(wall_motion, bounds_the_way_and_speed_of_points_of_a_box)
{
  const RigidMotion motion = motion_of({turning({0, 0, 0}, {0, 0, 1}, 8)});
  const Box box = {{-3, -4, -1}, {1, 2, 1}};
  EXPECT_NEAR(farthest_between(motion.pose_at(0), motion.pose_at(1), box), 10 * std::sin(kPi / 8),
              1e-14);
  EXPECT_NEAR(fastest_in(motion.pose_at(0.3), box), 5 * 2 * kPi / 8, 1e-14);
  const Box turned = placed_bounds(motion.pose_at(2), box);
  EXPECT_EQ(turned.lo, (Vec3{-2, -3, -1}));
  EXPECT_EQ(turned.hi, (Vec3{4, 1, 1}));
  const Box swept = swept_bounds(motion.pose_at(0), motion.pose_at(2), box);
  EXPECT_EQ(swept.lo, (Vec3{-3, -4, -1}));
  EXPECT_EQ(swept.hi, (Vec3{4, 2, 1}));
}

}    // namespace
}    // namespace lsdcd::test_rigid_motion
