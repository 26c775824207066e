// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_law, of numbers and of materials, and lsdcd_sub_model_get_facts
#include "api/law_given.h"

#include "api/refusals.h"
#include "base/number_words.h"
#include "law/make_law.h"
#include "material/material_law.h"

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

const SubModel &row_of(Family family, bool is_classic, const std::string &name,
                       const std::string &field)
{
  if (is_classic && family != Family::style && !is_beside_style(family))
    refuse_field(field + ".name", in_quotes(name),
                 "leave it null, as there is none beside a style");
  std::vector<std::string> names;
  for (const SubModel *row : sub_models(family)) {
    if (row->name == name) return *row;
    names.push_back(row->name);
  }
  refuse_field(field + ".name", in_quotes(name), nearest_or_all(name, names));
}

// NaN: derived, or of the materials where there are some.
Real number_of(const SubModel &row, const Parameter &p, double value, bool has_materials,
               const std::string &field)
{
  const std::string what = std::string(p.name) + " of " + in_quotes(row.name);
  const bool may_be_derived = p.may_be_null || (has_materials && p.property);
  if (!std::isfinite(value)) refuse_field(field, value, what + " is a finite number");
  if (value == LSDCD_DERIVED && may_be_derived) return NAN;
  if (!(value >= p.least && value <= p.most))
    refuse_field(field, value,
                 what + " is " + range_text(p.least, p.most) +
                     (may_be_derived ? ", or LSDCD_DERIVED" : ""));
  if (p.is_flag && value != 0 && value != 1) refuse_field(field, value, what + " is 0 or 1");
  return value;
}

void check_unused(const lsdcd_sub_model &given, std::size_t n, const std::string &field,
                  const std::string &what)
{
  for (std::size_t k = n; k < kRoom; k++)
    if (given.numbers[k] != 0)
      refuse_field(element(field + ".numbers", k), given.numbers[k],
                   what + " has " + (n == 0 ? "no numbers" : counted(n, "number")) +
                       ", and the others stay 0");
}

// A sub-model with a name.
GivenSubModel sub_model_of(const lsdcd_sub_model &given, Family family, bool is_classic,
                           bool has_materials, const std::string &field)
{
  GivenSubModel out = {&row_of(family, is_classic, given.name, field), {}};
  for (const Parameter &p : out.row->parameters) {
    const std::size_t k = out.numbers.size();
    out.numbers.push_back(
        number_of(*out.row, p, given.numbers[k], has_materials, element(field + ".numbers", k)));
  }
  check_unused(given, out.numbers.size(), field, in_quotes(out.row->name));
  return out;
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
      if (e.field == "limit_damping") refuse_field(field_ + ".limit_damping", "1", e.what());
      refuse_field(field_ + "." + e.field + ".name",
                   in_quotes(e.field == "rolling" ? given_.rolling.name : draft_.damping_name),
                   e.what());
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
                   "give a style, " + names_text(Family::style) +
                       ", or the names of `normal` and `tangential`");
    if (!given_.tangential.name)
      refuse_field(field_ + ".tangential.name", "null",
                   "beside a normal sub-model give one of " + names_text(Family::tangential));
  }

  void add(Family family, const lsdcd_sub_model &given)
  {
    const std::string field = field_ + "." + field_of(family);
    if (!given.name) return check_unused(given, 0, field, "a sub-model without a name");
    const GivenSubModel model = sub_model_of(given, family, is_classic_, false, field);
    const SubModel &row = *model.row;
    if (!is_classic_)
      text_ +=
          " " + (*family_word(family) ? family_word(family) + std::string(" ") : "") + row.name;
    for (std::size_t k = 0; k < model.numbers.size(); k++) {
      const Real number = model.numbers[k];
      if (std::isnan(number) && !can_derive(row, draft_))
        refuse_field(element(field + ".numbers", k), "LSDCD_DERIVED",
                     std::string(row.parameters[k].name) + " of " + in_quotes(row.name) +
                         " is derived from E and nu, which the normal sub-model " +
                         in_quotes(draft_.normal_name) + " does not have: give a number");
      if (!is_classic_) text_ += " " + (std::isnan(number) ? "NULL" : number_text(number));
    }
    add_sub_model(row, model.numbers, draft_);
  }

  const lsdcd_law &given_;
  const std::string field_;
  const bool is_classic_;
  LawDraft draft_ = {granular_law(NormalModel::hooke)};
  std::string text_;
};

// ---- laws of materials ------------------------------------------------------------------------

const MaterialWords kStructWords = {"wall", "overrides", "", "as an override says"};

