// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_sub_model_get_facts
#include "api/refusals.h"
#include "law/sub_models.h"

#include <cstddef>
#include <string>
#include <vector>

using namespace lsdcd;

extern "C" {

int lsdcd_sub_model_get_facts(size_t k, lsdcd_sub_model_facts *facts)
{
  return guard([&] {
    lsdcd_sub_model_facts f = checked(facts, "lsdcd_sub_model_facts");
    constexpr std::size_t kRoom = sizeof f.number / sizeof f.number[0];
    const std::vector<SubModel> &all = sub_models();
    if (k >= all.size())
      refuse_field("k", std::to_string(k),
                   "there are " + std::to_string(all.size()) + " sub-models, from 0");
    const SubModel &row = all[k];
    f.family = row.family == Family::style    ? "style"
               : row.family == Family::normal ? "normal"
                                              : family_word(row.family);
    f.name = row.name;
    f.source = row.help;
    f.beside_style = row.family == Family::style || is_beside_style(row.family);
    f.n = static_cast<int>(row.parameters.size());
    for (std::size_t i = 0; i < kRoom; i++) {
      const bool is_there = i < row.parameters.size();
      const Parameter none = {nullptr, nullptr, 0, 0};
      const Parameter &p = is_there ? row.parameters[i] : none;
      f.number[i] = p.name;
      f.unit[i] = p.unit;
      f.least[i] = p.least;
      f.most[i] = p.most;
      f.may_be_derived[i] = p.may_be_null;
    }
    copy_out(f, facts);
  });
}

}    // extern "C"
