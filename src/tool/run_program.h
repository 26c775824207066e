// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Other programs, for a limited time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lsdcd {

struct ProgramRun {
  bool is_late = false;    // it was ended, because its time was over
  int status =
      -1;    // with which it has ended; 128 and more: by signal status - 128; 127: it could not be started
  std::string output;    // standard output and error

  bool has_worked() const { return !is_late && status == 0; }
};

// Runs a program in a folder, where it leaves its output in the file "output", without input. After so many seconds it is ended, with all
// that it has started in its process group. A program without a folder in its name is looked for in PATH.
ProgramRun run_program(const std::vector<std::string> &words, const std::filesystem::path &folder,
                       double seconds);

// Returns the file of this name in the folders of PATH that may be run; empty: there is none.
std::filesystem::path program_in_path(const std::string &name);

// Returns the folders that an environment variable lists, separated by colons.
std::vector<std::filesystem::path> folders_of_variable(const char *name);

// Returns whether it is a file that may be run.
bool may_run(const std::filesystem::path &file);

// A new folder for temporary files, removed with all that is in it at the end.
class TemporaryFolder {
 public:
  // Throws InputError where it cannot be made.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &operator=(const TemporaryFolder &) = delete;

  const std::filesystem::path &path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}    // namespace lsdcd
