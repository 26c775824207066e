// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The columns of a wall: how many there are, and that the manual has them.
#include "wall/wall_outputs.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace lsdcd::test_wall_outputs {
namespace {

std::string columns(int first, int n)
{
  return std::to_string(first) + (n > 1 ? "-" + std::to_string(first + n - 1) : "");
}

TEST(wall_outputs, are_in_the_manual)
{
  std::ifstream file(LSDCD_TEST_DIR "/../doc/wall_output.rst");
  std::stringstream page;
  page << file.rdbuf();
  std::string table, ones;
  int column = 1;
  for (const WallOutput &row : wall_outputs()) {
    table += "* " + columns(column, row.n) + " = " + row.text +
             (*row.unit ? " (" + std::string(row.unit) + ")" : "") + "\n";
    column += row.n;
  }
  EXPECT_NE(page.str().find("\n\n" + table + "\n"), std::string::npos)
      << "the list of the page is to be:\n"
      << table;
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
}

}    // namespace
}    // namespace lsdcd::test_wall_outputs
