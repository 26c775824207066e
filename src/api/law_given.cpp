// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_law and lsdcd_sub_model_get_facts
#include "api/law_given.h"

#include "api/refusals.h"
#include "law/make_law.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace lsdcd;

namespace {

constexpr std::size_t kRoom = sizeof lsdcd_sub_model::numbers / sizeof lsdcd_sub_model::numbers[0];

// A field of lsdcd_law has its family's word; style and normal have none in scripts.
const char *field_of(Family family)
{
  const bool has_word = family != Family::style && family != Family::normal;
  return has_word ? family_word(family) : family == Family::style ? "style" : "normal";
}

// Sub-models while a law is made of them.
class LawMaker {
 public:
  LawMaker(const lsdcd_law &given, const std::string &field) :
      given_(given), field_(field), is_classic_(given.style.name != nullptr)
  {
  }

  NamedLaw make()
  {
    check_style_or_normal();
    add(Family::style, given_.style);
    add(Family::normal, given_.normal);
    add(Family::tangential, given_.tangential);
    add(Family::damping, given_.damping);
    add(Family::rolling, given_.rolling);
    add(Family::twisting, given_.twisting);
    add(Family::heat, given_.heat);
    add(Family::cohesion, given_.cohesion);
    draft_.law.limit_damping = checked_flag(given_.limit_damping, field_ + ".limit_damping");
    if (is_classic_) return {draft_.law, given_.style.name};
    try {
      finish_granular(draft_);
    } catch (const LawError &e) {
      const bool limits = e.field == "limit_damping";
      refuse_field(field_ + "." + e.field + (limits ? "" : ".name"),
                   limits ? "1" : in_quotes(draft_.damping_name), e.what());
    }
    return {draft_.law, "granular" + text_ + (draft_.law.limit_damping ? " limit_damping" : "")};
  }

 private:
  void check_style_or_normal() const
  {
    const char *const normal = given_.normal.name;
    if (is_classic_ && normal)
      refuse_field(field_ + ".normal.name", in_quotes(normal),
                   "there is the style " + in_quotes(given_.style.name) +
                       ", too; give one of them");
    if (is_classic_) return;
    if (!normal)
      refuse_field(field_ + ".style.name", "null",
                   "give a style, " + names_text(Family::style, GoesWith::classic) +
                       ", or the names of `normal` and `tangential`");
    if (!given_.tangential.name)
      refuse_field(field_ + ".tangential.name", "null",
                   "beside a normal sub-model give one of " +
                       names_text(Family::tangential, GoesWith::granular));
  }

  const SubModel &row_of(Family family, const std::string &name, const std::string &field) const
  {
    const GoesWith with = is_classic_ ? GoesWith::classic : GoesWith::granular;
    std::vector<std::string> names;
    for (const SubModel &row : sub_models()) {
      if (row.family != family) continue;
      if (row.name == name && row.with == with) return row;
      if (row.name == name)
        refuse_field(field + ".name", in_quotes(name),
                     is_classic_ ? "it goes with a normal sub-model, and `style` is given"
                                 : "it goes with a style, and `normal` is given");
      if (row.with == with) names.push_back(row.name);
    }
    if (names.empty())
      refuse_field(field + ".name", in_quotes(name),
                   std::string("leave it null, as there is none beside a ") +
                       (is_classic_ ? "style" : "normal sub-model"));
    refuse_field(field + ".name", in_quotes(name), nearest_or_all(name, names));
  }

  void add(Family family, const lsdcd_sub_model &given)
  {
    const std::string field = field_ + "." + field_of(family);
    if (!given.name) return check_unused(given, 0, field, "a sub-model without a name");
    const SubModel &row = row_of(family, given.name, field);
    std::vector<Real> numbers;
    if (!is_classic_)
      text_ +=
          " " + (*family_word(family) ? family_word(family) + std::string(" ") : "") + row.name;
    for (const Parameter &p : row.parameters) {
      numbers.push_back(number_of(row, p, given.numbers[numbers.size()],
                                  element(field + ".numbers", numbers.size())));
      if (!is_classic_)
        text_ += " " + (std::isnan(numbers.back()) ? "NULL" : number_text(numbers.back()));
    }
    check_unused(given, numbers.size(), field, in_quotes(row.name));
    add_sub_model(row, numbers, draft_);
  }

  // NaN: derived.
  Real number_of(const SubModel &row, const Parameter &p, double value,
                 const std::string &field) const
  {
    const std::string what = std::string(p.name) + " of " + in_quotes(row.name);
    if (!std::isfinite(value)) refuse_field(field, value, what + " is a finite number");
    if (value == LSDCD_DERIVED && p.may_be_null) {
      if (!can_derive(row, draft_))
        refuse_field(field, "LSDCD_DERIVED",
                     what + " is derived from E and nu, which the normal sub-model " +
                         in_quotes(draft_.normal_name) + " does not have: give a number");
      return NAN;
    }
    if (!(value >= p.least && value <= p.most))
      refuse_field(field, value,
                   what + " is " + range_text(p.least, p.most) +
                       (p.may_be_null ? ", or LSDCD_DERIVED" : ""));
    if (p.is_flag && value != 0 && value != 1) refuse_field(field, value, what + " is 0 or 1");
    return value;
  }

  static void check_unused(const lsdcd_sub_model &given, std::size_t n, const std::string &field,
                           const std::string &what)
  {
    for (std::size_t k = n; k < kRoom; k++)
      if (given.numbers[k] != 0)
        refuse_field(element(field + ".numbers", k), given.numbers[k],
                     what + " has " + (n == 0 ? "no numbers" : std::to_string(n) + " numbers") +
                         ", and the others stay 0");
  }

  const lsdcd_law &given_;
  const std::string field_;
  const bool is_classic_;
  LawDraft draft_ = {granular_law(NormalModel::hooke)};
  std::string text_;
};

}    // namespace

namespace lsdcd {

NamedLaw law_of(const lsdcd_law *given, const std::string &field)
{
  return LawMaker(checked(given, "lsdcd_law", sizeof(lsdcd_law), field), field).make();
}

}    // namespace lsdcd

extern "C" {

int lsdcd_sub_model_get_facts(size_t k, lsdcd_sub_model_facts *facts)
{
  return guard([&] {
    lsdcd_sub_model_facts f = checked(facts, "lsdcd_sub_model_facts");
    const std::vector<SubModel> &all = sub_models();
    if (k >= all.size())
      refuse_field("k", std::to_string(k),
                   "there are " + std::to_string(all.size()) + " sub-models, from 0");
    const SubModel &row = all[k];
    f.field = field_of(row.family);
    f.name = row.name;
    f.source = row.help;
    f.beside_style = row.with == GoesWith::classic;
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
