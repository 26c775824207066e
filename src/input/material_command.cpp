// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/material_command.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "input/granular_words.h"
#include "input/keywords.h"
#include "material/material_file.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

const char *const kMaterialSyntax = "granular [hertz/material|jkr|dmt] material FILE PARTICLE "
                                    "[types I PARTICLE ...] [on WALL] [with "
                                    "[MATERIAL] KEY VALUE ...] [sub-models, NULL for a number of "
                                    "the file] mesh FILE [material WALL "
                                    "[with ...]] [keywords]";

const MaterialWords kScriptWords = {"on", "with", kMaterialSyntax};

namespace {

std::string take(Tokens &w, const std::string &what)
{
  if (w.done()) w.fail(what + " is missing");
  return w.take();
}

std::string take_name(Tokens &w, const std::string &what)
{
  for (const char *const word : {"mesh", "types", "on", "with", "material"})
    if (!w.done() && w.peek() == word)
      w.fail(what + " is missing: the word '" + word + "' was found instead");
  return take(w, what);
}

bool is_family(const std::string &word)
{
  const std::vector<std::string> all = granular_families();
  return std::find(all.begin(), all.end(), word) != all.end();
}

// Does the word begin what may follow the material?
bool is_behind(const std::string &word)
{
  const std::vector<Keyword> &all = keywords();
  return is_family(word) ||
         std::any_of(all.begin(), all.end(), [&](const Keyword &k) { return word == k.name; });
}

bool is_any(const std::string &word, const std::vector<std::string> &names)
{
  return std::find(names.begin(), names.end(), word) != names.end();
}

// Reads KEY VALUE or MATERIAL KEY VALUE as long as they follow.
void read_overrides(Tokens &w, const std::vector<std::string> &names, const std::string &with,
                    std::vector<Override> &overrides)
{
  const auto is_key = [&] { return !w.done() && (w.peek() == "eta" || find_property(w.peek())); };
  const auto is_name = [&] { return !w.done() && is_any(w.peek(), names); };
  if (w.done() || is_behind(w.peek()))
    w.fail("'" + with + "' needs a property and its value, such as restitution 0.9");
  if (!is_key() && !is_name()) w.fail(not_a_property(w.peek()));
  while (is_key() || is_name()) {
    const std::string of = is_key() ? "" : w.take();
    if (!is_key() && !w.done() && !is_behind(w.peek())) w.fail(not_a_property(w.peek()));
    if (!is_key())
      w.fail("after '" + with + " " + of +
             "' write a property and its value, such as restitution 0.9");
    const std::string key = w.take();
    const Property *p = find_property(key);
    if (!of.empty() && (!p || p->of_pair))
      w.fail("'" + key + "' is not a property of " + of + " alone: leave the name out");
    for (const Override &o : overrides)
      if (o.key == key && o.of == of) w.fail("'" + key + "' is given twice");
    if (key == "density")
      w.fail("no contact style takes a density, because each atom has its own: leave it out");
    const Real number = w.number(key.c_str(), p ? std::nextafter(p->above, Tokens::kHuge) : 0,
                                 p ? p->most : Tokens::kHuge);
    overrides.push_back({of, key, number});
  }
  // It may be a misspelt keyword: the reader of keywords tells that.
  if (w.done() || is_behind(w.peek())) return;
  for (const Property &p : properties())
    if (is_near(w.peek(), p.name)) w.fail(not_a_property(w.peek()));
}

// Keyword, model, numbers.
void read_sub_models(Tokens &w, MaterialCommand &c)
{
  while (!w.done()) {
    const std::string key = w.peek();
    if (!is_family(key)) return;
    c.sub_models.push_back(w.take());
    if (key == "limit_damping" || w.done()) continue;
    if (key == "tangential") c.has_tangential = true;
    if (key == "damping") c.damping = w.peek();
    c.sub_models.push_back(w.take());
    while (!w.done() && (w.peek() == "NULL" || w.number_follows()))
      c.sub_models.push_back(w.take());
  }
}

// Reads types I NAME I NAME ...
void read_types(Tokens &w, MaterialCommand &c)
{
  if (w.done() || w.peek() != "types") return;
  w.take();
  const auto is_range = [&] {
    return !w.done() && w.peek().find_first_not_of("0123456789*") == std::string::npos;
  };
  if (!is_range()) w.fail("after 'types' write atom types and their material, such as 2 coal");
  while (is_range()) {
    const std::string types = w.take();
    c.types.push_back({types, take_name(w, "the material of atom types " + types)});
  }
}

// All that the words call a material, and a few others.
std::vector<std::string> names_in(const std::vector<std::string> &tokens, const MaterialCommand &c)
{
  std::vector<std::string> names = {c.particle, c.wall};
  for (const TypesMaterial &of : c.types) names.push_back(of.name);
  for (std::size_t i = 0; i + 1 < tokens.size(); i++)
    if (tokens[i] == "material") names.push_back(tokens[i + 1]);
  return names;
}

// Reads `mesh` and what follows.
void read_meshes(Tokens &w, MaterialCommand &c, const std::vector<std::string> &names,
                 const MaterialWords &words)
{
  const std::vector<std::string> before_file = {"cache", "mesh_fields", "mesh_stl", "torque_about"};
  std::string last, before_last;
  while (!w.done()) {
    const std::string word = w.take();
    const bool is_value = is_any(last, before_file);
    if (!is_value && word == "law" && !c.meshes.empty())
      c.meshes.back().has_law |= w.done() || w.peek() != "types";
    if (!is_value && word == "material") {
      if (c.meshes.empty()) w.fail("write the 'material' of a mesh after its mesh FILE");
      MeshMaterial &mesh = c.meshes.back();
      const std::string of = "mesh '" + c.rest[mesh.at - 1] + "'";
      for (const char *const head : {"law", "types", "granular"})
        if (last == head || before_last == head)
          w.fail("in 'law' of " + of + ", " + kNoMaterialHere);
      if (!mesh.name.empty()) w.fail("a mesh has two materials: leave one out");
      mesh.name = take_name(w, "the material of " + of);
      if (w.done() || w.peek() != "with") continue;
      w.take();
      read_overrides(w, names, words.with, mesh.overrides);
      continue;
    }
    before_last = last;
    last = word;
    c.rest.push_back(word);
    if (is_value || word != "mesh" || w.done()) continue;
    c.rest.push_back(w.take());
    c.meshes.push_back({c.rest.size(), "", {}, false});
  }
  for (const MeshMaterial &mesh : c.meshes)
    if (mesh.has_law && !mesh.name.empty())
      w.fail("mesh '" + c.rest[mesh.at - 1] + "' has 'material " + mesh.name +
             "' and 'law', which both set its contact numbers: leave one out");
}

}    // namespace

