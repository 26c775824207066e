// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Pairs of grains where their host has them: in the memory of a CPU or of a GPU. Pointers of a step are to that memory.
#pragma once

#include "base/strided_view.h"
#include "law/contact_law.h"
#include "pair/partners.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace lsdcd {

// The name of each grain, in 32 or 64 bits.
struct GrainNames {
  const void *at = nullptr;
  bool wide = false;

  LSDCD_FN Partners::Name operator[](std::size_t i) const
  {
    return wide ? static_cast<const std::int64_t *>(at)[i]
                : static_cast<const std::int32_t *>(at)[i];
  }
};

// The host's list: rows of neighbours, as PairList has them, in memory of any layout.
struct PairRows {
  int rows = 0;
  const int *grain = nullptr, *length = nullptr;
  const int *neighbor = nullptr;
  std::ptrdiff_t row = 0,
                 place =
                     0;    // from one grain to the next, and from one of its neighbours to the next
  int longest = 0;         // no row is longer
  int mask = 0, factor_shift = 0;
  bool full = false;    // a pair is in the rows of both its grains; else in one of them

  LSDCD_FN int at(int i, int k) const { return neighbor[i * row + k * place]; }
};

// What is asked of grains while a list is made anew. x is read where `near` is above 0.
struct ListedGrains {
  GrainNames name;
  const int *type = nullptr;
  StridedView<const Real> x = {};
  int n_all = 0;
  Real near =
      0;    // half of the least way from one image of a grain to another (length), where a grain may touch several; else 0
};

// What a step of pairs reads and writes; see PairJob. In a full list grains beyond n_own are read only.
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

// Sums over the pairs of a step: the elastic energy, and offset times force, xx, yy, zz, xy, xz, yz. Half of a pair is each grain's.
constexpr int kPairSums = 7;

// The laws of pairs, as PairJob has them.
struct PairLaws {
  std::vector<ContactLaw> laws;
  std::vector<int> law_of;
  int n_types = 0;        // one more than there are
  int width = 0;          // numbers that a pair keeps
  bool books = false;     // the last of them are KeptForces, and energy is booked
  bool by_law = false;    // laws keep numbers of several kinds
};

class PairEngine {
 public:
  virtual ~PairEngine() = default;

  // Before a run. With another width nothing is kept of before.
  virtual void set_laws(const PairLaws &laws) = 0;
  // Adds forces and torques. With `sums` (kPairSums of them, on the CPU) these become those of grains that n_own or, with
  // both_sides, n_all counts.
  virtual void run(const PairInput &step, Real *sums) = 0;
  // Books the energy of the step that has run, where laws have `books`: adds to rows on the CPU what PairJob::energy has.
  virtual void book(EnergyRows &rows) = 0;
  // Copies to the CPU what each of the first n grains has of the last sums: column k is [k * n, (k + 1) * n).
  virtual void sums_of_grains(int n, std::vector<Real> &to) = 0;

  // What pairs keep, by grain and partner: see Partners. It is there from collect(), from_cpu() and unpack() to hand_out(). The list
  // of collect() is that of the last step, and laws are those of the types that grains had then. hand_out() returns whether numbers
  // were cleared, as the pair has a law of another kind.
  virtual void collect(const PairRows &list, const ListedGrains &grains, int n) = 0;
  virtual bool hand_out(const PairRows &list, const ListedGrains &grains) = 0;
  // Types may have changed since the last step, with the same list and laws by_law. Returns what hand_out() does.
  virtual bool note_types(const PairRows &list, const ListedGrains &grains) = 0;
  virtual void to_cpu(Partners &partners, int n) = 0;
  virtual void from_cpu(const Partners &partners, int n) = 0;

  // For a host that moves grains where the engine computes: see Springs (engine/springs.h). A grain has a first partner and a
  // count.
  virtual void grow(int n) = 0;
  virtual int *first() = 0;
  virtual int *count() = 0;
  virtual int largest_packed_size(int n) = 0;
  virtual int pack(int n, const int *which, const int *from, double *buffer) = 0;
  virtual void unpack(int n, const int *to, const double *buffer, int n_first, int second) = 0;

  virtual std::size_t bytes() const = 0;
};

std::unique_ptr<PairEngine> make_cpu_pair_engine();
// `stream`: a cudaStream_t of this device.
std::unique_ptr<PairEngine> make_cuda_pair_engine(int device, void *stream);

}    // namespace lsdcd
