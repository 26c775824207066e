// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Memory for what pairs of a step keep, of an engine in the memory of a backend.
#include "backend/backend_cpu.h"
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
    engine.grow(kGrains);
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

}    // namespace lsdcd::test_pair_engine