lsdcd_sub_model &field_in(lsdcd_law &law, Family family)
{
  switch (family) {
    case Family::style:
      return law.style;
    case Family::normal:
      return law.normal;
    case Family::damping:
      return law.damping;
    case Family::tangential:
      return law.tangential;
    case Family::rolling:
      return law.rolling;
    case Family::twisting:
      return law.twisting;
    case Family::heat:
      return law.heat;
    case Family::cohesion:
      break;
  }
  return law.cohesion;
}

// What a check that says InputError refuses is this field.
template <class Check>
void check_field(const std::string &field, const std::string &value, const Check &check)
{
  try {
    check();
  } catch (const InputError &e) {
    refuse_field(field, value, e.what());
  }
}

std::string text_of(const char *given, const std::string &field, const std::string &remedy)
{
  if (!given || !*given) refuse_field(field, given ? "\"\"" : "null", remedy);
  return given;
}

void read_overrides(const lsdcd_materials &given, MaterialPair &pair)
{
  if (given.n_overrides > 0 && !given.overrides)
    refuse_field("materials.overrides", "null",
                 "give an array of " + std::to_string(given.n_overrides) +
                     ", or say that there are 0");
  for (std::size_t k = 0; k < given.n_overrides; k++) {
    const std::string field = element("materials.overrides", k);
    const lsdcd_override &o = given.overrides[k];
    const Override made = {o.of ? o.of : "",
                           text_of(o.key, field + ".key", "give a property, as \"restitution\""),
                           o.value};
    if (!made.of.empty() && made.of != pair.particle && made.of != pair.wall)
      refuse_field(field + ".of", in_quotes(made.of),
                   "the materials are " + in_quotes(pair.particle) + " and " +
                       in_quotes(pair.wall) + "; or leave it null");
    for (const Override &earlier : pair.overrides)
      if (earlier.of == made.of && earlier.key == made.key)
        refuse_field(field + ".key", in_quotes(made.key), "it is given twice; leave one out");
    check_field(field, in_quotes(made.key), [&] { check_override(made); });
    pair.overrides.push_back(made);
  }
}

// Reads what an lsdcd_law says before it is filled.
void read_beside(lsdcd_law law, MaterialPair &pair)
{
  if (law.style.name)
    refuse_field(
        "law.style.name", in_quotes(law.style.name),
        "a style takes no materials, as its damping depends on the mass of grains: leave it "
        "null");
  check_unused(law.normal, 0, "law.normal", "a normal sub-model of materials");
  if (law.normal.name) {
    pair.normal = law.normal.name;
    check_field("law.normal.name", in_quotes(pair.normal),
                [&] { check_normal_of_materials(pair.normal); });
  }
  for (const Family family : {Family::style, Family::damping, Family::tangential, Family::rolling,
                              Family::twisting, Family::heat, Family::cohesion}) {
    const lsdcd_sub_model &given = field_in(law, family);
    const std::string field = std::string("law.") + field_of(family);
    if (given.name)
      pair.beside.push_back(sub_model_of(given, family, false, true, field));
    else
      check_unused(given, 0, field, "a sub-model without a name");
  }
  pair.limit_damping = checked_flag(law.limit_damping, "law.limit_damping");
}

lsdcd_sub_model struct_of(const GivenSubModel &model)
{
  lsdcd_sub_model out = {};
  out.name = model.row->name;
  for (std::size_t k = 0; k < model.numbers.size(); k++)
    out.numbers[k] = std::isnan(model.numbers[k]) ? LSDCD_DERIVED : model.numbers[k];
  return out;
}

}    // namespace

namespace lsdcd {

NamedLaw law_of(const lsdcd_law *given, const std::string &field)
{
  return LawMaker(checked(given, "lsdcd_law", field), field).make();
}

}    // namespace lsdcd

extern "C" {

int lsdcd_law_from_material(const lsdcd_materials *materials, lsdcd_law *law, const char **report)
{
  return guard([&] {
    const lsdcd_materials given = checked(materials, "lsdcd_materials", "materials");
    lsdcd_law out = checked(law, "lsdcd_law", "law");
    MaterialPair pair;
    pair.file = text_of(given.file, "materials.file", "give a file of materials");
    pair.particle = text_of(given.particle, "materials.particle", "give a material of the file");
    pair.wall = given.wall ? given.wall : pair.particle;
    read_overrides(given, pair);
    read_beside(out, pair);
    const MaterialLaw made = law_of_materials(pair, given.units ? given.units : "si", kStructWords);
    for (const GivenSubModel &model : made.sub_models)
      field_in(out, model.row->family) = struct_of(model);
    static thread_local std::string told;
    told = made.report;
    if (report) *report = told.c_str();
    copy_out(out, law);
  });
}

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
