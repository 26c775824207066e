// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Clumps: the union of spheres against closed forms and against lines through it, the spheres that fill a mesh, and masses of atoms.
#include "base/input_error.h"
#include "clump/atom_masses.h"
#include "clump/fill_mesh.h"
#include "clump/molecule_file.h"
#include "clump/principal_frame.h"
#include "clump/sphere_union.h"
#include "clump/surface_gap.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/says.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lsdcd::test_clump {
namespace {

// Volume, first and second moments about the origin: of 1, x, y, z, xx, yy, zz, xy, xz, yz.
using Moments = std::array<Real, 10>;

Moments moments_of(const MassProperties &p)
{
  const Real half = 0.5 * p.inertia.trace(), m = p.mass;
  const Vec3 &c = p.centre;
  return {m,
          m * c.x,
          m * c.y,
          m * c.z,
          half - p.inertia.xx + m * c.x * c.x,
          half - p.inertia.yy + m * c.y * c.y,
          half - p.inertia.zz + m * c.z * c.z,
          m * c.x * c.y - p.inertia.xy,
          m * c.x * c.z - p.inertia.xz,
          m * c.y * c.z - p.inertia.yz};
}

MassProperties properties_of(const Moments &m)
{
  MassProperties p;
  p.mass = m[0];
  p.centre = (1 / p.mass) * Vec3{m[1], m[2], m[3]};
  const Vec3 &c = p.centre;
  const Real x2 = m[4] - p.mass * c.x * c.x, y2 = m[5] - p.mass * c.y * c.y,
             z2 = m[6] - p.mass * c.z * c.z;
  p.inertia = {y2 + z2,
               x2 + z2,
               x2 + y2,
               p.mass * c.x * c.y - m[7],
               p.mass * c.x * c.z - m[8],
               p.mass * c.y * c.z - m[9]};
  return p;
}

// The greatest difference, over the volume and a length of the clump.
Real difference(const Moments &is, const Moments &wanted, Real length)
{
  Real most = 0;
  for (int k = 0; k < 10; k++) {
    const Real scale = wanted[0] * (k == 0 ? 1 : k < 4 ? length : length * length);
    most = std::fmax(most, std::fabs(is[k] - wanted[k]) / scale);
  }
  return most;
}

// Spheres along x, each of which meets only its neighbours: discs of radius^2 = r^2 - (x - c)^2 between the planes in which they
// meet, whose integrals are polynomials.
Moments row_of(const std::vector<Ball> &balls)
{
  Moments m = {};
  for (std::size_t i = 0; i < balls.size(); i++) {
    const Real c = balls[i].centre.x, r = balls[i].radius;
    const auto plane = [&](const Ball &a, const Ball &b) {
      const Real d = b.centre.x - a.centre.x;
      return a.centre.x + (d * d + a.radius * a.radius - b.radius * b.radius) / (2 * d);
    };
    const Real from = i == 0 ? -r : plane(balls[i - 1], balls[i]) - c,
               to = i + 1 == balls.size() ? r : plane(balls[i], balls[i + 1]) - c;
    const auto power = [&](int n) {
      return (std::pow(to, n + 1) - std::pow(from, n + 1)) / (n + 1);
    };
    const Real p0 = power(0), p1 = power(1), p2 = power(2), p3 = power(3), p4 = power(4),
               r2 = r * r;
    const Real volume = kPi * (r2 * p0 - p2), first = kPi * (r2 * p1 - p3),
               second = kPi * (r2 * p2 - p4), across = kPi / 4 * (r2 * r2 * p0 - 2 * r2 * p2 + p4);
    m[0] += volume;
    m[1] += first + c * volume;
    m[4] += second + 2 * c * first + c * c * volume;
    m[5] += across;
    m[6] += across;
  }
  return m;
}

// Integrals along lines in x, exact on each, over a lattice of n x n lines. Their sum is off by about the 3/2 power of the step, as at the
// rim of a disc: 1e-5 and less for 900 lines.
Moments by_lines(const std::vector<Ball> &balls, int n)
{
  Vec3 lo = balls[0].centre, hi = lo;
  for (const Ball &b : balls)
    for (int k = 0; k < 3; k++) {
      lo[k] = std::min(lo[k], b.centre[k] - b.radius);
      hi[k] = std::max(hi[k], b.centre[k] + b.radius);
    }
  Moments m = {};
  const Real dy = (hi.y - lo.y) / n, dz = (hi.z - lo.z) / n;
  std::vector<std::array<Real, 2>> spans;
  for (int j = 0; j < n; j++)
    for (int k = 0; k < n; k++) {
      const Real y = lo.y + (j + 0.5) * dy, z = lo.z + (k + 0.5) * dz;
      spans.clear();
      for (const Ball &b : balls) {
        const Real u = y - b.centre.y, v = z - b.centre.z,
                   left = b.radius * b.radius - u * u - v * v;
        if (left > 0) spans.push_back({b.centre.x - std::sqrt(left), b.centre.x + std::sqrt(left)});
      }
      std::sort(spans.begin(), spans.end());
      Real end = -HUGE_VAL;
      for (auto [from, to] : spans) {
        from = std::max(from, end);
        if (to <= from) continue;
        end = to;
        const Real l0 = to - from, l1 = (to * to - from * from) / 2,
                   l2 = (to * to * to - from * from * from) / 3;
        const Real add[10] = {l0,         l1,         y * l0, z * l0, l2,
                              y * y * l0, z * z * l0, y * l1, z * l1, y * z * l0};
        for (int i = 0; i < 10; i++) m[i] += dy * dz * add[i];
      }
    }
  return m;
}

// Spheres of which each meets one of those before it.
std::vector<Ball> random_clump(Random &random, int n)
{
  std::vector<Ball> balls = {{uniform(random, {-1, -1, -1}, {1, 1, 1}), 1}};
  while (static_cast<int>(balls.size()) < n) {
    const Ball &other = balls[static_cast<std::size_t>(uniform(random, 0, balls.size()))];
    const Real r = uniform(random, 0.4, 1.2),
               apart = uniform(random, 0.2, 0.95) * (r + other.radius);
    balls.push_back({other.centre + apart * random_unit(random), r});
  }
  remove_covered(balls);
  return balls;
}

Moments union_moments(const std::vector<Ball> &balls)
{
  return moments_of(union_of(balls, 1).properties);
}

// An ellipsoid's mesh with corners on its surface: a cube of n^2 squares a side, blown up.
TriangleSoup ellipsoid_mesh(int n, const Vec3 &half)
{
  TriangleSoup soup;
  soup.source = "ellipsoid";
  for (int side = 0; side < 6; side++) {
    const auto corner = [&](int i, int j) {
      const int axis = side / 2;
      Vec3 p;
      p[axis] = side % 2 ? 1 : -1;
      p[(axis + 1) % 3] = std::tan(kPi / 4 * (2.0 * i / n - 1));
      p[(axis + 2) % 3] = std::tan(kPi / 4 * (2.0 * j / n - 1)) * (side % 2 ? 1 : -1);
      p = unit(p);
      return Vec3{half.x * p.x, half.y * p.y, half.z * p.z};
    };
    for (int i = 0; i < n; i++)
      for (int j = 0; j < n; j++)
        for (const Vec3 &c : {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j),
                              corner(i + 1, j + 1), corner(i, j + 1)})
          soup.corners.push_back(c);
  }
  return soup;
}

