// lsdcd inspect, lsdcd grid
#pragma once

#include <CLI/CLI.hpp>

namespace lsdcd {

void add_inspect_command(CLI::App &app);
void add_grid_command(CLI::App &app);

}    // namespace lsdcd
