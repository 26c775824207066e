// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/collide_settings.h"

#include "base/input_words.h"
#include "input/keywords.h"
#include "wall/spec/spec_words.h"

namespace lsdcd {

namespace {

const char *const kCollideSyntax =
    "compute ID group lsdcd/collide FIX_ID mesh FILE [scale s | sx sy sz] [rotate ax ay az "
    "degrees] [move x y z] [matrix m11 m12 m13 tx m21 m22 m23 ty m31 m32 m33 tz] [weld tol] "
    "[bodies one | molecule] [atoms FILE] [grid L | auto] [nearest N | all] [memory M] [device "
    "cpu | cuda | auto] [log full | brief] [names PREFIX NAME ...]";

// False where the word is no keyword.
bool read_word(const std::string &word, Tokens &w, CollideSettings &s)
{
  if (word == "bodies") {
    w.set_context("bodies", "bodies one | molecule");
    s.molecules = w.choice({"one", "molecule"}) == 1;
  } else if (word == "atoms") {
    w.set_context("atoms", "atoms FILE");
    if (w.done()) w.fail("the file name is missing");
    s.atoms_file = w.take();
  } else if (word == "grid") {
    w.set_context("grid", "grid L | auto");
    s.grid_length = w.number_or("auto", 0, "L", {kAboveZero, Tokens::kHuge});
  } else if (word == "nearest") {
    w.set_context("nearest", "nearest N | all");
    s.nearest = read_nearest(w);
  } else if (word == "memory") {
    w.set_context("memory", "memory M");
    s.memory = read_memory(w);
  } else if (word == "device") {
    w.set_context("device", "device cpu | cuda | auto");
    s.device = static_cast<Device>(w.choice(all_words(kDeviceWords)));
  } else if (word == "log") {
    w.set_context("log", "log full | brief");
    s.brief = w.choice({"full", "brief"}) == 1;
  } else {
    return false;
  }
  return true;
}

}    // namespace

CollideSettings parse_collide(const std::vector<std::string> &tokens)
{
  CollideSettings settings;
  Tokens w(tokens);
  w.set_context("compute lsdcd/collide", kCollideSyntax);
  if (w.done()) w.fail("FIX_ID is missing");
  settings.wall = w.take();
  std::vector<std::string> seen;
  while (!w.done()) {
    const std::string word = w.take();
    const bool twice = is_twice(word, seen);
    w.set_context("compute lsdcd/collide", kCollideSyntax);
    if (twice) w.fail("the keyword '" + word + "' is given twice");
    if (!read_mesh_word(word, w, settings.mesh) && !read_word(word, w, settings))
      w.fail("'" + word + "' is not a keyword");
  }
  w.set_context("compute lsdcd/collide", kCollideSyntax);
  if (settings.mesh.file.empty()) w.fail("mesh FILE is missing");
  return settings;
}

}    // namespace lsdcd
