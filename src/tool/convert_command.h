// lsdcd convert
#pragma once

#include <CLI/CLI.hpp>

namespace lsdcd {

void add_convert_command(CLI::App &app);

}    // namespace lsdcd