std::vector<Ball> filled(const TriangleSoup &soup, const FillSettings &settings)
{
  const auto mesh = welded(soup);
  return fill_mesh(InsideMesh(*mesh), settings);
}

TriangleSoup unit_cube()
{
  return box_mesh({0, 0, 0}, {1, 1, 1});
}

const std::vector<Ball> &forty_in_cube()
{
  static const std::vector<Ball> balls = filled(unit_cube(), {40, 0, 0});
  return balls;
}
// These leave it by up to a tenth of their radius.
const std::vector<Ball> &twelve_out_of_cube()
{
  static const std::vector<Ball> balls = filled(unit_cube(), {12, 0, 0.1});
  return balls;
}

// How deep a point is in the unit cube.
Real depth_in_cube(const Vec3 &p)
{
  Real depth = HUGE_VAL;
  for (int k = 0; k < 3; k++) depth = std::min({depth, p[k], 1 - p[k]});
  return depth;
}

}    // namespace

// ---- unions -------------------------------------------------------------------------------------

TEST(clump, has_the_mass_and_inertia_of_one_sphere)
{
  const MassProperties p = union_of({{{3, -4, 5}, 2}}, 7).properties;
  const Real mass = 7 * 4 * kPi / 3 * 8;
  EXPECT_NEAR(p.mass, mass, 1e-12 * mass);
  EXPECT_NEAR(norm(p.centre - Vec3{3, -4, 5}), 0, 1e-12);
  for (const Real moment : {p.inertia.xx, p.inertia.yy, p.inertia.zz})
    EXPECT_NEAR(moment, 0.4 * mass * 4, 1e-11 * mass);
  for (const Real product : {p.inertia.xy, p.inertia.xz, p.inertia.yz})
    EXPECT_NEAR(product, 0, 1e-11 * mass);
}

