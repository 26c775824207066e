// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/run_program.h"

#include "base/input_error.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace fs = std::filesystem;

namespace lsdcd {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook(5);    // between two looks at a program
constexpr double kGrace =
    2;    // seconds for mpirun to end its processes, which are not in its group

// Does not return. Only calls that are safe between fork and exec.
[[noreturn]] void exec_in(const char *folder, const char *output, char **words)
{
  setpgid(0, 0);
  const int in = open("/dev/null", O_RDONLY);
  if (chdir(folder) == 0) {
    const int out = open(output, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(in, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    execvp(words[0], words);
    const char *why = std::strerror(errno);
    if (write(STDERR_FILENO, why, std::strlen(why)) < 0) _exit(126);
  }
  _exit(127);
}

// Returns whether the child has ended within so many seconds, and then its status.
bool has_ended(pid_t child, double seconds, int &status)
{
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  for (;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return true;
    if (ended < 0 && errno != EINTR) {
      status = -1;
      return true;
    }
    if (Clock::now() >= end) return false;
    std::this_thread::sleep_for(kLook);
  }
}

void end_program(pid_t child)
{
  int status;
  kill(-child, SIGTERM);
  const bool ended = has_ended(child, kGrace, status);
  kill(-child, SIGKILL);    // what it has left
  if (!ended) waitpid(child, &status, 0);
}

}    // namespace

ProgramRun run_program(const std::vector<std::string> &words, const fs::path &folder,
                       double seconds)
{
  std::vector<std::string> copies = words;
  std::vector<char *> arguments;
  for (std::string &word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string file = folder / "output";
  ProgramRun run;
  const pid_t child = fork();
  if (child == 0) exec_in(folder.c_str(), file.c_str(), arguments.data());
  if (child < 0) {
    run.output = std::strerror(errno);
    return run;
  }
  setpgid(child, child);    // whichever of the two is first
  int status = -1;
  run.is_late = !has_ended(child, seconds, status);
  if (run.is_late)
    end_program(child);
  else
    run.status = WIFEXITED(status)     ? WEXITSTATUS(status)
                 : WIFSIGNALED(status) ? 128 + WTERMSIG(status)
                                       : -1;
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  run.output = text.str();
  return run;
}

bool may_run(const fs::path &file)
{
  std::error_code failed;
  return fs::is_regular_file(file, failed) && access(file.c_str(), X_OK) == 0;
}

std::vector<fs::path> folders_of_variable(const char *name)
{
  std::vector<fs::path> folders;
  const char *value = std::getenv(name);
  std::istringstream list(value ? value : "");
  for (std::string folder; std::getline(list, folder, ':');)
    if (!folder.empty()) folders.push_back(folder);
  return folders;
}

fs::path program_in_path(const std::string &name)
{
  for (const fs::path &folder : folders_of_variable("PATH"))
    if (may_run(folder / name)) return fs::absolute(folder / name);
  return {};
}

TemporaryFolder::TemporaryFolder()
{
  std::error_code failed;
  const fs::path above = fs::temp_directory_path(failed);
  std::string name = ((failed ? fs::path("/tmp") : above) / "lsdcd-check-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw InputError("a folder " + name + " for temporary files: " + std::strerror(errno) +
                     "; name a folder that can be written by TMPDIR");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
  std::error_code failed;
  fs::remove_all(path_, failed);
}

}    // namespace lsdcd
