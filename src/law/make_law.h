// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A law is made of sub-models and their numbers.
#pragma once

#include "base/input_error.h"
#include "law/sub_models.h"

#include <string>
#include <vector>

namespace lsdcd {

// Sub-models that do not go together.
struct LawError : InputError {
  LawError(const std::string &field, const std::string &text) : InputError(text), field(field) {}
  std::string
      field;    // "normal", "damping", "limit_damping", "rolling" or "cohesion": which of them to change
};

// Adds a sub-model to the draft. `given`: a number for each parameter, NaN where it is derived.
void add_sub_model(const SubModel &row, const std::vector<Real> &given, LawDraft &draft);
// Returns whether a parameter of this row can be derived from what the draft has: mindlin's kt needs E and nu,
// and the second angle of a bridge nothing.
bool can_derive(const SubModel &row, const LawDraft &draft);
// Resolve what depends on several sub-models, once all are there: of any law, and of one of `granular`. Throw LawError.
void finish_law(LawDraft &draft);
void finish_granular(LawDraft &draft);
// Returns the row of the damping, which the normal sub-model, the first one, says where there is none.
const SubModel &damping_of(const std::vector<GivenSubModel> &sub_models);
// Returns the law of these sub-models, a classic style or the normal one first. Throws LawError.
ContactLaw make_law(const std::vector<GivenSubModel> &sub_models, bool limit_damping);

// Throws LawError if the law has a dashpot that is given as a part of the critical one, as by a restitution, and if it would be another
// part in these units. `acceleration`: that of a mass of 1 by a force of 1, in units of velocity/time.
void check_dashpots(const ContactLaw &law, Real acceleration);

}    // namespace lsdcd
