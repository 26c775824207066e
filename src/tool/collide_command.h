// lsdcd collide
#pragma once

#include <CLI/CLI.hpp>

namespace lsdcd {

void add_collide_command(CLI::App &app);

}    // namespace lsdcd
