// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The paper's lion against its cylinder, radius 50 and height 100, against CGAL's AABB tree.
#include "bodies/body_collision.h"
#include "study/cylinder.h"
#include "support/cgal_collision.h"
#include "support/real_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace lsdcd {
namespace {

// Turned about z and then x, and moved.
BodyPose pose_of(Real about_z, Real about_x, const Vec3 &to)
{
  const Real c = std::cos(about_z), s = std::sin(about_z), d = std::cos(about_x),
             t = std::sin(about_x);
  BodyPose pose;
  pose.row[0] = {c, -s, 0};
  pose.row[1] = {d * s, d * c, -t};
  pose.row[2] = {t * s, t * c, d};
  pose.shift = to;
  return pose;
}

TEST(bodies_cgal, lion_meets_the_triangles_of_the_cylinder_that_cgal_finds)
{
  TriangleSoup lion = read_real_mesh("lion", LSDCD_UNPACKED);
  centre(lion, 25);
  CylinderMesh coarse, fine;
  fine.segments = 200;
  fine.along = 60;
  for (const CylinderMesh &shape : {coarse, fine}) {
    const WeldedMesh wall = weld(make_cylinder(shape), 0);
    const CgalCollision cgal(wall);
    const auto ours = make_body_collision(Device::cpu);
    ours->set_wall(build_grid(wall, collision_grid(lion, 0.5)));
    ours->set_body(lion);
    std::size_t all = 0;
    for (int k = 0; k < 12; k++) {
      // Through the side, the ends and both, deeply or barely; the last two nowhere.
      const Real turn = 0.7 * k, off = k < 10 ? 38 + 1.7 * k : 10;
      const Vec3 to = {off * std::cos(turn), off * std::sin(turn),
                       k % 3 == 0 && k < 10 ? 98. : 50.};
      const BodyPose pose = pose_of(turn, 0.3 * k, to);
      const Collision found = ours->collide(pose);
      const std::vector<BodyPair> expected = cgal.collide(lion, pose);
      EXPECT_TRUE(found.pairs == expected)
          << "pose " << k << ": " << found.pairs.size() << ", " << expected.size() << " expected";
      EXPECT_EQ(found.uncertain, 0u);
      EXPECT_TRUE(k < 10 || expected.empty());
      all += expected.size();
    }
    std::printf("  %zu triangles in %zu pieces, wall of %zu: %zu pairs\n", lion.n_triangles(),
                ours->n_pieces(), wall.faces.size(), all);
    EXPECT_GT(all, 1000u);
  }
}

}    // namespace
}    // namespace lsdcd

int main(int argc, char **argv)
{
  testing::InitGoogleTest(&argc, argv);
  if (!lsdcd::has_real_meshes()) {
    std::printf("skipped: %s is missing; install libcgal-demo\n", lsdcd::kRealMeshes);
    return 77;
  }
  return RUN_ALL_TESTS();
}
