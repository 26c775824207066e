// lsdcd effects: every effect of a wall, and what it costs.
#pragma once

#include <CLI/CLI.hpp>

namespace lsdcd {

void add_effects_command(CLI::App &app);

}    // namespace lsdcd
