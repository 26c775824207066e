// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "material/material_file.h"

#include "base/byte_order_mark.h"
#include "base/file_kind.h"
#include "base/input_error.h"
#include "base/input_words.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace lsdcd {

namespace {

constexpr Real kAny = Tokens::kHuge;
constexpr Real kFromZero = -1e-300;    // 0 is allowed
constexpr int kDeepest = 16;           // files that include files

const char *const kSyntax =
    "a file holds 'units si', 'include FILE', 'material NAME', 'pair NAME NAME', and under those "
    "lines like 'youngs_modulus 69e9 Pa  # source'";

std::string trim(const std::string &text)
{
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// `other` beside the file that names it.
std::string beside(const std::string &path, const std::string &other)
{
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos || other[0] == '/') return other;
  return path.substr(0, slash + 1) + other;
}

class Reader {
 public:
  explicit Reader(MaterialFile &into) : into_(into) {}

  // Each file once, however often it is included.
  void read(const std::string &path, int depth)
  {
    if (std::find(into_.files.begin(), into_.files.end(), path) != into_.files.end()) return;
    into_.files.push_back(path);
    std::ifstream file(path);
    if (!file) throw InputError("cannot read the material file '" + path + "'");
    MaterialSection *section = nullptr;
    bool units = false;
    std::string text;
    for (int line = 1; std::getline(file, text); line++) {
      if (line == 1) drop_byte_order_mark(text);
      location_ = path + " line " + std::to_string(line);
      const std::size_t hash = text.find('#');
      const std::string source = hash == std::string::npos ? "" : trim(text.substr(hash + 1));
      std::istringstream stream(text.substr(0, hash));
      std::vector<std::string> tokens;
      for (std::string word; stream >> word;) tokens.push_back(word);
      if (tokens.empty()) continue;

      if (tokens[0] == "units") {
        if (tokens.size() != 2 || tokens[1] != "si")
          fail("'" + trim(text.substr(0, hash)) + "': material files are in 'units si'");
        units = true;
      } else if (!units) {
        fail("'" + tokens[0] + "' comes before 'units si', which must be the first entry");
      } else if (tokens[0] == "include") {
        count(tokens, 2, "include FILE");
        if (depth == kDeepest) fail("more than 16 files include one another");
        const std::string other = beside(path, tokens[1]);
        const std::string why = why_no_file(other);
        if (!why.empty()) fail("the included file '" + other + "' cannot be read: " + why);
        read(other, depth + 1);
        section = nullptr;
      } else if (tokens[0] == "material") {
        count(tokens, 2, "material NAME");
        section = begin(into_.materials, tokens[1], "");
      } else if (tokens[0] == "pair") {
        count(tokens, 3, "pair NAME NAME");
        section = begin(into_.pairs, tokens[1], tokens[2]);
      } else {
        if (!section)
          fail("'" + tokens[0] + "' belongs to no material: write 'material NAME' before it");
        section->stated.push_back(value(*section, tokens, source));
      }
    }
    location_ = path;
    if (!units) fail("there is no 'units si'; " + std::string(kSyntax));
  }

  void check_pairs()
  {
    for (const MaterialSection &pair : into_.pairs)
      for (const std::string &name : {pair.first, pair.second}) {
        location_ = pair.place;
        if (std::none_of(into_.materials.begin(), into_.materials.end(),
                         [&](const MaterialSection &m) { return m.first == name; }))
          fail("the pair names '" + name +
               "', which is not a material of this file: add 'material " + name +
               "', or include the file that has it");
      }
  }

 private:
  MaterialSection *begin(std::vector<MaterialSection> &sections, const std::string &a,
                         const std::string &b)
  {
    for (const MaterialSection &old : sections)
      if ((old.first == a && old.second == b) || (old.first == b && old.second == a))
        fail("'" + a + (b.empty() ? "" : " " + b) + "' is already given, at " + old.place +
             ": keep one");
    sections.push_back({a, b, location_, {}});
    return &sections.back();
  }

