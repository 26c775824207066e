// lsdcd accuracy: the paper's study.
#pragma once

#include <CLI/CLI.hpp>

namespace lsdcd {

void add_accuracy_command(CLI::App &app);

}    // namespace lsdcd
