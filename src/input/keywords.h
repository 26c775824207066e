// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The keywords of fix wall/lsdcd: one row each, and what reads its values.
#pragma once

#include "base/input_words.h"
#include "input/wall_command.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsdcd {

// A keyword is of the wall or of the mesh before it: one of these two reads its values.
struct Keyword {
  const char *name;
  const char *values;
  const char *unit;
  const char *range;
  const char *fallback;    // empty: required
  const char *help;
  void (*read)(Tokens &, WallCommand &);    // null: of a mesh
  // Variables become inputs. Null: of the wall.
  void (*read_of_mesh)(Tokens &, MeshSpec &, InputNames &inputs) = nullptr;
  // What a program that writes it is told. Null: it is no keyword of scripts alone.
  const char *answer_to_program = nullptr;

  bool repeats() const;    // may it be given more than once?
};

const std::vector<Keyword> &keywords();
// Returns the keywords of a program's words: those of scripts, some with other values, but for those of scripts alone, and its own.
const std::vector<Keyword> &program_keywords();
// Returns the row of a keyword; null: there is none.
const Keyword *find_keyword(const std::vector<Keyword> &rows, const std::string &name);
std::string syntax_of(const Keyword &row);

// Reads the values of a word that all commands with a mesh share: mesh, scale, rotate, move, matrix, weld.
// False: it is none of these.
bool read_mesh_word(const std::string &word, Tokens &w, MeshSpec &mesh);
// Returns the values of `nearest`, "all" (0) or N, the paper's N triangles of a cell (section 3.6), and of `memory`, MiB: in
// bytes.
int read_nearest(Tokens &);
std::size_t read_memory(Tokens &);
// Returns the values FILE every N, of a file whose name ends in `end`.
FileEvery read_file_every(Tokens &w, const std::string &end);
// Is this keyword given a second time although that is not allowed? `seen` has those before it.
bool is_twice(const std::string &word, std::vector<std::string> &seen);

}    // namespace lsdcd
