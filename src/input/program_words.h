// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The words with which a program makes a wall: those of the fix, in which $NAME stands for a value of the program.
#pragma once

#include "base/real.h"
#include "mesh/welded_mesh.h"
#include "motion/motion.h"
#include "wall/spec/wall_spec.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

struct ProgramValue {
  enum class Kind { numbers, mesh, rows, text };
  std::string name;    // without $
  Kind kind = Kind::numbers;
  std::vector<Real> numbers;    // of rows one behind the other; not a number: NULL
  int columns = 0;              // of rows
  std::string text;
  // A mesh in its own frame, the file that it was read from, if any, and which vertex of it each vertex of the program became.
  std::shared_ptr<const WeldedMesh> mesh;
  std::shared_ptr<const std::vector<int>> welded_vertex;
  std::string file;
};

class ProgramWords {
 public:
  // Throws InputError for a value that no word names, one that there is not, and two of one name.
  ProgramWords(const std::string &text, const std::vector<ProgramValue> &values);

  // Returns the words as a script would have them: numbers with all digits, one word each. Only meshes and rows stay $NAME.
  const std::vector<std::string> &words() const { return words_; }
  // Returns for each word of which value it is a number, as "$law, number 7"; empty: of none.
  const std::vector<std::string> &origins() const { return origins_; }
  // Put meshes and rows in the places of their names, in what was read from these words. They throw InputError where $NAME stands elsewhere.
  void put_into(WallSpec &wall) const;
  void put_into(RigidMotion &motion) const;

 private:
  const ProgramValue *find(const std::string &name) const;
  // Returns the value of a word $NAME that stayed; null: the word is something else.
  const ProgramValue *value_of(const std::string &word) const;
  void add(const std::string &word, const std::string &origin = "");
  void add_numbers(const ProgramValue &value);
  std::ptrdiff_t put(RigidMotion &motion) const;    // returns how many
  void check_put(std::ptrdiff_t n) const;
  const std::vector<ProgramValue> &values_;
  std::vector<std::string> words_, origins_;
};

}    // namespace lsdcd
