// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The words of contact laws -> ContactLaw, by the rows of sub_models.h.
#pragma once

#include "base/input_words.h"
#include "law/sub_models.h"
#include "material/material_law.h"

#include <string>
#include <vector>

namespace lsdcd {

// Reads the numbers of one sub-model after its name, adds them to the draft, and returns them: NaN for NULL.
std::vector<Real> read_numbers(Tokens &w, const SubModel &row, LawDraft &draft);

// Reads after the word granular, up to the first word that belongs to no sub-model.
// `text` becomes what was read, for the log, and `given` the sub-models, the normal one first.
ContactLaw read_granular(Tokens &w, std::string &text, std::vector<GivenSubModel> *given = nullptr);

// Reads the sub-models beside a normal one that takes its numbers from materials: NULL is one of these, or derived.
void read_sub_models_of_materials(Tokens &w, MaterialPair &pair);

// For help and for errors: "granular NORMAL tangential MODEL [...]", the words that
// begin a family ("tangential"), and every sub-model with its parameters.
std::string granular_syntax();
std::vector<std::string> granular_families();
std::string granular_help();

}    // namespace lsdcd
