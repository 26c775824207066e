// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "input/material_words.h"
#include "material/material_file.h"
#include "tool/mesh_json.h"
#include "tool/number_options.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <sstream>

namespace lsdcd {

namespace {

const MaterialWords kWords = {
    "--on", "--with",
    "lsdcd material FILE NAME [--on WALL] [--normal "
    "hertz/material|jkr|dmt|hysteretic/edem|thornton] [--with [MATERIAL] KEY VALUE ...]",
    "as the options say"};

struct MaterialOptions {
  std::string file, name, wall, normal = "hertz/material", units = "si";
  std::vector<std::string> with;
  double kn = kNotGiven;
  std::vector<double> mass;
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

// Returns the words of a linear spring in place of the sub-models of materials, for pair styles that take none. A head-on impact
// of two bodies with this effective mass returns the restitution. The stiffnesses are to each other as those of Mindlin and Hertz,
// kt/kn = 2 (1 - nu)/(2 - nu), and friction is that of the materials.
std::string linear_words(const MaterialLaw &law, double kn, double mass)
{
  const std::vector<Real> &normal =
      law.sub_models[0].numbers;    // modulus, restitution, Poisson's ratio
  const Real nu = normal[2];
  // 0 is added because a restitution of 1 gives -0.
  const Real gamma = 0 + std::sqrt(kn / mass) * restitution_damping(NormalModel::hooke, normal[1]);
  return "hooke " + number_text(kn) + " " + number_text(gamma) + " tangential linear_history " +
         number_text(kn * 2 * (1 - nu) / (2 - nu)) + " 1 " + number_text(law.law.mu) +
         " damping mass_velocity";
}

// What the springs are of, with their words.
std::vector<std::pair<std::string, std::string>> linear_laws(const MaterialOptions &o,
                                                             const MaterialLaw &law)
{
  if (std::isnan(o.kn)) return {};
  const double m = o.mass[0];
  if (o.mass.size() == 2)
    return {{"grains of both masses", linear_words(law, o.kn, 1 / (1 / m + 1 / o.mass[1]))}};
  return {{"wall", linear_words(law, o.kn, m)}, {"two grains", linear_words(law, o.kn, m / 2)}};
}

nlohmann::json as_json(const MaterialOptions &o, const MaterialLaw &law)
{
  std::vector<std::string> words;
  std::istringstream text(law.name);
  for (std::string word; text >> word;) words.push_back(word);
  nlohmann::json told = {{"words", words}, {"report", law.report}};
  for (const auto &[of, linear] : linear_laws(o, law)) told["linear"][of] = linear;
  return told;
}

void print(const MaterialOptions &o, const MaterialLaw &law)
{
  for (const auto &[of, words] : linear_laws(o, law))
    std::printf("%s: %s\n", of.c_str(), words.c_str());
  if (!std::isnan(o.kn)) return;
  std::printf("%s\n", law.report.c_str());
  std::printf("  %s\n", law.name.c_str());
  if (!o.wall.empty()) return;
  if (law.law.yields()) {
    std::printf("grains on one another, with pair_style granular/lsdcd:\n  pair_coeff * * law %s\n",
                law.name.c_str());
    return;
  }
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
  if (std::isnan(o.kn) != o.mass.empty())
    throw_usage_error(std::isnan(o.kn) ? "--mass" : "--kn",
                      "the words of a linear spring need its stiffness and a mass: give --kn and "
                      "--mass");
  if (!std::isnan(o.kn) && o.normal != "hertz/material")
    throw_usage_error("--kn", "a linear spring has no adhesion: leave --normal out");
  const MaterialLaw law = law_of(o);
  if (o.json)
    print_json(stdout, as_json(o, law));
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
  command.footer(
      "With --kn the words are those of a linear spring, which LAMMPS's granular/superellipsoid\n"
      "takes: an impact of the mass returns the restitution, and kt is kn 2 (1 - nu)/(2 - nu).\n\n"
      "Example:\n  lsdcd material glass.lsdcd glass --on aluminium");
  command.option("file", o->file, "material file, looked for as in an input script").required();
  command.option("name", o->name, "material of the grains");
  command.option("--on", o->wall, "material of the wall (default: the same)");
  command.option("--normal", o->normal, "normal sub-model of the contact")
      .one_of(normals_of_materials())
      .shows_default();
  command.option("--units", o->units, "units of the input script")
      .one_of({"si", "cgs", "micro", "nano"})
      .shows_default();
  command.option("--with", o->with,
                 "properties and values that replace those of the file, or [material] property "
                 "value if the file has none");
  command
      .option("--kn", o->kn,
              "stiffness of a linear spring: prints its words in place of those of materials")
      .check(above_zero);
  command
      .option("--mass", o->mass,
              "with --kn, of a grain at a wall and of two such grains, or of two unlike grains")
      .words(1, 2)
      .check(above_zero);
  command.flag("--json", o->json, "print JSON");
  command.runs([o] { run(*o); });
}

}    // namespace lsdcd
