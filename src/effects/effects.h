// Every effect that a wall can have, and what it costs: the table behind `lsdcd effects`
// and ./run bench effects.
#pragma once

#include "engine/wall_engine.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace lsdcd {

// A wall with one effect more than another, or with several at once.
struct EffectCase {
  std::string name;
  std::string words;    // that turn it on
  std::string over;     // the case that lacks just this effect; empty: a combination, or the first
  EngineSettings settings;
};

// Parameters are nominal: what a contact costs does not depend on them.
std::vector<EffectCase> effect_cases();

// What a wall has on, for its log: what each keeps per contact beside the Spring that any
// law with history keeps, and the case of the table that it is.
struct Effect {
  std::string name;
  int bytes_per_contact;
  std::string kind;    // EffectCase::name; empty: its cost is in that of the first effect
};
std::vector<Effect> effects_of(const EngineSettings &settings);

// Costs that were measured on one core when this was built, ns per contact.
struct KeptCost {
  double ns, over_ns;    // of the case, and more than without its effect
};
const std::map<std::string, KeptCost> &kept_costs();    // by EffectCase::name
std::string kept_costs_where();                         // commit and device; empty: none are kept

// What is kept from step to step, exchanged and restarted.
int bytes_per_atom(const EngineSettings &settings);
int bytes_per_contact(const EngineSettings &settings);    // beside the atom's own

// Spheres on a floor of 20 000 triangles, each with one contact, in a step as the fix makes
// it. Cases take turns, so that what disturbs the machine disturbs all alike; the least of
// the times is nearest to the truth, since disturbances only add.
struct EffectCost {
  std::string device;
  int contacts, repeats;
  double median_ns, min_ns, max_ns;    // per contact
  std::size_t engine_bytes;            // held for all of them
};
std::vector<EffectCost> measure_effects(const std::vector<EffectCase> &cases, Device device,
                                        int n_spheres, int repeats);

// The least cost over that of the case that lacks the effect, ns; 0 where there is none.
double cost_over(const std::vector<EffectCase> &cases, const std::vector<EffectCost> &costs,
                 std::size_t i);

}    // namespace lsdcd
