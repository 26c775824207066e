// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Registers the styles of this library, and fix wall/lsdcd/kk, with the Kokkos LAMMPS that loads this file.

#include "fix_wall_lsdcd_kokkos.h"

#include "lammps/plugin_styles.h"

#include <cstdio>
#include <dlfcn.h>
#include <mpi.h>
#include <sstream>
#include <string>

using LAMMPS_NS::FixWallLsdcdKokkos;
using lsdcd::create_fix;

// Where Kokkos computes, and how vectors lie in its memory, in LAMMPS's words; older ones have
// one layout only.
#if defined(LMP_KOKKOS_LAYOUT_DEFAULT)
static constexpr char kLayout[] = "default";
#elif defined(LMP_KOKKOS_LAYOUT_LEGACY)
static constexpr char kLayout[] = "legacy";
#else
static constexpr char kLayout[] = "";
#endif
#if defined(KOKKOS_ENABLE_CUDA)
static constexpr char kBackend[] = "cuda";
#elif defined(KOKKOS_ENABLE_OPENMP)
static constexpr char kBackend[] = "openmp";
#else
static constexpr char kBackend[] = "serial";
#endif

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

// What of the host's Kokkos is not what this file was compiled for; empty if all is.
static std::string what_differs()
{
  using Feature = int(const char *, const char *, const char *);
  auto *has = reinterpret_cast<Feature *>(dlsym(RTLD_DEFAULT, "lammps_config_accelerator"));
  if (!has || !has("KOKKOS", "precision", "double"))
    return "has no KOKKOS package in double precision";
  if (!has("KOKKOS", "api", kBackend)) return std::string("has no Kokkos backend ") + kBackend;
  if (*kLayout && !has("KOKKOS", "layout", kLayout))
    return std::string("has no view layout ") + kLayout;
  // The running Kokkos, which is the host's, says what it is; versions from 3.6 on do.
  if (!Kokkos::is_initialized()) return "";
  std::ostringstream configuration;
  Kokkos::print_configuration(configuration);
  const int host = version_after(configuration.str(), "Kokkos Version:");
  if (host && host != KOKKOS_VERSION) return "has Kokkos " + version_text(host);
  return "";
}

static bool kokkos_matches()
{
  const std::string differs = what_differs();
  if (differs.empty()) return true;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0)
    std::fprintf(stderr,
                 "lsdcd Kokkos plugin not loaded: it was built for Kokkos %s with the backend %s "
                 "in double precision, this LAMMPS %s. Rebuild it against this LAMMPS: cmake -B "
                 "build -D LSDCD_KOKKOS_HOST=<folder>, or load lsdcdplugin.so for the fix "
                 "without /kk\n",
                 version_text(KOKKOS_VERSION).c_str(), kBackend, differs.c_str());
  return false;
}

extern "C" __attribute__((visibility("default"))) void lammpsplugin_init(void *lmp, void *handle,
                                                                         void *regfunc)
{
  if (!lsdcd::host_matches(lmp) || !kokkos_matches()) return;
  lsdcd::add_plain_styles(lmp, handle, regfunc);
  const auto add = [&](const char *name, lammpsplugin_factory2 *create) {
    lsdcd::add_style("fix", lmp, handle, regfunc, name, "the same with Kokkos", create);
  };
  add("wall/lsdcd/kk", create_fix<FixWallLsdcdKokkos<LMPDeviceType>>);
  add("wall/lsdcd/kk/device", create_fix<FixWallLsdcdKokkos<LMPDeviceType>>);
  add("wall/lsdcd/kk/host", create_fix<FixWallLsdcdKokkos<LMPHostType>>);
}
