// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/law_words.h"

#include "input/granular_words.h"
#include "law/coarse_grain.h"
#include "law/make_law.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

const char *const kLawOfTypesSyntax =
    "law [types I] STYLE numbers, of the wall's sub-models, with I as 2, 1*3, 2* or *";

namespace {

bool is_whole(const std::string &word, int *value)
{
  Real number = 0;
  if (!is_number(word, &number) || number < 1 || number > kAnyType - 1 ||
      number != std::floor(number))
    return false;
  *value = static_cast<int>(number);
  return true;
}

// The law takes from the wall what it leaves out itself. Beside `granular` only limit_damping may be left out.
void inherit(const ContactLaw &from, LawOfTypes &of)
{
  ContactLaw &law = of.law;
  const bool is_limited = from.limit_damping && !law.limit_damping;
  law.limit_damping = law.limit_damping || is_limited;
  if (is_limited && !law.is_classic()) of.name += " limit_damping";
  if (!law.is_classic()) return;
  if (!law.rolling.is_on()) law.rolling = from.rolling;
  if (!law.cohesion.is_on()) law.cohesion = from.cohesion;
}

// Makes a law of numbers that of larger grains. One of materials is, as it was read after the keyword.
void make_coarse(LawOfTypes &of, Real coarse_grain)
{
  if (coarse_grain == 1 || of.given.empty()) return;
  of.law = make_law(coarse_grained(of.given, coarse_grain), of.law.limit_damping);
  of.becomes = coarse_grain_text(of.given, coarse_grain);
}

}    // namespace

void read_types(Tokens &w, LawOfTypes &of)
{
  if (w.done()) w.fail("the atom types are missing after 'types'");
  of.first_type = 1;
  const std::string word = w.take();
  const std::size_t star = word.find('*');
  bool good;
  if (star == std::string::npos) {
    good = is_whole(word, &of.first_type);
    of.last_type = of.first_type;
  } else {
    const std::string from = word.substr(0, star), to = word.substr(star + 1);
    good = (from.empty() || is_whole(from, &of.first_type)) &&
           (to.empty() || is_whole(to, &of.last_type)) && of.first_type <= of.last_type;
  }
  if (!good) w.fail("'" + word + "' is not a range of atom types, such as 2, 1*3 or *");
}

std::string law_syntax()
{
  return names_text(Family::style) + " " + parameters_text(*sub_models(Family::style)[0]) +
         " [limit_damping] mesh FILE [keywords], or granular NORMAL ... mesh FILE [keywords]";
}

void read_law(Tokens &w, LawOfTypes &of, const std::string &syntax)
{
  if (w.done()) w.fail("the contact style is missing");
  of.name = w.peek();
  of.given.clear();
  if (of.name == "granular") {
    w.take();
    of.law = read_granular(w, of.name, &of.given);
    return;
  }
  for (const SubModel *row : sub_models(Family::style)) {
    if (of.name != row->name) continue;
    w.take();
    w.set_context(row->name, syntax);
    LawDraft draft;
    of.given.push_back({row, read_numbers(w, *row, draft)});
    if (!w.done() && w.peek() == "limit_damping") {
      draft.law.limit_damping = true;
      w.take();
    }
    w.refuse_number();
    of.law = draft.law;
    return;
  }
  w.fail("'" + of.name + "' is not a contact style");
}

std::vector<const SubModel *> rows_beside_style(Family family)
{
  std::vector<const SubModel *> rows = sub_models(family);
  const auto is_none = [](const SubModel *row) { return row->name == std::string("none"); };
  rows.erase(std::remove_if(rows.begin(), rows.end(),
                            [&](const SubModel *row) {
                              return is_none(row) ||
                                     (family == Family::cohesion &&
                                      acts_beyond_touch(static_cast<CohesionModel>(row->model)));
                            }),
             rows.end());
  return rows;
}

void read_beside_style(Tokens &w, LawOfTypes &of, Family family)
{
  if (!of.law.is_classic()) w.fail("beside granular it comes before mesh, as the other sub-models");
  const std::vector<const SubModel *> rows = rows_beside_style(family);
  std::vector<std::string> names;
  for (const SubModel *row : rows) names.push_back(row->name);
  LawDraft draft;
  draft.law = of.law;
  for (const SubModel *row : sub_models(family))
    if (!w.done() && w.peek() == row->name && w.peek() != "none" &&
        std::find(names.begin(), names.end(), w.peek()) == names.end())
      w.fail("'" + w.peek() +
             "' acts beyond touch, as the styles hooke, hooke/history and hertz/history do not: "
             "write the sub-models of granular, as 'granular hooke ... cohesion " +
             w.peek() + "' before mesh");
  const SubModel &row = *rows[w.choice(names)];
  of.given.push_back({&row, read_numbers(w, row, draft)});
  w.refuse_number();
  of.law = draft.law;
}

// The law of all types is that of those without a row of their own: it becomes the first row, wherever it stands.
void read_law_of_mesh(Tokens &w, MeshSpec &mesh, InputNames &)
{
  LawOfTypes of;
  const bool by_type = !w.done() && w.peek() == "types";
  if (by_type) {
    w.take();
    read_types(w, of);
  } else if (!mesh.laws.empty() && mesh.laws.front().first_type == 0) {
    w.fail("the mesh already has a law for all atom types");
  }
  if (w.is_near("material", 3)) {
    w.set_context("law' of mesh '" + mesh.file, kLawOfTypesSyntax);
    w.fail("numbers are expected, not a material: write the material of a mesh as 'material NAME' "
           "after mesh FILE, and that of atom types as 'types I NAME' after granular material FILE "
           "PARTICLE");
  }
  read_law(w, of, kLawOfTypesSyntax);
  while (of.law.is_classic() && !w.done()) {
    const bool rolls = w.peek() == family_word(Family::rolling);
    if (!rolls && w.peek() != family_word(Family::cohesion)) break;
    const bool twice = rolls ? of.law.rolling.is_on() : of.law.cohesion.is_on();
    w.set_context("law ... " + w.take(), kLawOfTypesSyntax);
    if (twice) w.fail("it is given twice");
    read_beside_style(w, of, rolls ? Family::rolling : Family::cohesion);
  }
  mesh.laws.insert(by_type ? mesh.laws.end() : mesh.laws.begin(), of);
}

void finish_laws(WallSpec &s)
{
  for (LawOfTypes &of : s.laws) make_coarse(of, s.coarse_grain);
  for (MeshSpec &mesh : s.meshes)
    for (LawOfTypes &of : mesh.laws) make_coarse(of, s.coarse_grain);
  for (MeshSpec &mesh : s.meshes)
    for (LawOfTypes &of : mesh.laws) inherit(s.law(), of);
  leave_out_zero_cohesion(s);
}

}    // namespace lsdcd
