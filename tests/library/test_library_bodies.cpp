// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Bodies through the library's headers: a cube through a floor of two triangles, in closed form.
#include "lsdcd_behind_core.h"
#include "support/says.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <thread>

namespace test_library_bodies {
namespace {

using Numbers = std::vector<double>;

// At z = 0 from -2 to 2: triangle 0 where x > y, 1 where x < y.
const Numbers kFloor = {-2, -2, 0, 2, -2, 0, 2, 2, 0, -2, -2, 0, 2, 2, 0, -2, 2, 0};

// A cube of side 1 about the origin; triangles 2 k and 2 k + 1 are one side: 0, 1 in x, then y, then z.
Numbers cube()
{
  const int faces[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 7, 5}, {1, 3, 7}, {0, 5, 4}, {0, 1, 5},
                            {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  Numbers corners;
  for (const auto &face : faces)
    for (const int v : face)
      for (int k = 0; k < 3; k++) corners.push_back((v >> k & 1) - 0.5);
  return corners;
}

// All over triangle 0, and half through the floor.
constexpr double kThrough[3] = {1, -1, 0.25};
constexpr double kAbove[3] = {1, -1, 0.75};

lsdcd::BodyOptions in_cells(double cell)
{
  lsdcd::BodyOptions options;
  options.cell = cell;
  return options;
}

lsdcd::Body cube_on_floor(double cell = 0.3)
{
  return lsdcd::Body(lsdcd::Mesh(kFloor), lsdcd::Mesh(cube()), in_cells(cell));
}

// Its four upright sides have two triangles each, all of which reach from z = -0.25 to 0.75.
void expect_upright_sides(const lsdcd::BodyPairs &found)
{
  EXPECT_EQ(found.wall, std::vector<std::uint32_t>(8, 0));
  EXPECT_EQ(found.body, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(library_bodies, upright_sides_of_a_cube_meet_the_floor)
{
  for (const double cell : {0., 0.05, 0.3, 5.}) {
    lsdcd::Body body = cube_on_floor(cell);
    expect_upright_sides(body.collide(kThrough));
    EXPECT_TRUE(body.collides(kThrough));
    EXPECT_FALSE(body.collides(kAbove));
    EXPECT_FALSE(body.collide(kAbove));
  }
}

TEST(library_bodies, a_cube_that_stands_on_the_floor_touches_it)
{
  const double on[3] = {1, -1, 0.5}, just_above[3] = {1, -1, std::nextafter(0.5, 1)};
  lsdcd::Body body = cube_on_floor();
  EXPECT_TRUE(body.collides(on));
  EXPECT_FALSE(body.collides(just_above));
  const lsdcd::BodyPairs found = body.collide(on, nullptr, true);
  ASSERT_EQ(found.wall.size(), 10u);    // the bottom's two triangles, and all upright ones
  for (std::size_t i = 0; i < 10; i++)
    EXPECT_EQ(std::isnan(found.segments[6 * i]), found.body[i] / 2 == 4) << i;    // one plane
}

// A turn by 90 degrees about x takes y to z: the sides in z and x are upright then.
TEST(library_bodies, a_quaternion_and_a_matrix_turn_the_body_alike)
{
  const double half = std::sqrt(0.5), quaternion[4] = {half, half, 0, 0};
  const double matrix[12] = {1, 0, 0, 1, 0, 0, -1, -1, 0, 1, 0, 0.25};
  lsdcd::Body body = cube_on_floor();
  const std::vector<std::uint32_t> upright = {0, 1, 2, 3, 8, 9, 10, 11};
  EXPECT_EQ(body.collide(kThrough, quaternion).body, upright);
  std::uint32_t triangles[8];
  EXPECT_EQ(body.collide(lsdcd::Matrix{matrix}).body, upright);
  EXPECT_TRUE(body.collides(lsdcd::Matrix{matrix}));
  lsdcd_collision c = {};
  c.size = sizeof c;
  c.matrix = matrix;
  c.room = 8;
  c.body_triangle = triangles;
  ASSERT_EQ(lsdcd_collide(body.get(), &c), LSDCD_OK) << lsdcd_last_error();
  EXPECT_EQ(c.collides, 1);
  EXPECT_EQ(std::vector<std::uint32_t>(triangles, triangles + 8), upright);
}

// Rounded to float each of its numbers is off by up to 2^-25, 3e-8, so products of rows by up to
// 2 sqrt(3) times that, 1e-7.
TEST(library_bodies, a_rotation_of_floats_is_taken)
{
  const float c = std::cos(0.7f), s = std::sin(0.7f);
  const double matrix[12] = {c, -s, 0, 1, s, c, 0, -1, 0, 0, 1, 0.25};
  EXPECT_NE(c * double(c) + s * double(s), 1);
  expect_upright_sides(cube_on_floor().collide(lsdcd::Matrix{matrix}));
}

// The bottom of the cube, at half of what a row stretches, is 1.5e-7 above the floor once it is not stretched
// by 4e-7, and 0.5e-7 below it with that.
TEST(library_bodies, a_rotation_of_floats_is_made_orthogonal)
{
  const double s = 1 + 4e-7, matrix[12] = {s, 0, 0, 1, 0, s, 0, -1, 0, 0, s, 0.5 + 1.5e-7};
  EXPECT_FALSE(cube_on_floor().collides(lsdcd::Matrix{matrix}));
}

TEST(library_bodies, too_little_room_gets_the_first_pairs_and_the_number_of_all)
{
  lsdcd::Body body = cube_on_floor();
  std::uint32_t wall[4] = {7, 7, 7, 7}, other[4] = {7, 7, 7, 7};
  lsdcd_collision c = {};
  c.size = sizeof c;
  c.position = kThrough;
  c.room = 3;
  c.wall_triangle = wall;
  c.body_triangle = other;
  ASSERT_EQ(lsdcd_collide(body.get(), &c), LSDCD_OK) << lsdcd_last_error();
  EXPECT_EQ(c.pairs, 8u);
  EXPECT_EQ(other[2], 2u);
  EXPECT_EQ(wall[2], 0u);
  EXPECT_EQ(other[3], 7u);
  EXPECT_EQ(wall[3], 7u);
}

TEST(library_bodies, more_pairs_than_the_usual_room_are_all_found)
{
  Numbers blades;    // 2000 upright triangles over triangle 0, each in a place of its own
  for (int k = 0; k < 2000; k++) {
    const double x = 0.5 + 1e-3 * (k % 50), y = -1 + 1e-3 * (k / 50), a = 1e-4;
    blades.insert(blades.end(), {x - a, y, -a, x + a, y, -a, x, y, a});
  }
  lsdcd::Body body(lsdcd::Mesh(kFloor), lsdcd::Mesh(blades, 0), in_cells(0.1));
  const double as_it_is[3] = {0, 0, 0};
  const lsdcd::BodyPairs found = body.collide(as_it_is);
  ASSERT_EQ(found.body.size(), 2000u);
  for (std::uint32_t k = 0; k < 2000; k++) EXPECT_EQ(found.body[k], k);
}

TEST(library_bodies, a_second_body_shares_the_wall_of_the_first_and_outlives_it)
{
  auto first = std::make_unique<lsdcd::Body>(cube_on_floor());
  Numbers half = cube();
  for (double &x : half) x *= 0.5;
  lsdcd::Body second(*first, lsdcd::Mesh(half)), same(*first, lsdcd::Mesh(cube()));
  EXPECT_EQ(second.facts().cell, first->facts().cell);
  first.reset();
  expect_upright_sides(same.collide(kThrough));
  const double low[3] = {1, -1, 0.2}, high[3] = {1, -1, 0.3};
  expect_upright_sides(second.collide(low));
  EXPECT_FALSE(second.collides(high));
}

// A facet without area is no face, and the others keep their numbers.
TEST(library_bodies, triangles_have_their_numbers_as_given)
{
  Numbers wall = {5, 5, 5, 5, 5, 5, 6, 6, 6}, body = {3, 3, 3, 3, 3, 3, 3, 3, 3};
  const Numbers cube_corners = cube();
  wall.insert(wall.end(), kFloor.begin(), kFloor.end());
  body.insert(body.end(), cube_corners.begin(), cube_corners.end());
  lsdcd::Body b(lsdcd::Mesh(wall), lsdcd::Mesh(body), in_cells(0.3));
  const lsdcd::BodyPairs found = b.collide(kThrough);
  EXPECT_EQ(found.wall, std::vector<std::uint32_t>(8, 1));
  EXPECT_EQ(found.body, (std::vector<std::uint32_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(b.facts().triangles, 12u);
}

TEST(library_bodies, bodies_of_one_wall_in_eight_threads_find_the_same)
{
  const lsdcd::Body first = cube_on_floor();
  const lsdcd::Mesh mesh(cube());
  std::vector<int> right(8, 0);
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; t++)
    threads.emplace_back([&, t] {
      lsdcd::Body body(first, mesh);
      for (int k = 0; k < 20; k++)
        right[t] += body.collide(kThrough, nullptr, false, 1 + t % 2).body.size() == 8 &&
                    !body.collides(kAbove);
    });
  for (std::thread &t : threads) t.join();
  EXPECT_EQ(right, std::vector<int>(8, 20));
}

TEST(library_bodies, nearest_lists_say_that_they_may_miss_pairs)
{
  lsdcd::BodyOptions options = in_cells(1);
  options.nearest = 1;
  lsdcd::Body body(lsdcd::Mesh(kFloor), lsdcd::Mesh(cube()), options);
  const double on_the_diagonal[3] = {0, 0, 0};
  EXPECT_GT(body.collide(on_the_diagonal).uncertain, 0u);
  EXPECT_EQ(cube_on_floor(1).collide(on_the_diagonal).uncertain, 0u);
}

TEST(library_bodies, a_gpu_finds_what_the_cpu_finds)
{
  if (!lsdcd_has_cuda()) GTEST_SKIP() << lsdcd_last_error();
  lsdcd::BodyOptions options = in_cells(0.3);
  options.device = LSDCD_CUDA;
  lsdcd::Body body(lsdcd::Mesh(kFloor), lsdcd::Mesh(cube()), options);
  lsdcd::Body sharing(body, lsdcd::Mesh(cube()));
  for (int k = 0; k < 3; k++) {
    expect_upright_sides(body.collide(kThrough));
    expect_upright_sides(sharing.collide(kThrough));
    EXPECT_FALSE(body.collides(kAbove));
  }
  EXPECT_EQ(body.collide(kThrough, nullptr, true).segments,
            cube_on_floor().collide(kThrough, nullptr, true).segments);
}

// ---- wrong use ----------------------------------------------------------------------------

class WrongBody : public ::testing::Test {
 protected:
  const lsdcd::Mesh wall{kFloor}, mesh{cube()};
  lsdcd::BodyOptions o = in_cells(0.3);
  lsdcd::Body body{wall, mesh, o};
  lsdcd_collision c = {};
  void SetUp() override
  {
    c.size = sizeof c;
    c.position = kThrough;
    c.pairs = 77;
  }

  static void expect(int code, int wanted, const char *says)
  {
    EXPECT_EQ(lsdcd_error_name(code), std::string(lsdcd_error_name(wanted)));
    EXPECT_TRUE(lsdcd::has(lsdcd_last_error(), says));
  }
  void not_made(int wanted, const char *says)
  {
    lsdcd_body *made = nullptr;
    expect(lsdcd_body_make(wall.get(), mesh.get(), &o, &made), wanted, says);
    EXPECT_EQ(made, nullptr);
  }
  void refused(int wanted, const char *says)
  {
    expect(lsdcd_collide(body.get(), &c), wanted, says);
    EXPECT_EQ(c.pairs, 77u);
  }
};

TEST_F(WrongBody, null_pointers)
{
  lsdcd_body *b = nullptr;
  expect(lsdcd_body_make(nullptr, mesh.get(), &o, &b), LSDCD_ERROR_ARGUMENT, "`wall` is null");
  expect(lsdcd_body_make(wall.get(), nullptr, &o, &b), LSDCD_ERROR_ARGUMENT, "`mesh` is null");
  expect(lsdcd_body_make(wall.get(), mesh.get(), &o, nullptr), LSDCD_ERROR_ARGUMENT, "`body` is");
  expect(lsdcd_collide(nullptr, &c), LSDCD_ERROR_ARGUMENT, "`body` is null");
  expect(lsdcd_collide(body.get(), nullptr), LSDCD_ERROR_ARGUMENT, "is null");
  expect(lsdcd_body_get_facts(nullptr, nullptr), LSDCD_ERROR_ARGUMENT, "`body` is null");
  expect(lsdcd_body_get_facts(body.get(), nullptr), LSDCD_ERROR_ARGUMENT, "is null");
  EXPECT_EQ(b, nullptr);
  lsdcd_body_free(nullptr);
  EXPECT_EQ(lsdcd_body_make(wall.get(), mesh.get(), nullptr, &b), LSDCD_OK);    // all defaults
  lsdcd_body_free(b);
}

TEST_F(WrongBody, options_that_make_no_sense)
{
  const struct {
    std::function<void(lsdcd::BodyOptions &)> spoil;
    const char *says;
    int code = LSDCD_ERROR_ARGUMENT;
  } rows[] = {
      {[](auto &w) { w.size = 4; }, "size is 4"},
      {[](auto &w) { w.cell = -1; }, "cell is -1"},
      {[](auto &w) { w.cell = NAN; }, "cell is nan"},
      {[](auto &w) { w.nearest = 33; }, "nearest is 33"},
      {[](auto &w) { w.memory = -1; }, "memory is -1"},
      {[](auto &w) { w.threads = -2; }, "`threads` is -2"},
      {[](auto &w) { w.device = 9; }, "device is neither"},
      {[](auto &w) { w.cell = 0.001, w.memory = 1e6; }, "`cell` 0.001 takes", LSDCD_ERROR_INPUT},
  };
  for (const auto &row : rows) {
    o = in_cells(0.3);
    row.spoil(o);
    not_made(row.code, row.says);
  }
}

TEST_F(WrongBody, cells_too_short_for_the_body)
{
  Numbers large = cube();
  for (double &x : large) x *= 1e5;
  lsdcd_body *b = nullptr;
  const lsdcd::Mesh other(large);
  expect(lsdcd_body_make(wall.get(), other.get(), &o, &b), LSDCD_ERROR_INPUT, "longer cells");
}

TEST_F(WrongBody, a_shared_wall_beside_one_of_its_own)
{
  o = lsdcd::BodyOptions();
  o.same_wall = body.get();
  not_made(LSDCD_ERROR_ARGUMENT, "same_wall is given");
  o.cell = 0.3;
  lsdcd_body *b = nullptr;
  expect(lsdcd_body_make(nullptr, mesh.get(), &o, &b), LSDCD_ERROR_ARGUMENT, "same_wall is given");
}

TEST_F(WrongBody, cuda_where_there_is_none)
{
  if (lsdcd_has_cuda()) GTEST_SKIP() << "there is a GPU";
  o.device = LSDCD_CUDA;
  not_made(LSDCD_ERROR_DEVICE, "LSDCD_CPU");
}

TEST_F(WrongBody, poses_and_arrays_that_make_no_sense)
{
  static const double long_one[4] = {1, 0, 0, 0.1}, none[4] = {0, 0, 0, 0}, nan[4] = {1, 0, 0, NAN},
                      far[3] = {0, INFINITY, 0}, too_far[3] = {0, 1e15, 0},
                      same[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
                      stretched[12] = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
                      nearly[12] = {1 + 2e-6, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
                      mirrored[12] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  static std::uint32_t one[1];
  const auto by_matrix = [](lsdcd_collision &w, const double *matrix) {
    w.position = nullptr;
    w.matrix = matrix;
  };
  const struct {
    std::function<void(lsdcd_collision &)> spoil;
    const char *says;
    int code = LSDCD_ERROR_ARGUMENT;
  } rows[] = {
      {[](auto &w) { w.size -= 8; }, "size is"},
      {[](auto &w) { w.threads = -1; }, "`threads` is -1"},
      {[](auto &w) { w.wall_triangle = one; }, "`room` is 0"},
      {[](auto &w) { w.position = nullptr; }, "no pose"},
      {[](auto &w) { w.matrix = same; }, "`matrix` is given beside"},
      {[](auto &w) { w.quaternion = long_one; }, "has the length 1.004", LSDCD_ERROR_INPUT},
      {[](auto &w) { w.quaternion = none; }, "has the length 0", LSDCD_ERROR_INPUT},
      {[](auto &w) { w.quaternion = nan; }, "number 4 is nan", LSDCD_ERROR_INPUT},
      {[](auto &w) { w.position = far; }, "number 2 is inf", LSDCD_ERROR_INPUT},
      {[](auto &w) { w.position = too_far; }, "rounding errors of its corners are too large",
       LSDCD_ERROR_INPUT},
      {[&](auto &w) { by_matrix(w, stretched); }, "not a rotation", LSDCD_ERROR_INPUT},
      {[&](auto &w) { by_matrix(w, mirrored); }, "mirrors", LSDCD_ERROR_INPUT},
      {[&](auto &w) { by_matrix(w, nearly); }, "to 1e-06", LSDCD_ERROR_INPUT},
  };
  const lsdcd_collision right = c;
  for (const auto &row : rows) {
    c = right;
    row.spoil(c);
    refused(row.code, row.says);
  }
}

}    // namespace
}    // namespace test_library_bodies
