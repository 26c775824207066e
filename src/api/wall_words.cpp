// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_wall_*: a wall is made and changed by the words of the fix; the keywords of these words.
#include "api/objects.h"
#include "api/refusals.h"
#include "api/wall_handle.h"
#include "base/input_words.h"
#include "input/keywords.h"
#include "input/program_words.h"
#include "input/wall_change.h"
#include "input/wall_command.h"
#include "wall/spec/run_files.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

using namespace lsdcd;

namespace {

ProgramValue value_of(const lsdcd_value &given, const std::string &field)
{
  if (!given.name) refuse_field(field + ".name", "null", "give a name, without $");
  ProgramValue value;
  value.name = given.name;
  using Kind = ProgramValue::Kind;
  const Kind kinds[] = {Kind::numbers, Kind::mesh, Kind::rows, Kind::text};
  value.kind = kinds[checked_choice(
      given.kind, field + ".kind", 4,
      "LSDCD_VALUE_NUMBERS, LSDCD_VALUE_MESH, LSDCD_VALUE_ROWS or LSDCD_VALUE_TEXT")];
  if (value.kind == Kind::text) {
    if (!given.text) refuse_field(field + ".text", "null", "give a text");
    value.text = given.text;
  } else if (value.kind == Kind::mesh) {
    if (!given.mesh) refuse_field(field + ".mesh", "null", "give a mesh");
    value.mesh = {given.mesh->in, &given.mesh->in->mesh};
    value.welded_vertex = {given.mesh->in, &given.mesh->in->welded_vertex};
    value.file = given.mesh->in->file;
  } else {
    if (given.n > 0 && !given.numbers)
      refuse_field(field + ".numbers", "null",
                   "give an array of " + std::to_string(given.n) + " numbers");
    value.numbers.assign(given.numbers, given.numbers + given.n);
    if (value.kind == Kind::numbers) return value;
    if (given.columns < 1 || given.n % static_cast<std::size_t>(given.columns) != 0)
      refuse_field(field + ".columns", std::to_string(given.columns),
                   "it is 1 or more and divides n, " + std::to_string(given.n) +
                       ", the numbers of all rows");
    value.columns = given.columns;
  }
  return value;
}

std::vector<ProgramValue> values_of(const lsdcd_value *values, std::size_t n)
{
  if (n > 0) need(values, "values");
  std::vector<ProgramValue> all;
  for (std::size_t k = 0; k < n; k++) all.push_back(value_of(values[k], element("values", k)));
  return all;
}

// Throws where an output would replace a file that a mesh was read from, in the first step of the wall or a later one.
void check_files(const std::vector<ProgramValue> &values, const WallSpec &wall)
{
  constexpr long long kBeforeAllSteps = 0;
  const std::vector<RunFile> files = files_of(wall);
  check_apart(files, "the wall", kBeforeAllSteps);
  for (const ProgramValue &value : values)
    for (const RunFile &file : files)
      if (!value.file.empty())
        check_apart(file, {"mesh", value.file}, "the mesh $" + value.name, kBeforeAllSteps);
}

// The text of a script's error, without the command that a program does not have.
std::string for_programs(std::string text)
{
  for (const char *const command : {"fix_modify ID ", "fix_modify "})
    for (std::size_t at; (at = text.find(command)) != std::string::npos;)
      text.erase(at, std::string(command).size());
  return text;
}

// Runs what reads words: what it refuses is an argument of the program.
template <class Read>
auto read_words(const Read &read)
{
  try {
    return read();
  } catch (const ApiError &) {
    throw;
  } catch (const InputError &e) {
    throw ApiError(LSDCD_ERROR_ARGUMENT, for_programs(e.what()));
  }
}

GivenWall read_wall(Host &host, const char *text, const std::vector<ProgramValue> &values,
                    const std::string &units, bool on_device)
{
  return read_words([&] {
    const ProgramWords words(text, values);
    const ProgramWall program = {words, on_device};
    MaterialsRead read;
    WallSpec spec =
        parse_wall(
            words.words(),
            [&](const WallMaterials &materials, const std::vector<MaterialPair> &pairs) {
              try {
                return read_laws(host, materials, pairs, units, read);
              } catch (const InputError &e) {    // of a file, as those of meshes
                throw ApiError(LSDCD_ERROR_INPUT, e.what());
              }
            },
            &program)
            .wall;
    check_files(values, spec);
    return GivenWall{spec, read.report};
  });
}

std::string units_of(const lsdcd_wall_options *options)
{
  return options && checked(options, "lsdcd_wall_options").units ? options->units : "si";
}

}    // namespace

