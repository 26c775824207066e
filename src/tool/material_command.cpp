// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "input/material_words.h"
#include "material/material_file.h"
#include "tool/mesh_json.h"

#include <cstdio>
#include <memory>
#include <sstream>

namespace lsdcd {

namespace {

const MaterialWords kWords = {"--on", "--with",
                              "lsdcd material FILE NAME [--on WALL] [--normal "
                              "hertz/material|jkr|dmt] [--with [MATERIAL] KEY VALUE ...]",
                              "as the options say"};

struct MaterialOptions {
  std::string file, name, wall, normal = "hertz/material", units = "si";
  std::vector<std::string> with;
  bool json = false;
};

nlohmann::json as_json(const std::vector<MaterialSection> &sections)
{
  nlohmann::json all = nlohmann::json::array();
  for (const MaterialSection &s : sections) {
    nlohmann::json properties = nlohmann::json::object();
    for (const Stated &v : s.stated)
      properties[v.property->name] = {
          {"value", v.value}, {"unit", v.property->unit}, {"source", v.source}};
    all.push_back(
        {{"first", s.first}, {"second", s.second}, {"place", s.place}, {"properties", properties}});
  }
  return all;
}

void list(const std::vector<MaterialSection> &sections)
{
  for (const MaterialSection &s : sections) {
    std::printf("%s %s%s%s    %s\n", s.second.empty() ? "material" : "pair", s.first.c_str(),
                s.second.empty() ? "" : " ", s.second.c_str(), s.place.c_str());
    for (const Stated &v : s.stated)
      std::printf("  %-22s %g %s\n    %s\n", v.property->name, v.value,
                  std::string(v.property->unit) == "1" ? "" : v.property->unit,
                  v.source.empty() ? "no source" : v.source.c_str());
  }
}

// Prints all that the file says.
void list(const MaterialOptions &o)
{
  const MaterialFile file = read_materials(find_material_file(o.file));
  if (o.json) {
    const nlohmann::json all = {{"materials", as_json(file.materials)},
                                {"pairs", as_json(file.pairs)}};
    print_json(stdout, all);
    return;
  }
  list(file.materials);
  list(file.pairs);
}

MaterialLaw law_of(const MaterialOptions &o)
{
  MaterialPair pair;
  pair.file = o.file;
  pair.particle = o.name;
  pair.wall = o.wall.empty() ? o.name : o.wall;
  pair.normal = o.normal;
  Tokens with(o.with);
  with.set_context("material", kWords.syntax);
  if (!o.with.empty()) pair.overrides = read_overrides(with, {pair.particle, pair.wall}, "--with");
  if (!with.done()) with.fail(not_a_property(with.peek()));
  return law_of_materials(pair, o.units, kWords);
}

nlohmann::json as_json(const MaterialLaw &law)
{
  std::vector<std::string> words;
  std::istringstream text(law.name);
  for (std::string word; text >> word;) words.push_back(word);
  return {{"words", words}, {"report", law.report}};
}

void print(const MaterialOptions &o, const MaterialLaw &law)
{
  std::printf("%s\n", law.report.c_str());
  std::printf("  %s\n", law.name.c_str());
  if (!o.wall.empty()) return;
  const std::string old = text_of(sub_models_of_29sep2021(law.sub_models)),
                    recent = text_of(law.sub_models);
  std::printf("grains on one another, with pair_style granular of LAMMPS 29Sep2021 and later:\n");
  std::printf("  pair_coeff * * %s\n", old.c_str());
  if (old == recent) return;
  std::printf("the same in the wall's form, which 29Sep2021 does not know:\n");
  std::printf("  pair_coeff * * %s\n", recent.c_str());
}

void run(const MaterialOptions &o)
{
  if (o.name.empty()) {
    list(o);
    return;
  }
  const MaterialLaw law = law_of(o);
  if (o.json)
    print_json(stdout, as_json(law));
  else
    print(o, law);
}

}    // namespace

void add_material_command(Command &program)
{
  const auto o = std::make_shared<MaterialOptions>();
  Command command = program.command(
      "material",
      "prints what a material file says or, with a name, the keywords for an input script");
  command.footer("Example:\n  lsdcd material glass.lsdcd glass --on aluminium");
  command.option("file", o->file, "material file, looked for as in an input script").required();
  command.option("name", o->name, "material of the grains");
  command.option("--on", o->wall, "material of the wall (default: the same)");
  command.option("--normal", o->normal, "normal sub-model of the contact")
      .one_of({"hertz/material", "jkr", "dmt"})
      .shows_default();
  command.option("--units", o->units, "units of the input script")
      .one_of({"si", "cgs", "micro", "nano"})
      .shows_default();
  command.option("--with", o->with,
                 "properties and values that replace those of the file, or [material] property "
                 "value if the file has none");
  command.flag("--json", o->json, "print JSON");
  command.runs([o] { run(*o); });
}

}    // namespace lsdcd
