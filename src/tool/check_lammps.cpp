// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/check_lammps.h"

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/number_words.h"
#include "output/mesh_stl.h"
#include "tool/run_program.h"
#include "tool/shapes.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <unistd.h>
#include <utility>

namespace fs = std::filesystem;

namespace lsdcd {

namespace {

constexpr char kLauncher[] = "lmp-lsdcd", kPlugin[] = "lsdcdplugin.so",
               kKokkosPlugin[] = "lsdcdkkplugin.so";
// Stiffness times overlap, and rounding of a radius of 0.1 that is less the height of the centre: 1e-13.
constexpr Real kForce = 0.1, kForceTolerance = 1e-9;

struct Lammps {
  fs::path program, plugin;    // plugin: to be loaded; empty: the program has it
  fs::path kokkos_plugin;
};

fs::path own_program_folder()
{
  std::error_code failed;
  return fs::read_symlink("/proc/self/exe", failed).parent_path();
}

// Folders of plugins: those that LAMMPS loads from, then LSDCD's own, of a build or an installation.
std::vector<fs::path> folders_of_plugins()
{
  std::vector<fs::path> folders = folders_of_variable("LAMMPS_PLUGIN_PATH");
  const fs::path own = own_program_folder();
  folders.push_back(own.parent_path() / "lib");
  folders.push_back((own / LSDCD_PLUGINS).lexically_normal());
  return folders;
}

fs::path file_in(const std::vector<fs::path> &folders, const std::string &name)
{
  std::error_code failed;
  for (const fs::path &folder : folders)
    if (fs::is_regular_file(folder / name, failed)) return fs::absolute(folder / name);
  return {};
}

fs::path named_file(const std::string &option, const std::string &name, bool is_program)
{
  std::error_code failed;
  const fs::path file =
      is_program && name.find('/') == std::string::npos && !fs::exists(name, failed)
          ? program_in_path(name)
          : fs::path(name);
  if (file.empty() || !fs::is_regular_file(file, failed))
    throw InputError(option + " " + name + ": there is no such file" +
                     (is_program ? ", nor in PATH" : ""));
  if (is_program && !may_run(file))
    throw InputError(option + " " + name + ": it may not be run: chmod +x " + name);
  return fs::absolute(file);
}

// Without options LSDCD's own LAMMPS, beside this program or in PATH, else lmp of PATH with LSDCD's plugin. No program: there is none.
Lammps find_lammps(const LammpsCheckOptions &o)
{
  std::vector<fs::path> folders = folders_of_plugins();
  Lammps found;
  if (!o.plugin.empty()) {
    found.plugin = named_file("--plugin", o.plugin, false);
    folders.insert(folders.begin(), found.plugin.parent_path());
  }
  found.kokkos_plugin = found.plugin.filename().string().find("kkplugin") != std::string::npos
                            ? found.plugin
                            : file_in(folders, kKokkosPlugin);
  if (!o.program.empty())
    found.program = named_file("--lmp", o.program, true);
  else if (o.plugin.empty())
    found.program = may_run(own_program_folder() / kLauncher) ? own_program_folder() / kLauncher
                                                              : program_in_path(kLauncher);
  if (!found.program.empty()) return found;
  if (found.plugin.empty()) found.plugin = file_in(folders, kPlugin);
  if (!found.plugin.empty()) found.program = program_in_path("lmp");
  return found;
}

// `suffix`: of the fix.
std::string script_of(const fs::path &plugin, const std::string &suffix)
{
  const std::string load = plugin.empty() ? "" : "plugin load " + plugin.string() + "\n";
  return load +
         "units si\n"
         "atom_style sphere\n"
         "atom_modify map array\n"
         "boundary f f f\n"
         "comm_modify cutoff 0.3\n"
         "region box block -1 1 -1 1 -1 1\n"
         "create_box 1 box\n"
         "create_atoms 1 single 0.25 0.25 0.0999\n"
         "set group all diameter 0.2 density 1000\n"
         "fix move all nve/sphere\n"
         "fix wall all wall/lsdcd" +
         suffix +
         " hooke 1000 NULL 0 NULL 0 0 mesh plane.stl\n"
         "run 0\n"
         "variable force equal fz[1]\n"
         "print \"lsdcd check: force $(v_force:%.15g)\"\n"
         "info config accelerator\n";
}

// Returns what is behind the first such words of a text, to the end of the line; empty: they are not there.
std::string rest_of_line(const std::string &text, const std::string &words)
{
  const std::size_t at = text.find(words);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + words.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

// The line that says most about a failure: the plugin's own, LAMMPS's error, or the last one with a letter.
std::string telling_line(const std::string &output)
{
  std::istringstream lines(output);
  std::string last, error;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("plugin not loaded: ") != std::string::npos) return line;
    if (error.empty() && line.compare(0, 5, "ERROR") == 0) error = line;
    if (line.find_first_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ") !=
        std::string::npos)
      last = line;
  }
  return !error.empty() ? error : last.empty() ? "no output" : last;
}

// Why a run has not worked; empty: it has.
std::string failure_of(const ProgramRun &run, double seconds)
{
  const std::string last = telling_line(run.output);
  if (run.is_late) return "did not end in " + number_text(seconds) + " s; its last line: " + last;
  if (run.status != 0) return "ended with " + std::to_string(run.status) + ": " + last;
  const std::string word = rest_of_line(run.output, "lsdcd check: force ");
  if (word.empty()) return "printed no force: " + last;
  const Real error = std::fabs(std::strtod(word.c_str(), nullptr) / kForce - 1);
  return error <= kForceTolerance
             ? ""
             : "the force is " + word + " and should be " + number_text(kForce);
}

class Checking {
 public:
  explicit Checking(const LammpsCheckOptions &o) : o_(o), found_(find_lammps(o))
  {
    TriangleSoup soup;
    for (const auto &triangle : plane_shape(1, 1, 0))
      soup.corners.insert(soup.corners.end(), triangle.begin(), triangle.end());
    write_whole_file((folder_.path() / "plane.stl").string(), stl_bytes(soup));
  }

