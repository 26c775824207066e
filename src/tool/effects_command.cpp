// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "effects/effects.h"

#include <cstdio>

namespace lsdcd {

void add_effects_command(Command &program)
{
  Command command =
      program.command("effects", "every effect of a wall: its words, bytes per atom and contact");
  command.footer("What each costs in time is in doc/effects.md.\n\nExample:\n  lsdcd effects");
  command.runs([] {
    std::printf("%-22s %9s %12s  %s\n", "effect", "B/atom", "B/contact", "turned on by");
    for (const EffectCase &c : effect_cases())
      std::printf("%-22s %9d %12d  %s\n", c.name.c_str(), bytes_per_atom(c.settings),
                  bytes_per_contact(c.settings), c.words.c_str());
  });
}

}    // namespace lsdcd
