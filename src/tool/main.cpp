// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd: what can be done with a mesh without a simulation, and with the files of one.
#include "base/version.h"
#include "tool/commands.h"

#include <cstdio>
#include <exception>
#include <new>
#include <string>

using namespace lsdcd;

namespace {

// Exit codes of the program; doc/tool.md has them too.
constexpr int kDone = 0, kUnusable = 1, kUsage = 2;

int run(int argc, char **argv)
{
  Program program("lsdcd: meshes of DEM walls, their grids, distances to them, bodies in them, "
                  "materials, shapes of grains, and reports and films of runs",
                  std::string("lsdcd ") + version() + (*LSDCD_COMMIT ? " (" LSDCD_COMMIT ")" : ""));
  program.footer(
      "lsdcd COMMAND --help shows its options and an example.\n"
      "Exit codes: 0: done; 1: a file or mesh cannot be used, or check has found what fails;\n"
      "2: wrong arguments; 3: repair has written what it cannot mend in full.");
  int exit_code = kDone;
  add_inspect_command(program);
  add_repair_command(program, exit_code);
  add_convert_command(program);
  add_generate_command(program);
  add_grid_command(program);
  add_distance_command(program);
  add_collide_command(program);
  add_material_command(program);
  add_timestep_command(program);
  add_shape_command(program);
  add_clump_command(program);
  add_tradeoff_command(program);
  add_accuracy_command(program);
  add_effects_command(program);
  add_check_command(program, exit_code);
  add_report_command(program);
  add_film_command(program);
  return program.run(argc, argv) ? exit_code : kUsage;
}

}    // namespace

int main(int argc, char **argv)
{
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc &) {
    std::fprintf(stderr, "lsdcd: no memory left\n");
  } catch (const std::exception &e) {
    std::fprintf(stderr, "lsdcd: %s\n", e.what());
  }
  return kUnusable;
}
