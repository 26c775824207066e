// `lsdcd material`: what a material file says, and what a deck would get from it.
#pragma once

#include <CLI/CLI.hpp>

namespace lsdcd {

void add_material_command(CLI::App &app);

}    // namespace lsdcd
