// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Motions that are tables, against closed forms.
#include "base/input_error.h"
#include "support/motions.h"
#include "support/says.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace lsdcd::test_motion_table {
namespace {

constexpr Real kEps = 2.3e-16;
const Vec3 kPoint = {0.3, -1.7, 0.9};    // of the mesh
const Vec3 kAxisPoint = {1, 2, 3}, kAxis = {1, -1, 0.5};

using Row = std::vector<Real>;

TableRows rows_of(const std::vector<Row> &rows, const TableOptions &options = {})
{
  TableRows all;
  all.options = options;
  all.columns = static_cast<int>(rows.front().size());
  for (const Row &row : rows) all.numbers.insert(all.numbers.end(), row.begin(), row.end());
  return all;
}

MotionTerm table_term(const TableRows &rows)
{
  MotionTerm m;
  m.kind = MotionKind::table;
  m.point = kAxisPoint;
  m.axis = kAxis;
  m.table_options = rows.options;
  m.table = std::make_shared<const MotionTable>(
      rows, [](std::size_t row) { return "row " + std::to_string(row); });
  return m;
}

RigidMotion table(const std::vector<Row> &rows, const TableOptions &options = {})
{
  return motion_of({table_term(rows_of(rows, options))});
}

TableOptions with_axis(bool linear = false, bool repeats = false)
{
  TableOptions o;
  o.has_axis = true;
  o.linear = linear;
  o.repeats = repeats;
  return o;
}

TableOptions options(bool linear, bool repeats = false)
{
  TableOptions o = with_axis(linear, repeats);
  o.has_axis = false;
  return o;
}

Vec3 place(const RigidMotion &motion, Time t)
{
  return motion.pose_at(t).to_box(kPoint);
}
Vec3 velocity(const RigidMotion &motion, Time t)
{
  const Pose pose = motion.pose_at(t);
  return pose.turn_to_box(pose.velocity_in_mesh(kPoint));
}

bool same_bits(const Pose &a, const Pose &b)
{
  for (int k = 0; k < 3; k++)
    if (!(a.row[k] == b.row[k])) return false;
  return a.shift == b.shift && a.velocity == b.velocity && a.angular == b.angular;
}

// Places are of size 10 and speeds of 100, in some 30 operations.
void expect_same(const RigidMotion &a, const RigidMotion &b, const std::vector<Real> &times)
{
  for (const Real t : times) {
    EXPECT_LE(norm(place(a, t) - place(b, t)), 30 * 10 * kEps) << t;
    EXPECT_LE(norm(velocity(a, t) - velocity(b, t)), 30 * 100 * kEps) << t;
  }
}

// Straight between rows

TEST(motion_table, of_two_places_is_linear)
{
  expect_same(table({{0, 0, 0, 0}, {0.5, 0.5, -1, 0.25}, {4, 4, -8, 2}}, options(true)),
              motion_of({linear({1, -2, 0.5})}), {0, 0.1, 0.5, 1.7, 3.9});
}

// A rotation vector that grows along an axis, and the quaternions of these turns: more than a turn.
std::vector<Row> turns_about_axis(int columns, Real period)
{
  const Vec3 axis = unit_vector(kAxis);
  std::vector<Row> rows;
  for (int i = 0; i <= 4; i++) {
    const Real t = 0.4 * i, angle = 2 * kPi * t / period;
    rows.push_back({t, 0, 0, 0});
    Row &row = rows.back();
    if (columns == 8) row.push_back(std::cos(angle / 2));
    const Real size = columns == 8 ? std::sin(angle / 2) : angle;
    for (int k = 0; k < 3; k++) row.push_back(size * axis[k]);
  }
  return rows;
}

TEST(motion_table, of_turns_about_an_axis_is_a_rotation)
{
  TableOptions degrees = with_axis(true);
  degrees.degrees = true;
  std::vector<Row> quaternions = turns_about_axis(8, 1.3);    // the sign of each other one is free
  for (std::size_t i = 1; i < quaternions.size(); i += 2)
    for (int k = 4; k < 8; k++) quaternions[i][k] = -quaternions[i][k];
  for (const RigidMotion &motion :
       {table({{0, 0}, {1.3 * 2.5, 2 * kPi * 2.5}}, with_axis(true)),
        table({{0, 0}, {2.6, 720}}, degrees), table(turns_about_axis(7, 1.3), options(true)),
        table(quaternions, options(true))})
    expect_same(motion, motion_of({turning(kAxisPoint, kAxis, 1.3)}), {0, 0.1, 0.4, 1, 1.5});
  // After whole turns a table that repeats goes on.
  expect_same(table({{0, 0}, {0.65, kPi}, {1.3, 6.283185}}, with_axis(true, true)),
              motion_of({turning(kAxisPoint, kAxis, 1.3)}), {1.3 + 0.1, 5 * 1.3 + 0.9});
}

// Cubic

// x(t) = Rz(1.1 t) Rx(0.7 t) (x - p) + p + d(t): the rotation's rows are closed forms, and so is its velocity,
// 1.1 z + Rz(1.1 t) 0.7 x.
struct Tumbling {
  static Vec3 z_turned(Real a, const Vec3 &v)
  {
    return {std::cos(a) * v.x - std::sin(a) * v.y, std::sin(a) * v.x + std::cos(a) * v.y, v.z};
  }
  static Vec3 x_turned(Real a, const Vec3 &v)
  {
    return {v.x, std::cos(a) * v.y - std::sin(a) * v.z, std::sin(a) * v.y + std::cos(a) * v.z};
  }
  static Vec3 shift(Real t) { return {std::sin(t), 0.5 * std::cos(2 * t) - 0.5, 0.3 * t}; }
  static Vec3 place(Real t)
  {
    return z_turned(1.1 * t, x_turned(0.7 * t, kPoint - kAxisPoint)) + kAxisPoint + shift(t);
  }
  static Vec3 velocity(Real t)
  {
    const Vec3 omega = Vec3{0, 0, 1.1} + z_turned(1.1 * t, {0.7, 0, 0});
    return cross(omega, place(t) - kAxisPoint - shift(t)) +
           Vec3{std::cos(t), -std::sin(2 * t), 0.3};
  }
  // The product of the quaternions of the two turns.
  static Row row(Real t)
  {
    const Real c = std::cos(0.55 * t), s = std::sin(0.55 * t), cx = std::cos(0.35 * t),
               sx = std::sin(0.35 * t);
    const Vec3 d = shift(t);
    return {t, d.x, d.y, d.z, c * cx, c * sx, s * sx, s * cx};
  }
};

struct Errors {
  Real place = 0, velocity = 0;
};

// Between times that do not depend on the rows.
Errors errors(int rows, const std::function<Row(Real)> &row, const TableOptions &o, Real end,
              const std::function<Vec3(Real)> &where, const std::function<Vec3(Real)> &speed)
{
  std::vector<Row> all;
  for (int i = 0; i <= rows; i++) all.push_back(row(end * i / rows));
  const RigidMotion motion = table(all, o);
  Errors e;
  for (int i = 0; i < 3000; i++) {
    const Real t = end * (i + 0.5) / 3000;
    e.place = std::max(e.place, norm(place(motion, t) - where(t)));
    e.velocity = std::max(e.velocity, norm(velocity(motion, t) - speed(t)));
  }
  return e;
}

// Half the time between rows: errors of the order h^4 and h^3 are a 16th and an 8th, but for terms of the next order,
// which at these rows are a tenth.
void expect_orders(const Errors &one, const Errors &half)
{
  EXPECT_NEAR(one.place / half.place, 16, 1.6);
  EXPECT_NEAR(one.velocity / half.velocity, 8, 0.8);
}

TEST(motion_table, of_a_sampled_tumbling_has_errors_of_fourth_order)
{
  const auto with_rows = [](int n) {
    return errors(n, Tumbling::row, {}, 3, Tumbling::place, Tumbling::velocity);
  };
  const Errors coarse = with_rows(80);
  expect_orders(coarse, with_rows(160));
  EXPECT_LT(coarse.place, 1e-5);
}

// An angle sin(2 pi t) about the axis, in periods of 1. Splined as it is.
Vec3 swung(Real t, bool speed)
{
  const Vec3 k = unit_vector(kAxis), d = kPoint - kAxisPoint;
  const Real a = std::sin(2 * kPi * t), rate = 2 * kPi * std::cos(2 * kPi * t);
  const Vec3 arm =
      std::cos(a) * d + std::sin(a) * cross(k, d) + ((1 - std::cos(a)) * dot(k, d)) * k;
  return speed ? cross(rate * k, arm) : kAxisPoint + arm;
}

TEST(motion_table, that_repeats_has_errors_of_fourth_order_at_its_ends_too)
{
  const auto with_rows = [](int n) {
    return errors(
        n,
        [](Real t) {
          return Row{t, std::sin(2 * kPi * t)};
        },
        with_axis(false, true), 1, [](Real t) { return swung(t, false); },
        [](Real t) { return swung(t, true); });
  };
  expect_orders(with_rows(40), with_rows(80));
}

// Any cubic is its own spline, any parabola that of three rows, any line that of two.
TEST(motion_table, goes_through_a_polynomial)
{
  const std::vector<Real> all_times = {0, 0.3, 1.1, 1.2, 2, 2.9};
  for (const std::size_t n : {2u, 3u, 4u, 6u}) {
    const Real cube = n > 3 ? 0.2 : 0, square = n > 2 ? -0.7 : 0;
    const auto x = [&](Real t) { return 0.4 + t * (1 + t * (square + t * cube)); };
    std::vector<Row> rows;
    for (std::size_t i = 0; i < n; i++)
      rows.push_back({all_times[i], x(all_times[i]), -x(all_times[i]), 0});
    const RigidMotion motion = table(rows);
    for (Real t = 0; t < all_times[n - 1]; t += 0.01) {
      EXPECT_NEAR(motion.pose_at(t).shift.x, x(t), 100 * kEps);
      EXPECT_NEAR(motion.pose_at(t).velocity.y, -(1 + t * (2 * square + t * 3 * cube)), 300 * kEps);
    }
  }
}

// Velocities

// Of fourth order. Rounding: 3e-15 of a place over h = 1e-3, in four places: 1e-11. The fifth derivatives of these
// turns are below 1e3: h^4/30 of them is 3e-11.
Vec3 difference(const RigidMotion &motion, Real t)
{
  const Real h = 1e-3;
  const auto at = [&](int k) { return place(motion, Time(t) + k * Time(h)); };
  return (1 / (12 * h)) * (8 * (at(1) - at(-1)) - (at(2) - at(-2)));
}

TEST(motion_table, has_the_derivative_of_its_curve_as_velocity)
{
  std::vector<Row> angles, places, both, vectors, quaternions;
  for (int i = 0; i <= 12; i++) {
    const Real t = 0.25 * i;
    const Row row = Tumbling::row(t);
    angles.push_back({t, std::sin(2 * t)});
    places.push_back({t, row[1], row[2], row[3]});
    both.push_back({t, row[1], row[2], row[3], std::sin(2 * t)});
    vectors.push_back({t, row[1], row[2], row[3], std::sin(t), 0.5 * t, 0.3});
    quaternions.push_back(row);
  }
  for (const bool linear : {false, true})
    for (const RigidMotion &motion :
         {table(angles, with_axis(linear)), table(places, options(linear)),
          table(both, with_axis(linear)), table(vectors, options(linear)),
          table(quaternions, options(linear))})
      for (Real t = 0.1; t < 3; t += 0.25)    // never within 0.1 of a row
        EXPECT_LE(norm(velocity(motion, t) - difference(motion, t)), 5e-11) << t;
}

// Ends

TEST(motion_table, rests_before_its_first_row_and_from_its_last_one_on)
{
  const RigidMotion motion = table({{1, 1, 0, 0, 0, 0, 0}, {2, 2, 0, 0, 0, 0, 1}});
  for (const Real t : {0.0, 0.999, 2.0, 100.0}) {
    const Pose pose = motion.pose_at(t);
    EXPECT_EQ(pose.velocity, (Vec3{0, 0, 0}));
    EXPECT_EQ(pose.angular, (Vec3{0, 0, 0}));
  }
  EXPECT_EQ(place(motion, 0.5), kPoint + Vec3({1, 0, 0}));
  EXPECT_TRUE(same_bits(motion.pose_at(2), motion.pose_at(77)));
}

std::vector<Row> closed_rows()
{
  return {{0.25, 0, 1, 0, 1, 0.2, 0},
          {0.5, 0.4, 0, 0, 0, 0.1, 0.5},
          {0.9, 0, 0, 0, 0.2, 0, 0},
          {1.25, 0, 1, 0, 1, 0.2, 0}};
}

// Times of 2^-10 are exact, and so is the period of 1.
TEST(motion_table, that_repeats_has_the_same_bits_in_each_period)
{
  for (const bool linear : {false, true}) {
    const RigidMotion motion = table(closed_rows(), options(linear, true));
    for (int i = 0; i < 1024; i += 31) {
      const Time t = i / 1024.0L;
      for (const int periods : {1, 2, 1000003})
        EXPECT_TRUE(same_bits(motion.pose_at(t), motion.pose_at(t + periods))) << i;
    }
  }
}

// A step of 1e-3 is no binary fraction: its product misses the period by a rounding, on either side.
TEST(motion_table, that_repeats_begins_anew_in_spite_of_a_timesteps_rounding)
{
  const RigidMotion motion = table(closed_rows(), options(true, true));
  for (const Real dt : {1e-3, -1e-3})
    for (const long steps : {1250L, 7250L, 1000000250L})
      EXPECT_TRUE(same_bits(motion.pose_at((dt > 0 ? 0 : 2 * steps) * 1e-3L + steps * Time(dt)),
                            motion.pose_at(0.25L)));
}

// The quaternion changes its sign on the way.
RigidMotion once_about()
{
  std::vector<Row> turns;
  for (int i = 0; i <= 8; i++) turns.push_back({0.125 * i, 0, 0, 0, 0, 0, kPi / 4 * i});
  return table(turns, options(false, true));
}

// By 1e-9 of a period on both sides of the seam, with accelerations below 1e4.
TEST(motion_table, that_repeats_has_no_jump_of_its_velocity)
{
  const RigidMotion turns = once_about();
  for (const RigidMotion &motion :
       {table(closed_rows(), options(false, true)), turns,
        table({{0, 0.1}, {0.6, 2}, {1, 0.1 + 4 * kPi}}, with_axis(false, true))})
    for (const Real seam : {1.0, 1.25})
      EXPECT_LE(norm(velocity(motion, seam - 1e-9) - velocity(motion, seam + 1e-9)), 2e-9 * 1e4);
  // All rows of a steady turn look alike, also that at the seam.
  EXPECT_NEAR(turns.pose_at(1).angular.z, turns.pose_at(0.375).angular.z, 100 * kEps);
  EXPECT_NEAR(turns.pose_at(1).angular.z, 2 * kPi, 0.01);
}

// What it keeps

TEST(motion_table, knows_which_directions_it_keeps)
{
  const Vec3 x = {1, 0, 0}, z = {0, 0, 1};
  const RigidMotion slide = table({{0, 0, 0, 0}, {1, 1, 2, 0}});
  EXPECT_TRUE(slide.keeps(z));
  EXPECT_FALSE(slide.keeps(x));
  const RigidMotion turn = table({{0, 0, 0, 0, 0, 0, 0}, {1, 0, 0, 0, 0, 0, 1}});
  EXPECT_TRUE(turn.keeps(z));
  EXPECT_FALSE(turn.keeps(x));
  MotionTerm angle = table_term(rows_of({{0, 0}, {1, 1}}, with_axis()));
  EXPECT_FALSE(motion_of({angle}).keeps(z));
  angle.axis = z;
  EXPECT_TRUE(motion_of({angle}).keeps(z));
}

// Errors

std::string error_of(const std::vector<Row> &rows, const TableOptions &o = {})
{
  return lsdcd::error_of([&] { table(rows, o); });
}

TEST(motion_table, refuses_rows_with_their_place_and_a_remedy)
{
  const Row still = {0, 0, 0, 0};
  EXPECT_TRUE(
      says(error_of({{0, 1, 2}}), {"row 0", "there are 3 numbers in a row: a row is a time and"}));
  EXPECT_TRUE(says(error_of({{0, 1}, {1, 1}}), {"row 0", "give its axis, by axis Px Py Pz"}));
  EXPECT_TRUE(says(error_of({still, {1, 0, 0, 0}}, with_axis()), {"row 0", "leave the axis out"}));
  EXPECT_TRUE(says(error_of({still}), {"row 0", "needs two or more"}));
  EXPECT_TRUE(says(error_of({still, {1, 0, 0, 0}, {1, 0, 0, 0}}),
                   {"row 2", "the time 1 is not after that of the row before, 1"}));
  EXPECT_TRUE(
      says(error_of({still, {1, 0, HUGE_VAL, 0}}), {"row 1", "number 3 of the row is not finite"}));
  EXPECT_TRUE(says(error_of({{0, 0, 0, 0, 0, 0, 3}, {1, 0, 0, 0, 0, 0, -3}}),
                   {"row 1", "is 343.775 degrees from that of the row before"}));
  EXPECT_TRUE(says(error_of({{0, 0, 0, 0, 1, 0, 0, 0}, {1, 0, 0, 0, 0.5, 0, 0, 0}}),
                   {"row 1", "has the length 0.5, and must have 1 to 1e-3"}));
  EXPECT_TRUE(says(error_of({{0, 0, 0, 0, 1, 0, 0, 0}, {1, 0, 0, 0, 0, 1, 0, 0}}),
                   {"row 1", "give a row between them"}));
}

TEST(motion_table, that_repeats_must_end_where_it_begins)
{
  const char *const why = "the table repeats, but its last row is not its first";
  EXPECT_TRUE(says(error_of({{0, 0, 0, 0}, {1, 0, 0, 1}, {2, 0, 0, 0.1}}, options(false, true)),
                   {"row 2", why}));
  EXPECT_TRUE(says(error_of({{0, 0}, {1, 6.2}}, with_axis(false, true)), {"row 1", why}));
  EXPECT_TRUE(says(error_of({{0, 0, 0, 0, 0, 0, 0}, {1, 0, 0, 0, 0, 0, 1}}, options(false, true)),
                   {"row 1", why}));
}

// Files

std::string error_of_file(const std::string &text, const TableOptions &o = {})
{
  const TempDir folder;
  const std::string file = folder.write("arm.txt", text);
  return lsdcd::error_of([&] { read_motion_table(file, o); });
}

// The motion begins at time 0, where the last row has no velocity any more.
TEST(motion_table, that_ends_before_it_begins_is_an_error)
{
  for (const char *rows : {"-2 0 0 0\n-1 1 0 0\n", "-2 0 0 0\n0 1 0 0\n"})
    EXPECT_TRUE(says(error_of_file(rows), {"arm.txt' line 2", "and the motion begins at time 0"}));
  TableOptions repeats;
  repeats.repeats = repeats.linear = true;
  EXPECT_NO_THROW(MotionTable(rows_of({{-2, 0, 0, 0}, {-1.5, 1, 0, 0}, {-1, 0, 0, 0}}, repeats),
                              [](std::size_t) { return ""; }));
  EXPECT_EQ(error_of_file("-2 0 0 0\n1e-9 1 0 0\n"), "");
}

TEST(motion_table, reads_a_file_with_comments_and_commas)
{
  const TempDir folder;
  std::ofstream(folder.path("arm.txt")) << "# t x y z\n0 0 0 0\r\n\n 0.5,\t1, 2,3 # up\n2 1e0 -2 3";
  const MotionTable read = read_motion_table(folder.path("arm.txt"), {});
  EXPECT_TRUE(read.rows() == rows_of({{0, 0, 0, 0}, {0.5, 1, 2, 3}, {2, 1, -2, 3}}));
}

TEST(motion_table, of_a_spreadsheet_may_begin_with_a_byte_order_mark)
{
  const TempDir folder;
  std::ofstream(folder.path("arm.csv")) << "\xEF\xBB\xBF"
                                        << "0,0,0,0\r\n1,2,3,4\r\n";
  EXPECT_TRUE(read_motion_table(folder.path("arm.csv"), {}).rows() ==
              rows_of({{0, 0, 0, 0}, {1, 2, 3, 4}}));
}

// Without y a displacement and a quaternion would be a displacement and a rotation vector.
TEST(motion_table, has_no_field_without_a_number)
{
  for (const char *const text :
       {"0,0,,0,1,0,0,0\n1,1,,0,1,0,0,0\n", "# t,x,y,z\n0,1,2,3,\n1,1,2,3,\n",
        "0,1,2,3\n ,1,2,3,4\n", "0,1,2,3\n1,2,3,4\n,\n"})
    EXPECT_TRUE(says(error_of_file(text), {"there is nothing before or behind one of the commas"}))
        << text;
}

TEST(motion_table, names_the_line_of_a_file_that_is_wrong)
{
  EXPECT_TRUE(says(error_of_file("t x y z\n0 0 0 0\n"),
                   {"arm.txt' line 1", "'t' is not a number; begin a line of text with #"}));
  EXPECT_TRUE(says(error_of_file("# t x\n\n0 0 0 0\n1 2 3\n"),
                   {"arm.txt' line 4", "the row has 3 numbers, and that of line 3 has 4"}));
  EXPECT_TRUE(says(error_of_file("0 0 0 0\n# half way\n1 0 0 0\n0.5 0 0 0\n"),
                   {"arm.txt' line 4",
                    "the time 0.5 is not after that of the row before, 1: times must ascend"}));
  EXPECT_TRUE(says(error_of_file("# nothing\n"), {"arm.txt'", "has no rows"}));
  EXPECT_TRUE(says(lsdcd::error_of([] { read_motion_table("no/such/table", {}); }),
                   {"'no/such/table'", "cannot read the table"}));
}

}    // namespace
}    // namespace lsdcd::test_motion_table
