// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Cited contact parameters of materials, read from text files (potentials/*.lsdcd).
#pragma once

#include "base/real.h"

#include <string>
#include <vector>

namespace lsdcd {

// One property a file can state. Dimensions are the powers of mass, length and time;
// temperature is kelvin in every system of units.
struct Property {
  const char *name;
  const char *unit;    // the word for it in files, SI
  int mass, length, time;
  Real above, most;    // above < value <= most, in SI
  bool of_pair;        // of two surfaces in contact, not of one material
};

const std::vector<Property> &properties();
const Property *find_property(const std::string &name);    // null: no such property

// "'x' is not a property; the nearest is 'y'", or which there are.
std::string not_a_property(const std::string &word);

// A number as a file states it.
struct Stated {
  const Property *property;
  Real value;            // SI
  std::string source;    // what follows '#'
  std::string place;     // "FILE line N"
};

// A material (`second` empty), or two that touch, in either order.
struct MaterialSection {
  std::string first, second, place;
  std::vector<Stated> stated;

  const Stated *find(const std::string &property) const;    // null: not stated
};

struct MaterialFile {
  std::string path;
  std::vector<std::string> files;    // it and those that are included
  std::vector<MaterialSection> materials, pairs;

  // Throws InputError that names the nearest, or all.
  const MaterialSection &material(const std::string &name) const;
  const MaterialSection *pair(const std::string &a, const std::string &b) const;    // null: none
};

// Reads `path` and what it includes. Throws InputError that names file, line, value and
// remedy.
MaterialFile read_materials(const std::string &path);

// Returns where `file` is: as given, then in the folders of the environment variables LSDCD_POTENTIALS and
// LAMMPS_POTENTIALS (several separated by ':'), then in potentials of shared_folder(). Throws InputError.
std::string find_material_file(const std::string &file);

}    // namespace lsdcd
