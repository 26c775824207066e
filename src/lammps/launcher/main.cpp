// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// lmp-lsdcd: LAMMPS's own command line, with plugins.

#include "base/input_error.h"
#include "base/version.h"
#include "input/collide_settings.h"
#include "input/impacts_settings.h"
#include "input/insert_settings.h"
#include "input/massflow_settings.h"
#include "input/pair_words.h"
#include "input/region_settings.h"
#include "input/wall_command.h"
#include "lammps/launcher/plugins.h"

#include "input.h"
#include "lammps.h"
#include "library.h"

#if __has_include("exceptions.h")
#include "exceptions.h"
#define LSDCD_HOST_THROWS
#endif

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <exception>
#include <mpi.h>
#include <string>

using namespace LAMMPS_NS;

// LAMMPS calls this on itself when its style maps are new: at the end of the
// constructor and of the clear command. Defined in the executable, it takes the
// place of the library's, does the same, and adds the plugins. It may go when every
// host that the launcher starts loads plugins by itself, from LAMMPS_PLUGIN_PATH.
void LAMMPS::post_create()
{
  using Original = void(LAMMPS *);
  static Original *const original =
      reinterpret_cast<Original *>(dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS6LAMMPS11post_createEv"));
  lsdcd::provide_plugins(this);
  original(this);
}

// The syntax of a command, as its error names it where the command has no arguments.
template <class Parse>
static std::string syntax_of(Parse parse)
{
  try {
    parse({});
  } catch (const lsdcd::InputError &e) {
    const std::string text = e.what(), before = "Syntax: ";
    return text.substr(text.find(before) + before.size());
  }
  return "";
}

static void show_help(int argc, char **argv)
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank) return;
  for (int i = 1; i < argc; i++)
    if (!std::strcmp(argv[i], "-h") || !std::strcmp(argv[i], "-help")) {
      std::printf(
          "lmp-lsdcd %s: LAMMPS %d with fix wall/lsdcd, fix massflow/lsdcd, "
          "fix insert/lsdcd, fix gravity/lsdcd, pair_style granular/lsdcd, compute lsdcd/collide, "
          "compute lsdcd/energy, compute lsdcd/impacts, region mesh/lsdcd and the "
          "plugin command\n\n%s\n"
          "%s\n  counts, weighs or deletes the spheres that pass a mesh\n\n"
          "%s\n  puts grains through a flat mesh or into a region, clear of the walls\n\n"
          "fix ID group gravity/lsdcd ..., as fix gravity\n  has no wait in each step on a GPU\n\n"
          "pair_style granular/lsdcd [CUTOFF]\n%s\n  the wall's contact laws between grains\n\n"
          "%s\n  counts where rigid bodies with a mesh meet the wall of a fix wall/lsdcd\n\n"
          "compute ID all lsdcd/energy\n  what contacts of pair_style granular/lsdcd dissipate, "
          "and "
          "the balance with the walls\n\n"
          "%s\n  counts and weighs impacts between grains of pair_style granular/lsdcd\n\n"
          "%s\n  the inside of a closed mesh; regions of LAMMPS have the last four keywords, "
          "too\n\n"
          "plugin load FILES | unload STYLE NAME | list | clear\n"
          "  LAMMPS_PLUGIN_PATH lists folders of plugins to load at the start\n",
          lsdcd::version(), LSDCD_HOST_VERSION, lsdcd::wall_help().c_str(),
          syntax_of(lsdcd::parse_massflow).c_str(), syntax_of(lsdcd::parse_insert).c_str(),
          lsdcd::pair_coeff_syntax().c_str(), syntax_of(lsdcd::parse_collide).c_str(),
          syntax_of(lsdcd::parse_impacts).c_str(), syntax_of(lsdcd::parse_region).c_str());
      std::fflush(stdout);
      return;
    }
}

static void finalize()
{
  lammps_kokkos_finalize();
  lammps_python_finalize();
}

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  show_help(argc, argv);
  try {
    LAMMPS *lammps = new LAMMPS(argc, argv, MPI_COMM_WORLD);
    lammps->input->file();
    delete lammps;
#ifdef LSDCD_HOST_THROWS
  } catch (const LAMMPSAbortException &e) {
    // Thrown by one process alone; LAMMPS has printed the message.
    finalize();
    MPI_Abort(MPI_COMM_WORLD, 1);
  } catch (const LAMMPSException &) {
    finalize();
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Finalize();
    return 1;
#endif
  } catch (const std::exception &e) {
    std::fprintf(stderr, "ERROR: %s\n", e.what());
    finalize();
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  finalize();
  MPI_Barrier(MPI_COMM_WORLD);
  MPI_Finalize();
  return 0;
}
