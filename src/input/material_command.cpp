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

const char *const kMaterialSyntax =
    "granular [hertz/material|jkr|dmt] material FILE PARTICLE [on WALL] [with [MATERIAL] KEY VALUE "
    "...] "
    "[sub-models, NULL for a number of the file] mesh FILE [keywords]";

const MaterialWords kScriptWords = {"on", "with", kMaterialSyntax};

namespace {

std::string take(Tokens &w, const char *what)
{
  if (w.done()) w.fail(std::string(what) + " is missing");
  return w.take();
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

// Reads KEY VALUE or MATERIAL KEY VALUE as long as they follow.
void read_overrides(Tokens &w, MaterialCommand &c, const std::string &with)
{
  const auto is_key = [&] { return !w.done() && (w.peek() == "eta" || find_property(w.peek())); };
  const auto is_name = [&] { return !w.done() && (w.peek() == c.particle || w.peek() == c.wall); };
  if (w.done() || is_behind(w.peek()))
    w.fail("'" + with + "' needs a property and its value, such as restitution 0.9");
  if (!is_key() && !is_name()) w.fail(not_a_property(w.peek()));
  while (is_key() || is_name()) {
    const std::string of = is_key() ? "" : w.take();
    if (!is_key() && !w.done() && !is_behind(w.peek())) w.fail(not_a_property(w.peek()));
    if (!is_key()) w.fail("after '" + with + " " + of + "' comes a property of it and its value");
    const std::string key = w.take();
    const Property *p = find_property(key);
    if (!of.empty() && (!p || p->of_pair))
      w.fail("'" + key + "' is not of " + of + " alone: leave the name out");
    if (c.override_of(key, of)) w.fail("'" + key + "' is given twice");
    if (key == "density") w.fail("density is the atoms' own: no contact style takes it");
    const Real number = w.number(key.c_str(), p ? std::nextafter(p->above, Tokens::kHuge) : 0,
                                 p ? p->most : Tokens::kHuge);
    c.overrides.push_back({of, key, number});
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
  c.particle = c.wall = take(w, "the material's name");
  if (!w.done() && w.peek() == "on") {
    w.take();
    if (w.done() || w.peek() == "mesh" || w.peek() == "with")
      w.fail(std::string("the wall's material is missing after '") + words.on + "'");
    c.wall = w.take();
  }
  if (!w.done() && w.peek() == "with") {
    w.take();
    read_overrides(w, c, words.with);
  }
  read_sub_models(w, c);
  while (!w.done()) c.rest.push_back(w.take());
  return c;
}

void fail_material(const std::string &problem, const MaterialWords &words)
{
  throw InputError("in 'material', " + problem + ". Syntax: " + words.syntax);
}

}    // namespace lsdcd