  Stated value(const MaterialSection &section, const std::vector<std::string> &tokens,
               const std::string &source)
  {
    const Property *p = find_property(tokens[0]);
    const bool in_pair = !section.second.empty();
    if (!p) fail(not_a_property(tokens[0]));
    const std::string example = std::string(p->name) + " VALUE " + p->unit + "  # source";
    if (p->of_pair && !in_pair)
      fail("'" + tokens[0] + "' is a property of two surfaces: write it under 'pair " +
           section.first + " " + section.first + "'");
    if (!p->of_pair && in_pair)
      fail("'" + tokens[0] + "' is a property of one material: write it under 'material " +
           section.first + "'");
    if (const Stated *old = section.find(p->name))
      fail("'" + tokens[0] + "' is already given, at " + old->place + ": keep one");
    if (tokens.size() != 3)
      fail("'" + tokens[0] + "' needs a value and its unit: write '" + example + "'");
    Real number = 0;
    if (!is_number(tokens[1], &number))
      fail("'" + tokens[1] + "' is not a number: write '" + example + "'");
    if (tokens[2] != p->unit)
      fail("'" + tokens[0] + "' is in '" + tokens[2] + "': convert the value and write '" +
           example + "'");
    if (!(number > p->above) || number > p->most)
      fail(tokens[0] + " = " + tokens[1] + " is out of range: it must be greater than " +
           number_text(p->above) + (p->most < kAny ? " and at most " + number_text(p->most) : ""));
    return {p, number, source, location_};
  }

  void count(const std::vector<std::string> &tokens, std::size_t n, const char *syntax)
  {
    if (tokens.size() != n) fail("'" + tokens[0] + "': write '" + syntax + "'");
  }

  [[noreturn]] void fail(const std::string &problem) const
  {
    throw InputError(location_ + ": " + problem);
  }

  MaterialFile &into_;
  std::string location_;
};

}    // namespace

const std::vector<Property> &properties()
{
  static const std::vector<Property> list = {
      {"youngs_modulus", "Pa", 1, -1, -2, 0, kAny, false},
      {"poissons_ratio", "1", 0, 0, 0, -1, 0.5, false},
      {"density", "kg/m3", 1, -3, 0, 0, kAny, false},
      {"surface_energy", "J/m2", 1, 0, -2, 0, kAny, false},
      {"thermal_conductivity", "W/m/K", 1, 1, -3, 0, kAny, false},
      {"yield_strength", "Pa", 1, -1, -2, 0, kAny, false},
      {"yield_pressure", "Pa", 1, -1, -2, 0, kAny, false},
      {"contact_angle", "deg", 0, 0, 0, kFromZero, 90, false},
      {"restitution", "1", 0, 0, 0, 0, 1, true},
      {"sliding_friction", "1", 0, 0, 0, 0, kAny, true},
      {"rolling_friction", "1", 0, 0, 0, 0, kAny, true},
      {"rolling_damping", "1", 0, 0, 0, 0, kAny, true},
      {"cohesion_energy_density", "J/m3", 1, -1, -2, 0, kAny, true},
      {"surface_tension", "N/m", 1, 0, -2, 0, kAny, true},
      {"bridge_volume", "m3", 0, 3, 0, 0, kAny, true},
      {"bridge_volume_share", "1", 0, 0, 0, 0, kAny, true},
      {"adhesive_force", "N", 1, 1, -2, 0, kAny, true},
      {"adhesive_force_fraction", "1", 0, 0, 0, 0, kAny, true},
      {"adhesive_stiffness", "N/m", 1, 0, -2, 0, kAny, true},
      {"adhesive_distance", "m", 0, 1, 0, 0, kAny, true},
  };
  return list;
}

const Property *find_property(const std::string &name)
{
  for (const Property &p : properties())
    if (name == p.name) return &p;
  return nullptr;
}

std::string not_a_property(const std::string &word)
{
  std::vector<std::string> names;
  for (const Property &p : properties()) names.push_back(p.name);
  return "'" + word + "' is not a property; " + nearest_or_all(word, names);
}

const Stated *MaterialSection::find(const std::string &property) const
{
  for (const Stated &s : stated)
    if (property == s.property->name) return &s;
  return nullptr;
}

const MaterialSection &MaterialFile::material(const std::string &name) const
{
  std::vector<std::string> names;
  for (const MaterialSection &m : materials) {
    if (m.first == name) return m;
    names.push_back(m.first);
  }
  if (names.empty()) throw InputError(path + " has no materials");
  throw InputError("'" + name + "' is not a material of " + path + "; " +
                   nearest_or_all(name, names));
}

const MaterialSection *MaterialFile::pair(const std::string &a, const std::string &b) const
{
  for (const MaterialSection &p : pairs)
    if ((p.first == a && p.second == b) || (p.first == b && p.second == a)) return &p;
  return nullptr;
}

MaterialFile read_materials(const std::string &path)
{
  MaterialFile file;
  file.path = path;
  Reader reader(file);
  reader.read(path, 0);
  reader.check_pairs();
  return file;
}

}    // namespace lsdcd
