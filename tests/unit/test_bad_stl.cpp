// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Every damaged file of tests/bad_stl is refused with words that help to repair it.
#include "base/input_error.h"
#include "mesh/triangle_soup.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace lsdcd::test_bad_stl {
namespace {

const std::string kFolder = LSDCD_TEST_DIR "/bad_stl";

struct BadFile {
  const char *name, *place, *value, *remedy;
};

const BadFile kBadFiles[] = {
    {"ascii_truncated", "line 12 (facet 2)", "the file ends", "truncated: copy or export it again"},
    {"ascii_not_a_number", "line 12 (facet 2)", "coordinate y of vertex 2 is 'zero', not a number",
     "correct the line or export"},
    {"ascii_decimal_comma", "line 5 (facet 1)", "'1,5'", "write a decimal point"},
    {"ascii_not_finite", "line 13 (facet 2)", "'1e999', not a finite number",
     "correct the line or export"},
    {"ascii_missing_coordinate", "line 4 (facet 1)", "coordinate z of vertex 1 is missing",
     "complete the line"},
    {"ascii_two_vertices", "line 13 (facet 2)", "has 2 vertices", "complete it"},
    {"ascii_four_vertices", "line 7 (facet 1)", "more than 3 vertices", "triangulate the mesh"},
    {"ascii_no_facets", "facet 1", "no facets", "export the mesh again"},
    {"not_an_stl", "line 1", "'OFF'", "export the mesh as STL"},
    {"binary_truncated", "facet 2", "3 facets promised", "truncated or not an STL: copy or export"},
    {"binary_count_too_small", "facet 2", "50 bytes follow", "correct the count"},
    {"binary_not_finite", "facet 2", "coordinate y of vertex 3 is nan", "repair or export"},
};

class bad_stl : public testing::TestWithParam<BadFile> {};

TEST_P(bad_stl, is_refused_with_file_place_value_and_remedy)
{
  const BadFile &bad = GetParam();
  const std::string path = kFolder + "/" + bad.name + ".stl";
  try {
    read_stl(path);
    FAIL() << path << " was accepted";
  } catch (const InputError &error) {
    const std::string message = error.what();
    for (const std::string &part :
         {path, std::string(bad.place), std::string(bad.value), std::string(bad.remedy)})
      EXPECT_NE(message.find(part), std::string::npos) << part << "\nnot in: " << message;
  }
}

INSTANTIATE_TEST_SUITE_P(table, bad_stl, testing::ValuesIn(kBadFiles),
                         [](const auto &row) { return std::string(row.param.name); });

TEST(bad_stl_folder, has_a_row_for_every_file)
{
  std::size_t n_files = 0;
  for (const auto &entry : std::filesystem::directory_iterator(kFolder))
    n_files += entry.path().extension() == ".stl";
  EXPECT_EQ(n_files, std::size(kBadFiles));
}

}    // namespace
}    // namespace lsdcd::test_bad_stl
