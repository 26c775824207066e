// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/pair_words.h"

#include "base/input_words.h"
#include "input/granular_words.h"
#include "input/law_words.h"
#include "input/material_words.h"
#include "law/make_law.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <sstream>

namespace lsdcd {

namespace {

const char *const kSyntax =
    "pair_coeff I J NORMAL ... tangential MODEL ... [damping MODEL] [rolling MODEL ...] [twisting "
    "MODEL ...] [heat MODEL ...] [cohesion MODEL ...] [limit_damping] [cutoff C], or pair_coeff I "
    "J law STYLE numbers "
    "[cutoff C], or pair_coeff I J law material FILE A [on B] ... [cutoff C]";

const char *const kMaterialsSyntax =
    "pair_coeff I J law [granular] [hertz/material|jkr|dmt|hysteretic/edem|thornton] material FILE "
    "A [on B] [with "
    "[MATERIAL] KEY VALUE ...] [sub-models, NULL for a number of the file] [cutoff C]";
const MaterialWords kPairWords = {kScriptWords.on, kScriptWords.with, kMaterialsSyntax,
                                  kScriptWords.as_given};

// Words of LAMMPS's pair_style granular that this one does not serve, and why.
struct Refused {
  const char *word, *why;
};
constexpr Refused kRefused[] = {
    {"mdr",
     "'mdr' is not served: its force depends on all contacts of a grain at once, and is no law of "
     "one contact"},
    {"synchronized_verlet",
     "'synchronized_verlet' is not served, as walls do not have it: one law is for both"}};

void refuse(const std::vector<std::string> &words)
{
  for (const Refused &refused : kRefused)
    if (std::count(words.begin(), words.end(), refused.word))
      throw InputError(std::string(refused.why) +
                       ". For LAMMPS's own pair style write 'suffix off' before, and 'pair_style "
                       "granular'");
}

// Takes `cutoff C` out of the words.
Real take_cutoff(std::vector<std::string> &words)
{
  const auto at = std::find(words.begin(), words.end(), "cutoff");
  if (at == words.end()) return -1;
  const std::vector<std::string> value(std::next(at), words.end());
  Tokens w(value);
  w.set_context("cutoff", kSyntax);
  const Real cutoff = w.number("cutoff", 0);
  words.erase(at, at + 2);
  return cutoff;
}

// kn kt|NULL ... [limit_damping] [rolling MODEL ...] [cohesion MODEL ...]
void read_classic(Tokens &w, PairCoeff &coeff)
{
  LawDraft draft;
  const std::string name = w.done() ? "" : w.peek();
  for (const SubModel &row : sub_models()) {
    if (row.family != Family::style || row.name != name) continue;
    w.take();
    w.set_context(row.name, kSyntax);
    coeff.sub_models.push_back({&row, read_numbers(w, row, draft)});
  }
  if (coeff.sub_models.empty()) w.fail("'" + name + "' is not a contact style");
  while (!w.done()) {
    const std::string word = w.take();
    if (word == "limit_damping") {
      coeff.limit_damping = true;
      continue;
    }
    const Family family = word == family_word(Family::rolling)    ? Family::rolling
                          : word == family_word(Family::cohesion) ? Family::cohesion
                                                                  : Family::style;
    if (family == Family::style || w.done()) w.fail("'" + word + "' is not expected");
    const std::string model = w.take();
    const auto is_it = [&](const SubModel &row) {
      return row.family == family && row.name == model && model != "none";
    };
    const auto row = std::find_if(sub_models().begin(), sub_models().end(), is_it);
    if (row == sub_models().end()) w.fail("'" + model + "' is not a sub-model of " + word);
    w.set_context(word + " " + model, kSyntax);
    const std::vector<const SubModel *> beside = rows_beside_style(family);
    if (std::find(beside.begin(), beside.end(), &*row) == beside.end())
      w.fail("it acts beyond touch, as the styles hooke, hooke/history and hertz/history do not: "
             "write the sub-models of granular, as 'granular hooke ... cohesion " +
             model + "'");
    coeff.sub_models.push_back({&*row, read_numbers(w, *row, draft)});
  }
}

void read_granular(Tokens &w, PairCoeff &coeff)
{
  std::string text;
  coeff.limit_damping = read_granular(w, text, &coeff.sub_models).limit_damping;
  w.set_context("pair_coeff", kSyntax);
  if (!w.done()) w.fail("'" + w.peek() + "' is not expected");
  // Equal laws have equal lists: what is left out is there by default.
  std::vector<GivenSubModel> &all = coeff.sub_models;
  const auto is_none = [](const GivenSubModel &g) {
    return g.row->name == std::string("none") && g.row->family != Family::damping;
  };
  all.erase(std::remove_if(all.begin(), all.end(), is_none), all.end());
  const auto is_damping = [](const GivenSubModel &g) { return g.row->family == Family::damping; };
  if (std::any_of(all.begin(), all.end(), is_damping)) return;
  all.push_back({&damping_of(all), {}});
}

}    // namespace

PairCoeff read_pair_coeff(const std::vector<std::string> &given)
{
  std::vector<std::string> words = given;
  refuse(words);
  PairCoeff coeff;
  coeff.cutoff = take_cutoff(words);
  Tokens w(words);
  w.set_context("pair_coeff", kSyntax);
  if (w.done()) w.fail("the contact law is missing");
  const bool of_wall = w.peek() == "law";
  if (of_wall) w.take();
  if (of_wall && (w.done() || w.peek() != "granular")) {
    read_classic(w, coeff);
  } else {
    if (of_wall) w.take();
    read_granular(w, coeff);
  }
  law_of(coeff);    // throws where the sub-models do not go together
  return coeff;
}

std::string pair_coeff_syntax()
{
  return kSyntax;
}

bool has_pair_materials(const std::vector<std::string> &words)
{
  if (words.size() < 2 || words[0] != "law") return false;
  return words[1] == "material" || (words[1] == "granular" && words.size() > 3 &&
                                    (words[2] == "material" || words[3] == "material"));
}

std::vector<std::string> read_pair_materials(const std::vector<std::string> &words,
                                             const std::string &units, MaterialsRead &read)
{
  refuse(words);
  std::vector<std::string> of_wall(words.begin() + 1, words.end());
  const auto cutoff = std::find(of_wall.begin(), of_wall.end(), "cutoff");
  std::vector<std::string> rest(cutoff, of_wall.end());
  if (rest.size() > 2) rest.resize(2);
  of_wall.erase(cutoff, cutoff + static_cast<std::ptrdiff_t>(rest.size()));
  if (of_wall[0] == "material") of_wall.insert(of_wall.begin(), "granular");
  Tokens w(of_wall);
  WallMaterials materials;
  read_wall_materials(w, of_wall, materials, kMaterialsSyntax, "the material of the other grain");
  w.set_context("pair_coeff ... material", kMaterialsSyntax);
  if (!materials.types.empty()) w.fail("the types are those before 'law': leave out 'types'");
  if (!w.done()) w.fail("'" + w.peek() + "' is not expected");
  const MaterialLaw made = law_of_materials(materials.pair, units, kPairWords);
  read = {made.report, made.files};
  std::istringstream text(made.name);
  std::vector<std::string> all = {"law"};
  all.insert(all.end(), std::istream_iterator<std::string>(text), {});
  all.insert(all.end(), rest.begin(), rest.end());
  return all;
}

}    // namespace lsdcd
