// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The words of `material` in a wall's command -> the laws that numbers would give.
#pragma once

#include "base/input_words.h"
#include "material/material_law.h"
#include "wall/spec/wall_spec.h"

#include <functional>
#include <string>
#include <vector>

namespace lsdcd {

class Host;

extern const char *const kMaterialSyntax;
extern const MaterialWords kScriptWords;

// The material of particles of some atom types.
struct TypesMaterial {
  LawOfTypes types;    // without a law
  std::string name;
};

// The material of a mesh.
struct MeshMaterial {
  std::string name;    // empty: the wall's
  std::vector<Override> overrides;
};

// All materials of a wall.
struct WallMaterials {
  MaterialPair
      pair;    // of the wall with particles of all other types; without a file: there are none
  std::string style;    // a classic one in front of `material`, which takes none; empty: granular
  bool has_wall = false;             // is the wall's material given?
  std::vector<std::string> names;    // which overrides may name
  std::vector<TypesMaterial> types;
  std::vector<MeshMaterial> meshes;    // of each up to the last one with a material

  bool are_given() const { return !pair.file.empty(); }
};

// Do the words of a wall, from its style on, begin with materials in place of numbers?
bool has_material(const std::vector<std::string> &words);
// Reads the style, `material` and what follows up to `mesh` or another keyword. `words`: all of the wall, or of two grains, with
// the syntax that errors show. `other`: whose material stands behind `on`, in errors.
void read_wall_materials(Tokens &w, const std::vector<std::string> &words, WallMaterials &materials,
                         const char *syntax = kMaterialSyntax,
                         const std::string &other = "the wall's material");
// Reads NAME [with ...] after the word material of mesh number `mesh`.
void read_material_of_mesh(Tokens &w, std::size_t mesh, const std::string &file,
                           WallMaterials &materials);
// Reads KEY VALUE or MATERIAL KEY VALUE as long as they follow `with`, by its name in messages.
std::vector<Override> read_overrides(Tokens &w, const std::vector<std::string> &names,
                                     const std::string &with);

// The law of each of these pairs, with its name.
using LawsOfMaterials = std::function<std::vector<LawOfTypes>(const WallMaterials &,
                                                              const std::vector<MaterialPair> &)>;
// What has been read of materials.
struct MaterialsRead {
  std::string report;                // of all numbers, several lines
  std::vector<std::string> files;    // where they were found
};
// Reads the files. `units`: the script's.
std::vector<LawOfTypes> read_laws(const WallMaterials &materials,
                                  const std::vector<MaterialPair> &pairs, const std::string &units,
                                  MaterialsRead &read);
// The same by the first process, which alone reads files and has `read`. Throws InputError on all. Collective.
std::vector<LawOfTypes> read_laws(Host &host, const WallMaterials &materials,
                                  const std::vector<MaterialPair> &pairs, const std::string &units,
                                  MaterialsRead &read);

// Gives wall and meshes the laws of their materials. Throws InputError where a mesh has a law of its own, too.
void add_laws(const WallMaterials &materials, const LawsOfMaterials &laws_of, WallSpec &wall);

}    // namespace lsdcd
