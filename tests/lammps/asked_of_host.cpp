// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Preloaded, says at the end how often masses of rigid bodies were asked for, and how often LSDCD had Kokkos bring places and IDs of
// atoms to the CPU.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <dlfcn.h>

#define EXTRACT "_ZN9LAMMPS_NS13FixRigidSmall7extractEPKcRi"
#define SYNC "_ZN9LAMMPS_NS10AtomKokkos4syncENS_14ExecutionSpaceEm"

namespace {

struct Counts {
  int masses = 0, places = 0;

  ~Counts() { std::fprintf(stderr, "asked for masses %d, for places %d\n", masses, places); }
} counts;

bool is_of_lsdcd(const void *code)
{
  Dl_info file;
  if (!dladdr(code, &file)) return false;
  const char *const name = std::strrchr(file.dli_fname, '/');
  return name && std::strstr(name, "lsdcd");
}

}    // namespace

#define PRELOADED __attribute__((visibility("default")))

PRELOADED void *extract(void *fix, const char *what, int &dim) __asm__(EXTRACT);
void *extract(void *fix, const char *what, int &dim)
{
  if (std::strcmp(what, "masstotal") == 0) counts.masses++;
  using Original = void *(void *, const char *, int &);
  static Original *const original = reinterpret_cast<Original *>(dlsym(RTLD_NEXT, EXTRACT));
  return original(fix, what, dim);
}

PRELOADED void sync(void *atoms, int space, std::uint64_t what) __asm__(SYNC);
void sync(void *atoms, int space, std::uint64_t what)
{
  constexpr int kHost = 0;
  // Where Kokkos computes on the CPU, a step asks for places there, too, but not for IDs.
  constexpr std::uint64_t kPlacesAndIds = 0x1 | 0x8;
  if (space == kHost && (what & kPlacesAndIds) == kPlacesAndIds &&
      is_of_lsdcd(__builtin_return_address(0)))
    counts.places++;
  using Original = void(void *, int, std::uint64_t);
  static Original *const original = reinterpret_cast<Original *>(dlsym(RTLD_NEXT, SYNC));
  original(atoms, space, what);
}
