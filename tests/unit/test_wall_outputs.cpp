// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The columns of a wall: how many there are, and that the manual has them.
#include "support/says.h"
#include "support/temp_dir.h"
#include "wall/wall_outputs.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <string>

namespace lsdcd::test_wall_outputs {
namespace {

std::string columns(int first, int n)
{
  return std::to_string(first) + (n > 1 ? "-" + std::to_string(first + n - 1) : "");
}

std::string keyword_of(OutputPart part)
{
  switch (part) {
    case OutputPart::servo:
      return " *servo*";
    case OutputPart::body:
      return " *body*";
    case OutputPart::wear:
      return " *wear ... deform*";
    case OutputPart::nodes:
      return " *nodes*";
    case OutputPart::means:
      return " *average*";
    case OutputPart::motion:
      return " *motion*";
    case OutputPart::energy:
      return " *energy*";
    case OutputPart::impacts:
      return " *impacts*";
    case OutputPart::wear_energy:
      return " *energy* with *wear ... deform*";
    default:
      return "";
  }
}

TEST(wall_outputs, are_in_the_manual)
{
  const std::string page = content(LSDCD_TEST_DIR "/../doc/wall_output.rst");
  std::string table, ones;
  int column = 1;
  for (const WallOutput &row : wall_outputs()) {
    table += "   " + columns(column, row.n) + ", \"" + row.text + "\", \"" + row.unit + "\"," +
             keyword_of(row.part) + "\n";
    column += row.n;
  }
  EXPECT_TRUE(has(page, "\n\n" + table + "\n")) << "the rows of the page are to be:\n" << table;
}

// How many numbers each double of a struct in the library's header has, by its name.
std::map<std::string, int> members_of(const std::string &name)
{
  const std::string header = content(LSDCD_TEST_DIR "/../src/api/lsdcd.h"),
                    begins = "typedef struct " + name + " {";
  const std::size_t at = header.find(begins), end = header.find("\n} " + name + ";");
  std::map<std::string, int> members;
  if (at == std::string::npos || end == std::string::npos) return members;
  const std::regex comment("/\\*[^]*?\\*/"), line("double ([^;]*);"),
      one("(\\w+)(?:\\[(\\d+)\\])?");
  const std::string text = std::regex_replace(header.substr(at, end - at), comment, "");
  for (std::sregex_iterator l(text.begin(), text.end(), line), none; l != none; ++l) {
    const std::string names = (*l)[1];
    for (std::sregex_iterator m(names.begin(), names.end(), one); m != none; ++m)
      members[(*m)[1]] = (*m)[2].matched ? std::stoi((*m)[2]) : 1;
  }
  return members;
}

// Python reads its structs from the header. The elastic energy has no column, and poses have a function.
TEST(wall_outputs, are_in_the_structs_of_the_library)
{
  std::map<std::string, int> totals, body;
  for (const WallOutput &row : wall_outputs())
    if (row.part != OutputPart::motion)
      (row.part == OutputPart::body ? body : totals)[row.name] += row.n;
  totals["energy"] = 1;
  EXPECT_EQ(members_of("lsdcd_wall_totals"), totals);
  EXPECT_EQ(members_of("lsdcd_body_state"), body);
}

TEST(wall_outputs, go_up_to_the_last_that_a_wall_has)
{
  WallSpec wall;
  wall.meshes.resize(2);
  EXPECT_EQ(n_outputs(wall), 11);
  wall.meshes[1].motion.servo().present = true;
  EXPECT_EQ(n_outputs(wall), 14);
  wall.wear_deform.every = 5;
  EXPECT_EQ(n_outputs(wall), 37);
  wall.meshes[1].has_nodes = true;
  EXPECT_EQ(n_outputs(wall), 40);
  wall.meshes[1].body.present = true;
  EXPECT_EQ(n_outputs(wall), 41);
  wall.average_every = 10;
  EXPECT_EQ(n_outputs(wall), 47);
  wall.meshes[0].motion.add(MotionTerm());
  EXPECT_EQ(n_outputs(wall), 54);
}

}    // namespace
}    // namespace lsdcd::test_wall_outputs
