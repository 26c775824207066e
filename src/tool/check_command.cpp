// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "backend/cuda_available.h"
#include "backend/threads.h"
#include "base/version.h"
#include "tool/check_lammps.h"
#include "tool/check_step.h"
#include "tool/mesh_json.h"
#include "tool/number_options.h"

#if defined(LSDCD_HAVE_CUDA)
#include <cuda_runtime_api.h>
#endif

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

namespace fs = std::filesystem;

namespace lsdcd {

namespace {

struct CheckOptions : LammpsCheckOptions {
  bool json = false;
};

struct CheckAnswer {
  std::vector<CheckLine> lines;
  double cpu_ns = kNotGiven, gpu_ns = kNotGiven;    // of a contact

  int failed() const
  {
    return static_cast<int>(std::count_if(lines.begin(), lines.end(), [](const CheckLine &line) {
      return line.state == CheckState::fails;
    }));
  }
};

std::string compiler()
{
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "g++ " __VERSION__;
#else
  return "another compiler";
#endif
}

#if defined(LSDCD_HAVE_CUDA)
// "13.0" for 13000.
std::string cuda_version(int number)
{
  return std::to_string(number / 1000) + "." + std::to_string(number % 1000 / 10);
}
#endif

CheckLine build_line()
{
#if defined(LSDCD_HAVE_CUDA)
  const std::string cuda = "with CUDA " + cuda_version(CUDART_VERSION);
#else
  const std::string cuda = "without CUDA";
#endif
  return {"lsdcd", CheckState::works,
          std::string("version ") + version() + (*LSDCD_COMMIT ? " (" LSDCD_COMMIT ")" : ""),
          "built by " + compiler() + ", " + cuda};
}

CheckLine cores_line()
{
  const bool asked = threads_asked_for();
  return {"CPU", CheckState::works, "cores and threads",
          std::to_string(std::thread::hardware_concurrency()) + " cores for this process; " +
              std::to_string(threads()) + (threads() == 1 ? " thread" : " threads") +
              (asked ? " by OMP_NUM_THREADS" : ", as OMP_NUM_THREADS is not set")};
}

// Times a step on a device, and compares its forces.
CheckLine step_line(const char *name, Device device, const std::string &remedy, double &ns)
{
  CheckLine line = {name, CheckState::fails, "a step of 10000 spheres on a plane", "", remedy};
  try {
    const CheckedStep step = check_step(device);
    char text[160];
    std::snprintf(text, sizeof text, "%.3g ns a contact, forces are Hooke's to %.1g",
                  step.ns_per_contact, step.largest_error);
    line.tried += ", " + step.device;
    line.gave = text;
    ns = step.ns_per_contact;
    if (step.largest_error <= kStepTolerance) {
      line.state = CheckState::works;
      line.remedy.clear();
    }
  } catch (const std::exception &e) {
    line.gave = e.what();
  }
  return line;
}

// Has the driver made a GPU of NVIDIA a file?
bool is_gpu_there()
{
  std::error_code failed;
  for (const auto &entry : fs::directory_iterator("/dev", failed)) {
    const std::string name = entry.path().filename();
    if (name.compare(0, 6, "nvidia") == 0 && name.size() > 6 &&
        std::isdigit(static_cast<unsigned char>(name[6])))
      return true;
  }
  return false;
}

std::string driver()
{
  std::string number;
  std::ifstream("/sys/module/nvidia/version") >> number;
  std::string text = number.empty() ? "driver of unknown version" : "driver " + number;
#if defined(LSDCD_HAVE_CUDA)
  int newest = 0;
  if (cudaDriverGetVersion(&newest) == cudaSuccess && newest > 0)
    text += " up to CUDA " + cuda_version(newest);
#endif
  return text;
}

void add_gpu_lines(CheckAnswer &a)
{
  std::string why;
  const std::string tried = "a GPU of NVIDIA";
  const int count = cuda_available(&why) ? cuda_devices() : 0;
  if (count > 0) {
    a.lines.push_back({"GPU", CheckState::works, tried,
                       std::to_string(count) + (count == 1 ? " GPU, " : " GPUs, ") + driver()});
    a.lines.push_back(step_line("GPU step", Device::cuda,
                                "is the driver as new as the CUDA of this build, and the GPU one "
                                "that it was compiled for (./run build all)?",
                                a.gpu_ns));
    return;
  }
  if (!is_gpu_there()) {
    a.lines.push_back({"GPU", CheckState::absent, tried,
                       "this machine has none, or no driver for it", "walls compute on the CPU"});
    return;
  }
#if defined(LSDCD_HAVE_CUDA)
  a.lines.push_back({"GPU", CheckState::fails, tried,
                     "there is one with " + driver() + ", but " + why,
                     "install a driver for CUDA " + cuda_version(CUDART_VERSION) + " or newer"});
#else
  a.lines.push_back({"GPU", CheckState::absent, tried,
                     "there is one with " + driver() + ", but the build has no CUDA: " + why,
                     "build again where nvcc is in PATH"});
#endif
}

const char *word_of(CheckState state)
{
  return state == CheckState::works ? "works" : state == CheckState::absent ? "no" : "FAILS";
}

nlohmann::json as_json(const CheckAnswer &a)
{
  nlohmann::json checks = nlohmann::json::array();
  for (const CheckLine &line : a.lines)
    checks.push_back({{"name", line.name},
                      {"state", line.state == CheckState::fails ? "fails" : word_of(line.state)},
                      {"tried", line.tried},
                      {"gave", line.gave},
                      {"remedy", line.remedy}});
  const auto number = [](double ns) {
    return std::isnan(ns) ? nlohmann::json() : nlohmann::json(ns);
  };
  return {{"works", a.failed() == 0},
          {"version", version()},
          {"ns_per_contact", {{"cpu", number(a.cpu_ns)}, {"gpu", number(a.gpu_ns)}}},
          {"checks", checks}};
}

void print(const CheckAnswer &a)
{
  for (const CheckLine &line : a.lines)
    std::printf("%-9s %-6s %s: %s%s%s\n", line.name.c_str(), word_of(line.state),
                line.tried.c_str(), line.gave.c_str(),
                line.remedy.empty() ? "" : "; remedy: ", line.remedy.c_str());
  if (a.failed() == 0)
    std::printf("\nAll that is here works.\n");
  else
    std::printf("\n%d of these %s.\n", a.failed(), a.failed() == 1 ? "fails" : "fail");
}

bool run(const CheckOptions &o)
{
  CheckAnswer a;
  a.lines = {build_line(), cores_line()};
  a.lines.push_back(
      step_line("CPU step", Device::cpu, "build LSDCD again, and tell us if it stays", a.cpu_ns));
  add_gpu_lines(a);
  for (const CheckLine &line : check_lammps(o)) a.lines.push_back(line);
  if (o.json)
    print_json(stdout, as_json(a));
  else
    print(a);
  return a.failed() == 0;
}

}    // namespace

void add_check_command(Command &program, int &exit_code)
{
  const auto o = std::make_shared<CheckOptions>();
  Command command = program.command(
      "check",
      "says whether CPU, GPU, LAMMPS with the plugin, MPI and Kokkos of this machine work");
  command.footer(
      "A step of the wall is timed and its forces are compared with stiffness times overlap, on\n"
      "one core, on the GPU, and in LAMMPS: alone, on two processes, and by Kokkos. What is not\n"
      "there is no error: its line says `no`. The exit code is 1 if a line says FAILS. LAMMPS is\n"
      "lmp-lsdcd, beside this program or in PATH, else lmp of PATH with the plugin\n"
      "lsdcdplugin.so of LAMMPS_PLUGIN_PATH or of LSDCD's folder of plugins.\n\n"
      "Example:\n"
      "  lsdcd check");
  command.option("--lmp", o->program, "the LAMMPS to try").shows_words("FILE");
  command.option("--plugin", o->plugin, "the plugin that it loads, with or without /kk")
      .shows_words("FILE");
  command.option("--seconds", o->seconds, "that each other program may take; 0: none is started")
      .check(not_below_zero)
      .shows_default();
  command.flag("--json", o->json, "print JSON");
  command.runs([o, &exit_code] { exit_code = run(*o) ? 0 : 1; });
}

}    // namespace lsdcd
