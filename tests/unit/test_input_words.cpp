// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/input_words.h"
#include "input/collide_settings.h"
#include "input/insert_settings.h"
#include "input/keywords.h"
#include "input/massflow_settings.h"
#include "input/region_settings.h"
#include "input/wall_command.h"
#include "support/comma_locale.h"

#include <gtest/gtest.h>

#include <iterator>
#include <sstream>

namespace lsdcd::test_input_words {
namespace {

TEST(input_words, are_read_and_written_with_a_point_in_any_locale)
{
  const CommaLocale commas;
  if (!commas.works()) GTEST_SKIP() << "this C library takes no locale of ours";
  Real value = 0, with_comma = 0;
  const bool is_one = is_number("0.5", &value), is_comma = is_number("0,5", &with_comma);
  EXPECT_TRUE(is_one);
  EXPECT_EQ(value, 0.5);
  EXPECT_FALSE(is_comma);
  EXPECT_EQ(number_text(0.25), "0.25");
  EXPECT_EQ(range_text(0.25, 0.5), "from 0.25 to 0.5");
}

TEST(input_words, are_numbers_with_a_plus_before_them)
{
  Real value = 0;
  EXPECT_TRUE(is_number("+1e-3", &value));
  EXPECT_EQ(value, 1e-3);
  for (const char *word : {"", "+", "+-1", "1x", " 1", "nan", "inf", "1e999"})
    EXPECT_FALSE(is_number(word, &value)) << word;
}

// As in meshes, and as LAMMPS reads them.
TEST(input_words, are_0_where_they_are_nearer_to_it_than_any_number)
{
  for (const char *word : {"1e-400", "-0.0001e-330", "1e-99999999999999999999"}) {
    Real value = 7;
    const bool is_one = is_number(word, &value);
    EXPECT_TRUE(is_one) << word;
    EXPECT_EQ(value, 0) << word;
  }
}

// One table says what may be given twice.
TEST(input_words, repeat_as_the_keywords_do)
{
  for (const Keyword &row : keywords()) {
    std::vector<std::string> seen = {row.name};
    EXPECT_EQ(is_twice(row.name, seen), !row.repeats()) << row.name;
  }
}

// Its rows are behind one another, each with its shift; what is before it is placed by it, too.
TEST(input_words, place_meshes_by_a_matrix_in_all_commands)
{
  const std::string place = "move 1 0 0 matrix 1 2 3 10 0 1 4 20 0 0 2 30 scale 2";
  const auto words = [&](const std::string &before, const std::string &behind) {
    std::istringstream in(before + " " + place + " " + behind);
    return std::vector<std::string>{std::istream_iterator<std::string>(in), {}};
  };
  const Placement placements[] = {
      parse_massflow(words("mesh a.stl", "")).surface.placement,
      parse_collide(words("wall mesh a.stl", "")).mesh.placement,
      parse_region(words("a.stl", "")).mesh.placement,
      parse_insert(words("mesh a.stl", "diam one 1 dens 1 number 1")).face.placement,
      parse_wall(words("hooke 1 1 1 1 1 1 mesh a.stl", "")).wall.meshes[0].placement};
  for (const Placement &p : placements)
    EXPECT_EQ(p.apply(Vec3{0, 1, 1}), (Vec3{2 * (1 + 2 + 3 + 10), 2 * (1 + 4 + 20), 2 * 32}));
}

TEST(number_words, one_thing_is_singular)
{
  EXPECT_EQ(counted(1, "edge"), "1 edge");
  EXPECT_EQ(counted(0, "edge"), "0 edges");
  EXPECT_EQ(counted(2, "edge"), "2 edges");
  EXPECT_EQ(counted(1, "pair of facets", "pairs of facets"), "1 pair of facets");
  EXPECT_EQ(counted(-3, "vertex", "vertices"), "-3 vertices");
}

}    // namespace
}    // namespace lsdcd::test_input_words