  std::vector<CheckLine> lines()
  {
    add_lammps();
    add_mpi();
    add_kokkos();
    return std::move(lines_);
  }

 private:
  void add(const std::string &name, CheckState state, const std::string &tried,
           const std::string &gave, const std::string &remedy = "")
  {
    lines_.push_back({name, state, tried, gave, remedy});
  }

  ProgramRun run(std::vector<std::string> words, const fs::path &plugin,
                 const std::string &suffix = "")
  {
    write_whole_file((folder_.path() / "in.check").string(), script_of(plugin, suffix));
    words.insert(words.end(), {"-in", "in.check", "-log", "none"});
    return run_program(words, folder_.path(), o_.seconds);
  }

  std::string limit_remedy() const { return "if the machine is busy, give more --seconds"; }

  void add_lammps()
  {
    const std::string looked = "lmp-lsdcd beside lsdcd and in PATH; lmp with lsdcdplugin.so";
    if (found_.program.empty())
      return add("LAMMPS", CheckState::absent, looked, "none is there",
                 "./run build makes it where LAMMPS is; or name yours by --lmp FILE --plugin FILE");
    const std::string program = found_.program.string(),
                      plugin = found_.plugin.empty() ? "its own" : found_.plugin.string();
    if (o_.seconds == 0)
      return add("LAMMPS", CheckState::absent, program, "not started, because of --seconds 0");
    const ProgramRun alone = run({program}, found_.plugin);
    output_ = alone.output;
    const std::string why = failure_of(alone, o_.seconds),
                      version = rest_of_line(output_, "LAMMPS (");
    const bool has_started = !version.empty(),
               has_style = !rest_of_line(output_, "Fix wall wall/lsdcd: ").empty();
    works_ = why.empty();
    add("LAMMPS", has_started ? CheckState::works : CheckState::fails, program,
        has_started ? "starts, version " + version.substr(0, version.find(')')) : why,
        has_started     ? ""
        : alone.is_late ? limit_remedy()
                        : "start " + program + " -h by hand; are its libraries found (ldd)?");
    if (!has_started) return;
    if (works_)
      return add("plugin", CheckState::works, plugin,
                 "LSDCD" + rest_of_line(output_, "\n  version    ") +
                     ", the force of a grain on a mesh is right");
    add("plugin", CheckState::fails, plugin, why,
        alone.is_late           ? limit_remedy()
        : has_style             ? "tell us, with the output of lsdcd check --json"
        : found_.plugin.empty() ? "name the plugin that was built for this LAMMPS by --plugin FILE"
                                : "build the plugin for this LAMMPS (doc/install.md)");
  }

