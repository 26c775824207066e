// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The state of a wall as versions before 0.10.0 wrote it, where a motion is known by its words.
#include "input/old_wall_state.h"
#include "wall/wall_state.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lsdcd::test_old_wall_state {
namespace {

// Format, kind of the history, time, meshes; of the mesh: how many numbers its motion has, its clock, three poses, a
// servo that holds, values of `terms` terms, a number for each letter; time, facets, edges, vertices, rows of loads, the
// fingerprint, one row.
std::vector<Real> old_numbers(const std::string &words, int terms)
{
  std::vector<Real> motion = {2, 0x1p-60, 5, 8, 0.1};
  for (int pose = 0; pose < 3; pose++)
    motion.insert(motion.end(), {1, 0, 0, 0, 1, 0, 0, 0, 1, Real(pose), 0, 0});
  motion.insert(motion.end(), {2, 1, 0, 0, 1, 4, 5, 6, 0.5, 0.25});
  motion.push_back(terms);
  for (int k = 0; k < terms; k++) motion.insert(motion.end(), {Real(k), 0, 0, 7, 0, 0});
  for (const char c : words) motion.push_back(c);
  std::vector<Real> all = {-6, 77, 1.5, 1, static_cast<Real>(motion.size())};
  all.insert(all.end(), motion.begin(), motion.end());
  all.insert(all.end(), {9, 10, 20, 30, 1, 40});
  for (int k = 0; k < 8; k++) all.push_back(k);
  return all;
}

WallState read(const std::vector<Real> &numbers)
{
  return read_wall_state(numbers.data(), numbers.size());
}

TEST(OldWallState, is_read)
{
  const WallState wall = read(old_numbers("wiggle z 0.1 2, linear 1 0 0", 2));
  EXPECT_EQ(wall.history_kind, 77);
  EXPECT_EQ(wall.time, 1.5L);
  ASSERT_EQ(wall.meshes.size(), 1U);
  EXPECT_TRUE((wall.meshes[0].mesh == MeshIdentity{10, 20, 30, 40}));
  EXPECT_EQ(wall.meshes[0].loads.time, 9);
  EXPECT_EQ(wall.meshes[0].loads.rows.size(), 8U);
  const MotionState &motion = wall.meshes[0].motion;
  EXPECT_EQ(motion.clock.base, 2 + 0x1p-60L);
  EXPECT_EQ(motion.last.shift, (Vec3{2, 0, 0}));
  EXPECT_TRUE(motion.servo.present && motion.servo.holds && motion.servo.turns);
  EXPECT_EQ(motion.servo.point, (Vec3{4, 5, 6}));
  EXPECT_EQ(motion.servo.velocity, 0.25);
  ASSERT_EQ(motion.terms.size(), 2U);
  EXPECT_EQ(motion.terms[0].kind, MotionKind::cosine);
  EXPECT_EQ(motion.terms[0].amplitude, (Vec3{0, 0, 0.1}));
  EXPECT_EQ(motion.terms[1].kind, MotionKind::linear);
  EXPECT_EQ(motion.terms[1].displacement, (Vec3{1, 0, 0}));
  EXPECT_EQ(motion.terms[1].speed, (Vec3{7, 0, 0}));
  EXPECT_FALSE(motion.stopped);
}

TEST(OldWallState, knows_that_a_motion_was_stopped)
{
  const MotionState motion = read(old_numbers("rotate 0 0 0 0 0 1 5", 0)).meshes[0].motion;
  EXPECT_TRUE(motion.stopped);
  ASSERT_EQ(motion.terms.size(), 1U);
  EXPECT_EQ(motion.terms[0].period, 5);
}

TEST(OldWallState, that_is_cut_anywhere_is_refused)
{
  std::vector<Real> numbers = old_numbers("wiggle 0 0 1 2", 1);
  while (!numbers.empty()) {
    numbers.pop_back();
    EXPECT_THROW(read(numbers), StateError) << numbers.size();
  }
}

}    // namespace
}    // namespace lsdcd::test_old_wall_state