TEST(clump, has_the_closed_form_of_two_spheres_along_each_axis)
{
  for (const Real r : {1.0, 0.6, 0.3})
    for (const Real apart : {0.75, 0.9, 1.2}) {
      const std::vector<Ball> pair = {{{0, 0, 0}, 1}, {{apart, 0, 0}, r}};
      const Moments wanted = row_of(pair);
      EXPECT_LT(difference(union_moments(pair), wanted, 1), 1e-10) << r << " " << apart;
      // The same along y and z: moments in other places.
      const std::vector<Ball> along_z = {{{0, 0, 0}, 1}, {{0, 0, apart}, r}};
      const Moments turned = {wanted[0], 0, 0, wanted[1], wanted[5], wanted[6], wanted[4], 0, 0, 0};
      EXPECT_LT(difference(union_moments(along_z), turned, 1), 1e-10) << r << " " << apart;
    }
}

TEST(clump, has_the_closed_form_of_three_spheres_in_a_row)
{
  const std::vector<Ball> row = {{{0, 0, 0}, 0.5}, {{0.6, 0, 0}, 0.7}, {{1.5, 0, 0}, 0.4}};
  EXPECT_LT(difference(union_moments(row), row_of(row), 1), 1e-10);
}

TEST(clump, is_the_sum_of_spheres_that_do_not_meet)
{
  const MassProperties p = union_of({{{0, 0, 0}, 1}, {{3, 0, 0}, 1}}, 1).properties;
  const Real one = 4 * kPi / 3;
  EXPECT_NEAR(p.mass, 2 * one, 1e-11);
  EXPECT_NEAR(p.inertia.zz, 2 * one * (0.4 + 2.25), 1e-10);
}

TEST(clump, is_what_lines_find_of_20_random_sets)
{
  Random random(17);
  for (int k = 0; k < 20; k++) {
    const std::vector<Ball> balls = random_clump(random, 3 + k);
    EXPECT_LT(difference(union_moments(balls), by_lines(balls, 900), 2), 2e-5) << k;
  }
}

// Rims of symmetric spheres meet in common points, poles and tangents.
TEST(clump, is_what_lines_find_of_a_symmetric_set)
{
  std::vector<Ball> balls;
  for (int k = 0; k < 27; k++)
    balls.push_back({{k % 3 - Real(1), k / 3 % 3 - Real(1), k / 9 - Real(1)}, 0.75});
  EXPECT_LT(difference(union_moments(balls), by_lines(balls, 900), 2), 2e-5);
}

TEST(clump, states_an_error_that_its_moments_keep)
{
  const std::vector<Ball> row = {{{0, 0, 0}, 1}, {{0.9, 0, 0}, 0.6}};
  const SphereUnion u = union_of(row, 1);
  EXPECT_LT(u.error, 1e-8);
  EXPECT_LE(difference(moments_of(u.properties), row_of(row), 1), u.error);
}

TEST(clump, is_the_same_far_from_the_origin)
{
  Random random(3);
  std::vector<Ball> balls = random_clump(random, 8);
  const MassProperties here = union_of(balls, 1).properties;
  for (Ball &b : balls) b.centre += Vec3{1e4, -2e4, 3e4};
  const MassProperties there = union_of(balls, 1).properties;
  // Places are rounded to 4e-12.
  EXPECT_NEAR(there.mass, here.mass, 1e-9 * here.mass);
  EXPECT_NEAR(there.inertia.xy, here.inertia.xy, 1e-9 * here.inertia.xx);
}

