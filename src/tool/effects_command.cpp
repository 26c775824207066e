// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "effects/effects.h"
#include "tool/mesh_json.h"

#include <cstdio>
#include <memory>

namespace lsdcd {

void add_effects_command(Command &program)
{
  Command command = program.command(
      "effects", "lists all effects of a wall with their keywords and bytes per atom and contact");
  command.footer(
      "doc/effects.md has the time that each of them costs.\n\nExample:\n  lsdcd effects");
  const auto json = std::make_shared<bool>(false);
  command.flag("--json", *json, "print JSON");
  command.runs([json] {
    if (*json) {
      nlohmann::json all;
      for (const EffectCase &c : effect_cases())
        all.push_back({{"effect", c.name},
                       {"bytes_per_atom", bytes_per_atom(c.settings)},
                       {"bytes_per_contact", bytes_per_contact(c.settings)},
                       {"words", c.words}});
      std::printf("%s\n", all.dump(2).c_str());
      return;
    }
    std::printf("%-22s %9s %12s  %s\n", "effect", "B/atom", "B/contact", "turned on by");
    for (const EffectCase &c : effect_cases())
      std::printf("%-22s %9d %12d  %s\n", c.name.c_str(), bytes_per_atom(c.settings),
                  bytes_per_contact(c.settings), c.words.c_str());
  });
}

}    // namespace lsdcd
