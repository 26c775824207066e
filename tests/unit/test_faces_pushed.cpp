// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The faces that a moving surface pushes along their normals: none of a belt, a roll or a
// turntable; lifters and screws by their closed forms.
#include "support/meshes.h"
#include "wall/checks/faces_pushed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace lsdcd::test_faces_pushed {
namespace {

SurfaceMotion sliding(const Vec3 &velocity)
{
  SurfaceMotion m;
  m.velocity = velocity;
  return m;
}

SurfaceMotion turning(Real speed)
{
  SurfaceMotion m;
  m.angular = {0, 0, speed};
  return m;
}

PushReport report_of(const TriangleSoup &soup, const SurfaceMotion &motion)
{
  return faces_pushed(weld(soup, -1), motion);
}

// n x m quads of a surface given by two parameters in 0..1, each cut in two along either
// diagonal that does not fold it; inner nodes are shifted by up to `jitter` of a quad. Corners are
// rounded to floats, as STL files hold them.
TriangleSoup sheet(int n, int m, Real jitter, const std::function<Vec3(Real, Real)> &at)
{
  std::mt19937 random(17);
  std::uniform_real_distribution<Real> shift(-jitter, jitter);
  std::vector<Vec3> node, flat;
  for (int i = 0; i <= n; i++)
    for (int j = 0; j <= m; j++) {
      const bool inner = i > 0 && i < n && j > 0 && j < m;
      // One after the other: compilers differ in the order of arguments.
      const Real dt = inner ? shift(random) : 0, ds = inner ? shift(random) : 0;
      flat.push_back({i + ds, j + dt, 0});
      const Vec3 p = at((i + ds) / n, (j + dt) / m);
      node.push_back({float(p.x), float(p.y), float(p.z)});
    }
  TriangleSoup soup;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < m; j++) {
      const int a = i * (m + 1) + j, d = a + 1, b = a + m + 1, c = b + 1;
      const auto folds = [&](int p, int q, int r) {
        return cross(flat[q] - flat[p], flat[r] - flat[p]).z <= 0;
      };
      const bool drawn = random() % 2;
      const bool other =
          drawn ? !(folds(a, b, d) || folds(b, c, d)) : folds(a, b, c) || folds(a, c, d);
      for (const int p : {a, b, other ? d : c, other ? b : a, c, d})
        soup.corners.push_back(node[p]);
    }
  return soup;
}

Vec3 round_z(Real r, Real turns, Real z)
{
  return {r * std::cos(2 * kPi * turns), r * std::sin(2 * kPi * turns), z};
}

TEST(faces_pushed, a_belt_along_its_velocity_has_none)
{
  // 30 degrees up, in words of two digits.
  const TriangleSoup belt = sheet(40, 9, 0.4, [](Real s, Real t) {
    return Vec3{7 + 3 * s * std::cos(kPi / 6), t, 3 * s * std::sin(kPi / 6)};
  });
  EXPECT_EQ(report_of(belt, sliding({0.87, 0, 0.5})).faces, 0u);
}

TEST(faces_pushed, a_belt_askew_is_pushed_by_the_sine_of_the_angle)
{
  const Real angle = 5 * kPi / 180;
  const PushReport push =
      report_of(floor_mesh(4, 1), sliding({2 * std::cos(angle), 0, 2 * std::sin(angle)}));
  EXPECT_EQ(push.faces, 32u);
  EXPECT_NEAR(push.component, 2 * std::sin(angle), 1e-15);
  EXPECT_NEAR(push.share, std::sin(angle), 1e-15);
}

TEST(faces_pushed, a_turntable_has_none)
{
  EXPECT_EQ(report_of(floor_mesh(9, 1, 3), turning(5)).faces, 0u);
}

TEST(faces_pushed, a_roll_has_none_from_six_sides_on)
{
  for (const int n : {6, 7, 12, 36, 200})
    for (const int m : {1, 10})
      EXPECT_EQ(report_of(cylinder_mesh(n, m, 1, 3), turning(5)).faces, 0u);
}

TEST(faces_pushed, surfaces_of_revolution_in_any_triangles_have_none)
{
  const auto roll = [](Real s, Real t) { return round_z(1, s, 2 * t); };
  const auto cone = [](Real s, Real t) { return round_z(1 + t, s, 2 * t); };
  const auto ball = [](Real s, Real t) { return round_z(std::sin(kPi * t), s, std::cos(kPi * t)); };
  for (const int n : {12, 40, 100}) {
    for (const int m : {2, 30}) {
      EXPECT_LT(report_of(sheet(n, m, 0.3, roll), turning(3)).area, kSlivers) << n << " " << m;
      EXPECT_LT(report_of(sheet(n, m, 0.3, cone), turning(3)).area, kSlivers) << n << " " << m;
    }
    EXPECT_LT(report_of(sheet(n, n, 0.1, ball), turning(3)).area, kSlivers) << n;
  }
}

// A flight from 0.3 to 1 with pitch 1, each quad in two triangles: at r it rises by 1 / (2 pi r)
// along its chord, and the triangle with its two corners at r has that slope.
TEST(faces_pushed, every_face_of_a_screw_is_told)
{
  for (const int n : {12, 48}) {
    const PushReport push = report_of(
        sheet(n, 1, 0, [](Real s, Real t) { return round_z(0.3 + 0.7 * t, s, s); }), turning(1));
    EXPECT_EQ(push.faces, 2u * n);
    EXPECT_GT(push.share, std::sin(std::atan(1 / (2 * kPi))));
  }
}

}    // namespace
}    // namespace lsdcd::test_faces_pushed