TEST(clump, leaves_out_spheres_within_others_and_all_but_one_of_equal_ones)
{
  std::vector<Ball> balls = {
      {{0.3, 0, 0}, 0.7}, {{0, 0, 0}, 1}, {{0, 0, 0}, 1}, {{0.4, 0, 0}, 0.7}};
  EXPECT_EQ(remove_covered(balls), 2u);
  ASSERT_EQ(balls.size(), 2u);
  EXPECT_EQ(balls[0].radius, 1);
  EXPECT_EQ(balls[1].centre.x, 0.4);
}

TEST(clump, is_in_a_sphere_about_its_centre)
{
  EXPECT_EQ(radius_around({{{0, 0, 0}, 1}, {{3, 0, 0}, 0.5}}, {1, 0, 0}), 2.5);
}

// ---- filling ------------------------------------------------------------------------------------

TEST(clump, begins_with_the_largest_sphere_in_a_cube)
{
  const Ball &first = forty_in_cube()[0];
  EXPECT_NEAR(first.radius, 0.5, 1e-4);
  EXPECT_NEAR(norm(first.centre - Vec3{0.5, 0.5, 0.5}), 0, 1e-4);
}

TEST(clump, has_as_many_spheres_as_it_may)
{
  EXPECT_EQ(forty_in_cube().size(), 40u);
}

TEST(clump, stays_in_the_mesh)
{
  for (const Ball &b : forty_in_cube()) EXPECT_LE(b.radius, depth_in_cube(b.centre) + 1e-12);
}

TEST(clump, sticks_out_by_no_more_than_the_share_of_each_radius)
{
  Real most = 0;
  for (const Ball &b : twelve_out_of_cube())
    most = std::max(most, 1 - depth_in_cube(b.centre) / b.radius);
  EXPECT_NEAR(most, 0.1, 1e-9);
}

TEST(clump, is_nearer_to_a_cube_if_its_spheres_stick_out)
{
  std::vector<Ball> inside = forty_in_cube();
  inside.resize(12);
  EXPECT_LT(std::fabs(union_of(twelve_out_of_cube(), 1).properties.mass - 1),
            1 - union_of(inside, 1).properties.mass);
}

// Each adds the most that one can, but for what moving it gains, and what the lattice of a quarter of a million points is off by.
TEST(clump, takes_spheres_by_what_they_add)
{
  Real volume = 0, last = 1;
  for (std::size_t n = 1; n <= 40; n++) {
    const std::vector<Ball> first(forty_in_cube().begin(), forty_in_cube().begin() + n);
    const Real now = union_of(first, 1).properties.mass;
    EXPECT_LT(now - volume, 1.25 * last) << n;
    EXPECT_GT(now - volume, 0) << n;
    last = now - volume;
    volume = now;
  }
}

TEST(clump, has_no_sphere_below_the_least_radius)
{
  const std::vector<Ball> balls = filled(unit_cube(), {9, 0.25, 0});
  ASSERT_FALSE(balls.empty());
  for (const Ball &b : balls) EXPECT_GE(b.radius, 0.25);
}

TEST(clump, has_the_largest_sphere_where_the_least_radius_allows_no_other)
{
  const std::vector<Ball> balls = filled(unit_cube(), {9, 0.4999, 0});
  ASSERT_EQ(balls.size(), 1u);
  EXPECT_NEAR(balls[0].radius, 0.5, 1e-4);
}

TEST(clump, is_empty_where_the_least_radius_is_too_large)
{
  EXPECT_TRUE(filled(unit_cube(), {40, 0.6, 0}).empty());
}

TEST(clump, begins_with_the_spheres_of_a_smaller_one)
{
  const std::vector<Ball> few = filled(unit_cube(), {5, 0, 0});
  for (std::size_t i = 0; i < few.size(); i++) {
    EXPECT_EQ(few[i].centre, forty_in_cube()[i].centre);
    EXPECT_EQ(few[i].radius, forty_in_cube()[i].radius);
  }
}

