// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "effects/effects.h"
#include "pair/pair_job.h"
#include "tool/mesh_json.h"

#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>

namespace lsdcd {

namespace {

// Of a touching pair of grains.
std::size_t bytes_per_pair(const ContactLaw &law)
{
  return law.has_history() ? PairHistory::bytes_per_pair(3 + law.n_extra()) : 0;
}

}    // namespace

void add_effects_command(Command &program)
{
  Command command = program.command("effects", "lists all effects of a wall with their keywords "
                                               "and bytes per atom, contact and pair of grains");
  command.footer(
      "doc/effects.md has the time that each of them costs.\n\nExample:\n  lsdcd effects");
  const auto json = std::make_shared<bool>(false);
  command.flag("--json", *json, "print JSON");
  command.runs([json] {
    if (*json) {
      nlohmann::json all;
      for (const EffectCase &c : effect_cases()) {
        all.push_back({{"effect", c.name},
                       {"bytes_per_atom", bytes_per_atom(c.settings)},
                       {"bytes_per_contact", bytes_per_contact(c.settings)},
                       {"words", c.words}});
        if (acts_on_pairs(c.settings))
          all.back()["bytes_per_pair"] = bytes_per_pair(c.settings.law());
      }
      print_json(stdout, all);
      return;
    }
    std::printf("%-25s %9s %12s %9s  %s\n", "effect", "B/atom", "B/contact", "B/pair",
                "turned on by");
    for (const EffectCase &c : effect_cases()) {
      const std::string pair = acts_on_pairs(c.settings)
                                   ? std::to_string(bytes_per_pair(c.settings.law()))
                                   : std::string("-");
      std::printf("%-25s %9d %12d %9s  %s\n", c.name.c_str(), bytes_per_atom(c.settings),
                  bytes_per_contact(c.settings), pair.c_str(), c.words.c_str());
    }
  });
}

}    // namespace lsdcd
