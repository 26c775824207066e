// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/host_pairs.h"

#include "base/input_error.h"

#include "neighbor.h"
#include "pair.h"
#include "pointers.h"
#include "update.h"
#if __has_include("respa.h")
#include "respa.h"
#endif

#include <cstring>

using namespace LAMMPS_NS;

namespace lsdcd {

namespace {

#if LSDCD_HOST_VERSION < 20220601
// LAMMPS installs no neigh_request.h, and before 4May2022 a list is asked for by its members. These are those that NeighRequest
// has begun with since 2017; what its constructor gives them is compared.
class RequestNumbers : protected Pointers {
 public:
  int index;
  void *requestor;
  int instance, id;
  int pair, fix, compute, command, neigh;
  int half, full;
  int occasional, newton, ghost, size;

 protected:
  using Pointers::Pointers;
};

bool is_as_known(const RequestNumbers &request, const Pair *pair, int instance)
{
  return request.requestor == pair && request.instance == instance && request.pair == 1 &&
         request.half == 1 && request.full == 0 && request.fix == 0 && request.size == 0;
}
#endif

}    // namespace

void request_half_list(Neighbor &neighbor, Pair *pair, int instance, bool by_radii)
{
#if LSDCD_HOST_VERSION < 20220601
  const int at = neighbor.request(pair, instance);
  if (!by_radii) return;
  auto *request = reinterpret_cast<RequestNumbers *>(neighbor.requests[at]);
  if (!is_as_known(*request, pair, instance))
    throw InputError("this LAMMPS has another neigh_request.h than LAMMPS 29Sep2021: neighbour "
                     "lists by radii cannot be asked for");
  request->size = 1;
#else
  (void) instance;
  neighbor.add_request(pair, by_radii ? NeighConst::REQ_SIZE : NeighConst::REQ_DEFAULT);
#endif
}

double step_of_level([[maybe_unused]] const Update &update, [[maybe_unused]] int level)
{
#if __has_include("respa.h")
  const auto *respa = reinterpret_cast<const Respa *>(update.integrate);
  return respa->step[level];
#elif LSDCD_HOST_VERSION < 20220601
  // Where Respa of 29Sep2021 has nlevels and step. The step of the outermost level is compared.
  constexpr int kLevels = 0x110, kStep = 0x118;
  const char *const respa = reinterpret_cast<const char *>(update.integrate);
  int levels;
  std::memcpy(&levels, respa + kLevels, sizeof levels);
  double *step;
  std::memcpy(&step, respa + kStep, sizeof step);
  if (levels > 0 && levels < 100 && level < levels && step[levels - 1] == update.dt)
    return step[level];
#endif
  throw InputError("this LAMMPS does not say which timestep a level of run_style respa has, as it "
                   "installs no respa.h: use run_style verlet, or a LAMMPS built from source");
}

}    // namespace lsdcd
