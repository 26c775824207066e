// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/own_wall_gran.h"

#include <sstream>

namespace lsdcd {

namespace {

bool has_word(const std::string &words, const std::string &wanted)
{
  std::istringstream in(words);
  for (std::string word; in >> word;)
    if (word == wanted) return true;
  return false;
}

bool is_hooke(const std::string &words, const ContactLaw &)
{
  return words == "hooke";
}
bool is_hooke_history(const std::string &words, const ContactLaw &)
{
  return words == "hooke/history";
}
bool is_hertz_history(const std::string &words, const ContactLaw &)
{
  return words == "hertz/history";
}
bool is_undamped(const std::string &, const ContactLaw &law)
{
  return law.is_classic() && law.eta == 0;
}
bool has_modulus(const std::string &words, const ContactLaw &)
{
  return has_word(words, "hertz/material") || has_word(words, "dmt") || has_word(words, "jkr");
}
bool is_tsuji(const std::string &words, const ContactLaw &)
{
  return has_word(words, "tsuji");
}
bool is_marshall(const std::string &words, const ContactLaw &)
{
  return has_word(words, "marshall") && words.find("mindlin") != std::string::npos;
}

struct Difference {
  int first, last;    // versions; kNewest: still so in the newest that was tried
  bool (*concerns)(const std::string &words, const ContactLaw &law);
  const char *what;
};

constexpr int kNewest = 99999999;

// In 28Mar2023 fix wall/gran got the sub-models of pair_style granular. Its pull request 5007, of May 2026, mended
// two of the classic styles.
const Difference kDifferences[] = {
    {20230328, 20240417, is_hooke,
     "its hooke takes kt for the tangential damping, and gamma_t over gamma_n for the friction"},
    {20230328, 20260528, is_hooke_history, "its hooke/history multiplies kt by the contact radius"},
    {20230328, 20260528, is_hertz_history,
     "its hertz/history sets back the spring of a contact that slips by kt without the contact "
     "radius"},
    {20230328, kNewest, is_undamped, "its forces are not a number where gamma_n is 0"},
    {0, 20230208, has_modulus,
     "its modulus is E/(2(1 - nu)) where E/(2(1 - nu^2)) is right, and NULL for kt is a different "
     "number"},
    {0, kNewest, is_tsuji,
     "its damping tsuji lacks a factor of sqrt(2): it returns 0.62 for a restitution of 0.5"},
    {20230328, kNewest, is_marshall,
     "its twisting marshall lacks the contact radius in the stiffness"},
};

}    // namespace

std::string wall_gran_difference(int version, const std::string &words, const ContactLaw &law)
{
  std::string text;
  for (const Difference &d : kDifferences)
    if (version >= d.first && version <= d.last && d.concerns(words, law))
      text += (text.empty() ? "" : "; ") + std::string(d.what);
  return text;
}

}    // namespace lsdcd
