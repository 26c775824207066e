// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/granular_words.h"

#include "law/make_law.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

std::string with_gap(const std::string &a, const std::string &b)
{
  return a.empty() || b.empty() ? a + b : a + " " + b;
}

// "tangential linear_history kt xgammat mu"
std::string words_of(const SubModel &row)
{
  return with_gap(family_word(row.family), syntax_of(row));
}

// "tangential linear_nohistory|linear_history|..."
std::string choices_of(Family family)
{
  return with_gap(family_word(family), names_text(family));
}

const Family kFamilies[] = {Family::damping,  Family::tangential, Family::rolling,
                            Family::twisting, Family::heat,       Family::cohesion};

const SubModel &read_name(Tokens &w, Family family)
{
  w.set_context(with_gap("granular", family_word(family)), choices_of(family));
  if (w.done()) w.fail("the name of the sub-model is missing");
  for (const SubModel *row : sub_models(family)) {
    if (w.peek() != row->name) continue;
    w.take();
    w.set_context(with_gap("granular", with_gap(family_word(family), row->name)), words_of(*row));
    return *row;
  }
  w.fail("'" + w.peek() + "' is not a sub-model");
}

// Calls read(family) for each sub-model that follows. Returns whether limit_damping does, too.
template <class Read>
bool read_families(Tokens &w, const Read &read)
{
  const std::vector<std::string> words = granular_families();
  std::vector<std::string> seen;
  bool limits = false;
  while (!w.done()) {
    const auto at = std::find(words.begin(), words.end(), w.peek());
    if (at == words.end()) break;
    const bool limit = w.take() == "limit_damping";
    w.set_context("granular " + *at, limit ? *at : choices_of(kFamilies[at - words.begin()]));
    if (std::count(seen.begin(), seen.end(), *at)) w.fail("it is given twice");
    seen.push_back(*at);
    limits |= limit;
    if (!limit) read(kFamilies[at - words.begin()]);
  }
  return limits;
}

// A number; NaN: NULL, where there may be one.
Real read_number(Tokens &w, const Parameter &p, bool may_be_null)
{
  const bool null = may_be_null && !w.done() && w.peek() == "NULL";
  const Real value = null ? NAN : w.number(p.name, p.least, p.most);
  if (null) w.take();
  if (p.is_flag && value != 0 && value != 1) w.fail(std::string(p.name) + " must be 0 or 1");
  return value;
}

// Of a wall and of two grains.
std::string sub_models_syntax()
{
  return "granular " + choices_of(Family::normal) +
         " ... tangential MODEL ... [damping MODEL] [rolling MODEL ...] [twisting MODEL ...] "
         "[heat MODEL ...] [cohesion MODEL ...] [limit_damping]";
}

// Which words an error of finish_granular() is about.
void finish(Tokens &w, LawDraft &d)
{
  try {
    finish_granular(d);
  } catch (const LawError &e) {
    if (e.field == "damping")
      w.set_context(std::string("granular damping ") + d.damping_name,
                    "granular hooke|hertz kn e, or hertz/material E e nu, with 0 < e <= 1");
    else
      w.set_context("granular " + e.field, sub_models_syntax());
    w.fail(e.what());
  }
}

}    // namespace

std::vector<Real> read_numbers(Tokens &w, const SubModel &row, LawDraft &d)
{
  std::vector<Real> given;
  for (const Parameter &p : row.parameters) {
    given.push_back(read_number(w, p, p.may_be_null));
    if (std::isnan(given.back()) && !can_derive(row, d))
      w.fail(std::string(p.name) +
             " can be NULL only where the normal sub-model has E and nu, not "
             "with '" +
             d.normal_name + "'");
  }
  add_sub_model(row, given, d);
  return given;
}

void read_sub_models_of_materials(Tokens &w, MaterialPair &pair)
{
  pair.limit_damping = read_families(w, [&](Family family) {
    GivenSubModel given = {&read_name(w, family), {}};
    for (const Parameter &p : given.row->parameters)
      given.numbers.push_back(read_number(w, p, p.may_be_null || p.property));
    pair.beside.push_back(given);
  });
}

std::vector<std::string> granular_families()
{
  std::vector<std::string> words;
  for (Family family : kFamilies) words.push_back(family_word(family));
  words.push_back("limit_damping");
  return words;
}

std::string granular_syntax()
{
  return sub_models_syntax() + " mesh FILE [keywords]";
}

std::string granular_help()
{
  std::string help;
  for (const SubModel &row : sub_models())
    if (row.family != Family::style) help += "    " + words_of(row) + "\n";
  return help;
}

ContactLaw read_granular(Tokens &w, std::string &text, std::vector<GivenSubModel> *given)
{
  LawDraft d;
  const auto read = [&](Family family) {
    const SubModel &row = read_name(w, family);
    const std::vector<Real> numbers = read_numbers(w, row, d);
    w.refuse_number();
    if (given) given->push_back({&row, numbers});
  };
  d.law = granular_law(NormalModel::hooke);
  const std::size_t first = w.at();
  read(Family::normal);
  bool has_tangential = false;
  d.law.limit_damping = read_families(w, [&](Family family) {
    read(family);
    has_tangential |= family == Family::tangential;
  });
  text = "granular " + w.between(first);

  if (!has_tangential) {
    w.set_context("granular", choices_of(Family::tangential));
    w.fail("the tangential sub-model is missing");
  }
  finish(w, d);
  return d.law;
}

}    // namespace lsdcd
