// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The motion that motion.py adds: from the words of a script to the pose.
#include "base/input_error.h"
#include "input/wall_command.h"

#include <gtest/gtest.h>

namespace lsdcd {
namespace {

RigidMotion of_words(const std::vector<std::string> &motion)
{
  std::vector<std::string> words = {"hooke", "1e4", "0",    "0",     "0",
                                    "0",     "0",   "mesh", "a.stl", "motion"};
  words.insert(words.end(), motion.begin(), motion.end());
  return parse_wall(words).wall.meshes[0].motion;
}

// x = A (t/T - sin(2 pi t/T)/(2 pi)), so that at a quarter x = A (1/4 - 1/(2 pi)). Lengths are of
// size 3: some roundings of 2.2e-16 of that.
TEST(recipe_motion, follows_its_closed_form)
{
  const RigidMotion motion = of_words({"cycloid", "0", "0", "3", "0.5"});
  constexpr Real kInTwoPi = 0.15915494309189533577;
  const struct {
    Time t;
    Real z, speed;
  } rows[] = {{0, 0, 0},        {0.125L, 3 * (0.25 - kInTwoPi), 6},
              {0.25L, 1.5, 12}, {0.375L, 3 * (0.75 + kInTwoPi), 6},
              {0.5L, 3, 0},     {2.25L, 13.5, 12}};
  for (const auto &row : rows) {
    const Pose pose = motion.pose_at(row.t);
    EXPECT_NEAR(pose.shift.z, row.z, 4e-15) << double(row.t);
    EXPECT_NEAR(pose.velocity.z, row.speed, 8e-15) << double(row.t);
    EXPECT_EQ(pose.shift.x, 0);
  }
}

TEST(recipe_motion, is_among_the_words_where_one_is_unknown)
{
  try {
    of_words({"cycle", "0", "0", "3", "0.5"});
    ADD_FAILURE() << "accepted";
  } catch (const InputError &e) {
    EXPECT_NE(std::string(e.what()).find("cycloid"), std::string::npos) << e.what();
  }
}

}    // namespace
}    // namespace lsdcd
