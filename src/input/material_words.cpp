// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/material_words.h"

#include "host/host.h"
#include "input/granular_words.h"
#include "input/keywords.h"
#include "input/law_words.h"
#include "material/material_file.h"

#include <algorithm>
#include <type_traits>

namespace lsdcd {

const char *const kMaterialSyntax =
    "granular [hertz/material|jkr|dmt|hysteretic/edem|thornton] material FILE PARTICLE "
    "[types I PARTICLE ...] [on WALL] [with "
    "[MATERIAL] KEY VALUE ...] [sub-models, NULL for a number of "
    "the file] mesh FILE [material WALL "
    "[with ...]] [keywords]";

const MaterialWords kScriptWords = {"on", "with", kMaterialSyntax, "as the input script says"};

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

bool is_any(const std::string &word, const std::vector<std::string> &names)
{
  return std::find(names.begin(), names.end(), word) != names.end();
}

// Does the word begin what may follow the material?
bool is_behind(const std::string &word)
{
  return is_any(word, granular_families()) || find_keyword(keywords(), word) ||
         find_keyword(program_keywords(), word);
}

// Errors of what a core function checks get the words around it.
template <class Check>
void check_words(const Tokens &w, const Check &check)
{
  try {
    check();
  } catch (const InputError &e) {
    w.fail(e.what());
  }
}

// Reads types I NAME I NAME ...
void read_types_and_names(Tokens &w, WallMaterials &m)
{
  if (w.done() || w.peek() != "types") return;
  w.take();
  const auto is_range = [&] {
    return !w.done() && w.peek().find_first_not_of("0123456789*") == std::string::npos;
  };
  if (!is_range()) w.fail("after 'types' write atom types and their material, such as 2 coal");
  while (is_range()) {
    const std::string types = w.peek();
    TypesMaterial of;
    read_types(w, of.types);
    of.name = take_name(w, "the material of atom types " + types);
    m.types.push_back(of);
  }
}

// All that the words call a material, and a few others.
std::vector<std::string> names_in(const std::vector<std::string> &words, const WallMaterials &m)
{
  std::vector<std::string> names = {m.pair.particle, m.pair.wall};
  for (const TypesMaterial &of : m.types) names.push_back(of.name);
  for (std::size_t i = 0; i + 1 < words.size(); i++)
    if (words[i] == "material") names.push_back(words[i + 1]);
  return names;
}

// A word where none is expected that is no misspelt keyword may be the wall's material, or that of the other grain.
void refuse_second_name(const Tokens &w, const std::string &other)
{
  if (w.done() || is_behind(w.peek())) return;
  for (const char *const word : {"types", "on", "with", "material"})
    if (w.peek() == word) return;
  std::vector<std::string> names;
  for (const Keyword &row : keywords()) names.push_back(row.name);
  if (is_like(w.peek(), nearest(w.peek(), names))) return;
  w.fail("'" + w.peek() + "' is not a keyword: if it is " + other + ", write 'on " + w.peek() +
         "'");
}

}    // namespace

bool has_material(const std::vector<std::string> &words)
{
  if (words.size() < 2) return false;
  if (words[0] == "granular" && words.size() > 2 && words[2] == "material") return true;
  for (const char *style : {"granular", "hooke", "hooke/history", "hertz/history"})
    if (words[0] == style) return words[1] == "material";
  return false;
}

std::vector<Override> read_overrides(Tokens &w, const std::vector<std::string> &names,
                                     const std::string &with)
{
  std::vector<Override> overrides;
  const auto is_key = [&] { return !w.done() && (w.peek() == "eta" || find_property(w.peek())); };
  const auto is_name = [&] { return !w.done() && is_any(w.peek(), names); };
  if (w.done() || is_behind(w.peek()))
    w.fail("'" + with + "' needs a property and its value, such as restitution 0.9");
  if (!is_key() && !is_name()) w.fail(not_a_property(w.peek()));
  while (is_key() || is_name()) {
    Override o;
    if (!is_key()) o.of = w.take();
    if (!is_key() && !w.done() && !is_behind(w.peek())) w.fail(not_a_property(w.peek()));
    if (!is_key())
      w.fail("after '" + with + " " + o.of +
             "' write a property and its value, such as restitution 0.9");
    o.key = w.take();
    for (const Override &other : overrides)
      if (other.key == o.key && other.of == o.of) w.fail("'" + o.key + "' is given twice");
    o.value = w.number(o.key.c_str());
    check_words(w, [&] { check_override(o); });
    overrides.push_back(o);
  }
  // It may be a misspelt keyword: the reader of keywords tells that.
  if (w.done() || is_behind(w.peek())) return overrides;
  for (const Property &p : properties())
    if (is_near(w.peek(), p.name)) w.fail(not_a_property(w.peek()));
  return overrides;
}

