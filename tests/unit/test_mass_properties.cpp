// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Mass, centre and inertia of meshes, against closed forms.
#include "base/input_error.h"
#include "rigid/mass_properties.h"
#include "support/meshes.h"
#include "support/says.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace lsdcd::test_mass_properties {
namespace {

constexpr Real kExact =
    1e-12;    // of each number's scale: sums of 12 terms of rounding 1e-16, far from the origin less

TriangleSoup tetrahedron(Real a)
{
  const Vec3 o = {0, 0, 0}, x = {a, 0, 0}, y = {0, a, 0}, z = {0, 0, a};
  TriangleSoup soup;
  soup.source = "tetrahedron";
  soup.corners = {o, y, x, o, x, z, o, z, y, x, y, z};
  return soup;
}

MassProperties of(const TriangleSoup &soup, Real density)
{
  return mass_properties(weld(soup, -1), density);
}

void expect_inertia(const SymmetricMatrix &is, const SymmetricMatrix &want, Real scale)
{
  EXPECT_NEAR(is.xx, want.xx, kExact * scale);
  EXPECT_NEAR(is.yy, want.yy, kExact * scale);
  EXPECT_NEAR(is.zz, want.zz, kExact * scale);
  EXPECT_NEAR(is.xy, want.xy, kExact * scale);
  EXPECT_NEAR(is.xz, want.xz, kExact * scale);
  EXPECT_NEAR(is.yz, want.yz, kExact * scale);
}

std::string error_of(const TriangleSoup &soup)
{
  return lsdcd::error_of([&] { of(soup, 1); });
}

}    // namespace

TEST(mass_properties, of_a_cube)
{
  const MassProperties p = of(box_mesh({1.2, -0.1, 0}, {1.4, 0.1, 0.2}), 5000);
  EXPECT_NEAR(p.mass, 40, 40 * kExact);
  EXPECT_NEAR(norm(p.centre - Vec3{1.3, 0, 0.1}), 0, kExact);
  const Real moment = 40 * 0.2 * 0.2 / 6;    // 0.266667
  expect_inertia(p.inertia, {moment, moment, moment, 0, 0, 0}, moment);
}

TEST(mass_properties, of_a_right_tetrahedron)
{
  const Real a = 0.3, density = 2000, mass = density * a * a * a / 6;
  const MassProperties p = of(tetrahedron(a), density);
  EXPECT_NEAR(p.mass, mass, kExact * mass);
  EXPECT_NEAR(norm(p.centre - Vec3{a / 4, a / 4, a / 4}), 0, kExact * a);
  const Real m = mass * a * a;    // the element xy is - (integral of x y) = + m a^2 / 80
  expect_inertia(p.inertia, {0.075 * m, 0.075 * m, 0.075 * m, m / 80, m / 80, m / 80}, m);
}

TEST(mass_properties, do_not_depend_on_the_winding)
{
  const MassProperties out = of(tetrahedron(1), 3), in = of(inverted(tetrahedron(1)), 3);
  EXPECT_NEAR(in.mass, out.mass, kExact);
  EXPECT_NEAR(norm(in.centre - out.centre), 0, kExact);
  expect_inertia(in.inertia, out.inertia, 1);
}

// A box of 4 by 3 by 2 without one of 2 by 1 by 1 beside its middle: differences of two boxes.
TEST(mass_properties, leave_out_a_hollow)
{
  TriangleSoup soup = box_mesh({0, 0, 0}, {4, 3, 2});
  append(soup, inverted(box_mesh({1.5, 1, 0.5}, {3.5, 2, 1.5})));
  const MassProperties p = of(soup, 1);
  EXPECT_NEAR(p.mass, 22, 22 * kExact);
  const Real x = (24 * 2 - 2 * 2.5) / 22;
  EXPECT_NEAR(norm(p.centre - Vec3{x, 1.5, 1}), 0, kExact);
  const Real about_y = 24. / 12 * (16 + 4) + 24 * (2 - x) * (2 - x) -
                       (2. / 12 * (4 + 1) + 2 * (2.5 - x) * (2.5 - x));
  EXPECT_NEAR(p.inertia.yy, about_y, kExact * about_y);
  EXPECT_NEAR(p.inertia.xx, 24. / 12 * (9 + 4) - 2. / 12 * 2, kExact * 24);
}

TEST(mass_properties, of_an_open_mesh_are_refused_with_its_open_edges)
{
  TriangleSoup soup = box_mesh({0, 0, 0}, {1, 2, 3});
  soup.corners.resize(soup.corners.size() - 3);    // one of the 12 triangles
  const std::string error = error_of(soup);
  EXPECT_TRUE(has(error, "it has 3 open edges ("));
  // The places of all three: each is between two corners of the triangle that was taken off.
  EXPECT_EQ(std::count(error.begin(), error.end(), ';'), 2) << error;
}

// A paddle that begins in its shaft: two closed boxes that cut each other.
TEST(mass_properties, of_parts_that_overlap_are_refused_with_a_remedy)
{
  TriangleSoup soup = box_mesh({0, 0, 0}, {1, 1, 4});
  append(soup, box_mesh({0.5, 0.25, 1}, {3, 0.75, 2}));
  const std::string error = error_of(soup);
  EXPECT_TRUE(has(error, "cut or touch each other: unite overlapping parts"));
}

TEST(mass_properties, take_a_lamina_and_refuse_what_no_body_has)
{
  MassProperties p;
  p.mass = 1;
  p.inertia = {1, 2, 3, 0, 0, 0};
  EXPECT_NO_THROW(check_mass_properties(p, "plate"));
  p.inertia.zz = 3.1;
  EXPECT_THROW(check_mass_properties(p, "plate"), InputError);
  p.inertia = {1, 1, 1, 1.5, 0, 0};    // a principal moment of -0.5
  EXPECT_THROW(check_mass_properties(p, "plate"), InputError);
}

// Half a mass of infinity has no place.
TEST(mass_properties, are_refused_where_steps_have_no_numbers)
{
  const WeldedMesh cube = weld(box_mesh({0, 0, 0}, {2, 2, 2}), -1);
  for (const Real density : {1e308, 1e200, 1e-200, 1e-310})
    EXPECT_THROW(mass_properties(cube, density), InputError) << density;
  EXPECT_NO_THROW(mass_properties(cube, 1e30));
  MassProperties p;
  p.mass = 1;
  for (const Real moment : {1e300, 1e-300, HUGE_VAL}) {
    p.inertia = {moment, moment, moment, 0, 0, 0};
    EXPECT_THROW(check_mass_properties(p, "ball"), InputError) << moment;
  }
}

}    // namespace lsdcd::test_mass_properties
