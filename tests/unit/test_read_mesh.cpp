// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The format that a file is read as.
#include "base/input_error.h"
#include "mesh/io/read_mesh.h"
#include "output/mesh_file.h"
#include "support/random.h"
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
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                           "float y\nproperty float z\nelement ",
                    list = "\nproperty list int int vertex_indices\n",
                    points = "end_header\n0 0 0\n1 0 0\n0 1 0\n";
  const ReadMesh faces =
      read_mesh(dir.write("faces.ply", head + "face 3" + list +
                                           "element edge 2\nproperty int vertex1\nproperty int "
                                           "vertex2\n" +
                                           points + "1 0\n3 0 1 2\n2 0 1\n0 1\n1 2\n"));
  EXPECT_EQ(faces.soup.corners, kTriangle);
  EXPECT_EQ(faces.left_out, 4u);
  // Strips of three, two and one corners.
  const ReadMesh strips = read_mesh(
      dir.write("strips.ply", head + "tristrips 1" + list + points + "8 0 1 2 -1 1 0 -1 2\n"));
  EXPECT_EQ(strips.soup.corners, kTriangle);
  EXPECT_EQ(strips.left_out, 2u);
}

TEST(read_mesh, a_ply_that_we_write_is_read_back_to_the_bit)
{
  const TempDir dir;
  Random random(50);
  for (const bool floats : {true, false}) {
    TriangleSoup soup;
    for (int i = 0; i < 3000; ++i) {
      Vec3 x = uniform(random, {-1, -1, -1}, {1, 1, 1});
      if (floats) x = {float(x.x), float(x.y), float(x.z)};
      soup.corners.push_back(x);
    }
    write_mesh_file(dir.path("a.ply"), soup);
    EXPECT_EQ(read_mesh(dir.path("a.ply")).soup.corners, soup.corners);
  }
}

}    // namespace
}    // namespace lsdcd::test_read_mesh