void read_wall_materials(Tokens &w, const std::vector<std::string> &words, WallMaterials &m,
                         const char *syntax, const std::string &other)
{
  w.set_context("material", syntax);
  const std::string style = w.take();
  if (style != "granular") m.style = style;
  if (w.peek() != "material") m.pair.normal = w.take();
  check_words(w, [&] { check_normal_of_materials(m.pair.normal); });
  w.take();
  m.pair.file = take(w, "the file name");
  m.pair.particle = m.pair.wall = take_name(w, "the material's name");
  read_types_and_names(w, m);
  m.has_wall = !w.done() && w.peek() == "on";
  if (m.has_wall) {
    w.take();
    m.pair.wall = take_name(w, "after 'on' " + other);
  }
  m.names = names_in(words, m);
  const bool has_overrides = !w.done() && w.peek() == "with";
  if (has_overrides) {
    w.take();
    m.pair.overrides = read_overrides(w, m.names, "with");
  } else if (!m.has_wall && m.types.empty()) {
    refuse_second_name(w, other);
  }
  read_sub_models_of_materials(w, m.pair);
  w.set_context("material", syntax);
  for (const char *const word : {"types", "on", "with"})
    if (!w.done() && w.peek() == word)
      w.fail("'" + w.peek() +
             "' must come earlier: the order is PARTICLE, types, on, with, sub-models, mesh");
}

void read_material_of_mesh(Tokens &w, std::size_t mesh, const std::string &file, WallMaterials &m)
{
  w.set_context("material", kMaterialSyntax);
  if (file.empty()) w.fail("write the 'material' of a mesh after its mesh FILE");
  if (m.meshes.size() <= mesh) m.meshes.resize(mesh + 1);
  MeshMaterial &of = m.meshes[mesh];
  if (!of.name.empty()) w.fail("a mesh has two materials: leave one out");
  of.name = take_name(w, "the material of mesh '" + file + "'");
  if (w.done() || w.peek() != "with") return;
  w.take();
  of.overrides = read_overrides(w, m.names, "with");
}

std::vector<LawOfTypes> read_laws(const WallMaterials &materials,
                                  const std::vector<MaterialPair> &pairs, const std::string &units,
                                  MaterialsRead &read)
{
  std::vector<LawOfTypes> laws;
  if (!materials.style.empty())
    refuse_classic_of_materials(materials.style, pairs.front(), units, kScriptWords);
  for (const MaterialLaw &made : laws_of_materials(pairs, units, kScriptWords)) {
    laws.emplace_back();
    laws.back().law = made.law;
    laws.back().name = made.name;
    laws.back().becomes = made.becomes;
    if (read.report.find(made.report) == std::string::npos)
      read.report += (read.report.empty() ? "" : "\n") + made.report;
    read.files = made.files;    // those of each pair
  }
  return laws;
}

std::vector<LawOfTypes> read_laws(Host &host, const WallMaterials &materials,
                                  const std::vector<MaterialPair> &pairs, const std::string &units,
                                  MaterialsRead &read)
{
  std::vector<LawOfTypes> laws;
  run_collectively(host, host.is_first(), [&] { laws = read_laws(materials, pairs, units, read); });
  laws.resize(pairs.size());
  static_assert(std::is_trivially_copyable_v<ContactLaw>, "its bytes are sent");
  for (LawOfTypes &of : laws) {
    host.broadcast(&of.law, sizeof of.law, 0);
    broadcast_text(host, of.name);
    broadcast_text(host, of.becomes);
  }
  return laws;
}

// The law of a mesh for all types is its first row; those of types stand before the rows that a script has for types.
void add_laws(const WallMaterials &m, const LawsOfMaterials &laws_of, WallSpec &wall)
{
  std::vector<MaterialPair> pairs = {m.pair};
  const auto material_of = [&](std::size_t mesh) {
    return mesh < m.meshes.size() ? m.meshes[mesh] : MeshMaterial();
  };
  // The wall's own is that of no contact where each mesh has one, and the file need not have it.
  bool all = !m.has_wall;
  for (std::size_t k = 0; k < wall.meshes.size(); k++) all = all && !material_of(k).name.empty();
  if (all) pairs.front().wall = m.meshes.front().name;
  for (std::size_t k = 0; k < wall.meshes.size(); k++) {
    const MeshMaterial own = material_of(k);
    const MeshSpec &mesh = wall.meshes[k];
    if (!own.name.empty() && !mesh.laws.empty() && mesh.laws.front().first_type == 0)
      throw InputError("in 'material', mesh '" + mesh.file + "' has 'material " + own.name +
                       "' and 'law', which both set its contact numbers: leave one out. Syntax: " +
                       kMaterialSyntax);
    MaterialPair pair = pairs.front();
    if (!own.name.empty()) pair.wall = own.name;
    pair.overrides.insert(pair.overrides.begin(), own.overrides.begin(), own.overrides.end());
    if (!own.name.empty()) pairs.push_back(pair);
    for (const TypesMaterial &of : m.types) {
      pair.particle = of.name;
      pairs.push_back(pair);
    }
  }
  const std::vector<LawOfTypes> laws = laws_of(m, pairs);
  auto next = laws.begin();
  wall.laws.front() = *next++;
  for (std::size_t k = 0; k < wall.meshes.size(); k++) {
    std::vector<LawOfTypes> &rows = wall.meshes[k].laws;
    if (!material_of(k).name.empty()) rows.insert(rows.begin(), *next++);
    std::size_t at = !rows.empty() && rows.front().first_type == 0;
    for (const TypesMaterial &of : m.types) {
      LawOfTypes row = *next++;
      row.first_type = of.types.first_type;
      row.last_type = of.types.last_type;
      rows.insert(rows.begin() + static_cast<std::ptrdiff_t>(at++), row);
    }
  }
}

}    // namespace lsdcd
