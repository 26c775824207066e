// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/python_script.h"

#include "base/input_error.h"
#include "base/shared_files.h"

#include <cstdio>
#include <filesystem>
#include <sys/wait.h>
#include <unistd.h>

namespace lsdcd {

namespace {

// Does not return if there is an interpreter.
void exec_script(const std::string &name, const std::vector<std::string> &words)
{
  std::vector<std::string> all = {python_program(), python_script(name)};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char *> arguments;
  for (std::string &word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
}

}    // namespace

std::string python_program()
{
  return std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
}

std::string python_script(const std::string &name)
{
  return shared_folder() / name;
}

bool run_script(const std::string &name, const std::vector<std::string> &words)
{
  const pid_t child = fork();
  if (child == 0) {
    exec_script(name, words);
    _exit(127);
  }
  int status = -1;
  if (child > 0) waitpid(child, &status, 0);
  return status == 0;
}

void become_script(const std::string &name, const std::vector<std::string> &words)
{
  std::fflush(stdout);
  exec_script(name, words);
  throw InputError("this command is a program in Python, and python3 is missing (Debian: python3)");
}

}    // namespace lsdcd
