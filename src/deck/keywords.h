// The keywords of fix wall/lsdcd: one row each, and what reads its values.
#pragma once

#include "base/input_words.h"
#include "deck/settings.h"

#include <string>
#include <vector>

namespace lsdcd {

struct Keyword {
  const char *name;
  const char *values;
  const char *unit;
  const char *range;
  const char *fallback;
  const char *help;
  void (*read)(Tokens &, WallSettings &);
};

const std::vector<Keyword> &keywords();
std::string syntax_of(const Keyword &row);

}    // namespace lsdcd