// The half-axes are 2, 1 and 0.8; facets of a 24th of a side take 0.4 % of the volume.
TEST(clump, comes_near_the_volume_and_moments_of_an_ellipsoid)
{
  const Vec3 half = {2, 1, 0.8};
  const MassProperties p = union_of(filled(ellipsoid_mesh(24, half), {40, 0, 0}), 1).properties;
  const Real volume = 4 * kPi / 3 * half.x * half.y * half.z;
  EXPECT_LT(p.mass, volume);
  EXPECT_GT(p.mass, 0.96 * volume);
  EXPECT_NEAR(p.inertia.xx, volume / 5 * (1 + 0.64), 0.08 * p.inertia.xx);
  EXPECT_NEAR(p.inertia.zz, volume / 5 * (4 + 1), 0.08 * p.inertia.zz);
  EXPECT_NEAR(norm(p.centre), 0, 0.02);
}

TEST(clump, fills_a_mesh_whose_normals_point_in)
{
  const std::vector<Ball> in = filled(inverted(unit_cube()), {1, 0, 0});
  ASSERT_EQ(in.size(), 1u);
  EXPECT_NEAR(in[0].radius, 0.5, 1e-4);
}

TEST(clump, refuses_an_open_mesh)
{
  TriangleSoup open = unit_cube();
  open.corners.resize(open.corners.size() - 3);
  EXPECT_TRUE(says(error_of([&] { filled(open, {1, 0, 0}); }), {"open"}));
}

// ---- surfaces -----------------------------------------------------------------------------------

TEST(clump, is_farthest_from_the_corners_of_a_cube_around_it)
{
  const auto mesh = welded(unit_cube());
  const SurfaceGap gap = surface_gap(InsideMesh(*mesh), {{{0.5, 0.5, 0.5}, 0.5}});
  EXPECT_NEAR(gap.uncovered, std::sqrt(0.75) - 0.5, 1e-12);
  EXPECT_EQ(gap.stick_out, 0);
}

TEST(clump, sticks_out_of_a_cube_by_its_radius_less_its_depth)
{
  const auto mesh = welded(unit_cube());
  EXPECT_NEAR(surface_gap(InsideMesh(*mesh), {{{0.5, 0.5, 0.4}, 0.5}}).stick_out, 0.1, 1e-12);
  EXPECT_NEAR(surface_gap(InsideMesh(*mesh), {{{0.5, 0.5, -0.2}, 0.5}}).stick_out, 0.7, 1e-12);
}

// ---- masses of atoms ----------------------------------------------------------------------------

// What a program sums that knows no overlaps.
Moments sums_of(const std::vector<Ball> &balls, const std::vector<Real> &mass)
{
  Moments m = {};
  for (std::size_t i = 0; i < balls.size(); i++) {
    const Vec3 &c = balls[i].centre;
    const Real own = balls[i].radius * balls[i].radius / 5;
    const Real add[10] = {
        1,         c.x,       c.y,      c.z, c.x * c.x + own, c.y * c.y + own, c.z * c.z + own,
        c.x * c.y, c.x * c.z, c.y * c.z};
    for (int k = 0; k < 10; k++) m[k] += mass[i] * add[k];
  }
  return m;
}

// A clump that some masses have, which are not shares by volume.
TEST(clump, has_atoms_whose_sums_are_its_mass_centre_and_inertia)
{
  Random random(29);
  for (int k = 0; k < 20; k++) {
    const std::vector<Ball> balls = random_clump(random, 4 + 2 * k);
    std::vector<Real> some;
    for (std::size_t i = 0; i < balls.size(); i++) some.push_back(uniform(random, 0.1, 5));
    const Moments wanted = sums_of(balls, some);
    const AtomMasses atoms = atom_masses(balls, properties_of(wanted));
    for (const Real m : atoms.mass) EXPECT_GT(m, 0);
    EXPECT_LT(difference(sums_of(balls, atoms.mass), wanted, 1), 1e-9) << k;
  }
}

