// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// When near spheres are chosen: whatever moves, none comes to the wall unseen.
#include "engine/candidate_schedule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lsdcd::test_candidate_schedule {
namespace {

constexpr Real kDistance = 0.25;

SphereDrift drift(SphereDrift::Kind kind, bool has_begun = false)
{
  SphereDrift d;
  d.kind = kind;
  d.distance = kDistance;
  d.has_begun = has_begun;
  return d;
}

MovingMesh moved_by(const Vec3 &shift)
{
  MovingMesh mesh;
  mesh.bounds = {{-1, -1, -1}, {1, 1, 1}};
  mesh.pose.placed = true;
  mesh.pose.shift = shift;
  return mesh;
}

// About z.
MovingMesh turned_by(Real angle)
{
  MovingMesh mesh = moved_by({0, 0, 0});
  mesh.pose.row[0] = {std::cos(angle), -std::sin(angle), 0};
  mesh.pose.row[1] = {std::sin(angle), std::cos(angle), 0};
  return mesh;
}

// The next step after a choice with these meshes.
CandidateSchedule after_choice(const std::vector<MovingMesh> &moving = {}, bool has_begun = false)
{
  CandidateSchedule schedule;
  schedule.note_update(drift(SphereDrift::watched, has_begun), moving);
  return schedule;
}

bool never_asked()
{
  ADD_FAILURE() << "the engine need not look at spheres";
  return false;
}

TEST(CandidateSchedule, first_step_is_due)
{
  EXPECT_TRUE(CandidateSchedule().next(drift(SphereDrift::bounded), {}, never_asked).is_due);
}

TEST(CandidateSchedule, choice_holds_until_it_expires)
{
  CandidateSchedule schedule = after_choice();
  EXPECT_FALSE(schedule.next(drift(SphereDrift::bounded), {}, never_asked).is_due);
  schedule.expire();
  EXPECT_TRUE(schedule.next(drift(SphereDrift::bounded), {}, never_asked).is_due);
}

TEST(CandidateSchedule,
     margin_is_how_far_spheres_go_once_more_where_they_have_moved_and_for_a_wall_that_moves)
{
  const std::vector<MovingMesh> moves = {moved_by({0, 0, 0})};
  const auto choice = [](const SphereDrift &of, const std::vector<MovingMesh> &wall) {
    return CandidateSchedule().next(of, wall, never_asked);
  };
  EXPECT_FALSE(choice(drift(SphereDrift::bounded), {}).watch);
  EXPECT_EQ(choice(drift(SphereDrift::bounded), {}).margin, kDistance);
  EXPECT_EQ(choice(drift(SphereDrift::bounded, true), {}).margin, 2 * kDistance);
  EXPECT_EQ(choice(drift(SphereDrift::bounded, true), moves).margin, 3 * kDistance);
  EXPECT_EQ(choice(drift(SphereDrift::watched, true), {}).margin,
            kDistance);    // what they went is seen
}

TEST(CandidateSchedule, is_due_once_the_wall_has_gone_its_margin)
{
  const CandidateSchedule schedule = after_choice({moved_by({5, 0, 0})});
  const SphereDrift bounded = drift(SphereDrift::bounded);
  EXPECT_FALSE(schedule.next(bounded, {moved_by({5, 0, 0.249})}, never_asked).is_due);
  EXPECT_TRUE(schedule.next(bounded, {moved_by({5, 0, 0.251})}, never_asked).is_due);
}

TEST(CandidateSchedule, is_due_once_any_of_several_meshes_has_gone)
{
  const CandidateSchedule schedule = after_choice({moved_by({0, 0, 0}), moved_by({5, 0, 0})});
  const std::vector<MovingMesh> now = {moved_by({0, 0, 0}), moved_by({5.3, 0, 0})};
  EXPECT_TRUE(schedule.next(drift(SphereDrift::bounded), now, never_asked).is_due);
}

// A corner is sqrt(2) from the axis, and goes along a chord of 2 sqrt(2) sin(angle/2).
TEST(CandidateSchedule, counts_how_far_the_corners_of_a_turning_wall_go)
{
  const CandidateSchedule schedule = after_choice({turned_by(0)});
  const SphereDrift bounded = drift(SphereDrift::bounded);
  const Real angle = 2 * std::asin(kDistance / (2 * std::sqrt(2.0)));
  EXPECT_FALSE(schedule.next(bounded, {turned_by(0.99 * angle)}, never_asked).is_due);
  EXPECT_TRUE(schedule.next(bounded, {turned_by(1.01 * angle)}, never_asked).is_due);
}

TEST(CandidateSchedule, is_due_where_another_mesh_begins_to_move)
{
  EXPECT_TRUE(
      after_choice().next(drift(SphereDrift::bounded), {moved_by({0, 0, 0})}, never_asked).is_due);
}

TEST(CandidateSchedule, asks_the_engine_where_spheres_go_any_distance)
{
  const CandidateSchedule schedule = after_choice();
  const SphereDrift watched = drift(SphereDrift::watched);
  EXPECT_FALSE(schedule.next(watched, {}, [] { return false; }).is_due);
  const CandidateUpdate choice = schedule.next(watched, {}, [] { return true; });
  EXPECT_TRUE(choice.is_due);
  EXPECT_TRUE(choice.watch);
  EXPECT_EQ(choice.margin, kDistance);
}

// The host has seen that none has gone the distance since it counted from 0, where the choice was made.
TEST(CandidateSchedule, spares_the_engine_a_look_that_the_host_took)
{
  SphereDrift looked = drift(SphereDrift::watched, true);
  looked.host_has_looked = true;
  EXPECT_FALSE(after_choice().next(looked, {}, never_asked).is_due);
  const auto yes = [] { return true; };
  EXPECT_TRUE(after_choice().next(drift(SphereDrift::watched, true), {}, yes).is_due);
  EXPECT_TRUE(after_choice({}, true).next(looked, {}, yes).is_due);
}

// Relative to a wall that has gone its own part of the margin, spheres may have gone all of it.
TEST(CandidateSchedule, asks_the_engine_where_the_wall_has_gone_its_part_of_the_margin)
{
  const CandidateSchedule schedule = after_choice({moved_by({0, 0, 0})});
  SphereDrift looked = drift(SphereDrift::watched, true);
  looked.host_has_looked = true;
  EXPECT_FALSE(schedule.next(looked, {moved_by({0, 0, 0.249})}, never_asked).is_due);
  EXPECT_TRUE(schedule.next(looked, {moved_by({0, 0, 0.251})}, [] { return true; }).is_due);
  EXPECT_FALSE(schedule.next(looked, {moved_by({0, 0, 0.251})}, [] { return false; }).is_due);
}

TEST(CandidateSchedule, is_due_in_each_step_where_spheres_come_and_go)
{
  const CandidateUpdate choice = after_choice().next(drift(SphereDrift::unknown), {}, never_asked);
  EXPECT_TRUE(choice.is_due);
  EXPECT_FALSE(choice.watch);
  EXPECT_EQ(choice.margin, 0);
}

}    // namespace
}    // namespace lsdcd::test_candidate_schedule
