// The words of `granular` -> ContactLaw, in LAMMPS's syntax. One row per sub-model.
#pragma once

#include "base/input_words.h"
#include "law/contact_law.h"

#include <string>
#include <vector>

namespace lsdcd {

// `w` is past the word granular; reads up to the first word that is none of its own.
// `text` becomes what was read, for the log.
ContactLaw read_granular(Tokens &w, std::string &text);

// For help and for errors: "granular NORMAL tangential MODEL [...]", the words that
// begin a family ("tangential"), and every sub-model with its parameters.
std::string granular_syntax();
std::vector<std::string> granular_families();
std::string granular_help();

}    // namespace lsdcd