TEST(clump, of_a_filled_mesh_has_atoms_with_its_inertia)
{
  const MassProperties p = union_of(forty_in_cube(), 3).properties;
  EXPECT_LT(
      difference(sums_of(forty_in_cube(), atom_masses(forty_in_cube(), p).mass), moments_of(p), 1),
      1e-9);
}

TEST(clump, has_atoms_with_its_mass_and_centre_where_they_cannot_have_its_inertia)
{
  Random random(31);
  for (int n = 2; n < 8; n++) {
    const std::vector<Ball> balls = random_clump(random, n);
    const Moments wanted = moments_of(union_of(balls, 3).properties),
                  is = sums_of(balls, atom_masses(balls, union_of(balls, 3).properties).mass);
    for (int k = 0; k < 4; k++) EXPECT_NEAR(is[k], wanted[k], 1e-9 * wanted[0]) << n;
  }
}

TEST(clump, says_what_its_atoms_sum_to)
{
  const std::vector<Ball> balls = {{{0, 0, 0}, 1}, {{1, 0, 0}, 0.8}, {{1.2, 1, 0.1}, 0.7}};
  const AtomMasses atoms = atom_masses(balls, union_of(balls, 2).properties);
  EXPECT_LT(difference(moments_of(atoms.sums), sums_of(balls, atoms.mass), 1), 1e-12);
}

TEST(clump, of_one_sphere_has_one_atom_of_its_mass)
{
  const std::vector<Ball> one = {{{1, 2, 3}, 0.5}};
  const MassProperties p = union_of(one, 2).properties;
  EXPECT_NEAR(atom_masses(one, p).mass[0], p.mass, 1e-12 * p.mass);
}

// Sets whose four first centres span a volume, which has its sign.
TEST(clump, in_its_principal_frame_has_its_moments_about_the_origin_and_is_no_mirror_image)
{
  Random random(37);
  for (int n = 0; n < 10; n++) {
    const std::vector<Ball> balls = random_clump(random, 6);
    const MassProperties was = union_of(balls, 3).properties;
    const Principal principal = principal_of(was.inertia);
    std::vector<Ball> placed = balls;
    MassProperties told = was;
    place_in_principal_frame(principal, placed, told);
    // union_of() is exact to 1e-10 of the volume.
    const MassProperties is = union_of(placed, 3).properties;
    const Real moment = principal.moment[2];
    EXPECT_LT(norm(is.centre), 1e-8);
    const SymmetricMatrix &i = is.inertia;
    for (const Real off :
         {i.xx - told.inertia.xx, i.yy - told.inertia.yy, i.zz - told.inertia.zz, i.xy, i.xz, i.yz})
      EXPECT_LT(std::fabs(off), 1e-8 * moment);
    EXPECT_TRUE(i.xx <= i.yy && i.yy <= i.zz);
    EXPECT_TRUE(norm(told.centre) == 0 && told.inertia.xy == 0);
    const auto spanned = [](const std::vector<Ball> &b) {
      return dot(cross(b[1].centre - b[0].centre, b[2].centre - b[0].centre),
                 b[3].centre - b[0].centre);
    };
    EXPECT_NEAR(spanned(placed), spanned(balls), 1e-12 * (1 + std::fabs(spanned(balls))));
  }
}

// ---- the file -----------------------------------------------------------------------------------

TEST(clump, is_written_as_a_molecule_with_the_products_of_inertia_in_the_order_that_lammps_reads)
{
  MassProperties p;
  p.mass = 2;
  p.centre = {1, 0.5, 0.25};
  p.inertia = {11, 12, 13, 0.12, 0.13, 0.23};
  EXPECT_EQ(molecule_text({{{0, 1, 2}, 0.5}, {{3, 4, 5}, 0.25}}, {1.5, 0.5}, p, 3, "two"),
            "# two\n\n2 atoms\n2 mass\n1 0.5 0.25 com\n"
            "11 12 13 0.23 0.13 0.12 inertia    # xx yy zz yz xz xy, as LAMMPS reads them\n"
            "\nCoords\n\n1 0 1 2\n2 3 4 5\n\nTypes\n\n1 3\n2 3\n"
            "\nDiameters\n\n1 1\n2 0.5\n\nMasses\n\n1 1.5\n2 0.5\n");
}

}    // namespace lsdcd::test_clump
