// `lsdcd tradeoff`: what each setting buys and costs on the user's mesh.
#pragma once

#include <CLI/CLI.hpp>

namespace lsdcd {

void add_tradeoff_command(CLI::App &app);

}    // namespace lsdcd
