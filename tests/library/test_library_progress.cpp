// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Long calls of the library tell how far they are, and end where that is asked for.
#include "points_and_meshes.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

namespace test_library_progress {
namespace {

// 24 000 triangles, so that a tree tells more than once.
lsdcd::Mesh cylinder()
{
  return lsdcd::Mesh(numbers(lsdcd::cylinder_mesh(120, 99, 1, 2)));
}
lsdcd::Mesh box()
{
  return lsdcd::Mesh(numbers(lsdcd::box_mesh({-1, -1, -1}, {1, 1, 1})));
}

// The reports of calls that nobody ends, as shares from 0 to 1.
class Told {
 public:
  lsdcd::Progress listener()
  {
    return [this](const char *what, double done) {
      EXPECT_TRUE(done >= 0 && done <= 1) << what << " " << done;
      EXPECT_EQ(std::this_thread::get_id(), thread_);
      what_.insert(what);
      return false;
    };
  }
  const std::set<std::string> &what() const { return what_; }

 private:
  std::thread::id thread_ = std::this_thread::get_id();
  std::set<std::string> what_;
};

// call(listener) is cancelled at each thing that it tells.
template <class Call>
void expect_cancelled(const Call &call, std::size_t fewest)
{
  Told told;
  call(told.listener());
  EXPECT_GE(told.what().size(), fewest);
  for (const std::string &at : told.what()) {
    try {
      call([&](const char *what, double) { return what == at; });
      ADD_FAILURE() << "not cancelled at " << at;
    } catch (const lsdcd::Error &e) {
      EXPECT_EQ(e.code(), LSDCD_ERROR_CANCELLED);
      EXPECT_TRUE(lsdcd::has(e.what(), "cancelled the call, at: " + at));
    }
    // An exception of it comes out.
    EXPECT_THROW(call([&](const char *what, double) -> bool {
                   if (what == at) throw std::out_of_range("mine");
                   return false;
                 }),
                 std::out_of_range);
  }
}

TEST(progress, a_tree_is_cancelled)
{
  const lsdcd::Mesh mesh = cylinder();
  expect_cancelled([&](const lsdcd::Progress &p) { lsdcd::Grid(mesh, lsdcd::GridOptions(), p); },
                   1);
  expect_cancelled([&](const lsdcd::Progress &p) { lsdcd::Grid(mesh, lsdcd::GridOptions(0.1), p); },
                   2);
}

TEST(progress, cells_are_cancelled)
{
  const lsdcd::Mesh mesh = cylinder();
  lsdcd::GridOptions options(0.1);
  options.precision = LSDCD_FLOAT;
  options.threads = 3;
  expect_cancelled([&](const lsdcd::Progress &p) { lsdcd::Grid(mesh, options, p); }, 4);
}

TEST(progress, cells_that_were_cancelled_leave_no_file)
{
  const lsdcd::Mesh mesh = cylinder();
  lsdcd::TempDir folder;
  const std::string file = folder.path("grid.cache");
  lsdcd::GridOptions options(0.1);
  options.cell = 0.1;
  options.cache = file.c_str();
  EXPECT_THROW(lsdcd::Grid(mesh, options, [](const char *, double) { return true; }), lsdcd::Error);
  EXPECT_TRUE(std::filesystem::is_empty(std::filesystem::path(file).parent_path()));
  EXPECT_FALSE(lsdcd::Grid(mesh, options).facts().from_cache);
}

TEST(progress, a_body_is_cancelled)
{
  const lsdcd::Mesh wall = cylinder(), mesh = box();
  expect_cancelled(
      [&](const lsdcd::Progress &p) { lsdcd::Body(wall, mesh, lsdcd::BodyOptions(), p); }, 3);
}

// The first call on a grid of cells makes the cells.
TEST(progress, contacts_are_cancelled_and_then_made)
{
  const lsdcd::Mesh mesh = cylinder();
  const std::vector<double> points = random_points<double>(6000);
  const std::vector<double> radius = {0.1};
  const lsdcd::Grid grid(mesh, 0.1);
  EXPECT_THROW(grid.contacts(points, radius, 1, [](const char *, double) { return true; }),
               lsdcd::Error);
  Told told;
  const lsdcd::Contacts<double> a = grid.contacts(points, radius, 1, told.listener()),
                                b = grid.contacts(points, radius);
  EXPECT_GE(told.what().size(), 4u);    // parts of cells, and spheres
  EXPECT_GT(a.feature.size(), 100u);
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.feature, b.feature);
  EXPECT_EQ(a.point, b.point);
}

// In parts, of arrays with steps.
template <class T>
void expect_same(const lsdcd::Grid &grid, bool with_radii)
{
  const std::size_t n = 20000;
  const std::vector<T> points = random_points<T>(n);
  std::vector<T> radii;    // each another one
  for (std::size_t i = 0; i < n; i++) radii.push_back(T(0.05) + T(0.2) * T(i) / T(n));
  // The bytes of all answers, so that no number equals no number.
  const auto answers = [&](const lsdcd::Progress &progress) {
    std::vector<T> distance(2 * n), winding(2 * n), with_sign(2 * n), closest(3 * n), normal(3 * n),
        barycentric(3 * n);
    std::vector<std::uint32_t> triangle(n), feature(n);
    std::vector<std::int8_t> side(n);
    std::vector<std::uint8_t> status(n);
    lsdcd::Query<T> q(points.data(), n);
    if (with_radii) q.radii = radii.data();
    q.distance = distance.data();
    q.winding = winding.data();
    q.signed_distance = with_sign.data();
    q.distance_step = q.winding_step = q.signed_distance_step = 2;
    q.barycentric = barycentric.data();
    q.closest = closest.data();
    q.normal = normal.data();
    q.triangle = triangle.data();
    q.feature = feature.data();
    q.side = side.data();
    q.status = status.data();
    q.threads = 2;
    grid.query(q, progress);
    std::string bytes;
    const auto add = [&](const auto &...arrays) {
      (bytes.append(reinterpret_cast<const char *>(arrays.data()),
                    arrays.size() * sizeof arrays[0]),
       ...);
    };
    add(distance, winding, with_sign, closest, normal, barycentric, triangle, feature, side,
        status);
    return bytes;
  };
  Told told;
  EXPECT_TRUE(answers(told.listener()) == answers({}));
  EXPECT_EQ(told.what(), std::set<std::string>{"points"});
}

TEST(progress, answers_are_the_same_with_a_listener)
{
  const lsdcd::Mesh mesh = box();
  lsdcd::GridOptions cells(0.3);
  cells.cell = 0.1;
  cells.precision = LSDCD_FLOAT;
  for (const lsdcd::Grid &grid :
       {lsdcd::Grid(mesh), lsdcd::Grid(mesh, 0.3), lsdcd::Grid(mesh, cells)})
    for (const bool with_radii : {false, true}) {
      expect_same<double>(grid, with_radii);
      expect_same<float>(grid, with_radii);
    }
}

// A listener that takes a tenth of a second is called again at the next part.
TEST(progress, a_query_is_cancelled_between_its_parts)
{
  const lsdcd::Grid grid(box());
  const std::size_t n = 20000;
  const std::vector<double> points = random_points<double>(n);
  std::vector<double> distance(n, -1);
  lsdcd::Query<double> q(points.data(), n);
  q.distance = distance.data();
  try {
    grid.query(q, [](const char *, double done) {
      std::this_thread::sleep_for(std::chrono::milliseconds(101));
      return done > 0;
    });
    FAIL();
  } catch (const lsdcd::Error &e) {
    EXPECT_EQ(e.code(), LSDCD_ERROR_CANCELLED);
  }
  EXPECT_GE(distance[0], 0);
  EXPECT_EQ(distance[n - 1], -1);
}

// The first query of sides makes what tells them: three things, and the points.
TEST(progress, first_sides_are_cancelled_and_then_made)
{
  const std::vector<double> points = {0, 0, 0.3, 9, 9, 9};
  for (const bool estimated : {false, true}) {
    std::int8_t side[2] = {0, 0};
    double winding[2];
    lsdcd::Query<double> q(points.data(), 2);
    q.side = side;
    if (estimated) q.winding = winding;
    expect_cancelled([&](const lsdcd::Progress &p) { lsdcd::Grid(box()).query(q, p); }, 4);
    const lsdcd::Grid grid(box());
    EXPECT_THROW(grid.query(q, [](const char *, double) { return true; }), lsdcd::Error);
    grid.query(q, [](const char *, double) { return false; });
    EXPECT_EQ(side[0], -1);
    EXPECT_EQ(side[1], 1);
  }
}

// Winding numbers tell sides of a grid in float, too. What they need takes no part of the points.
TEST(progress, first_sides_in_float_are_told)
{
  lsdcd::GridOptions options(20);
  options.precision = LSDCD_FLOAT;
  const lsdcd::Grid grid(box(), options);
  const std::vector<double> points = {0, 0, 0.3, 9, 9, 9};
  std::int8_t side[2] = {0, 0};
  lsdcd::Query<double> q(points.data(), 2);
  q.side = side;
  Told first, second;
  grid.query(q, first.listener());
  grid.query(q, second.listener());
  EXPECT_EQ(second.what(), std::set<std::string>{"points"});
  EXPECT_GT(first.what().size(), 1u);
}

TEST(progress, an_error_of_a_later_part_has_the_number_of_its_point)
{
  const lsdcd::Grid grid(box(), 0.3);
  const std::size_t n = 20000;
  const std::vector<double> points = random_points<double>(n);
  std::vector<double> radii(n, 0.1), distance(n);
  radii[17000] = 0.4;
  lsdcd::Query<double> q(points.data(), n);
  q.distance = distance.data();
  q.radii = radii.data();
  const lsdcd::Progress never = [](const char *, double) { return false; };
  const auto expect = [&](const char *of, const auto &call) {
    try {
      call();
      FAIL();
    } catch (const lsdcd::Error &e) {
      EXPECT_TRUE(lsdcd::begins(e.what(), std::string(of) + " 17000 has radius 0.4"));
    }
  };
  expect("point", [&] { grid.query(q, never); });
  expect("sphere", [&] { grid.contacts(points, radii, 1, never); });
}

}    // namespace
}    // namespace test_library_progress
