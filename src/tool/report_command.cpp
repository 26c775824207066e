// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Commands of the Python package, which has their options and their help.
#include "tool/commands.h"
#include "tool/python_script.h"

namespace lsdcd {

namespace {

// Goes on as a module of the package lsdcd.
void become_module(const std::string &module, const std::vector<std::string> &words)
{
  std::vector<std::string> all = {module};
  all.insert(all.end(), words.begin(), words.end());
  become_script("run_module.py", all);
}

}    // namespace

void add_report_command(Program &program)
{
  program.passes_on("report",
                    "makes one HTML file of a run: checks, numbers, plots, and a view of it",
                    [](const std::vector<std::string> &words) { become_module("report", words); });
}

void add_film_command(Program &program)
{
  program.passes_on("film", "draws a run as a film or as pictures",
                    [](const std::vector<std::string> &words) { become_module("film", words); });
}

}    // namespace lsdcd
