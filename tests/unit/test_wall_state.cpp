// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The state of a wall in a restart file: blocks that come back.
#include "wall/saved/wall_state.h"

#include <gtest/gtest.h>

#include <vector>

namespace lsdcd::test_wall_state {
namespace {

WallState from(const State &state)
{
  const std::vector<Real> numbers = state.numbers();
  return WallState::from({WallState::kKind, numbers.data(), numbers.size()});
}

WallState some_wall()
{
  WallState wall;
  wall.history_kind = 12345;
  wall.time = 0.25L + 0x1p-60L;
  wall.meshes.resize(2);
  wall.meshes[0].mesh = {10, 20, 30, 0x1p52};
  wall.meshes[1].loads = {0.5, std::vector<Real>(16, 0.125)};
  MotionState &motion = wall.meshes[1].motion;
  motion.clock = {1 + 0x1p-60L, -3, 7, 0.1};
  motion.last.shift = {1, 2, 3};
  motion.servo.present = motion.servo.holds = true;
  motion.servo.position = 0.7;
  MotionTerm term;
  term.kind = MotionKind::transrot;
  term.axis = {0, 1, 0};
  term.period = 3;
  motion.terms = {term};
  motion.stopped = true;
  return wall;
}

TEST(WallState, comes_back_from_its_blocks)
{
  const WallState was = some_wall(), is = from(was.blocks());
  EXPECT_EQ(is.history_kind, was.history_kind);
  EXPECT_EQ(is.time, was.time);
  ASSERT_EQ(is.meshes.size(), 2U);
  EXPECT_TRUE(is.meshes[0].mesh == was.meshes[0].mesh);
  EXPECT_TRUE(is.meshes[0].loads.rows.empty());
  EXPECT_EQ(is.meshes[1].loads.time, 0.5);
  EXPECT_EQ(is.meshes[1].loads.rows, was.meshes[1].loads.rows);
  const MotionState &motion = is.meshes[1].motion;
  EXPECT_EQ(motion.clock.base, 1 + 0x1p-60L);
  EXPECT_EQ(motion.clock.base_step, -3);
  EXPECT_EQ(motion.last.shift, (Vec3{1, 2, 3}));
  EXPECT_TRUE(motion.servo.holds);
  EXPECT_EQ(motion.servo.position, 0.7);
  EXPECT_TRUE(motion.stopped);
  ASSERT_EQ(motion.terms.size(), 1U);
  EXPECT_EQ(motion.terms[0].kind, MotionKind::transrot);
  EXPECT_EQ(motion.terms[0].period, 3);
  EXPECT_TRUE(is.unread.empty());
}

TEST(WallState, refuses_nodes_that_are_not_those_of_the_vertices)
{
  WallState wall = some_wall();    // its first mesh has 30 vertices
  NodeState &nodes = wall.meshes[0].nodes;
  nodes = {};
  nodes.names.assign(30, 5);
  nodes.places.assign(90, 0.25);
  const WallState is = from(wall.blocks());
  EXPECT_EQ(is.meshes[0].nodes.names, nodes.names);
  EXPECT_EQ(is.meshes[0].nodes.places, nodes.places);
  nodes.names.resize(29);
  EXPECT_THROW(from(wall.blocks()), StateError);
  nodes = {};
  nodes.places.assign(89, 0.25);
  EXPECT_THROW(from(wall.blocks()), StateError);
}

WallState wall_with_table()
{
  WallState wall = some_wall();
  MotionTerm term;
  term.kind = MotionKind::table;
  term.table_file = "arm.txt";
  TableRows rows;
  rows.options.repeats = true;
  rows.columns = 4;
  rows.numbers = {0, 0, 0, 0, 0.3, 1, 2, 3, 1, 0, 0, 0};
  term.table_options = rows.options;
  term.table = std::make_shared<const MotionTable>(rows, [](std::size_t) { return std::string(); });
  wall.meshes[1].motion.terms.push_back(term);
  return wall;
}

TEST(WallState, has_the_tables_of_motions)
{
  const WallState was = wall_with_table(), is = from(was.blocks());
  ASSERT_EQ(is.meshes[1].motion.terms.size(), 2U);
  const MotionTerm &term = is.meshes[1].motion.terms[1];
  EXPECT_EQ(term.table_file, "arm.txt");
  EXPECT_TRUE(term.table_options.repeats);
  ASSERT_TRUE(term.table);
  EXPECT_TRUE(term.table->rows() == was.meshes[1].motion.terms[1].table->rows());
}

TEST(WallState, refuses_a_motion_whose_table_is_missing)
{
  WallState wall = wall_with_table();
  wall.meshes[1].motion.terms[1].table = nullptr;
  EXPECT_THROW(from(wall.blocks()), StateError);
}

TEST(WallState, names_blocks_of_a_later_version_and_reads_the_rest)
{
  State state = some_wall().blocks();
  state.add("bodies", 1, Real(3));
  EXPECT_EQ(from(state).unread, "'bodies'");
}

TEST(WallState, refuses_a_motion_whose_input_is_not_there)
{
  WallState wall = some_wall();
  MotionState &motion = wall.meshes[1].motion;
  motion.inputs = {"height"};
  motion.terms[0].input[2] = 0;
  EXPECT_EQ(from(wall.blocks()).meshes[1].motion.terms[0].input[2], 0);
  for (const int input : {1, -2}) {
    motion.terms[0].input[2] = input;
    EXPECT_THROW(from(wall.blocks()), StateError) << input;
  }
}

TEST(WallState, refuses_loads_that_are_no_rows)
{
  WallState wall = some_wall();
  wall.meshes[1].loads.rows.pop_back();
  EXPECT_THROW(from(wall.blocks()), StateError);
}

}    // namespace
}    // namespace lsdcd::test_wall_state
