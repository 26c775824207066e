// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The format that mesh_format.py adds.
#include "base/input_error.h"
#include "mesh/io/read_mesh.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

namespace lsdcd {
namespace {

TEST(recipe_mesh_format, reads_a_file_of_its_ending)
{
  const TempDir dir;
  const TriangleSoup soup =
      read_mesh(dir.write("wall.TRI", "0 0 0 1 0 0 0 1 0\n0.5 0 0 1 0 -2 0 1 0\n")).soup;
  const std::vector<Vec3> corners = {{0, 0, 0},   {1, 0, 0},  {0, 1, 0},
                                     {0.5, 0, 0}, {1, 0, -2}, {0, 1, 0}};
  EXPECT_EQ(soup.corners, corners);
}

TEST(recipe_mesh_format, is_named_where_an_ending_is_unknown)
{
  const TempDir dir;
  try {
    read_mesh(dir.write("wall.vtk", "0 0 0 1 0 0 0 1 0\n"));
    ADD_FAILURE() << "accepted";
  } catch (const InputError &e) {
    EXPECT_NE(std::string(e.what()).find(".off, .tri"), std::string::npos) << e.what();
  }
}

}    // namespace
}    // namespace lsdcd
