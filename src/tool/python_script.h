// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Scripts in Python that come with the program, in shared_folder().
#pragma once

#include <string>
#include <vector>

namespace lsdcd {

// Returns Debian's interpreter, because another one in PATH would not see Debian's modules; without it
// that of PATH.
std::string python_program();
// Returns the path of a script.
std::string python_script(const std::string &name);
// Runs a script with some words. Returns whether it has ended well.
bool run_script(const std::string &name, const std::vector<std::string> &words);
// Goes on as a script with some words, in place of this program. Throws InputError where there is no interpreter.
void become_script(const std::string &name, const std::vector<std::string> &words);

}    // namespace lsdcd
