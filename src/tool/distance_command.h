// lsdcd distance
#pragma once

#include <CLI/CLI.hpp>

namespace lsdcd {

void add_distance_command(CLI::App &app);

}    // namespace lsdcd
