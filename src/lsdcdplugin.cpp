// Registers fix wall/lsdcd with the LAMMPS that loads this file; nothing else.

#include "fix_wall_lsdcd.h"
#include "plugin_api.h"

#include <cstdio>
#include <dlfcn.h>
#include <mpi.h>

static void *create_fix(void *lmp, int narg, char **arg)
{
  return new LAMMPS_NS::FixWallLsdcd(static_cast<LAMMPS_NS::LAMMPS *>(lmp), narg, arg);
}

// LAMMPS's classes change their layout from version to version and nothing in the
// loader compares them: a plugin of another version would crash later. The C
// interface is stable, so it is asked before any LAMMPS object is touched.
static bool host_matches(void *lmp)
{
  using VersionFunction = int(void *);
  auto *ask = reinterpret_cast<VersionFunction *>(dlsym(RTLD_DEFAULT, "lammps_version"));
  const int host = ask ? ask(lmp) : 0;
  if (host == LSDCD_HOST_VERSION) return true;

  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) {
    char version[32] = "an unknown version";
    if (host) std::snprintf(version, sizeof version, "version %d", host);
    std::fprintf(stderr,
                 "lsdcd plugin not loaded: it was built for LAMMPS version %d, this is %s. "
                 "Rebuild it against this LAMMPS: cmake -B build -D LSDCD_HOST_INCLUDE=<its src "
                 "or include/lammps folder>\n",
                 LSDCD_HOST_VERSION, version);
  }
  return false;
}

extern "C" __attribute__((visibility("default"))) void lammpsplugin_init(void *lmp, void *handle,
                                                                         void *regfunc)
{
  if (!host_matches(lmp)) return;

  lammpsplugin_t plugin{};
  plugin.version = static_cast<LAMMPS_NS::LAMMPS *>(lmp)->version;
  plugin.style = "fix";
  plugin.name = "wall/lsdcd";
  plugin.info = "fix wall/lsdcd: DEM walls from an STL mesh";
  plugin.author = "the LSDCD authors";
  plugin.creator.v2 = create_fix;
  plugin.handle = handle;
  reinterpret_cast<lammpsplugin_regfunc>(regfunc)(&plugin, lmp);
}
