// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The versions of LAMMPS that have a fix wall/gran that differs, law by law: doc/other-walls.md has the measurements.
#include "input/wall_command.h"
#include "lammps/own_wall_gran.h"

#include <gtest/gtest.h>

#include <sstream>

namespace lsdcd {
namespace {

// The difference for the words of a law.
std::string difference(int version, const std::string &law)
{
  std::istringstream in(law + " mesh floor.stl");
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  const WallSpec settings = parse_wall(words).wall;
  return wall_gran_difference(version, settings.laws.front().name, settings.law());
}

bool says(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

const char *const kHookeHistory = "hooke/history 1e4 NULL 5 NULL 0.5 1";

TEST(own_wall_gran, styles_of_29Sep2021_differ_nowhere)
{
  for (const char *style : {"hooke", "hooke/history", "hertz/history"})
    EXPECT_EQ(difference(20210929, std::string(style) + " 1e4 NULL 0 NULL 0.5 1"), "") << style;
}

TEST(own_wall_gran, hooke_history_differs_from_28Mar2023_until_it_was_mended)
{
  for (int version : {20230328, 20230802, 20240207, 20240829, 20250204, 20260211})
    EXPECT_EQ(difference(version, kHookeHistory),
              "its hooke/history multiplies kt by the contact radius");
  for (int version : {20230208, 20260704}) EXPECT_EQ(difference(version, kHookeHistory), "");
}

TEST(own_wall_gran, hooke_was_mended_before)
{
  EXPECT_TRUE(says(difference(20240207, "hooke 1e4 NULL 5 NULL 0.5 1"), "gamma_t over gamma_n"));
  EXPECT_EQ(difference(20240829, "hooke 1e4 NULL 5 NULL 0.5 1"), "");
}

TEST(own_wall_gran, several_differences_of_a_law_are_all_named)
{
  const std::string text = difference(20240829, "hertz/history 1e6 NULL 0 0 0.5 1");
  EXPECT_TRUE(says(text, "slips")) << text;
  EXPECT_TRUE(says(text, "not a number")) << text;
}

TEST(own_wall_gran, the_modulus_of_material_constants_differs_before_28Mar2023)
{
  const char *const law = "granular hertz/material 1e7 20 0.25 tangential mindlin NULL 1 0.3";
  EXPECT_TRUE(says(difference(20210929, law), "E/(2(1 - nu))"));
  EXPECT_EQ(difference(20260704, law), "");
}

TEST(own_wall_gran, tsuji_and_twisting_marshall_differ_in_the_newest_too)
{
  EXPECT_TRUE(
      says(difference(20260704,
                      "granular hertz 1e6 0.5 tangential linear_nohistory 1 0.3 damping tsuji"),
           "sqrt(2)"));
  EXPECT_TRUE(says(
      difference(20260704, "granular hertz 1e6 5 tangential mindlin 1e6 1 0.3 twisting marshall"),
      "twisting marshall"));
}

}    // namespace
}    // namespace lsdcd
