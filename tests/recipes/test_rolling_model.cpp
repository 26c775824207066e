// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The model that rolling_model.py adds: from the words of a script to the torque.
#include "effects/effects.h"
#include "input/wall_command.h"
#include "support/meshes.h"
#include "support/test_engine.h"

#include <gtest/gtest.h>

namespace lsdcd {
namespace {

EngineSettings of_words()
{
  EngineSettings s;
  s.law() = parse_wall({"granular", "hooke", "1e4", "0", "tangential", "linear_nohistory", "0", "0",
                        "rolling", "plastic", "50", "0.1", "mesh", "a.stl"})
                .wall.law();
  return s;
}

// An overlap of 0.01 presses with 100; the limit is 0.1 * 100 * 0.5 = 5.
TEST(recipe_rolling_model, gives_the_torque_of_its_formula)
{
  Scene scene(floor_mesh(2, 2), 0.5, of_words());
  scene.add_sphere({0.1, 0.2, 0.49}, 0.5, 2, {0, 0, 0}, {0, 3, 7});
  for (int step = 1; step <= 50; step++) {
    scene.compute(1e-3);
    // 50 * 3 * 1e-3 a step; rounding of one operation a step.
    EXPECT_NEAR(scene.torque(0).y, -std::min(0.15 * step, 5.0), 1e-14 * step);
    EXPECT_EQ(scene.torque(0).z, 0);
  }
}

TEST(recipe_rolling_model, is_known_to_log_exchange_and_restart)
{
  const EngineSettings s = of_words();
  EXPECT_EQ(effects_of(s).back().name, "plastic rolling");
  EXPECT_EQ(s.law().n_extra(), 3);
  EngineSettings sds = s;
  sds.law().rolling = RollingModel::sds;
  EXPECT_NE(s.law().history_kind(), sds.law().history_kind());
}

}    // namespace
}    // namespace lsdcd
