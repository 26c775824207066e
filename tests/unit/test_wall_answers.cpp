// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How wrong the answers of a setting are, and the spheres that they are of.
#include "study/wall_answers.h"

#include "contact/find_contacts.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

namespace lsdcd::test_wall_answers {
namespace {

// A vessel in small: a wall of the finest facets, a funnel below and a flat lid of slivers.
TriangleSoup vessel()
{
  TriangleSoup soup = cylinder_mesh(60, 25, 1, 2.5);
  append(soup, cone_mesh(40, 1, 0.7));
  return soup;
}

// One sphere of radius 1 with contacts on the given closest points, and a force along x.
WallAnswers answers_of(const std::vector<WallAnswers::Contact> &contacts, Real force)
{
  WallAnswers a;
  a.contacts = contacts;
  a.first = {0, contacts.size()};
  a.force = {{force, 0, 0}};
  return a;
}

struct Compare : testing::Test {
  Compare() { sample.add({0, 0, 0}, 1); }
  AnswerError error(const WallAnswers &reference, const WallAnswers &trial) const
  {
    return compare(reference, trial, sample, 100);
  }
  SphereSample sample;
  const WallAnswers::Contact below = {{0, 0, -0.9}, 0.1, true}, beside = {{0.9, 0, 0}, 0.1, true};
};

TEST_F(Compare, a_contact_without_a_foot_beside_its_own_is_missed)
{
  const WallAnswers both = answers_of({below, beside}, 10);
  EXPECT_EQ(error(both, both).missed, 0);
  EXPECT_EQ(error(both, answers_of({beside}, 10)).missed, 1);
  WallAnswers::Contact off = below;
  off.closest.x = 0.9e-3;
  EXPECT_EQ(error(both, answers_of({off, beside}, 10)).missed, 0);
  off.closest.x = 1.1e-3;
  EXPECT_EQ(error(both, answers_of({off, beside}, 10)).missed, 1);
  EXPECT_EQ(error(both, both).contacts, 2);
  EXPECT_DOUBLE_EQ(error(both, answers_of({beside}, 10)).missed_share(), 0.5);
}

TEST_F(Compare, a_contact_that_bears_nothing_cannot_be_missed)
{
  WallAnswers::Contact idle = below;
  idle.bears = false;
  const AnswerError e = error(answers_of({idle, beside}, 10), answers_of({beside}, 10));
  EXPECT_EQ(e.contacts, 1);
  EXPECT_EQ(e.missed, 0);
}

TEST_F(Compare, forces_are_compared_to_their_own_size_or_a_usual_one)
{
  EXPECT_DOUBLE_EQ(error(answers_of({below}, 10), answers_of({below}, 10.5)).largest, 0.05);
  // An overlap of 1 % of the radius takes a force of 1 here.
  EXPECT_DOUBLE_EQ(error(answers_of({below}, 0.25), answers_of({below}, 0.5)).largest, 0.25);
  EXPECT_DOUBLE_EQ(error(answers_of({below}, 10), answers_of({}, 0)).largest, 1);
  EXPECT_DOUBLE_EQ(error(answers_of({}, 0), answers_of({below}, 3)).largest, 3);    // a false one
}

TEST(band_spheres, are_all_within_reach_and_none_is_deep)
{
  const WeldedMesh mesh = weld(vessel(), -1);
  StepGridSettings g;
  g.cutoff = 0.1;
  const StepGrid grid = build_grid(mesh, g);
  SphereSample sample;
  Random random(5);
  add_band_spheres(grid, 5000, {0.1, 0.06}, random, sample);
  ASSERT_EQ(sample.n(), 5000);
  long touching = 0;
  for (int i = 0; i < sample.n(); i++) {
    CellAddress at;
    Cell cell;
    EXPECT_TRUE(find_cell(grid.view(), sample.x[i], at, cell));
    ContactSet<64> set;
    find_contacts(grid.view(), sample.x[i], sample.radius[i], set);
    for (int k = 0; k < set.n; k++) EXPECT_GE(set.distance[k], 0.5 * sample.radius[i]);
    touching += set.n > 0;
  }
  EXPECT_GT(touching, 500);
}

}    // namespace
}    // namespace lsdcd::test_wall_answers
