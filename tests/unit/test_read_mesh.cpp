// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The format that a file is read as.
#include "base/input_error.h"
#include "mesh/io/read_mesh.h"
#include "support/says.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

namespace lsdcd::test_read_mesh {
namespace {

const char *const kStl = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                         "vertex 0 1 0\nendloop\nendfacet\nendsolid s\n";
// The same triangle, and a line, which is no facet.
const char *const kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n";
const std::vector<Vec3> kTriangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

std::string error_of(const std::string &path)
{
  return lsdcd::error_of([&] { read_mesh(path); });
}

TEST(read_mesh, the_case_of_an_ending_does_not_matter)
{
  const TempDir dir;
  EXPECT_EQ(name_ending("a.b/Wall.StL"), ".stl");
  EXPECT_EQ(read_mesh(dir.write("wall.StL", kStl)).soup.corners, kTriangle);
}

TEST(read_mesh, a_name_without_a_known_ending_is_read_as_stl)
{
  const TempDir dir;
  EXPECT_EQ(read_mesh(dir.write("wall", kStl)).soup.corners, kTriangle);
  EXPECT_EQ(read_mesh(dir.write("wall.mesh", kStl)).soup.corners, kTriangle);
}

TEST(read_mesh, an_error_of_an_unknown_ending_names_those_that_are_known)
{
  const TempDir dir;
  const std::string path = dir.write("wall.vtk", kObj), error = error_of(path);
  EXPECT_TRUE(has(error, path));
  EXPECT_TRUE(has(error, ".stl, .obj, .ply, .off"));
}

TEST(read_mesh, points_and_lines_are_left_out_and_counted)
{
  const TempDir dir;
  const ReadMesh obj =
      read_mesh(dir.write("wall.obj", kObj + std::string("l 1 2 3\np 1 2\nf 1 2\n")));
  EXPECT_EQ(obj.soup.corners, kTriangle);
  EXPECT_EQ(obj.left_out, 6u);
  const ReadMesh off =
      read_mesh(dir.write("wall.off", "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n1 2\n3 0 1 2\n"));
  EXPECT_EQ(off.soup.corners, kTriangle);
  EXPECT_EQ(off.left_out, 2u);
}

}    // namespace
}    // namespace lsdcd::test_read_mesh
