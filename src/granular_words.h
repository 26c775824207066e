// The words of `granular` -> ContactLaw, in LAMMPS's syntax. One row per sub-model.
#pragma once

#include "input_words.h"
#include "model/contact_law.h"

#include <string>
#include <vector>

namespace lsdcd {

// `w` is past the word granular; reads up to the first word that is none of its own.
// `text` becomes what was read, for the log.
ContactLaw read_granular(Words &w, std::string &text);

// For help and for errors: "granular NORMAL tangential MODEL [...]", the words that
// begin a family ("tangential"), and every sub-model with its parameters.
std::string granular_syntax();
std::vector<std::string> granular_families();
std::string granular_help();

// What a law turns on, and what each of it keeps per contact beside the Spring that any
// law with history keeps.
struct Effect {
  std::string name;
  int bytes_per_contact;
};
std::vector<Effect> effects_of(const ContactLaw &law);

}    // namespace lsdcd
