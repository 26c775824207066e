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
  return with_gap(family_word(family), names_text(family, GoesWith::granular));
}

const Family kFamilies[] = {Family::damping, Family::tangential, Family::rolling, Family::twisting,
                            Family::heat};

void read_sub_model(Tokens &w, LawDraft &d, Family family)
{
  w.set_context(with_gap("granular", family_word(family)), choices_of(family));
  if (w.done()) w.fail("the name of the sub-model is missing");
  for (const SubModel *row : sub_models(family, GoesWith::granular)) {
    if (w.peek() != row->name) continue;
    w.take();
    w.set_context(with_gap("granular", with_gap(family_word(family), row->name)), words_of(*row));
    read_numbers(w, *row, d);
    return;
  }
  w.fail("'" + w.peek() + "' is not a sub-model");
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
      w.set_context("granular " + e.field, granular_syntax());
    w.fail(e.what());
  }
}

}    // namespace

void read_numbers(Tokens &w, const SubModel &row, LawDraft &d)
{
  std::vector<Real> given;
  for (const Parameter &p : row.parameters) {
    const bool null = p.may_be_null && !w.done() && w.peek() == "NULL";
    given.push_back(null ? NAN : w.number(p.name, p.least, p.most));
    if (p.is_flag && given.back() != 0 && given.back() != 1)
      w.fail(std::string(p.name) + " must be 0 or 1");
    if (!null) continue;
    w.take();
    if (!can_derive(row, d))
      w.fail(std::string(p.name) +
             " can be NULL only where the normal sub-model has E and nu, not "
             "with '" +
             d.normal_name + "'");
  }
  add_sub_model(row, given, d);
}

std::vector<std::string> granular_families()
{
  std::vector<std::string> words;
  for (Family family : kFamilies) words.push_back(family_word(family));
  words.push_back("limit_damping");
  return words;
}

const char *const kNoMaterialHere =
    "numbers are expected, not a material: write the material of a mesh as 'material NAME' after "
    "mesh "
    "FILE, and that of atom types as 'types I NAME' after granular material FILE PARTICLE";

std::string granular_syntax()
{
  return "granular " + choices_of(Family::normal) +
         " ... tangential MODEL ... [damping MODEL] [rolling MODEL ...] [twisting MODEL ...] "
         "[heat MODEL ...] [limit_damping] mesh FILE [keywords]";
}

std::string granular_help()
{
  std::string help;
  for (const SubModel &row : sub_models())
    if (row.with == GoesWith::granular) help += "    " + words_of(row) + "\n";
  return help;
}

ContactLaw read_granular(Tokens &w, std::string &text)
{
  LawDraft d;
  d.law = granular_law(NormalModel::hooke);
  const std::size_t first = w.at();
  if (!w.done() && w.peek() == "material") {
    w.set_context("granular", choices_of(Family::normal));
    w.fail(kNoMaterialHere);
  }
  read_sub_model(w, d, Family::normal);

  const std::vector<std::string> words = granular_families();
  std::vector<std::string> seen;
  const auto has = [&](const std::string &word) {
    return std::find(seen.begin(), seen.end(), word) != seen.end();
  };
  const std::string tangential = family_word(Family::tangential);
  while (!w.done()) {
    const auto at = std::find(words.begin(), words.end(), w.peek());
    if (at == words.end()) break;
    const bool limit = w.take() == "limit_damping";
    w.set_context("granular " + *at, limit ? *at : choices_of(kFamilies[at - words.begin()]));
    if (has(*at)) w.fail("it is given twice");
    seen.push_back(*at);
    if (limit)
      d.law.limit_damping = true;
    else
      read_sub_model(w, d, kFamilies[at - words.begin()]);
  }
  text = "granular " + w.between(first);

  if (!has(tangential)) {
    w.set_context("granular", choices_of(Family::tangential));
    w.fail("the tangential sub-model is missing");
  }
  finish(w, d);
  return d.law;
}

}    // namespace lsdcd
