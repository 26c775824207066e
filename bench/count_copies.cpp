// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A library of Kokkos's tools interface that counts what Kokkos copies between host and
// device in each step of LAMMPS. bench/kokkos.py compiles and loads it. A step begins with
// the first half of nve/sphere. At the end it writes, for each process to the file
// $LSDCD_COPIES.PID, a line for all before the first step and one per step: 1 if lists of
// neighbours were built, then copies, bytes and bytes of the largest copy between host and
// device, copies and bytes within one of them, and 1 if the step began with the end of the last
// in one kernel.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <unistd.h>
#include <vector>

namespace {

struct Space {
  char name[64];
};

struct Step {
  bool reneighbours = false, fused = false;
  std::uint64_t copies = 0, bytes = 0, largest = 0, within = 0, bytes_within = 0;
};

std::vector<Step> steps(1);    // first what is before them

// Pinned memory is the host's.
bool on_device(const Space &space)
{
  return std::strncmp(space.name, "Host", 4) != 0 && std::strncmp(space.name, "HBW", 3) != 0 &&
         !std::strstr(space.name, "Pinned");
}

}    // namespace

extern "C" {

void kokkosp_begin_parallel_for(const char *name, std::uint32_t, std::uint64_t *)
{
  const bool fused = std::strstr(name, "FusedIntegrate");
  if (std::strstr(name, "NVESphere") && (fused || std::strstr(name, "InitialIntegrate"))) {
    steps.emplace_back();
    steps.back().fused = fused;
  }
  if (std::strstr(name, "NPairKokkosBuild")) steps.back().reneighbours = true;
}

void kokkosp_begin_deep_copy(Space to, const char *, const void *, Space from, const char *,
                             const void *, std::uint64_t size)
{
  Step &s = steps.back();
  if (on_device(to) != on_device(from)) {
    s.copies++;
    s.bytes += size;
    s.largest = std::max(s.largest, size);
  } else {
    s.within++;
    s.bytes_within += size;
  }
}

void kokkosp_finalize_library()
{
  const char *path = std::getenv("LSDCD_COPIES");
  if (!path) return;
  std::FILE *f = std::fopen((path + ('.' + std::to_string(getpid()))).c_str(), "w");
  if (!f) {
    std::perror(path);
    return;
  }
  const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  for (const Step &s : steps)
    std::fprintf(f, "%d %llu %llu %llu %llu %llu %d\n", s.reneighbours, count(s.copies),
                 count(s.bytes), count(s.largest), count(s.within), count(s.bytes_within), s.fused);
  std::fclose(f);
}

}    // extern "C"
