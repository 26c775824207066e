// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The words of `material` in a script, taken apart.
#pragma once

#include "base/real.h"

#include <string>
#include <vector>

namespace lsdcd {

extern const char *const kMaterialSyntax;

// How messages call what can be written: in a script, or as options of a program.
struct MaterialWords {
  const char *on, *with, *syntax;
};
extern const MaterialWords kScriptWords;

// A number of the script, in its units. `of`: the material; empty: of the pair, or of the material for
// which the file lacks it.
struct Override {
  std::string of, key;
  Real value;
};

// The material of particles of some atom types.
struct TypesMaterial {
  std::string types, name;    // types: as law takes them
};

// The material of a mesh.
struct MeshMaterial {
  std::size_t at;      // in MaterialCommand::rest, behind its file's name
  std::string name;    // empty: the wall's
  std::vector<Override> overrides;
  bool has_law;    // of its own, for all atom types
};

struct MaterialCommand {
  std::string style;     // FSTYLE
  std::string normal;    // normal model of granular; empty with another style
  std::string file, particle, wall;
  std::vector<TypesMaterial> types;
  std::vector<MeshMaterial> meshes;
  std::vector<Override> overrides;        // `with`
  std::vector<std::string> sub_models;    // of granular, as they stand
  std::string damping;                    // model among those; empty: none
  bool has_tangential = false;
  std::vector<std::string> rest;    // `mesh` and what follows, without materials

  // Null: none.
  const Real *override_of(const std::string &key, const std::string &of = "") const;
};

bool has_material(const std::vector<std::string> &tokens);

// Throws InputError that shows the syntax.
MaterialCommand read_material_command(const std::vector<std::string> &tokens,
                                      const MaterialWords &words = kScriptWords);

// The same error for checks of what was read.
[[noreturn]] void fail_material(const std::string &problem, const MaterialWords &words);

}    // namespace lsdcd
