// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The mesh as an STL file.
#include "base/atomic_file.h"
#include "base/input_error.h"
#include "motion/motion.h"
#include "output/mesh_stl.h"
#include "support/meshes.h"
#include "support/says.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <string>
#include <sys/stat.h>

namespace lsdcd::test_mesh_stl {
namespace {

TEST(mesh_stl, of_a_mesh_at_rest_has_the_bits_that_were_read)
{
  const TempDir dir;
  const TriangleSoup soup = box_mesh({0.1f, -0.2f, 0.3f}, {1.7f, 2.9f, 3.3f});    // floats
  write_mesh_stl(dir.path("a.stl"), weld(soup, 0));
  EXPECT_EQ(read_stl(dir.path("a.stl")).corners, soup.corners);
}

TEST(mesh_stl, of_a_mesh_that_moves_has_its_places_in_float_and_outward_normals)
{
  const TempDir dir;
  const WeldedMesh mesh = weld(box_mesh({0, 0, 0}, {1, 2, 3}), -1);
  RigidMotion motion;
  MotionTerm turn;
  turn.kind = MotionKind::rotate;
  turn.axis = unit_vector({1, 2, 3});
  turn.point = {0.3, 0.4, 0.5};
  turn.period = 1;
  motion.add(turn);
  const Pose pose = motion.pose_at(0.2L);
  write_mesh_stl(dir.path("a.stl"), mesh, pose);
  const TriangleSoup soup = read_stl(dir.path("a.stl"));
  ASSERT_EQ(soup.n_triangles(), 12u);
  for (std::size_t f = 0; f < 12; f++)
    for (int k = 0; k < 3; k++) {
      const Vec3 p = pose.to_box(mesh.vertices[mesh.faces[f][k]]);
      for (int d = 0; d < 3; d++)
        EXPECT_EQ(static_cast<float>(soup.corners[3 * f + k][d]), static_cast<float>(p[d]));
    }
  const WeldedMesh again = weld(soup, -1);
  EXPECT_TRUE(again.report.closed && again.report.oriented);
  // Floats of places of size 3 are off by 1.2e-7; each of 3 lengths by at most twice that.
  EXPECT_NEAR(again.report.volume, 6, 6 * 3 * 2.4e-7);
}

TEST(whole_file, a_pipe_is_refused_and_stays)
{
  const TempDir dir;
  const std::string pipe = dir.path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(fails_with("pipe' is not a regular file", [&] { write_whole_file(pipe, "text"); }));
  struct stat there;
  ASSERT_EQ(stat(pipe.c_str(), &there), 0);
  EXPECT_TRUE(S_ISFIFO(there.st_mode));
}

}    // namespace
}    // namespace lsdcd::test_mesh_stl
