// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// An effect added as doc/design.md tells, composed with the library's own sub-models and
// run by the library's own kernel.
#include "example_effect/saturating_damping.h"

#include "backend/backend_cpu.h"
#include "engine/broad_phase/selection_cpu.h"
#include "engine/on_backend/engine_on.h"
#include "engine/step/compile_law.h"
#include "engine/step/step_cpu.h"
#include "support/laws.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lsdcd::test_example_effect {
namespace {

// Step 2: a law that has it.
using SaturatingLaw = ContactModel<HookeNormal, SaturatingDamping, LinearNoHistory>;

// Step 3: the law, compiled for a kernel.
CompiledLaw<CpuBackend> compiled(const SaturatingLaw &law)
{
  return CompileLaw<CpuBackend, WallKernels::plain>{{false, false, false}}(law);
}

// Step 4: a closed form. One sphere on a floor, the force of one step.
Real force_at(Real v_normal, const CompiledLaw<CpuBackend> &law)
{
  Scene scene(floor_mesh(2, 2), 0.5, hooke(1));
  scene.use(std::make_unique<EngineOn<CpuBackend>>(EngineSettings(), law, CpuBackend()));
  scene.add_sphere({0.1, 0.2, 0.49}, 0.5, 2, {0, 0, v_normal});
  scene.compute(1e-4);
  EXPECT_EQ(scene.engine->results().totals().contacts, 1);
  return scene.force(0).z;
}

TEST(example_effect, damps_as_its_formula_says)
{
  const Real k = 1e4, gamma = 30, v0 = 0.2;
  const CompiledLaw<CpuBackend> law = compiled({{k}, {gamma, v0}, {0, 0}, false});
  for (const Real v : {-2.0, -0.2, -0.01, 0.0, 0.3})
    EXPECT_NEAR(force_at(v, law), k * 0.01 - 2 * gamma * v0 * v / (v0 + std::fabs(v)), 1e-9);
}

TEST(example_effect, keeps_nothing_that_it_does_not_need)
{
  const LawTraits traits = compiled({{1}, {1, 1}, {0, 0}, false}).traits;
  EXPECT_FALSE(traits.history || traits.heat || traits.contacts);
  EXPECT_EQ(traits.n_extra, 0);
}

}    // namespace
}    // namespace lsdcd::test_example_effect
