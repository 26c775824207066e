// lsdcd generate
#pragma once

#include <CLI/CLI.hpp>

namespace lsdcd {

void add_generate_command(CLI::App &app);

}    // namespace lsdcd
