// lsdcd repair
#pragma once

#include <CLI/CLI.hpp>

namespace lsdcd {

// Sets `exit_code` where something is left that cannot be mended.
void add_repair_command(CLI::App &app, int &exit_code);

}    // namespace lsdcd
