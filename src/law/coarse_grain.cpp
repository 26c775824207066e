// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "law/coarse_grain.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "law/make_law.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

// "rolling sds", "hertz"
std::string name_of(const SubModel &row)
{
  const std::string family = family_word(row.family);
  return family + (family.empty() ? "" : " ") + row.name;
}

Real scaled(Real number, Real scale, Real power)
{
  return power == 0 ? number : number * std::pow(scale, power);
}

}    // namespace

Real power_of_number(const std::vector<GivenSubModel> &sub_models, const GivenSubModel &given,
                     std::size_t k)
{
  const std::vector<Parameter> &all = given.row->parameters;
  const Real power = all[k].power;
  if (power == kPowerOfDamping) return damping_of(sub_models).second;
  if (power != kPowerByExponent) return power;
  const auto n = std::find_if(all.begin(), all.end(),
                              [](const Parameter &p) { return p.name == std::string("n"); });
  return 2 - given.numbers[static_cast<std::size_t>(n - all.begin())];
}

std::vector<GivenSubModel> coarse_grained(const std::vector<GivenSubModel> &sub_models, Real scale)
{
  std::vector<GivenSubModel> made = sub_models;
  if (scale == 1) return made;
  for (GivenSubModel &given : made)
    for (std::size_t k = 0; k < given.numbers.size(); k++) {
      const Real power = power_of_number(sub_models, given, k);
      if (power == kNoPower)
        throw InputError("in 'coarse_grain', nothing is known of how the number " +
                         std::string(given.row->parameters[k].name) + " of '" +
                         name_of(*given.row) +
                         "' changes with the size of the grains: leave coarse_grain out, and give "
                         "all numbers for the larger grains");
      given.numbers[k] = scaled(given.numbers[k], scale, power);
    }
  return made;
}

std::string coarse_grain_text(const std::vector<GivenSubModel> &sub_models, Real scale)
{
  std::string text;
  if (scale == 1) return text;
  for (const GivenSubModel &given : sub_models)
    for (std::size_t k = 0; k < given.numbers.size(); k++) {
      const Real number = given.numbers[k];
      const Real power = power_of_number(sub_models, given, k);
      if (power == 0 || number == 0 || std::isnan(number)) continue;
      const bool is_first =
          given.row->family == Family::style || given.row->family == Family::normal;
      const std::string name = given.row->parameters[k].name;
      text += (text.empty() ? "" : ", ") + (is_first ? "" : name_of(*given.row) + " ") +
              name.substr(0, name.find('|')) + " " + number_text(number) + " becomes " +
              number_text(scaled(number, scale, power));
    }
  return text;
}

std::string coarse_grain_line(Real scale, const std::vector<CoarseGrained> &laws)
{
  std::vector<CoarseGrained> told;
  for (const CoarseGrained &law : laws)
    if (!law.text.empty() && std::none_of(told.begin(), told.end(), [&](const CoarseGrained &t) {
          return t.text == law.text;
        }))
      told.push_back(law);
  std::string all;
  for (const CoarseGrained &law : told)
    all += (told.size() > 1 ? law.of + ": " : "") + law.text + "; ";
  return "coarse_grain " + number_text(scale) + ": " +
         (all.empty() ? "all numbers stay" : all + "other numbers stay");
}

}    // namespace lsdcd
