// The keywords of fix wall/lsdcd: one row each, and what reads its values.
#pragma once

#include "base/input_words.h"
#include "deck/settings.h"

#include <string>
#include <vector>

namespace lsdcd {

// Either of the wall, or of the mesh before it.
struct Keyword {
  const char *name;
  const char *values;
  const char *unit;
  const char *range;
  const char *fallback;
  const char *help;
  void (*read)(Tokens &, WallSettings &);                      // null: of a mesh
  void (*read_of_mesh)(Tokens &, MeshSettings &) = nullptr;    // null: of the wall

  bool repeats() const;    // may it be given more than once?
};

const std::vector<Keyword> &keywords();
std::string syntax_of(const Keyword &row);

}    // namespace lsdcd
