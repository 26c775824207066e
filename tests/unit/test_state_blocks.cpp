// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers in blocks with names and versions: what was written comes back, and nothing else is taken for it.
#include "base/state_blocks.h"

#include "base/countable.h"
#include "support/says.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lsdcd::test_state_blocks {
namespace {

enum class Kind { none, some };

struct Part {
  Kind kind = Kind::none;
  bool is_on = false;
  std::int64_t step = 0;
  Vec3 at = {0, 0, 0};
  long double time = 0;
  std::string names[2];
  std::vector<Real> row;
};

template <class Numbers>
void each_number(Numbers &numbers, Part &p)
{
  numbers(p.kind, p.is_on, p.step, p.at, p.time, p.names, p.row);
}

Part some_part()
{
  Part p;
  p.kind = Kind::some;
  p.is_on = true;
  p.step = -(std::int64_t(1) << 53);
  p.at = {0.1, -0.2, 1e-310};
  p.time = 1 + 0x1p-60L;
  p.names[0] = "a name of more than twelve bytes";
  p.names[1] = "\xc3\xa9";
  p.row = {1, 2.5};
  return p;
}

std::vector<Real> numbers_of(const Part &part)
{
  State state("thing");
  state.add("part", 1, part);
  return state.numbers();
}

Part part_of(const std::vector<Real> &numbers)
{
  Part part;
  State("thing", numbers.data(), numbers.size()).read("part", 1, part);
  return part;
}

TEST(State, brings_back_every_bit)
{
  const Part was = some_part(), is = part_of(numbers_of(was));
  EXPECT_EQ(is.kind, was.kind);
  EXPECT_EQ(is.is_on, was.is_on);
  EXPECT_EQ(is.step, was.step);
  EXPECT_EQ(is.at, was.at);
  EXPECT_EQ(is.time, was.time);
  EXPECT_EQ(is.names[0], was.names[0]);
  EXPECT_EQ(is.names[1], was.names[1]);
  EXPECT_EQ(is.row, was.row);
}

// 30 letters are 5 numbers and their count.
TEST(State, packs_six_letters_in_a_number)
{
  StateWriter out;
  out(std::string(30, 'x'));
  EXPECT_EQ(out.all().size(), 6U);
}

std::string problem_of(const std::vector<Real> &numbers)
{
  return error_of([&] { part_of(numbers); });
}

TEST(State, that_is_cut_anywhere_is_refused)
{
  std::vector<Real> numbers = numbers_of(some_part());
  const std::size_t whole = numbers.size();
  while (!numbers.empty()) {
    numbers.pop_back();
    EXPECT_NE(problem_of(numbers), "") << numbers.size() << " of " << whole;
  }
}

const Real kBad[] = {-1, 0, 0.5, 7, 1e9, 0x1p53, 1e300, std::nan("")};

TEST(State, with_a_wrong_number_anywhere_is_refused)
{
  const std::vector<Real> whole = numbers_of(some_part());
  for (std::size_t at = 0; at < whole.size(); at++)
    for (const Real bad : kBad) {
      std::vector<Real> numbers = whole;
      numbers[at] = bad;
      if (bad != whole[at]) {
        EXPECT_NE(problem_of(numbers), "") << bad << " at " << at;
      }
    }
}

TEST(State, tells_that_a_number_was_damaged)
{
  std::vector<Real> numbers = numbers_of(some_part());
  numbers.back() = 2.25;
  EXPECT_EQ(problem_of(numbers),
            "the data of the thing are damaged: their checksum is not that of what was written");
}

// Counts and lengths may be anything: an error, or numbers of the size that there is, but nothing past the end.
TEST(StateReader, with_a_wrong_number_anywhere_reads_to_the_end_at_most)
{
  StateWriter out;
  out(some_part());
  for (std::size_t at = 0; at < out.all().size(); at++)
    for (const Real bad : kBad) {
      std::vector<Real> numbers = out.all();
      numbers[at] = bad;
      numbers.shrink_to_fit();    // for a sanitizer
      StateReader in(numbers.data(), numbers.size(), "the data");
      try {
        in.next<Part>();
        EXPECT_LE(in.left(), numbers.size());
      } catch (const StateError &e) {
        EXPECT_EQ(std::string(e.what()).substr(0, 8), "the data");
      }
    }
}

TEST(State, of_another_kind_program_or_version_or_without_a_block_is_refused)
{
  State later("thing");
  later.add("part", 3, some_part());
  const std::pair<std::vector<Real>, const char *> rows[] = {
      {State("other").numbers(), "these are data of the other, not of the thing"},
      {{-6, 1, 2, 3}, "the data of the thing are of a different program or version"},
      {later.numbers(),
       "the block 'part' in the data of the thing is of version 3, and this program knows it "
       "up to version 1"},
      {State("thing").numbers(), "the block 'part' in the data of the thing is missing"}};
  for (const auto &[numbers, text] : rows) EXPECT_EQ(problem_of(numbers), text);
}

TEST(State, refuses_a_block_that_is_too_long)
{
  State state("thing");
  state.add("number", 1, std::vector<Real>{1, 2});
  Real number = 0;
  EXPECT_THROW(state.read("number", 1, number), StateError);
}

TEST(State, has_blocks_in_blocks)
{
  State state("thing");
  for (const Real number : {3.0, 4.0}) {
    State mesh("thing");
    mesh.add("number", 1, number);
    state.add("mesh", 1, mesh);
  }
  const std::vector<Real> numbers = state.numbers();
  const State back("thing", numbers.data(), numbers.size());
  const std::vector<State> meshes = back.inside("mesh", 1);
  ASSERT_EQ(meshes.size(), 2U);
  Real number = 0;
  meshes[1].read("number", 1, number);
  EXPECT_EQ(number, 4);
  EXPECT_EQ(meshes[0].unread(), "'number' of mesh 1");
  EXPECT_EQ(meshes[1].unread(), "");
}

TEST(State, passes_over_blocks_that_nobody_asks_for_and_names_them)
{
  State state("thing");
  state.add("of a later version", 1, Real(1));
  state.add("part", 1, some_part());
  const std::vector<Real> numbers = state.numbers();
  const State back("thing", numbers.data(), numbers.size());
  Part part;
  back.read("part", 1, part);
  EXPECT_EQ(back.unread(), "'of a later version'");
}

// A restart file of LAMMPS has the number of bytes of a fix as an int, which 2^28 doubles pass.
TEST(Countable, is_an_int_or_an_error_that_tells_limit_and_remedy)
{
  EXPECT_EQ(countable((std::int64_t(1) << 31) - 1, "bytes", "use less"), 2147483647);
  const auto error = [](std::int64_t n) {
    return error_of([&] { countable(n, "bytes", "use less"); });
  };
  EXPECT_EQ(error((std::int64_t(1) << 28) * sizeof(double)),
            "2147483648 bytes are more than an int counts, 2147483647: use less");
  // A sum of ints that has passed the limit.
  EXPECT_EQ(error(std::int32_t(2000000000u + 2000000000u)),
            "more bytes than an int counts, 2147483647: use less");
}

}    // namespace
}    // namespace lsdcd::test_state_blocks
