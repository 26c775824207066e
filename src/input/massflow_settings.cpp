// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/massflow_settings.h"

#include "base/input_words.h"
#include "input/keywords.h"

namespace lsdcd {

namespace {

const char *const kMassflowSyntax =
    "fix ID group massflow/lsdcd mesh FILE [scale s | sx sy sz] [rotate ax ay az degrees] "
    "[move x y z] [matrix m11 m12 m13 tx m21 m22 m23 ty m31 m32 m33 tz] [weld tol] [count each "
    "| once] [delete no | yes] [clumps no | yes] [every N] [file NAME] [log full | brief]";

}    // namespace

MassflowSettings parse_massflow(const std::vector<std::string> &tokens)
{
  MassflowSettings settings;
  Tokens w(tokens);
  std::vector<std::string> seen;
  while (!w.done()) {
    const std::string word = w.take();
    const bool twice = is_twice(word, seen);
    w.set_context("fix massflow/lsdcd", kMassflowSyntax);
    if (twice) w.fail("the keyword '" + word + "' is given twice");
    if (read_mesh_word(word, w, settings.surface)) continue;
    if (word == "count") {
      w.set_context("count", "count each | once");
      settings.once = w.choice({"each", "once"}) == 1;
    } else if (word == "log") {
      w.set_context("log", "log full | brief");
      settings.brief = w.choice({"full", "brief"}) == 1;
    } else if (word == "delete") {
      w.set_context("delete", "delete no | yes");
      settings.deletes = w.choice({"no", "yes"}) == 1;
    } else if (word == "clumps") {
      w.set_context("clumps", "clumps no | yes");
      settings.clumps = w.choice({"no", "yes"}) == 1;
    } else if (word == "file") {
      w.set_context("file", "file NAME");
      if (w.done()) w.fail("its name is missing");
      settings.file = w.take();
    } else if (word == "every") {
      w.set_context("every", "every N");
      settings.every = static_cast<int>(w.whole("N", 1, 2147483647));
    } else {
      w.fail("'" + word + "' is not a keyword");
    }
  }
  w.set_context("fix massflow/lsdcd", kMassflowSyntax);
  if (settings.surface.file.empty()) w.fail("mesh FILE is missing");
  return settings;
}

}    // namespace lsdcd
