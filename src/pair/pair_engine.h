// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The engine for pairs of grains in the host's memory: of a CPU or of a GPU. Pointers of a step are to that memory.
#pragma once

#include "base/strided_view.h"
#include "engine/resident_rows.h"
#include "law/contact_law.h"
#include "pair/kept_of_pair.h"
#include "pair/partners.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace lsdcd {

// The names of the grains, in 32 or 64 bits.
struct GrainNames {
  const void *at = nullptr;
  bool wide = false;

  LSDCD_FN Partners::Name operator[](std::size_t i) const
  {
    return wide ? static_cast<const std::int64_t *>(at)[i]
                : static_cast<const std::int32_t *>(at)[i];
  }
};

// The host's list: rows of neighbours, as in PairList, in memory of any layout.
struct PairRows {
  int rows = 0;
  const int *grain = nullptr, *length = nullptr;
  const int *neighbor = nullptr;
  std::ptrdiff_t row = 0,
                 place = 0;    // strides: from grain to grain, and from neighbour to neighbour
  int longest = 0;             // no row is longer
  int mask = 0, factor_shift = 0;
  bool full = false;    // a pair is in the rows of both its grains; else in one of them

  LSDCD_FN int at(int i, int k) const { return neighbor[i * row + k * place]; }
};

// The data of grains that are needed when a list is made anew. x is read if `near` is above 0.
struct ListedGrains {
  GrainNames name;
  const int *type = nullptr;
  StridedView<const Real> x = {};
  int n_all = 0;
  Real near =
      0;    // half of the least distance between two images of a grain (length), if a grain may touch several; else 0
};

// What a step of pairs reads and writes; see PairJob. In a full list grains beyond n_own are only read.
struct PairInput {
  StridedView<const Real> x, v, omega;
  const Real *radius = nullptr, *mass = nullptr;
  const int *type = nullptr, *mask = nullptr;
  int frozen = 0;
  StridedView<Real> force, torque;
  const Real *temperature = nullptr;
  Real *heat = nullptr;
  int n_own = 0, n_all = 0;
  bool both_sides = false;
  PairRows list;
  Real factor[4] = {1, 1, 1, 1};
  Real dt = 0;
  bool update = false;
};

// Number of sums over the pairs of a step: the elastic energy, and offset times force, xx, yy, zz, xy, xz, yz. Each grain gets half
// of a pair.
constexpr int kPairSums = 7;

// The laws of pairs, as in PairJob.
struct PairLaws {
  std::vector<ContactLaw> laws;
  std::vector<int> law_of;
  int n_types = 0;        // one more than the number of types
  int width = 0;          // number of values that a pair keeps
  KeptOfPair kept;        // the last of these values; none: energy is not recorded
  bool by_law = false;    // laws keep values of several kinds
};

class PairEngine {
 public:
  virtual ~PairEngine() = default;

  // Sets the laws before a run. If the width changes, nothing that was kept before stays.
  virtual void set_laws(const PairLaws &laws) = 0;
  // Adds forces and torques. `sums`: kPairSums numbers on the CPU, which become the sums over the first n_own grains, or with
  // both_sides over the first n_all; or null.
  virtual void run(const PairInput &step, Real *sums) = 0;
  // Adds the energy of the step that has run to rows on the CPU, if laws have `books`; see PairJob::energy.
  virtual void book(EnergyRows &rows) = 0;
  // Copies the parts of the last sums that belong to each of the first n grains to the CPU: column k is [k * n, (k + 1) * n).
  virtual void sums_of_grains(int n, std::vector<Real> &to) = 0;

  // The following functions bring what pairs keep to grains and partners, see Partners, and back. It is there from collect(),
  // from_cpu() or partners().unpack() until hand_out(). The list of collect() is that of the last step, and laws are those of the
  // types that grains had in that step. hand_out() returns whether it has cleared any numbers because the pair has a law of
  // another kind.
  virtual void collect(const PairRows &list, const ListedGrains &grains, int n) = 0;
  virtual bool hand_out(const PairRows &list, const ListedGrains &grains) = 0;
  // Notes that types may have changed since the last step, for the same list and laws by_law. Returns the same as hand_out().
  virtual bool note_types(const PairRows &list, const ListedGrains &grains) = 0;
  virtual void to_cpu(Partners &partners, int n) = 0;
  virtual void from_cpu(const Partners &partners, int n) = 0;
  // Returns the rows of partners, for a host that moves grains in the memory of the engine.
  virtual ResidentRows &partners() = 0;

  virtual std::size_t bytes() const = 0;
};

std::unique_ptr<PairEngine> make_cpu_pair_engine();
// `stream`: a cudaStream_t of this device.
std::unique_ptr<PairEngine> make_cuda_pair_engine(int device, void *stream);

}    // namespace lsdcd
