// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/program_words.h"

#include "base/input_words.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

namespace lsdcd {

namespace {

constexpr char kMark = '$';

bool is_name(const std::string &name)
{
  return !name.empty() && std::all_of(name.begin(), name.end(),
                                      [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

// Throws where a value cannot stand in words.
void check_value(const ProgramValue &value)
{
  const std::string named = "the value '" + value.name + "'";
  if (!is_name(value.name))
    throw InputError(named + ": a name has letters, digits and _ alone, and no $");
  if (value.kind == ProgramValue::Kind::text && value.text.find(kMark) == 0)
    throw InputError(named + ": a text does not begin with $");
  const bool has_numbers =
      value.kind == ProgramValue::Kind::numbers || value.kind == ProgramValue::Kind::rows;
  if (has_numbers && value.numbers.empty()) throw InputError(named + " has no numbers");
  const bool may_be_null = value.kind == ProgramValue::Kind::numbers;
  for (std::size_t k = 0; k < value.numbers.size(); k++)
    if (!std::isfinite(value.numbers[k]) && !(may_be_null && std::isnan(value.numbers[k])))
      throw InputError(named + ": number " + std::to_string(k + 1) + " is " +
                       number_text(value.numbers[k]) + ", not finite");
}

}    // namespace

ProgramWords::ProgramWords(const std::string &text, const std::vector<ProgramValue> &values) :
    values_(values)
{
  for (std::size_t k = 0; k < values.size(); k++) {
    check_value(values[k]);
    if (find(values[k].name) != &values[k])
      throw InputError("there are two values '" + values[k].name + "'");
  }
  std::istringstream lines(text);
  std::vector<std::string> used;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line.substr(0, line.find('#')));
    for (std::string word; in >> word;) {
      if (word == "&") continue;    // at the end of a line of a script
      const std::size_t mark = word.find(kMark);
      if (mark == std::string::npos) {
        add(word);
        continue;
      }
      if (mark != 0) throw InputError("'" + word + "': $NAME is a word of its own");
      const std::string name = word.substr(1);
      const ProgramValue *const value = find(name);
      if (!value) {
        std::vector<std::string> names;
        for (const ProgramValue &one : values) names.push_back(one.name);
        throw InputError("'" + word + "': there is no value of this name" +
                         (names.empty() ? "" : ": " + nearest_or_all(name, names)));
      }
      used.push_back(name);
      const std::string before = words_.empty() ? "" : words_.back();
      const bool of_matrix = before == "matrix";
      if (value->kind == ProgramValue::Kind::numbers && before == "mesh")
        throw InputError("in 'mesh', " + word + " is numbers: make a mesh of them");
      if (value->kind == ProgramValue::Kind::text)
        add(value->text);
      else if (value->kind == ProgramValue::Kind::numbers ||
               (value->kind == ProgramValue::Kind::rows && of_matrix))
        add_numbers(*value);
      else
        add(word);
    }
  }
  for (const ProgramValue &value : values)
    if (std::find(used.begin(), used.end(), value.name) == used.end())
      throw InputError("the value '" + value.name + "' is given, and no word is $" + value.name +
                       (std::find(words_.begin(), words_.end(), value.name) == words_.end()
                            ? ""
                            : ": a value stands behind a $, and '" + value.name + "' is none"));
}

void ProgramWords::add(const std::string &word, const std::string &origin)
{
  words_.push_back(word);
  origins_.push_back(origin);
}

void ProgramWords::add_numbers(const ProgramValue &value)
{
  const std::string name = kMark + value.name;
  const std::size_t n = value.numbers.size(), columns = static_cast<std::size_t>(value.columns);
  if (value.kind == ProgramValue::Kind::rows && (columns != 4 || n != 12))
    throw InputError("in 'matrix', " + name + " has " + counted(n / columns, "row") + " of " +
                     counted(columns, "number") + ": give three rows of four");
  for (std::size_t k = 0; k < n; k++)
    add(std::isnan(value.numbers[k]) ? "NULL" : exact_text(value.numbers[k]),
        name + (n > 1 ? ", number " + std::to_string(k + 1) : ""));
}

const ProgramValue *ProgramWords::find(const std::string &name) const
{
  for (const ProgramValue &value : values_)
    if (value.name == name) return &value;
  return nullptr;
}

const ProgramValue *ProgramWords::value_of(const std::string &word) const
{
  return word.empty() || word[0] != kMark ? nullptr : find(word.substr(1));
}

void ProgramWords::put_into(WallSpec &wall) const
{
  std::ptrdiff_t n = 0;
  for (MeshSpec &mesh : wall.meshes) {
    n += put(mesh.motion);
    const ProgramValue *const value = value_of(mesh.file);
    if (!value) continue;
    n++;
    if (value->kind != ProgramValue::Kind::mesh)
      throw InputError(
          "in 'mesh', " + mesh.file + " is no mesh" +
          (value->kind == ProgramValue::Kind::text ? "" : ": make one of the numbers"));
    if (mesh.weld >= 0)
      throw InputError("in 'weld', the mesh " + mesh.file +
                       " was welded when it was made: leave the keyword out");
    if (mesh.name == mesh.file) mesh.name = value->name;
    mesh.file.clear();
    mesh.weld = 0;
    mesh.mesh = value->mesh;
    mesh.welded_vertex = value->welded_vertex;
  }
  check_put(n);
}

void ProgramWords::put_into(RigidMotion &motion) const
{
  check_put(put(motion));
}

std::ptrdiff_t ProgramWords::put(RigidMotion &motion) const
{
  std::ptrdiff_t n = 0;
  for (MotionTerm &term : motion.terms()) {
    const ProgramValue *const value = value_of(term.table_file);
    if (!value) continue;
    n++;
    const std::string word = term.table_file;
    if (value->kind != ProgramValue::Kind::rows)
      throw InputError("in 'motion', " + word + " has no rows of a table");
    TableRows rows;
    rows.options = term.table_options;
    rows.columns = value->columns;
    rows.numbers = value->numbers;
    term.table_file.clear();
    term.table = std::make_shared<const MotionTable>(rows, [&](std::size_t row) {
      return "in 'motion', row " + std::to_string(row + 1) + " of " + word;
    });
  }
  return n;
}

void ProgramWords::check_put(std::ptrdiff_t n) const
{
  std::ptrdiff_t marked = 0;
  std::string word;
  for (const std::string &one : words_)
    if (value_of(one)) {
      marked++;
      word = one;
    }
  if (marked > n)
    throw InputError(
        "'" + word +
        "' is a mesh or rows, which stand behind 'mesh', 'motion table' or 'matrix' alone");
}

}    // namespace lsdcd
