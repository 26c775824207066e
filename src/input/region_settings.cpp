// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/region_settings.h"

#include "base/input_words.h"
#include "input/keywords.h"
#include "input/value_words.h"

namespace lsdcd {

namespace {

const char *const kRegionSyntax =
    "region ID mesh/lsdcd FILE [scale s | sx sy sz] [rotate ax ay az degrees] [move x y z] "
    "[matrix m11 m12 m13 tx m21 m22 m23 ty m31 m32 m33 tz] [weld tol] [gap D] [side in | out] "
    "[units box | lattice] [move v_x v_y v_z] [rotate v_theta Px Py Pz Rx Ry Rz]";

// A word that LAMMPS reads, with its n values.
void keep_for_host(const std::string &word, int n, Tokens &w, RegionSettings &s)
{
  s.host_words.push_back(word);
  for (int k = 0; k < n; k++) {
    if (w.done()) w.fail("'" + word + "' has too few values");
    s.host_words.push_back(w.take());
  }
}

// `move` and `rotate` of the mesh have numbers first, those of LAMMPS a variable or NULL.
bool is_by_variable(const Tokens &w)
{
  return !w.done() && (w.peek() == "NULL" || variable_follows(w));
}

void keep_choice(const std::string &word, const std::vector<std::string> &choices, Tokens &w,
                 RegionSettings &s)
{
  w.set_context(word, word + " " + choices[0] + " | " + choices[1]);
  const std::string &chosen = choices[w.choice(choices)];
  s.host_words.push_back(word);
  s.host_words.push_back(chosen);
}

}    // namespace

RegionSettings parse_region(const std::vector<std::string> &tokens)
{
  RegionSettings settings;
  Tokens w(tokens);
  w.set_context("region mesh/lsdcd", kRegionSyntax);
  if (w.done()) w.fail("FILE is missing");
  settings.mesh.file = w.take();
  std::vector<std::string> seen;
  while (!w.done()) {
    const std::string word = w.take();
    w.set_context("region mesh/lsdcd", kRegionSyntax);
    if ((word == "move" || word == "rotate") && is_by_variable(w)) {
      if (is_twice(word + " v_", seen)) w.fail("'" + word + "' by a variable is given twice");
      keep_for_host(word, word == "move" ? 3 : 7, w, settings);
      continue;
    }
    if (is_twice(word, seen)) w.fail("the keyword '" + word + "' is given twice");
    if (word == "side") {
      keep_choice(word, {"in", "out"}, w, settings);
    } else if (word == "units") {
      keep_choice(word, {"box", "lattice"}, w, settings);
    } else if (word == "gap") {
      w.set_context("gap", "gap D");
      settings.gap = w.number("D", 0);
    } else if (word == "mesh" || !read_mesh_word(word, w, settings.mesh)) {
      w.fail("'" + word + "' is not a keyword");
    }
  }
  return settings;
}

}    // namespace lsdcd
