// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/output_variables.h"

#include "base/input_error.h"
#include "base/input_words.h"

#include "input.h"
#include "lammps.h"
#include "variable.h"

#include <algorithm>
#include <cctype>

using namespace LAMMPS_NS;
using lsdcd::InputError;
using lsdcd::NamedElement;

OutputVariables::OutputVariables(LAMMPS *lmp, const std::string &reference) :
    lammps(lmp), reference(reference)
{
}

OutputVariables::~OutputVariables()
{
  Variable &all = *lammps->input->variable;
  for (const std::string &name : made)
    if (all.find(name.c_str()) >= 0) all.set(name + " delete");
}

static bool may_begin_variable(const std::string &word)
{
  return !word.empty() && std::all_of(word.begin(), word.end(),
                                      [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

void OutputVariables::make(const std::vector<std::string> &words,
                           const std::vector<NamedElement> &known, int row,
                           const std::function<std::string(const std::string &)> &why_not)
{
  if (words.size() < 3)
    throw InputError("in 'names', PREFIX and NAME are missing: names PREFIX NAME [NAME ...], or "
                     "names PREFIX all, make variables PREFIX_NAME");
  const std::string prefix = words[1];
  if (!may_begin_variable(prefix))
    throw InputError("in 'names', the prefix '" + prefix +
                     "' cannot begin the name of a variable: it must have letters, digits and "
                     "underscores alone");
  std::vector<NamedElement> wanted;
  if (words.size() == 3 && words[2] == "all") {
    wanted = known;
  } else
    for (auto word = words.begin() + 2; word != words.end(); ++word) {
      const auto is_it = [&](const NamedElement &one) { return one.name == *word; };
      const auto found = std::find_if(known.begin(), known.end(), is_it);
      if (found == known.end()) throw InputError("in 'names', " + why_not(*word));
      if (std::any_of(wanted.begin(), wanted.end(), is_it))
        throw InputError("in 'names', '" + *word + "' stands twice");
      wanted.push_back(*found);
    }
  Variable &variables = *lammps->input->variable;
  for (const NamedElement &one : wanted)
    if (variables.find((prefix + "_" + one.name).c_str()) >= 0)
      throw InputError("in 'names', there is a variable '" + prefix + "_" + one.name +
                       "' already: choose another prefix, or delete it before");
  for (const NamedElement &one : wanted) {
    std::string element;
    if (row > 0) element = "[" + std::to_string(row) + "]";
    if (one.column != NamedElement::kScalar) element += "[" + std::to_string(one.column + 1) + "]";
    const std::string name = prefix + "_" + one.name;
    variables.set(name + " equal " + reference + element);
    made.push_back(name);
  }
}

void OutputVariables::make(const std::vector<std::string> &words,
                           const std::vector<NamedElement> &known, int row)
{
  make(words, known, row, [&](const std::string &name) {
    std::vector<std::string> names;
    for (const NamedElement &one : known) names.push_back(one.name);
    return "there is no number '" + name + "': " + lsdcd::nearest_or_all(name, names);
  });
}
