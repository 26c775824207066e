// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The columns of a wall: how many there are, and that the manual has them.
#include "support/says.h"
#include "support/temp_dir.h"
#include "wall/wall_outputs.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>

namespace lsdcd::test_wall_outputs {
namespace {

std::string columns(int first, int n)
{
  return std::to_string(first) + (n > 1 ? "-" + std::to_string(first + n - 1) : "");
}

std::string in_quotes(const std::string &text)
{
  return text.find(',') == std::string::npos ? text : "\"" + text + "\"";
}

// The names of a row as the manual has them: apart by commas.
std::string names_of(const OutputRow &row)
{
  std::string names;
  for (int d = 0; d < row.n; d++) names += (d ? ", " : "") + output_name(row, d);
  return in_quotes(names);
}

TEST(wall_outputs, are_in_the_manual)
{
  const std::string page = content(LSDCD_TEST_DIR "/../doc/wall_output.rst");
  std::string table;
  int column = 1;
  for (const WallOutput &output : wall_outputs()) {
    const std::string keyword = keyword_of(output.part);
    const OutputRow &row = output.row;
    table += "   " + (output.part == OutputPart::scalar ? "scalar" : columns(column, row.n)) +
             ", " + names_of(row) + ", \"" + row.text + "\", \"" + row.unit + "\"," +
             (keyword.empty() ? "" : " " + keyword) + "\n";
    column += row.n;
  }
  EXPECT_TRUE(has(page, "\n\n" + table + "\n")) << "the rows of the page are to be:\n" << table;
}

// The tables of other styles: the page, and whether the last row is the scalar.
struct Table {
  const char *page;
  std::vector<OutputRow> rows;
  bool with_scalar;
};

const Table kTables[] = {{"fix_massflow_lsdcd", massflow_outputs(), false},
                         {"fix_insert_lsdcd", insertion_outputs(), false},
                         {"compute_lsdcd_energy", energy_outputs(), true},
                         {"compute_lsdcd_impacts", impact_outputs(), false},
                         {"compute_lsdcd_impacts", impact_outputs_by_types(), false},
                         {"compute_lsdcd_collide", collide_outputs(), true},
                         {"compute_lsdcd_collide", collide_outputs_by_body(), false},
                         {"wall_output", contact_outputs(true), false},
                         {"wall_output", each_contact_outputs(true), false}};

TEST(outputs_of_styles, are_in_the_manual)
{
  for (const Table &of : kTables) {
    std::string table;
    int column = 1;
    for (const OutputRow &row : of.rows) {
      const bool is_scalar = of.with_scalar && &row == &of.rows.back();
      table += "   " + (is_scalar ? "scalar" : columns(column, row.n)) + ", " + names_of(row) +
               ", " + in_quotes(row.text) + "," + (*row.unit ? " " : "") + row.unit + "\n";
      column += row.n;
    }
    EXPECT_TRUE(has(content(std::string(LSDCD_TEST_DIR "/../doc/") + of.page + ".rst"),
                    "\n\n" + table + "\n"))
        << of.page << ": the rows are to be:\n"
        << table;
  }
}

TEST(wall_outputs, have_a_name_each)
{
  WallSpec wall;
  std::set<std::string> names, of_wall;
  for (const NamedElement &one : named_outputs(wall)) of_wall.insert(one.name);
  int column = 0;
  for (const WallOutput &output : wall_outputs())
    for (int d = 0; d < output.row.n; d++, column++) {
      const std::string name = output_name(output.row, d);
      EXPECT_TRUE(names.insert(name).second) << name;
      int place = -1;
      const WallOutput *const found = find_output(wall, name, place);
      if (of_wall.count(name))
        EXPECT_TRUE(found == &output && place == d) << name;
      else
        EXPECT_EQ(found, nullptr) << name;
    }
  EXPECT_EQ(output_name(wall_outputs().front().row, 2), "force_z");
  EXPECT_TRUE(names.count("dissipated_power_slider") && names.count("body_velocity_x") &&
              names.count("elastic_energy"));
}

TEST(outputs_of_styles, have_a_name_each)
{
  for (const Table &of : kTables) {
    std::set<std::string> names;
    for (const NamedElement &one : named_elements(of.rows, of.with_scalar))
      EXPECT_TRUE(names.insert(one.name).second) << of.page << " " << one.name;
  }
}

// Those of a wall with one mesh that does not move, and what others need.
TEST(wall_outputs, of_a_wall_are_those_of_its_keywords)
{
  WallSpec wall;
  wall.meshes.resize(1);
  const std::vector<NamedElement> few = named_outputs(wall);
  ASSERT_EQ(few.size(), 12U);
  EXPECT_EQ(few[10].name, "power");
  EXPECT_EQ(few[10].column, 10);
  EXPECT_EQ(few[11].name, "elastic_energy");
  EXPECT_EQ(few[11].column, NamedElement::kScalar);
  wall.energy = true;
  EXPECT_EQ(named_outputs(wall)[11].name, "dissipated_power_damping");
  EXPECT_EQ(named_outputs(wall)[11].column, 54);
  EXPECT_EQ(why_no_output(wall, "impacts"),
            "there is no number 'impacts': the wall needs 'impacts' for it");
  EXPECT_EQ(why_no_output(wall, "forse_z"),
            "there is no number 'forse_z': the nearest is 'force_z'");
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

// Python reads its structs from the header. Poses have a function.
TEST(wall_outputs, are_in_the_structs_of_the_library)
{
  std::map<std::string, int> totals, body;
  for (const WallOutput &output : wall_outputs()) {
    const std::string name = output.row.name;
    if (output.part == OutputPart::body)
      body[name.substr(std::string("body_").size())] = output.row.n;
    else if (output.part != OutputPart::motion)
      totals[name] = output.row.n;
  }
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