const Real *MaterialCommand::override_of(const std::string &key, const std::string &of) const
{
  for (const Override &o : overrides)
    if (o.key == key && o.of == of) return &o.value;
  return nullptr;
}

bool has_material(const std::vector<std::string> &tokens)
{
  if (tokens.size() < 2) return false;
  if (tokens[0] == "granular" && tokens.size() > 2 && tokens[2] == "material") return true;
  for (const char *style : {"granular", "hooke", "hooke/history", "hertz/history"})
    if (tokens[0] == style) return tokens[1] == "material";
  return false;
}

MaterialCommand read_material_command(const std::vector<std::string> &tokens,
                                      const MaterialWords &words)
{
  Tokens w(tokens);
  w.set_context("material", words.syntax);
  MaterialCommand c;
  c.style = w.take();
  if (c.style == "granular") {
    c.normal = w.peek() == "material" ? "hertz/material" : w.take();
    if (c.normal != "hertz/material" && c.normal != "jkr" && c.normal != "dmt")
      w.fail("the normal model '" + c.normal +
             "' does not take material constants: use hertz/material, jkr or dmt");
  }
  w.take();
  c.file = take(w, "the file name");
  c.particle = c.wall = take_name(w, "the material's name");
  read_types(w, c);
  const bool has_wall = !w.done() && w.peek() == "on";
  if (has_wall) {
    w.take();
    c.wall = take_name(w, std::string("after '") + words.on + "' the wall's material");
  }
  const std::vector<std::string> names = names_in(tokens, c);
  if (!w.done() && w.peek() == "with") {
    w.take();
    read_overrides(w, names, words.with, c.overrides);
  }
  read_sub_models(w, c);
  for (const char *const word : {"types", "on", "with"})
    if (!w.done() && w.peek() == word)
      w.fail("'" + w.peek() +
             "' must come earlier: the order is PARTICLE, types, on, with, sub-models, mesh");
  read_meshes(w, c, names, words);
  // The wall's own is then that of no contact, and the file need not have it.
  if (!has_wall && !c.meshes.empty() &&
      std::none_of(c.meshes.begin(), c.meshes.end(),
                   [](const MeshMaterial &m) { return m.name.empty(); }))
    c.wall = c.meshes.front().name;
  return c;
}

void fail_material(const std::string &problem, const MaterialWords &words)
{
  throw InputError("in 'material', " + problem + ". Syntax: " + words.syntax);
}

}    // namespace lsdcd
