// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// lmp-lsdcd: LAMMPS's own command line, with plugins.

#include "base/version.h"
#include "input/settings.h"
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

using namespace LAMMPS_NS;

// LAMMPS calls this on itself when its style maps are new: at the end of the
// constructor and of the clear command. Defined in the executable, it takes the
// place of the library's, does the same, and adds the plugins.
void LAMMPS::post_create()
{
  using Original = void(LAMMPS *);
  static Original *const original =
      reinterpret_cast<Original *>(dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS6LAMMPS11post_createEv"));
  lsdcd::provide_plugins(this);
  original(this);
}

static void show_help(int argc, char **argv)
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank) return;
  for (int i = 1; i < argc; i++)
    if (!std::strcmp(argv[i], "-h") || !std::strcmp(argv[i], "-help")) {
      std::printf("lmp-lsdcd %s: LAMMPS %d with fix wall/lsdcd and the plugin command\n\n%s\n"
                  "plugin load FILES | unload STYLE NAME | list | clear\n"
                  "  LAMMPS_PLUGIN_PATH lists folders of plugins to load at the start\n",
                  lsdcd::version(), LSDCD_HOST_VERSION, lsdcd::settings_help().c_str());
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
