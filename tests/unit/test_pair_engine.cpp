// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Memory for what pairs of a step keep, of an engine in the memory of a backend.
#include "backend/backend_cpu.h"
#include "base/packed_integer.h"
#include "pair/pair_engine_on.h"
#include "support/grain_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd::test_pair_engine {

constexpr int kGrains = 3000, kListed = 2;
constexpr Real kDt = 1e-3, kStiffness = 1000, kShear = 300, kSpeed = 0.1;

// A row of spheres with a diameter of 1, of which the list has the two behind each. Neighbours slide along each other at 2 kSpeed.
struct Row : GrainRows {
  explicit Row(std::size_t most_bytes) :
      GrainRows(kGrains, kListed), engine(CpuBackend(), most_bytes)
  {
    ContactLaw law = classic_law(NormalModel::hooke, true);
    law.k_normal = kStiffness;
    law.k_tangent = kShear;
    law.mu = 100;    // nothing slips
    engine.set_laws({{law}, {0, 0, 0, 0}, 2, 3});
    for (int i = 0; i < kGrains; i++) {
      v[3 * i + 1] = i % 2 ? kSpeed : -kSpeed;
      name[i] = i;
      length[i] = std::min(kListed, kGrains - 1 - i);
      for (int k = 0; k < kListed; k++) neighbor[kListed * i + k] = i + 1 + k;
    }
    engine.partners().grow(kGrains);
    engine.hand_out(list(), {{name.data(), false}});
  }

  // Gives it a law whose dashpot alone exceeds the limit of friction, by a fifth.
  void slip()
  {
    ContactLaw law = granular_law(NormalModel::hooke);
    law.k_normal = kStiffness;
    law.damping = DampingModel::velocity;
    law.eta = 30;
    law.tangential = TangentialModel::linear_history;
    law.k_tangent = kShear;
    law.xgammat = 1;
    law.mu = 0.5;
    engine.set_laws({{law}, {0, 0, 0, 0}, 2, 3});
  }

  void step(Real apart, bool update = true)
  {
    for (int i = 0; i < kGrains; i++) x[3 * i] = apart * i;
    PairInput s;
    give(s);
    s.dt = kDt;
    s.update = update;
    engine.run(s, nullptr);
  }

  PairEngineOn<CpuBackend> engine;
  std::vector<std::int32_t> name = std::vector<std::int32_t>(kGrains);
};

// The list is new while no pair touches; then all neighbours do, several steps in turn, and none again.
void check(Row &row)
{
  for (int round = 0; round < 3; round++) {
    row.step(1.01);
    for (const Real f : row.force) ASSERT_EQ(f, 0);
    for (int step = 1; step < 5; step++) {
      row.step(0.99);
      const Real slid = step * kDt * 2 * kSpeed;
      for (int i = 0; i < kGrains; i++) {
        const int both = (i > 0) + (i < kGrains - 1);
        const Real push = i == 0 ? -kStiffness : i == kGrains - 1 ? kStiffness : 0;
        // Places up to 3000 are rounded to 5e-13, and forces are of springs of stiffness 1000.
        ASSERT_NEAR(row.force[3 * i], 0.01 * push, 2e-9) << "round " << round << " step " << step;
        ASSERT_NEAR(row.force[3 * i + 1], (i % 2 ? -1 : 1) * both * kShear * slid, 1e-9);
      }
    }
  }
}

TEST(pair_engine, computes_all_pairs_where_there_is_room_for_all_of_a_list)
{
  Row row(1 << 20);
  check(row);
}

TEST(pair_engine, computes_all_pairs_where_more_touch_than_there_was_room_for)
{
  Row row(0);
  check(row);
}

// Forces after a setup, whose velocities are of another time than those of the steps, are those of a row without one.
TEST(pair_engine, moves_no_spring_in_a_setup)
{
  std::vector<Real> seen[2];
  for (const bool with_setup : {false, true}) {
    Row row(1 << 20);
    row.slip();
    for (int step = 0; step < 3; step++) row.step(0.99);
    if (with_setup) {
      for (Real &v : row.v) v *= 2;
      row.step(0.99, false);
      for (Real &v : row.v) v *= 0.5;
    }
    row.step(0.99);
    seen[with_setup] = row.force;
  }
  EXPECT_EQ(seen[0], seen[1]);
}

// Grain 1 leaves and grain 3 takes its place; grain 2 leaves from the end. A message has the offsets of both, then their partners; another
// one, which has grain 0 alone, comes behind it where they arrive.
TEST(pair_engine, packs_partners_as_the_host_of_a_gpu_sends_them)
{
  const std::vector<std::vector<Real>> of = {
      {1, 12, 1, 2, 3}, {2, 10, 4, 5, 6, 13, 7, 8, 9}, {0}, {1, 11, -4, -5, -6}};
  Partners partners({3}), arrived;
  partners.grow(4);
  for (int i = 0; i < 4; i++) partners.unpack(i, of[i].data());
  PairEngineOn<CpuBackend> from{CpuBackend()}, to{CpuBackend()};
  from.from_cpu(partners, 4);
  EXPECT_EQ(from.partners().largest_packed_size(4), 9);
  const int which[] = {1, 2}, comes[] = {3, -1}, first[] = {0}, stays[] = {-1};
  std::vector<Real> buffer(20, -7);
  ASSERT_EQ(from.partners().pack(2, which, comes, buffer.data()), 2 + 9 + 1);
  EXPECT_EQ(as_integer(buffer[0]), 2);
  EXPECT_EQ(as_integer(buffer[1]), 2 + 9);
  EXPECT_EQ(std::vector<Real>(buffer.begin() + 2, buffer.begin() + 11), of[1]);
  EXPECT_EQ(buffer[11], 0);
  EXPECT_EQ(buffer[12], -7);
  const auto packed = [&](int i) {
    std::vector<Real> numbers(static_cast<std::size_t>(arrived.packed_size(i)));
    arrived.pack(i, numbers.data());
    return numbers;
  };
  from.to_cpu(arrived, 4);
  EXPECT_EQ(packed(0), of[0]);
  EXPECT_EQ(packed(1), of[3]);
  for (int i : {2, 3}) EXPECT_EQ(packed(i), of[2]) << i;    // it has none
  ASSERT_EQ(from.partners().pack(1, first, stays, buffer.data() + 12), 1 + 5);
  const int places[] = {5, -1, 0};
  to.from_cpu(partners, 1);
  to.partners().grow(6);
  to.partners().unpack(3, places, buffer.data(), 2, 12);
  to.to_cpu(arrived, 6);
  EXPECT_EQ(packed(5), of[1]);
  EXPECT_EQ(packed(0), of[0]);
  for (int i = 1; i < 5; i++) EXPECT_EQ(arrived.count(i), 0) << i;
}

}    // namespace lsdcd::test_pair_engine
