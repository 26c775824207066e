// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Registers the styles of this library, and their forms for Kokkos, with the Kokkos LAMMPS that loads this file.

#include "fix_gravity_lsdcd_kokkos.h"
#include "fix_insert_lsdcd_kokkos.h"
#include "fix_massflow_lsdcd_kokkos.h"
#include "fix_springs_lsdcd_kokkos.h"
#include "fix_wall_lsdcd_kokkos.h"
#include "guarded_fix_kokkos.h"
#include "pair_granular_lsdcd_kokkos.h"

#include "lammps/plugin_styles.h"

#include "force.h"

#include <cstdio>
#include <mpi.h>
#include <sstream>
#include <string>

using namespace LAMMPS_NS;
using lsdcd::create_fix;
using lsdcd::create_pair;

static std::string version_text(int version)
{
  return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
         std::to_string(version % 100);
}

// The number that follows the first `name` in a text; 0 without one.
static int version_after(const std::string &text, const std::string &name)
{
  std::size_t at = text.find(name);
  if (at == std::string::npos) return 0;
  at = text.find_first_of("0123456789", at + name.size());
  int part[3] = {0, 0, 0}, n = 0;
  if (at != std::string::npos)
    n = std::sscanf(text.c_str() + at, "%d.%d.%d", part, part + 1, part + 2);
  return n == 1 ? part[0] : 10000 * part[0] + 100 * part[1] + part[2];
}

// The running Kokkos, which is the host's, says what it is. plugin_guard.cpp has asked for the rest.
static bool kokkos_matches()
{
  if (!Kokkos::is_initialized()) return true;
  std::ostringstream configuration;
  Kokkos::print_configuration(configuration);
  const int host = version_after(configuration.str(), "Kokkos Version:");
  if (host == KOKKOS_VERSION) return true;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0)
    std::fprintf(
        stderr,
        "lsdcd Kokkos plugin not loaded: it was built for Kokkos %s, this LAMMPS has Kokkos "
        "%s. Rebuild it against this LAMMPS: cmake -B build-host -D LSDCD_KOKKOS_HOST=<its build "
        "folder>, or load lsdcdplugin.so for the fix without /kk\n",
        version_text(KOKKOS_VERSION).c_str(), version_text(host).c_str());
  return false;
}

extern "C" __attribute__((visibility("default"))) void lsdcd_add_styles(void *lmp, void *handle,
                                                                        void *regfunc)
{
  if (!kokkos_matches()) return;
  lsdcd::add_plain_styles(lmp, handle, regfunc);
  const auto add = [&](const char *name, lammpsplugin_factory2 *create) {
    lsdcd::add_style("fix", lmp, handle, regfunc, name, "the same with Kokkos", create);
  };
  // Names are kept as they are given.
  add("wall/lsdcd/kk", create_fix<GuardedFixKokkos<FixWallLsdcdKokkos<LMPDeviceType>>>);
  add("wall/lsdcd/kk/device", create_fix<GuardedFixKokkos<FixWallLsdcdKokkos<LMPDeviceType>>>);
  add("wall/lsdcd/kk/host", create_fix<GuardedFixKokkos<FixWallLsdcdKokkos<LMPHostType>>>);
  add("massflow/lsdcd/kk", create_fix<GuardedFixKokkos<FixMassflowLsdcdKokkos>>);
  add("massflow/lsdcd/kk/device", create_fix<GuardedFixKokkos<FixMassflowLsdcdKokkos>>);
  add("massflow/lsdcd/kk/host", create_fix<GuardedFixOnHost<FixMassflowLsdcd>>);
  add("insert/lsdcd/kk", create_fix<GuardedFixOnHost<FixInsertLsdcdKokkos>>);
  add("insert/lsdcd/kk/device", create_fix<GuardedFixOnHost<FixInsertLsdcdKokkos>>);
  add("insert/lsdcd/kk/host", create_fix<GuardedFixOnHost<FixInsertLsdcdKokkos>>);
  add("gravity/lsdcd/kk", create_fix<FixGravityLsdcdKokkos<LMPDeviceType>>);
  add("gravity/lsdcd/kk/device", create_fix<FixGravityLsdcdKokkos<LMPDeviceType>>);
  add("gravity/lsdcd/kk/host", create_fix<FixGravityLsdcdKokkos<LMPHostType>>);

  // The pair style asks for these by their whole names.
  add("SPRINGS/LSDCD/KK/DEVICE",
      create_fix<GuardedFixKokkos<FixSpringsLsdcdKokkos<LMPDeviceType>>>);
  add("SPRINGS/LSDCD/KK/HOST", create_fix<GuardedFixKokkos<FixSpringsLsdcdKokkos<LMPHostType>>>);
  const auto add_pair = [&](const char *name, lammpsplugin_factory1 *create) {
    lsdcd::add_pair_style(lmp, handle, regfunc, name, "the same with Kokkos", create);
  };
  add_pair("granular/lsdcd/kk", create_pair<GuardedPair<PairGranularLsdcdKokkos<LMPDeviceType>>>);
  add_pair("granular/lsdcd/kk/device",
           create_pair<GuardedPair<PairGranularLsdcdKokkos<LMPDeviceType>>>);
  add_pair("granular/lsdcd/kk/host",
           create_pair<GuardedPair<PairGranularLsdcdKokkos<LMPHostType>>>);
  if (!static_cast<LAMMPS *>(lmp)->force->pair_map->count("granular/kk"))
    add_pair("granular/kk", create_pair<GuardedPair<PairAsGranularKokkos<LMPDeviceType>>>);
}