extern "C" {

int lsdcd_wall_create(const char *words, const lsdcd_value *values, size_t n,
                      const lsdcd_wall_options *options, lsdcd_wall **wall)
{
  return guard([&] {
    need(words, "words");
    need(wall, "wall");
    const std::string units = units_of(options);
    *wall =
        make_wall(options, [&](lsdcd_wall &made) {
          return read_wall(made.caller, words, values_of(values, n), units, made.gpu != nullptr);
        }).release();
  });
}

int lsdcd_wall_check(const char *words, const lsdcd_value *values, size_t n,
                     const lsdcd_wall_options *options)
{
  return guard([&] {
    need(words, "words");
    const std::string units = units_of(options);
    lsdcd_wall_options o = {};
    if (options) o = *options;
    WallCaller caller(o);
    read_wall(caller, words, values_of(values, n), units, o.device == LSDCD_CUDA);
  });
}

int lsdcd_wall_change(lsdcd_wall *wall, const char *words, const lsdcd_value *values, size_t n)
{
  return guard_wall(wall, [&] {
    need(words, "words");
    const std::vector<ProgramValue> all = values_of(values, n);
    note_late(*wall);
    read_words([&] {
      const ProgramWords read(words, all);
      const std::vector<std::string> &arguments = read.words();
      const std::string syntax = "[mesh NAME] motion ..., servo ... or body ...";
      if (arguments.empty()) throw InputError("nothing is given to change: write " + syntax);
      const std::size_t taken = static_cast<std::size_t>(
          change_wall(*wall->in, arguments, {wall->number, wall->dt}, &read));
      if (taken == 0) throw InputError("'" + arguments[0] + "' is not expected: write " + syntax);
    });
  });
}

int lsdcd_keyword_get_facts(size_t k, lsdcd_keyword_facts *facts)
{
  return guard([&] {
    lsdcd_keyword_facts f = checked(facts, "lsdcd_keyword_facts");
    const std::vector<Keyword> &all = program_keywords();
    if (k >= all.size())
      refuse_field("k", std::to_string(k),
                   "there are " + std::to_string(all.size()) + " keywords, from 0");
    const Keyword &row = all[k];
    f.name = row.name;
    f.values = row.values;
    f.unit = row.unit;
    f.range = row.range;
    f.fallback = row.fallback;
    f.meaning = row.help;
    f.of_mesh = row.read_of_mesh != nullptr;
    f.repeats = row.repeats();
    copy_out(f, facts);
  });
}

int lsdcd_wall_set_input(lsdcd_wall *wall, const char *name, double value)
{
  return guard_wall(wall, [&] {
    need(name, "name");
    const InputNames &names = wall->in->spec().inputs;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw ApiError(LSDCD_ERROR_ARGUMENT,
                     "the wall reads no v_" + std::string(name) +
                         (std::string(name).rfind("v_", 0) == 0 ? ": the name is without v_"
                          : names.empty()                       ? ""
                                          : ": " + nearest_or_all(name, names)));
    checked_number(value, "value of v_" + std::string(name));
    wall->inputs.resize(names.size());
    const std::ptrdiff_t k = found - names.begin();
    wall->inputs[static_cast<std::size_t>(k)] = value;
    wall->poses.add(-1 - static_cast<int>(k), std::vector<Real>{value});
  });
}

int lsdcd_wall_get_mesh(lsdcd_wall *wall, const char *name, int *mesh)
{
  return guard_wall(wall, [&] {
    need(name, "name");
    need(mesh, "mesh");
    std::vector<std::string> names;
    for (const MeshPart &m : wall->in->meshes()) names.push_back(m.spec.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw ApiError(LSDCD_ERROR_ARGUMENT, "no mesh is called '" + std::string(name) +
                                               "': " + nearest_or_all(name, names));
    if (std::count(names.begin(), names.end(), name) > 1)
      throw ApiError(LSDCD_ERROR_ARGUMENT, "several meshes are called '" + std::string(name) +
                                               "': give them names by the keyword name");
    *mesh = static_cast<int>(found - names.begin());
  });
}

}    // extern "C"
