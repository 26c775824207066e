// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Queries that only the study makes: the paper's formula (5), every face, and the entries of lists that are read.
#include "support/brute_force_long.h"
#include "support/device.h"
#include "support/meshes.h"
#include "support/random_mesh.h"

#include "base/input_error.h"
#include "mesh/welded_mesh.h"
#include "study/sphere_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lsdcd::test_sphere_query {
namespace {

struct Wall {
  TriangleSoup soup;
  WeldedMesh mesh;
  Real cutoff;

  Wall(TriangleSoup given, Real cutoff) :
      soup(std::move(given)), mesh(weld(soup, 0)), cutoff(cutoff)
  {
  }
  // nearest 0: complete lists.
  QueryGrid grid(int nearest, bool in_floats = false) const
  {
    QueryGridSettings settings;
    settings.cutoff = cutoff;
    settings.length = cutoff / 2;
    settings.nearest = nearest;
    settings.in_floats = in_floats;
    return build_grid(mesh, settings, test_on_cuda());
  }
  std::vector<Sphere> spheres(std::size_t n) const
  {
    Numbers r(1);
    std::vector<Sphere> out;
    for (std::size_t i = 0; i < n; i++) {
      const Vec3 x = random_centre(r, soup.corners.data(), int(soup.n_triangles()), mesh.report.lo,
                                   mesh.report.hi, cutoff);
      out.push_back({x.x, x.y, x.z, cutoff * r.in(0, 1)});
    }
    return out;
  }
};

Wall triangle(const Vec3 &a, const Vec3 &b, const Vec3 &c, Real cutoff)
{
  TriangleSoup soup;
  soup.corners = {a, b, c};
  return Wall(soup, cutoff);
}

struct Answers {
  std::vector<std::uint8_t> status;
  std::vector<Real> distance;
  std::vector<std::uint32_t> entries;
};

Answers ask(const Wall &wall, const QueryGrid &grid, const std::vector<Sphere> &spheres,
            QuerySettings settings = {}, Device device = test_device())
{
  const auto query = make_sphere_query(device);
  query->set_grid(grid, wall.mesh);
  query->set_spheres(spheres.data(), spheres.size());
  query->run(settings);
  return {query->status(), query->distance(), query->entries(settings)};
}

QuerySettings every_face()
{
  QuerySettings settings;
  settings.every_face = true;
  return settings;
}
QuerySettings paper()
{
  QuerySettings settings;
  settings.inside = InsideTest::formula_five;
  return settings;
}

const Wall &cylinder()
{
  static const Wall wall(cylinder_mesh(24, 6, 1, 2), 0.3);
  return wall;
}

// Against every triangle tried in more digits. Records are rounded at the coordinates' size, 2, as is a point in their
// frame: some units of the largest length, as in test_query.cpp.
TEST(sphere_query, every_face_needs_no_lists_and_reads_all)
{
  const std::vector<Sphere> spheres = cylinder().spheres(2000);
  const QueryGrid grid = cylinder().grid(1);
  const auto triangles = long_triangles<LongReal>(cylinder().soup);
  const Real tolerance = 1.5 * grid.tolerance + 16 * kRoundoff * (2 + cylinder().cutoff);
  const Answers a = ask(cylinder(), grid, spheres, every_face());
  std::size_t found = 0;
  for (std::size_t i = 0; i < spheres.size(); i++) {
    const Real truth = long_distance(triangles.data(), int(triangles.size()), spheres[i].centre());
    ASSERT_EQ((a.status[i] & kFound) != 0, a.distance[i] < kAnyDistance);
    ASSERT_TRUE(a.status[i] & kCertified);
    if (a.distance[i] < kAnyDistance) {
      ASSERT_NEAR(a.distance[i], truth, tolerance);
      found++;
    } else {
      ASSERT_GT(truth, spheres[i].r - tolerance);
    }
    ASSERT_EQ(a.entries[i], cylinder().mesh.faces.size());
  }
  EXPECT_GT(found, 500u);
}

TEST(sphere_query, every_face_answers_spheres_of_any_radius)
{
  const std::vector<Sphere> large = {{0, 0, 9, 30}};
  EXPECT_NEAR(ask(cylinder(), cylinder().grid(0), large, every_face()).distance[0], 7, 1e-14);
  EXPECT_THROW(ask(cylinder(), cylinder().grid(0), large), InputError);
}

TEST(sphere_query, a_list_of_n_reads_one_more_at_most)
{
  const Wall cone(cone_mesh(200, 1, 0.5), 0.2);
  const std::vector<Sphere> spheres = cone.spheres(2000);
  for (std::uint32_t n : {1u, 2u, 5u}) {
    const std::vector<std::uint32_t> entries = ask(cone, cone.grid(n), spheres).entries;
    EXPECT_EQ(*std::max_element(entries.begin(), entries.end()), n + 1);
  }
}

TEST(sphere_query, spheres_away_from_the_wall_read_nothing)
{
  const Wall box(box_mesh({0, 0, 0}, {4, 4, 4}), 0.3);
  for (int n : {0, 1})
    for (std::uint32_t entries :
         ask(box, box.grid(n), {{2, 2, 2, 0.3}, {9, 9, 9, 0.3}, {std::nan(""), 0, 0, 0.3}}).entries)
      EXPECT_EQ(entries, 0u);
}

// Formula (5) gives the exact distance over the inside of an acute triangle, where its search and the library's must
// agree on all but how far a list is read.
TEST(sphere_query, the_search_that_counts_finds_what_the_library_finds)
{
  const Wall wall = triangle({0, 0, 0}, {2, 0, 0}, {1, 1.8, 0}, 2);
  std::vector<Sphere> spheres;
  Numbers r(3);
  for (int i = 0; i < 500; i++) spheres.push_back({r.in(0.9, 1.1), r.in(0.4, 0.8), r.in(-1, 1), 2});
  const Answers own = ask(wall, wall.grid(1), spheres, paper()),
                library = ask(wall, wall.grid(1), spheres);
  EXPECT_EQ(own.status, library.status);
  EXPECT_EQ(own.distance, library.distance);
}

TEST(sphere_query, grid_and_spheres_can_change_between_calls)
{
  const Wall box(box_mesh({0, 0, 0}, {1, 2, 3}), 0.4);
  const auto query = make_sphere_query(test_device());
  for (const Wall *wall : {&cylinder(), &box, &cylinder()}) {
    const QueryGrid grid = wall->grid(2);
    query->set_grid(grid, wall->mesh);
    for (const std::size_t n : {1000, 100, 1000}) {
      const std::vector<Sphere> spheres = wall->spheres(n);
      query->set_spheres(spheres.data(), n);
      query->run({});
      const Answers once = ask(*wall, grid, spheres);
      EXPECT_EQ(query->status(), once.status);
      EXPECT_EQ(query->distance(), once.distance);
      EXPECT_EQ(query->entries({}), once.entries);
    }
  }
}

TEST(sphere_query, stores_no_distance_that_is_not_asked_for)
{
  const std::vector<Sphere> spheres = cylinder().spheres(1000);
  const auto query = make_sphere_query(test_device());
  query->set_grid(cylinder().grid(0), cylinder().mesh);
  query->set_spheres(spheres.data(), spheres.size());
  query->run({});
  const std::vector<std::uint8_t> status = query->status();
  QuerySettings settings;
  settings.distance = false;
  const QueryTiming timing = query->time(settings, 3);
  EXPECT_EQ(query->status(), status);
  EXPECT_TRUE(query->distance().empty());
  EXPECT_EQ(timing.repeats, 3);
  EXPECT_LE(timing.min_ms, timing.median_ms);
  EXPECT_LE(timing.median_ms, timing.max_ms);
}

TEST(sphere_query, gives_the_same_bits_on_both_devices)
{
  if (!test_on_cuda()) GTEST_SKIP() << "compares CUDA with the CPU";
  const std::vector<Sphere> spheres = cylinder().spheres(2000);
  const QueryGrid grid = cylinder().grid(2);
  for (const QuerySettings &settings : {QuerySettings(), every_face(), paper()}) {
    const Answers cpu = ask(cylinder(), grid, spheres, settings, Device::cpu),
                  cuda = ask(cylinder(), grid, spheres, settings, Device::cuda);
    EXPECT_EQ(cpu.status, cuda.status);
    EXPECT_EQ(cpu.distance, cuda.distance);
    EXPECT_EQ(cpu.entries, cuda.entries);
  }
}

// ---- the paper's test ---------------------------------------------------------------

TEST(formula_five, is_six_products_then_a_plane_or_three_sides)
{
  Numbers r(9);
  int n_inside = 0;
  for (int t = 0; t < 60; t++) {
    const Vec3 corner[3] = {r.in_box(), r.in_box(), r.in_box()};
    std::vector<Sphere> spheres;
    for (int i = 0; i < 200; i++) {
      const Vec3 q = 1.5 * r.in_box();
      spheres.push_back({q.x, q.y, q.z, 4});
    }
    const Wall wall = triangle(corner[0], corner[1], corner[2], 4);
    const Answers answers = ask(wall, wall.grid(1), spheres, paper());
    const Vec3 across = cross(corner[1] - corner[0], corner[2] - corner[0]);
    for (std::size_t i = 0; i < spheres.size(); i++) {
      const Vec3 q = spheres[i].centre();
      bool inside = true;
      Real side = HUGE_VAL;
      for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++) {
          if (j == k) continue;
          const Vec3 u = corner[j] - corner[k];
          const Real along = dot(q - corner[k], u) / norm(u);
          inside = inside && along >= 0;
          const Real on = std::fmin(std::fmax(along, Real(0)), norm(u));
          side = std::fmin(side, norm(q - corner[k] - (on / norm(u)) * u));
        }
      n_inside += inside;
      const Real expected = inside ? std::fabs(dot(across, q - corner[0])) / norm(across) : side;
      ASSERT_NEAR(answers.distance[i], expected, 1e-12) << t << " " << i;
    }
  }
  EXPECT_GT(n_inside, 500);
}

TEST(formula_five, is_refused_where_lists_hold_no_triangles)
{
  const Wall &wall = cylinder();
  const std::vector<Sphere> spheres = wall.spheres(10);
  EXPECT_THROW(ask(wall, wall.grid(0), spheres, paper()), InputError);
  EXPECT_THROW(ask(wall, wall.grid(2, true), spheres, paper()), InputError);
  EXPECT_NO_THROW(ask(wall, wall.grid(2), spheres, paper()));
  QuerySettings faces = paper();
  faces.every_face = true;
  EXPECT_NO_THROW(ask(wall, wall.grid(0), spheres, faces));
}

}    // namespace
}    // namespace lsdcd::test_sphere_query
