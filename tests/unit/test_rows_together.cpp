// Which lane of a warp reads which word of 32 three-vectors, and hands it to whom: what the
// lanes of a GPU do, played through with an array for what each of them holds.
#include "parallel/rows_together.h"

#include <gtest/gtest.h>

using namespace lsdcd;

namespace {

constexpr int kLanes = WarpWords::kLanes;

// Component c of row r.
Real number(int r, int c)
{
  return 10 * r + c;
}

// What the lanes hold once each has read its three words.
struct Words {
  Real of[kLanes][3];
};
Words read_all()
{
  Words words;
  for (int lane = 0; lane < kLanes; lane++)
    for (int r = 0; r < 3; r++)
      words.of[lane][r] = number(WarpWords::row(lane, r), WarpWords::component(lane, r));
  return words;
}

TEST(rows_together, neighbours_read_neighbouring_words)
{
  for (int r = 0; r < 3; r++)
    for (int lane = 0; lane < kLanes; lane++)
      EXPECT_EQ(3 * WarpWords::row(lane, r) + WarpWords::component(lane, r), kLanes * r + lane);
}

TEST(rows_together, every_lane_is_handed_its_own_row)
{
  const Words words = read_all();
  for (int c = 0; c < 3; c++) {
    Real given[kLanes];
    for (int lane = 0; lane < kLanes; lane++)
      given[lane] = words.of[lane][WarpWords::word_given(lane, c)];
    for (int lane = 0; lane < kLanes; lane++)
      EXPECT_EQ(given[WarpWords::lane_with(lane, c)], number(lane, c)) << lane << " " << c;
  }
}

TEST(rows_together, what_lanes_hand_back_goes_to_the_words_that_they_were_handed)
{
  Words sum = {};
  for (int c = 0; c < 3; c++)
    for (int lane = 0; lane < kLanes; lane++)
      sum.of[lane][WarpWords::word_given(lane, c)] += number(WarpWords::row_given(lane, c), c);
  const Words words = read_all();
  for (int lane = 0; lane < kLanes; lane++)
    for (int r = 0; r < 3; r++) EXPECT_EQ(sum.of[lane][r], words.of[lane][r]) << lane << " " << r;
}

TEST(rows_together, of_a_host_are_those_of_one_sphere)
{
  const Real read[] = {1, 2, 3, 4, 5, 6};
  const RowsTogether rows(1);
  EXPECT_TRUE(rows.read(Rows<const Real>(read)) == (Vec3{4, 5, 6}));
  Real a[] = {0, 0, 0, 10, 20, 30}, b[] = {0, 0, 0, 1, 2, 3};
  rows.add(Rows<Real>(a), {1, 2, 3}, Rows<Real>(b), {4, 5, 6}, false);
  EXPECT_EQ(a[3] + b[3], 11);
  rows.add(Rows<Real>(a), {1, 2, 3}, Rows<Real>(b), {4, 5, 6}, true);
  EXPECT_TRUE(Rows<Real>(a)[1] == (Vec3{11, 22, 33}));
  EXPECT_TRUE(Rows<Real>(b)[1] == (Vec3{5, 7, 9}));
  EXPECT_TRUE(Rows<Real>(a)[0] == (Vec3{0, 0, 0}));
}

}    // namespace
