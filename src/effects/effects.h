// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Every effect that a wall can have: the table behind `lsdcd effects`.
#pragma once

#include "engine/settings.h"

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

// Is it an effect of the contact law, which pairs of grains may have, too?
bool acts_on_pairs(const EngineSettings &settings);

// Parameters are nominal: the bytes and the cost of a contact do not depend on them.
std::vector<EffectCase> effect_cases();

// The effects of a wall, for its log, with what each stores per contact beside the Spring of a
// law with history.
struct Effect {
  std::string name;
  int bytes_per_contact;
};
std::vector<Effect> effects_of(const EngineSettings &settings);

// Bytes that are stored from step to step, exchanged and written to restart files.
int bytes_per_atom(const EngineSettings &settings);
int bytes_per_contact(const EngineSettings &settings);    // beside the atom's own

}    // namespace lsdcd
