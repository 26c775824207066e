// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The file that a user loads. It asks the running LAMMPS what it is. If that is what the plugin was
// built for, it opens the file with the styles, which lies beside it; else it says what differs.
//
// LAMMPS itself compares nothing. Its classes change their layout from version to version, so that
// styles of another version would crash later; handles of one MPI library are nonsense in another;
// and a file that was built for other sizes of integers does not open at all. Therefore this file
// needs no name of LAMMPS or MPI: it opens in every host, and looks names up.

#include "lmptype.h"

#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <mpi.h>    // for what it defines; nothing that it declares is called. MPI_STUBS: LAMMPS's stand-in

namespace {

// The MPI library that the styles were built for, and a name that only libraries like it have.
// Intel's, Cray's and MVAPICH are libraries like MPICH.
#if defined(OPEN_MPI)
constexpr char kMpi[] = "Open MPI", kMpiMark[] = "ompi_mpi_comm_world";
#elif defined(MPICH_NAME)
constexpr char kMpi[] = "MPICH", kMpiMark[] = "MPIR_Dup_fn";
#elif defined(MPI_STUBS)
constexpr char kMpi[] = "no MPI", kMpiMark[] = "";
#else
constexpr char kMpi[] = "another MPI library", kMpiMark[] = "MPI_Init";
#endif
#ifdef MPI_STUBS
constexpr bool kSerial = true;
#else
constexpr bool kSerial = false;
#endif

#ifdef LSDCD_KOKKOS_BACKEND
constexpr char kName[] = "lsdcd Kokkos plugin", kFolder[] = "LSDCD_KOKKOS_HOST=<its build folder>";
#else
constexpr char kName[] = "lsdcd plugin",
               kFolder[] = "LSDCD_HOST_INCLUDE=<its src or include/lammps folder>";
#endif
constexpr char kRebuild[] = "Rebuild it against this LAMMPS: cmake -B build-host -D";

// A function of the host; null if it has none of this name.
template <class Function>
Function *host_function(const char *name)
{
  return reinterpret_cast<Function *>(dlsym(RTLD_DEFAULT, name));
}

// Below 0 for a setting that the host does not know.
int setting(void *lmp, const char *name)
{
  auto *ask = host_function<int(void *, const char *)>("lammps_extract_setting");
  return ask ? ask(lmp, name) : -1;
}

// LAMMPS's name for the sizes in bytes of an atom's ID and of a count of atoms.
const char *size_name(int tagint, int bigint)
{
  if (tagint == 4 && bigint == 8) return "LAMMPS_SMALLBIG";
  if (tagint == 8 && bigint == 8) return "LAMMPS_BIGBIG";
  if (tagint == 4 && bigint == 4) return "LAMMPS_SMALLSMALL";
  return "<unknown>";
}

// Writes the first words of what the host's MPI library says it is, and returns whether it is one
// that the styles can call. The version is the one call that takes no handle, so that it means the
// same in each library. Several libraries may be in one process, as that of Python's mpi4py: the
// mark is looked for where the function is that answers. Profilers replace MPI_ names, not PMPI_.
bool ask_mpi(char *words, std::size_t size)
{
  static char text[64 * 1024];    // MPICH asks for 8192
  std::strcpy(text, "an unknown MPI library");
  void *library = RTLD_DEFAULT;
  if (auto *ask = host_function<int(char *, int *)>("PMPI_Get_library_version")) {
    int length = 0;
    ask(text, &length);
    Dl_info place{};
    if (dladdr(reinterpret_cast<void *>(ask), &place) && place.dli_fname)
      if (void *opened = dlopen(place.dli_fname, RTLD_LAZY | RTLD_NOLOAD)) library = opened;
  }
  text[std::strcspn(text, ",\n")] = '\0';
  for (char *c = text; *c; c++)
    if (*c == '\t') *c = ' ';
  std::snprintf(words, size, "%.60s", text);
  return dlsym(library, kMpiMark);
}

// Says why on the first process. The host tells which that is: MPI cannot be asked before it fits.
__attribute__((format(printf, 2, 3))) bool refuse(void *lmp, const char *format, ...)
{
  char text[4 * PATH_MAX];
  va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  if (setting(lmp, "universe_rank") <= 0) std::fprintf(stderr, "%s not loaded: %s\n", kName, text);
  return false;
}

bool host_matches(void *lmp)
{
  auto *ask = host_function<int(void *)>("lammps_version");
  const int host = ask ? ask(lmp) : 0;
  char version[32] = "an unknown version";
  if (host) std::snprintf(version, sizeof version, "version %d", host);

  const char *own_sizes = size_name(sizeof(LAMMPS_NS::tagint), sizeof(LAMMPS_NS::bigint));
  const char *sizes = size_name(setting(nullptr, "tagint"), setting(nullptr, "bigint"));
  const bool same_sizes = std::strcmp(sizes, own_sizes) == 0;

  auto *has_mpi = host_function<int()>("lammps_config_has_mpi_support");
  const bool serial = has_mpi && !has_mpi();
  char mpi[64] = "no MPI";
  const bool same_mpi = serial ? kSerial : ask_mpi(mpi, sizeof mpi) && !kSerial;

  if (host == LSDCD_HOST_VERSION && same_sizes && same_mpi) return true;
  const char *its_mpi = same_mpi ? ""
                        : serial ? " -D LSDCD_HOST_MPI=OFF"
                        : kSerial
                            ? " -D LSDCD_HOST_MPI=ON -D MPI_CXX_COMPILER=<the mpicxx of its MPI>"
                            : " -D MPI_CXX_COMPILER=<the mpicxx of its MPI>";
  return refuse(
      lmp,
      "it was built for LAMMPS version %d with %s and integers %s, this is %s with %s and "
      "integers %s. %s %s%s%s%s",
      LSDCD_HOST_VERSION, kMpi, own_sizes, version, mpi, sizes, kRebuild, kFolder,
      same_sizes ? "" : " -D LSDCD_HOST_SIZES=", same_sizes ? "" : sizes, its_mpi);
}

#ifdef LSDCD_KOKKOS_BACKEND
// How vectors lie in Kokkos's memory, in LAMMPS's words; older ones have one layout only.
#if defined(LMP_KOKKOS_LAYOUT_DEFAULT)
constexpr char kLayout[] = "default";
#elif defined(LMP_KOKKOS_LAYOUT_LEGACY)
constexpr char kLayout[] = "legacy";
#else
constexpr char kLayout[] = "";
#endif

// The precision of atoms, and of sums over them, in LAMMPS's words; older ones have double only.
#if defined(LMP_KOKKOS_SINGLE_SINGLE)
constexpr char kPrecision[] = "single";
#elif defined(LMP_KOKKOS_SINGLE_DOUBLE)
constexpr char kPrecision[] = "mixed";
#else
constexpr char kPrecision[] = "double";
#endif

// The backend that has the atoms: the first of these, for a LAMMPS may have others beside it.
constexpr const char *kBackends[] = {"cuda", "hip", "sycl", "openmp", "pthreads", "serial"};

const char *backend_with_atoms(int has(const char *, const char *, const char *))
{
  for (const char *name : kBackends)
    if (has("KOKKOS", "api", name)) return name;
  return "";
}

// The styles ask which Kokkos runs: only they can call it.
bool kokkos_matches(void *lmp)
{
  auto *has =
      host_function<int(const char *, const char *, const char *)>("lammps_config_accelerator");
  const char *lacks = nullptr, *name = "";
  if (!has || !has("KOKKOS", "precision", kPrecision))
    lacks = "KOKKOS package in precision ", name = kPrecision;
  else if (std::strcmp(backend_with_atoms(has), LSDCD_KOKKOS_BACKEND) != 0)
    lacks = "atoms on the Kokkos backend ", name = LSDCD_KOKKOS_BACKEND;
  else if (*kLayout && !has("KOKKOS", "layout", kLayout))
    lacks = "view layout ", name = kLayout;
  return !lacks ||
         refuse(lmp,
                "it was built for Kokkos with the backend %s in precision %s, this LAMMPS has "
                "no %s%s. %s %s, or load lsdcdplugin.so for the fix without /kk",
                LSDCD_KOKKOS_BACKEND, kPrecision, lacks, name, kRebuild, kFolder);
}
#else
bool kokkos_matches(void *)
{
  return true;
}
#endif

// The file with the styles, once open, stays: this file may be named otherwise the next time.
void *open_styles(void *lmp)
{
  static void *styles = nullptr;
  if (styles) return styles;
  Dl_info own{};
  dladdr(reinterpret_cast<void *>(&open_styles), &own);
  char real[PATH_MAX], path[PATH_MAX + sizeof LSDCD_STYLES];
  const char *file = realpath(own.dli_fname, real) ? real : own.dli_fname;
  const char *slash = std::strrchr(file, '/');
  std::snprintf(path, sizeof path, "%.*s%s", slash ? static_cast<int>(slash - file + 1) : 0, file,
                LSDCD_STYLES);
  styles = dlopen(path, RTLD_NOW | RTLD_GLOBAL);
  if (!styles)
    refuse(lmp,
           "it was built for LAMMPS version %d, and its other file does not open in this one: %s. "
           "Keep "
           "both files in one folder. %s %s",
           LSDCD_HOST_VERSION, dlerror(), kRebuild, kFolder);
  return styles;
}

}    // namespace

extern "C" __attribute__((visibility("default"))) void lammpsplugin_init(void *lmp, void *handle,
                                                                         void *regfunc)
{
  if (!host_matches(lmp) || !kokkos_matches(lmp)) return;
  if (void *styles = open_styles(lmp))
    reinterpret_cast<void (*)(void *, void *, void *)>(dlsym(styles, "lsdcd_add_styles"))(
        lmp, handle, regfunc);
}
