// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "law/make_law.h"

#include "base/input_words.h"

#include <algorithm>

namespace lsdcd {

namespace {

template <class Model>
void choose(Chosen<Model> &chosen, const SubModel &row, const std::vector<Real> &given)
{
  chosen.model = static_cast<Model>(row.model);
  std::copy(given.begin(), given.end(), chosen.numbers);
}

}    // namespace

void add_sub_model(const SubModel &row, const std::vector<Real> &given, LawDraft &draft)
{
  if (row.family == Family::normal) draft.normal_name = row.name;
  if (row.family == Family::damping) draft.damping_name = row.name;
  if (row.set) return row.set(given.data(), draft);
  switch (row.family) {
    case Family::rolling:
      return choose(draft.law.rolling, row, given);
    case Family::twisting:
      return choose(draft.law.twisting, row, given);
    case Family::heat:
      return choose(draft.law.heat, row, given);
    default:
      return choose(draft.law.cohesion, row, given);
  }
}

bool can_derive(const SubModel &row, const LawDraft &draft)
{
  return row.family == Family::style || draft.young != 0;
}

void finish_granular(LawDraft &d)
{
  ContactLaw &law = d.law;
  const bool adhesive = law.is_adhesive();
  const std::string normal = "'" + std::string(d.normal_name) + "'";
  if (law.limit_damping && adhesive)
    throw LawError("limit_damping", "the adhesive sub-model " + normal + " must be able to pull");
  if (law.rolling.model == RollingModel::epsd2 && !law.has_spring())
    throw LawError("rolling", "epsd2 has the stiffness of the tangential sub-model: take one with "
                              "a history, or epsd");
  // The damping says what the second number of the normal sub-model is.
  law.eta = d.second;
  if (law.damping != DampingModel::stiffness) return;
  if (adhesive)
    throw LawError("damping", "the damping does not work with the adhesive sub-model " + normal);
  const bool exact = d.damping_name == std::string("coeff_restitution");
  if (d.second > 1 || (exact && d.second == 0))
    throw LawError("damping", "e = " + number_text(d.second) +
                                  " is out of range: it must be above 0 and at most 1, as the "
                                  "second number of the normal sub-model is the restitution");
  law.eta = exact ? restitution_damping(law.normal, d.second) : tsuji_damping(d.second);
}

}    // namespace lsdcd
