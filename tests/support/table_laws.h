// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Contact laws of the rows of the table of sub-models, for tests that go through all of it.
#pragma once

#include "law/make_law.h"

#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace lsdcd {

using LawRows = std::vector<
    const SubModel *>;    // a style, or a normal sub-model and others; null: none of its family

// A number of a sub-model: NaN where it can be derived.
inline Real number_of(const Parameter &p, bool can_be_derived)
{
  static const std::map<std::string, Real> by_unit = {{"of the damping", 0.4},
                                                      {"0 or 1", 1},
                                                      {"1", 0.3},
                                                      {"1 or 1.5", 1.5},
                                                      {"multiple of 0.5", 2},
                                                      {"force", -0.5},
                                                      {"force/length^n", 1e4},
                                                      {"length", 0.3},
                                                      {"degrees", 20},
                                                      {"volume", 1e-3},
                                                      {"force/mass", 5},
                                                      {"force/length", 1e3},
                                                      {"force/length^2", 1e5},
                                                      {"pressure", 1e5},
                                                      {"1/time", 20},
                                                      {"1/(time length)", 20},
                                                      {"mass/time", 2},
                                                      {"energy/length^2", 5},
                                                      {"energy/volume", 200},
                                                      {"torque/angle", 30},
                                                      {"torque time/angle", 2},
                                                      {"power/(length temperature)", 3},
                                                      {"power/(length^2 temperature)", 3}};
  if (p.may_be_null && can_be_derived) return NAN;
  if (p.name == std::string("F0")) return 0.5;
  if (p.name == std::string("delta")) return 0.01;    // a reach that grains leave
  if (p.unit == std::string("force/length") &&
      (p.name == std::string("gamma") || p.name == std::string("K")))
    return 2;    // a pull that lets grains come apart
  if (p.name == std::string("kp"))
    return 4e3;    // the stiffness of unloading, above that of loading
  if (p.name == std::string("py")) return 1e3;    // so that it yields
  const auto found = by_unit.find(p.unit);
  if (found == by_unit.end())
    throw std::logic_error("name the unit '" + std::string(p.unit) + "' in table_laws.h");
  return found->second;
}

inline std::string name_of(const LawRows &rows)
{
  std::string name;
  for (const SubModel *row : rows)
    if (row) name += std::string(family_word(row->family)) + " " + row->name + ", ";
  return name;
}

// Returns the law of these rows; none where they do not go together.
inline std::optional<ContactLaw> law_of_rows(const LawRows &rows, bool limit_damping = false)
{
  LawDraft draft = {granular_law(NormalModel::hooke)};
  for (const SubModel *row : rows) {
    if (!row) continue;
    std::vector<Real> numbers;
    for (const Parameter &p : row->parameters)
      numbers.push_back(number_of(p, can_derive(*row, draft)));
    add_sub_model(*row, numbers, draft);
  }
  draft.law.limit_damping = limit_damping;
  try {
    finish_law(draft);
  } catch (const LawError &) {
    return std::nullopt;
  }
  return draft.law;
}

// The rows of a family, and null where it may be left out.
inline LawRows choices_of(Family family)
{
  LawRows rows = sub_models(family);
  if (family == Family::cohesion) rows.push_back(nullptr);
  return rows;
}

// Calls act(law, rows) for each law that can be made of the table.
template <class Act>
void each_law_of_table(const Act &act)
{
  const auto both = [&](const LawRows &rows) {
    for (const bool limit : {false, true})
      if (const std::optional<ContactLaw> law = law_of_rows(rows, limit)) act(*law, rows);
  };
  for (const SubModel *rolling : choices_of(Family::rolling))
    for (const SubModel *cohesion : choices_of(Family::cohesion)) {
      for (const SubModel *style : choices_of(Family::style)) both({style, rolling, cohesion});
      for (const SubModel *normal : choices_of(Family::normal))
        for (const SubModel *damping : choices_of(Family::damping))
          for (const SubModel *tangential : choices_of(Family::tangential))
            for (const SubModel *twisting : choices_of(Family::twisting))
              for (const SubModel *heat : choices_of(Family::heat))
                both({normal, damping, tangential, rolling, twisting, heat, cohesion});
    }
}

}    // namespace lsdcd