  void add_mpi()
  {
    const std::string mpirun = program_in_path("mpirun").string();
    if (mpirun.empty())
      return add(
          "MPI", CheckState::absent, "mpirun in PATH", "there is none",
          "install the MPI that LAMMPS was built with (Debian: openmpi-bin), or load its module");
    const std::string tried = "mpirun -np 2";
    if (!works_)
      return add("MPI", CheckState::absent, tried, "not tried, without a LAMMPS that works");
    // Two processes on one busy core: Open MPI's would wait in turns for nothing.
    setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
    const ProgramRun two = run({mpirun, "-np", "2", found_.program.string()}, found_.plugin);
    const std::string why = failure_of(two, o_.seconds);
    if (!why.empty())
      return add("MPI", CheckState::fails, tried, why,
                 two.is_late ? limit_remedy()
                 : geteuid() == 0 && two.output.find("root") != std::string::npos
                     ? "as root set OMPI_ALLOW_RUN_AS_ROOT=1 and OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"
                     : "try mpirun -np 2 hostname; on one core add --oversubscribe");
    if (two.output.find("1 by 1 by 1 MPI") != std::string::npos)
      return add("MPI", CheckState::fails, tried,
                 "two runs of one process each instead of one of two",
                 "take the mpirun of the MPI that LAMMPS was built with; " +
                     found_.program.filename().string() + " -h names it");
    add("MPI", CheckState::works, tried, "the same force on two processes");
  }

  void add_kokkos()
  {
    const std::string tried = "package KOKKOS of LAMMPS";
    if (!works_)
      return add("Kokkos", CheckState::absent, tried, "not tried, without a LAMMPS that works");
    const std::string api = rest_of_line(output_, "KOKKOS package API: ");
    if (api.empty())
      return add("Kokkos", CheckState::absent, tried, "this LAMMPS does not have it",
                 "build one with it (doc/install.md), and name it by --lmp FILE --plugin FILE");
    if (found_.kokkos_plugin.empty())
      return add("Kokkos", CheckState::absent, kKokkosPlugin, "none is there",
                 "build it for this LAMMPS (doc/install.md), and name it by --plugin FILE");
    const bool on_cuda = api.find("CUDA") != std::string::npos;
    std::error_code failed;
    if (on_cuda && !fs::exists("/dev/nvidiactl", failed))
      return add("Kokkos", CheckState::absent, tried,
                 "its atoms are on a GPU, and this machine has none");
    std::vector<std::string> words = {found_.program.string(), "-k", "on", "-sf", "kk"};
    words.insert(words.begin() + 3, {on_cuda ? "g" : "t", "1"});
    const ProgramRun kk = run(words, found_.kokkos_plugin, "/kk");
    const std::string why = failure_of(kk, o_.seconds),
                      with = found_.kokkos_plugin.string() + " on " + api;
    if (why.empty())
      return add("Kokkos", CheckState::works, with, "the same force by wall/lsdcd/kk");
    add("Kokkos", CheckState::fails, with, why,
        kk.is_late ? limit_remedy()
                   : "build lsdcdkkplugin.so for this LAMMPS and this Kokkos (doc/install.md)");
  }

  const LammpsCheckOptions &o_;
  const Lammps found_;
  TemporaryFolder folder_;
  std::vector<CheckLine> lines_;
  bool works_ = false;
  std::string output_;    // of LAMMPS alone
};

}    // namespace

std::vector<CheckLine> check_lammps(const LammpsCheckOptions &options)
{
  return Checking(options).lines();
}

}    // namespace lsdcd
