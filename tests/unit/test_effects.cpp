// The table of effects: what is kept for each, and what its measurement runs.
#include "effects/effects.h"
#include "support/laws.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <set>

namespace lsdcd {
namespace {

TEST(effects, have_a_name_each_and_stand_over_a_case_before_them)
{
  std::set<std::string> seen;
  for (const EffectCase &c : effect_cases()) {
    EXPECT_TRUE(c.over.empty() || seen.count(c.over)) << c.name << " over " << c.over;
    EXPECT_TRUE(seen.insert(c.name).second) << c.name;
    EXPECT_FALSE(c.words.empty());
  }
}

// What a step leaves behind is what the table says: the memory report of each effect.
TEST(effects, keep_the_bytes_of_the_table_and_no_others)
{
  constexpr int kSpheres = 300;
  for (const EffectCase &c : effect_cases()) {
    Scene scene(floor_mesh(8, 10), 0.7, c.settings);
    if (c.settings.law.has_heat()) continue;    // the scene's spheres have no temperature
    for (int i = 0; i < kSpheres; i++)
      scene.add_sphere({-9 + 1.1 * (i % 17), -9 + 1.0 * (i / 17), 0.495}, 0.5, 1, {0.1, 0, 0});
    scene.compute(1e-7);
    ASSERT_EQ(scene.engine->totals().contacts, kSpheres) << c.name;
    int kept = 0;
    for (int i = 0; i < kSpheres; i++)
      kept += scene.springs.packed_size(i) - 1;    // 7 + n_extra numbers each
    const bool history = c.settings.law.has_history();
    EXPECT_EQ(kept, history ? kSpheres * (7 + c.settings.law.n_extra()) : 0) << c.name;
    EXPECT_EQ(bytes_per_atom(c.settings), history ? 8 : 0) << c.name;
    EXPECT_EQ(bytes_per_contact(c.settings), history ? 56 + 8 * c.settings.law.n_extra() : 0)
        << c.name;
    EXPECT_EQ(scene.engine->n_records(), c.settings.records ? kSpheres : 0) << c.name;
  }
}

// What a wall has on is in the table, and the log can tell its cost.
TEST(effects, of_a_wall_are_kinds_of_the_table)
{
  std::set<std::string> kinds;
  for (const EffectCase &c : effect_cases()) kinds.insert(c.name);
  for (const EffectCase &c : effect_cases()) {
    int bytes = 0;
    bool itself = c.over.empty();
    for (const Effect &e : effects_of(c.settings)) {
      EXPECT_TRUE(e.kind.empty() || kinds.count(e.kind)) << e.kind;
      itself = itself || e.kind == c.name;
      bytes += e.bytes_per_contact;
    }
    EXPECT_TRUE(itself) << c.name;
    EXPECT_EQ(bytes, 8 * c.settings.law.n_extra()) << c.name;
  }
}

// An engine holds no array for an effect that is off.
TEST(effects, that_are_off_take_no_memory_of_the_engine)
{
  const std::vector<EffectCase> cases = effect_cases();
  const std::vector<EffectCost> costs = measure_effects(cases, Device::cpu, 500, 1);
  const std::size_t least = costs[0].engine_bytes;
  // As the engine grows its arrays: by an eighth more; two pools of four slots for each sphere
  // and 65536 to spare.
  const auto grown = [](std::size_t n) { return n + n / 8; };
  const std::size_t slots = 2 * grown(4 * 500 + 65536);
  for (std::size_t i = 0; i < cases.size(); i++) {
    const EngineSettings &s = cases[i].settings;
    const bool history = s.law.has_history();
    const std::size_t per_slot = history * (sizeof(Spring) + s.law.n_extra() * sizeof(Real)) +
                                 s.records * sizeof(ContactRecord);
    const std::size_t expected = least + slots * per_slot + history * 2 * 500 * sizeof(int) +
                                 s.law.has_heat() * grown(500) * sizeof(Real) +
                                 s.records * grown(500) * sizeof(int);
    const std::size_t records =
        s.records ? 1024 * sizeof(ContactRecord) : 0;    // grown by doubling
    EXPECT_GE(costs[i].engine_bytes, expected) << cases[i].name;
    EXPECT_LE(costs[i].engine_bytes, expected + records) << cases[i].name;
    EXPECT_EQ(costs[i].contacts, 500);
  }
}

}    // namespace
}    // namespace lsdcd
