// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The table of effects: what is kept for each.
#include "effects/effects.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/table_laws.h"

#include <gtest/gtest.h>

#include <set>

namespace lsdcd::test_effects {
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

// A step leaves behind what the table says: the memory report of each effect.
TEST(effects, keep_the_bytes_of_the_table_and_no_others)
{
  constexpr int kSpheres = 300;
  for (const EffectCase &c : effect_cases()) {
    Scene scene(floor_mesh(8, 10), 0.7, c.settings, 4);    // a small grid: cells of 4
    if (c.settings.law().has_heat()) continue;    // the scene's spheres have no temperature
    for (int i = 0; i < kSpheres; i++)
      scene.add_sphere({-9 + 1.1 * (i % 17), -9 + 1.0 * (i / 17), 0.495}, 0.5, 1, {0.1, 0, 0});
    scene.compute(1e-7);
    ASSERT_EQ(scene.engine->results().totals().contacts, kSpheres) << c.name;
    int kept = 0;
    for (int i = 0; i < kSpheres; i++)
      kept += scene.springs.packed_size(i) - 1;    // 7 + n_extra numbers each
    const bool history = c.settings.law().has_history();
    EXPECT_EQ(kept, history ? kSpheres * (7 + c.settings.law().n_extra()) : 0) << c.name;
    EXPECT_EQ(bytes_per_atom(c.settings), history ? 8 : 0) << c.name;
    EXPECT_EQ(bytes_per_contact(c.settings), history ? 56 + 8 * c.settings.law().n_extra() : 0)
        << c.name;
    const bool records = c.settings.contacts || c.settings.bodies ||
                         c.settings.law().keeps_forces || c.settings.impact_speed > 0;
    EXPECT_EQ(scene.engine->results().n_contacts(), records ? kSpheres : 0) << c.name;
  }
}

// What the log says of each effect is all that a contact keeps beside its spring.
TEST(effects, have_bytes_that_add_up_to_those_of_a_contact)
{
  const auto check = [](const EngineSettings &s, const std::string &name) {
    int bytes = 0;
    for (const Effect &e : effects_of(s)) bytes += e.bytes_per_contact;
    EXPECT_EQ(bytes, 8 * s.law().n_extra()) << name;
  };
  each_law_of_table([&](const ContactLaw &law, const LawRows &rows) {
    EngineSettings s;
    s.law() = law;
    check(s, name_of(rows));
  });
  EngineSettings s;
  s.law() = *law_of_rows({sub_models(Family::style).front()});
  s.law().keeps_forces = true;
  check(s, "energy balance");
  s.law().keeps_at_nodes = true;
  check(s, "energy balance at nodes");
  s.law().keeps_losses = true;
  check(s, "losses at nodes");
}

std::vector<std::string> names_of(const EngineSettings &settings)
{
  std::vector<std::string> names;
  for (const Effect &e : effects_of(settings)) names.push_back(e.name);
  return names;
}

TEST(effects, that_a_wall_has_more_than_another_are_named_in_its_log)
{
  const std::vector<EffectCase> cases = effect_cases();
  for (const EffectCase &c : cases)
    for (const EffectCase &without : cases)
      if (c.over == without.name) {
        EXPECT_NE(names_of(c.settings), names_of(without.settings)) << c.name;
      }
}

// An engine holds no array for an effect that is off.
TEST(effects, that_are_off_take_no_memory_of_the_engine)
{
  constexpr int kSpheres = 500;
  std::size_t least = 0;    // of the first, which keeps nothing
  for (const EffectCase &c : effect_cases()) {
    Scene scene(floor_mesh(8, 30), 0.7, c.settings, 4);
    for (int i = 0; i < kSpheres; i++)
      scene.add_sphere({-20 + 1.1 * (i % 25), -20 + 1.1 * (i / 25), 0.495}, 0.5, 1);
    for (int step = 0; step < 2; step++) scene.compute(1e-7);    // the second pool, too
    ASSERT_EQ(scene.engine->results().totals().contacts, kSpheres) << c.name;
    const std::size_t bytes = scene.engine->bytes();
    if (least == 0) least = bytes;
    // As the engine grows its arrays: by an eighth more; two pools of four slots for each sphere
    // and 65536 to spare.
    const auto grown = [](std::size_t n) { return n + n / 8; };
    const std::size_t slots = 2 * grown(4 * kSpheres + 65536);
    const EngineSettings &s = c.settings;
    const bool history = s.law().has_history(), booked = s.law().keeps_forces,
               recorded = s.contacts || s.bodies || booked || s.impact_speed > 0;
    const std::size_t per_slot = history * (sizeof(Spring) + s.law().n_extra() * sizeof(Real)) +
                                 recorded * sizeof(StepContact);
    const std::size_t expected =
        least + slots * per_slot + history * 2 * grown(kSpheres) * sizeof(int) +
        s.law().has_heat() * grown(kSpheres) * sizeof(Real) +
        booked * grown(kSpheres) * (sizeof(EnergyRows) + 1) +
        recorded * grown(kSpheres) * sizeof(int) +
        (s.energy_places || s.impact_speed > 0) * grown(slots) * sizeof(EnergyRecord) +
        s.law().keeps_losses * grown(slots / 2) * sizeof(EndedContact);
    const std::size_t records =    // grown by doubling
        recorded ? 1024 * (sizeof(StepContact) + s.law().keeps_losses * sizeof(KeptLosses)) : 0;
    EXPECT_GE(bytes, expected) << c.name;
    EXPECT_LE(bytes, expected + records) << c.name;
  }
}

}    // namespace
}    // namespace lsdcd::test_effects
