// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Kernels of a step of pairs: they find which pairs of a list touch, and compute these. They run on every backend.
#pragma once

#include "backend/atomic.h"
#include "backend/threads.h"
#include "backend/warp.h"
#include "pair/pair_engine.h"
#include "pair/pair_kernel.h"

#include <type_traits>

namespace lsdcd {

constexpr int kWordBits = 32;
// On a GPU the n-th pairs of this many rows lie side by side, in 32 bytes that are read and written together. It is the stride from a
// row's pair to its next one; 1 on a CPU.
constexpr unsigned kGpuPairStep = 4;

// Which pairs of a list touch, and where the numbers that they keep are: bit k % 32 of word k / 32 is that of place k in the row.
struct TouchingPairs {
  std::uint32_t *words = nullptr;    // word w of row r is at [w * rows + r]; null: none touch
  int *first = nullptr;              // of each row's first pair among all pairs
  Real *numbers = nullptr;           // the k-th numbers of all pairs are side by side
  std::size_t room = 0;              // number of pairs for which there is memory

  LSDCD_FN PairNumbers<Real> of(std::size_t pair) const { return {numbers + pair, room}; }
};

// A step as its kernels see it.
struct PairStepView : PairInput {
  int words = 0;    // number of words of a row
  TouchingPairs now, old;
  int width = 0;
  KeptOfPair kept;      // for the energy balance
  unsigned step = 1;    // see kGpuPairStep
  std::uint32_t *n_pairs = nullptr,
                *n_pairs_next = nullptr;    // count of places of this step, and of the next one
  const LawBytes *laws = nullptr;
  int n_laws = 0;
  const int *law_of = nullptr;
  int n_types = 0;
  const int *kind_of = nullptr;    // laws of one kind have the same compiled law
  int kind = 0;                    // the kind whose pairs are computed
  const LawReach *reach = nullptr;
  Real *sums = nullptr;     // column k of kPairSums at [k * n_all]; null: not asked for
  unsigned left_out = 0;    // bit k: factor k is 0, and its pairs are left out
  bool alone = false;       // one thread adds forces

  LSDCD_FN int law(int i, int j) const { return law_of[type[i] * n_types + type[j]]; }
};

// Adds to a number to which other threads may add.
LSDCD_FN void add_shared(Real *at, Real value, [[maybe_unused]] bool alone)
{
#if LSDCD_ON_GPU()
  atomicAdd(at, value);
#else
  if (alone) {
    *at += value;
    return;
  }
  Real seen = *at, sum;
  do sum = seen + value;
  while (!__atomic_compare_exchange(at, &seen, &sum, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED));
#endif
}
LSDCD_FN void add_shared(const StridedView<Real> &to, int i, const Vec3 &a, bool alone)
{
  Real *const at = to.of(i);
  for (int k = 0; k < 3; k++) add_shared(at + k * to.column, a[k], alone);
}

// The number of rows that lie side by side.
template <class W>
constexpr unsigned kSide = W::kSize == 1 ? 1 : kGpuPairStep;

// Returns how many places rows side by side take, of which this one has `count` pairs. All threads of a warp call it together.
template <class W>
LSDCD_FN unsigned places_side_by_side(const W &warp, unsigned count)
{
  for (unsigned apart = 1; apart < kSide<W>; apart *= 2) {
    const unsigned other = warp.of_other(count, apart);
    if (other > count) count = other;
  }
  return kSide<W> * count;
}

// Reserves places for what a row's `count` pairs keep. All threads of a warp call it together.
template <class W>
LSDCD_FN void take_places(const W &warp, bool mine, std::size_t row, unsigned count,
                          std::uint32_t *n_pairs, int *first)
{
  const unsigned room = places_side_by_side(warp, count);
  const unsigned end = warp.sum_up(warp.rank() % kSide<W> == 0 ? room : 0);
  unsigned begin = 0;
  if (warp.rank() == W::kSize - 1 && end > 0) begin = fetch_add(n_pairs, end);
  begin = warp.of(begin, W::kSize - 1);
  if (mine) first[row] = static_cast<int>(begin + end - room + warp.rank() % kSide<W>);
}

// Finds the pairs that touch, and reserves places for what they keep. kBeyond: adhesion may hold pairs beyond contact.
template <bool kBeyond>
struct FindTouching {
  PairStepView s;

  template <class W>
  LSDCD_FN void operator()(const W &warp, bool mine, std::size_t k) const
  {
    unsigned count = 0;
    if (mine) {
      if (k == 0) *s.n_pairs_next = 0;
      const int i = s.list.grain[k], n = s.list.length[i];
      const Vec3 x = s.x[i];
      const Real radius = s.radius[i];
      for (int w = 0; w < s.words; w++) {
        const int begin = kWordBits * w, end = n < begin + kWordBits ? n : begin + kWordBits;
        std::uint32_t bits = 0;
        for (int place = begin; place < end; place++)
          bits |= std::uint32_t(touches(i, x, radius, k, w, place - begin)) << (place - begin);
        s.now.words[std::size_t(w) * s.list.rows + k] = bits;
        count += static_cast<unsigned>(count_bits(bits));
      }
    }
    if (s.width > 0) take_places(warp, mine, k, count, s.n_pairs, s.now.first);
  }

 private:
  LSDCD_FN bool touches(int i, const Vec3 &x, Real radius, std::size_t k, int w, int bit) const
  {
    const int with = s.list.at(i, kWordBits * w + bit), j = with & s.list.mask;
    const Real of_j = s.radius[j], sum = radius + of_j, distance_sq = norm_sq(x - s.x[j]);
    bool yes = distance_sq < sum * sum;
    if constexpr (kBeyond)
      if (!yes) {
        GrainPair p = {};
        p.distance_sq = distance_sq;
        p.radius_i = radius;
        p.radius_j = of_j;
        const bool touched =
            s.old.words && s.old.words[std::size_t(w) * s.list.rows + k] >> bit & 1;
        yes = is_within(p, s.reach[s.law(i, j)], touched);
      }
    return yes && !(s.left_out >> (with >> s.list.factor_shift & 3) & 1) && !are_frozen(s, i, j);
  }
};

// A pair: its place in the list of its row, what it kept a step ago, and what it keeps now; null: nothing.
struct PairOfRow {
  std::size_t row;
  unsigned owner;    // the thread of the warp to which the row belongs
  int place;
  PairNumbers<Real> old, now;
};

// Calls act(is_pair, pair), for all threads of a warp together, for the touching pairs of the warp's rows, as many at once as the warp
// has threads. The threads share them, because most rows have few pairs. kParted: also for pairs that touched a step ago.
template <bool kParted, class W, class Act>
LSDCD_FN void for_each_pair(const PairStepView &s, const W &warp, bool mine, std::size_t k,
                            const Act &act)
{
  const std::size_t begin = warp.of(k, 0);    // the first row
  unsigned first_now = mine && s.width > 0 ? static_cast<unsigned>(s.now.first[k]) : 0,
           first_old = mine && s.old.words ? static_cast<unsigned>(s.old.first[k]) : 0;
  for (int w = 0; w < s.words; w++) {
    const std::size_t at = std::size_t(w) * s.list.rows + k;
    const std::uint32_t now = mine && s.now.words ? s.now.words[at] : 0,
                        old = mine && s.old.words ? s.old.words[at] : 0;
    const unsigned count = static_cast<unsigned>(count_bits(kParted ? now | old : now)),
                   end = warp.sum_up(count), last = warp.of(end, W::kSize - 1);
    for (unsigned from = 0; from < last; from += W::kSize) {
      const unsigned n = from + warp.rank(), owner = owner_of(warp, end - count, n);
      const std::uint32_t its_now = warp.of(now, owner), its_old = warp.of(old, owner);
      const unsigned before = warp.of(end - count, owner), of_now = warp.of(first_now, owner),
                     of_old = warp.of(first_old, owner);
      PairOfRow pair = {begin + owner, owner, 0, {nullptr, 0}, {nullptr, 0}};
      if (n < last) {
        std::uint32_t bits = kParted ? its_now | its_old : its_now;
        for (unsigned left = n - before; left > 0; left--) bits &= bits - 1;
        const unsigned bit = lowest_bit(bits);
        const auto numbers = [&](const TouchingPairs &pairs, std::uint32_t word, unsigned first) {
          if (s.width == 0 || !(word >> bit & 1)) return PairNumbers<Real>{nullptr, 0};
          const int nth = count_bits(word & ((std::uint32_t(1) << bit) - 1));
          return pairs.of(first + std::size_t(s.step) * static_cast<std::size_t>(nth));
        };
        pair.place = kWordBits * w + static_cast<int>(bit);
        pair.old = numbers(s.old, its_old, of_old);
        pair.now = numbers(s.now, its_now, of_now);
      }
      act(n < last, pair);
    }
    first_now += s.step * static_cast<unsigned>(count_bits(now));
    first_old += s.step * static_cast<unsigned>(count_bits(old));
  }
}

// Computes the touching pairs that have laws of this kind. kOne: there is one law, and sums are not asked for.
template <class Law, bool kOne, bool kFull>
struct AddPairs {
  static constexpr unsigned kBlocksAtOnce = 4;
  struct None {};
  PairStepView s;
  std::conditional_t<kOne, Law, None> only;

  template <class W>
  LSDCD_FN void operator()(const W &warp, bool mine, std::size_t k) const
  {
    if (s.width > 0 && *s.n_pairs > s.now.room) return;    // the host starts it again
    for_each_pair<false>(s, warp, mine, k, [&](bool is_pair, const PairOfRow &pair) {
      Row row = {{0, 0, 0}, {0, 0, 0}, 0};
      int i = 0;
      if (is_pair) {
        i = s.list.grain[pair.row];
        add(i, s.list.at(i, pair.place), pair.old, pair.now, row);
      }
      const unsigned owner = is_pair ? pair.owner : W::kSize;
      bool is_first;
      if constexpr (Law::kHeat)
        is_first = warp.sum_side_by_side(owner, row.force, row.torque, row.heat);
      else
        is_first = warp.sum_side_by_side(owner, row.force, row.torque);
      if constexpr (kFull) warp.wait();    // until the pairs of the row before these are added
      if (!is_pair || !is_first) return;
      if constexpr (kFull) {
        s.force.add(i, row.force);
        s.torque.add(i, row.torque);
      } else {
        add_shared(s.force, i, row.force, s.alone);
        add_shared(s.torque, i, row.torque, s.alone);
      }
      if constexpr (Law::kHeat)
        if (s.heat) add_shared(s.heat + i, row.heat, s.alone || kFull);
    });
  }

 private:
  struct Row {
    Vec3 force, torque;
    Real heat;
  };

  LSDCD_FN void add(int i, int with, const PairNumbers<Real> &old, const PairNumbers<Real> &kept,
                    Row &row) const
  {
    const int j = with & s.list.mask;
    const Law *law;
    if constexpr (kOne) {
      law = &only;
    } else {
      const int of_pair = s.law(i, j);
      if (s.kind_of[of_pair] != s.kind) return;
      law = &s.laws[of_pair].template in_kernel<Law>();
      for (int n = 0; n < s.width; n++) kept[n] = 0;    // other laws may keep more numbers
    }
    const GrainPair p = grain_pair(s, i, j, s.update);
    PairForce f;
    evaluate_pair(*law, p, old, kept, f);
    const Real factor = s.factor[with >> s.list.factor_shift & 3];
    const Vec3 force = factor * f.force();
    row.force += force;
    row.torque += factor * f.torque_i();
    const bool both = !kFull && (s.both_sides || j < s.n_own);
    if (both) {
      add_shared(s.force, j, -force, s.alone);
      add_shared(s.torque, j, factor * f.torque_j(), s.alone);
    }
    if constexpr (Law::kHeat)
      if (s.heat) {
        row.heat += f.heat;
        if (both) add_shared(s.heat + j, -f.heat, s.alone);
      }
    if constexpr (!kOne)
      if (s.sums) {
        const Real half[kPairSums] = {factor * f.energy / 2,    p.offset.x * force.x / 2,
                                      p.offset.y * force.y / 2, p.offset.z * force.z / 2,
                                      p.offset.x * force.y / 2, p.offset.x * force.z / 2,
                                      p.offset.y * force.z / 2};
        for (int n = 0; n < kPairSums; n++) {
          Real *const column = s.sums + std::size_t(n) * s.n_all;
          add_shared(column + i, half[n], s.alone || kFull);
          if (both) add_shared(column + j, half[n], s.alone);
        }
      }
  }
};

// Gives touching pairs what they kept a step ago, in a setup: the limits of friction cut forces there, but springs stay as they are.
struct KeepNumbers {
  PairStepView s;

  template <class W>
  LSDCD_FN void operator()(const W &warp, bool mine, std::size_t k) const
  {
    for_each_pair<false>(s, warp, mine, k, [&](bool is_pair, const PairOfRow &pair) {
      if (!is_pair) return;
      for (int n = 0; n < s.width; n++) pair.now[n] = !pair.old ? Real(0) : pair.old[n];
    });
  }
};

// A law of pairs, compiled for a backend.
template <class B>
struct PairLawOn {
  LawBytes law;
  void (*run)(const PairStepView &, const LawBytes &, B &);
};

template <class Law, class B>
void run_pair_law(const PairStepView &s, const LawBytes &law, B &b)
{
  const auto run = [&](const auto &kernel) {
    b.for_each_in_warps(static_cast<std::size_t>(s.list.rows), kernel);
  };
  if (s.n_laws > 1 || s.sums)
    s.list.full ? run(AddPairs<Law, false, true>{s, {}}) : run(AddPairs<Law, false, false>{s, {}});
  else
    s.list.full ? run(AddPairs<Law, true, true>{s, law.as<Law>()})
                : run(AddPairs<Law, true, false>{s, law.as<Law>()});
}

template <class B, class Law>
PairLawOn<B> compiled_pair(const Law &law)
{
  return {LawBytes(law), run_pair_law<Law, B>};
}

// The law that records energy, compiled for a backend.
template <class B>
struct PairBookOn {
  LawBytes law;
  // Adds the energy of the pairs whose laws are of this kind to sums[k], where k counts groups of as many rows as threads share, and
  // marks the groups that have any.
  void (*run)(const PairStepView &, const LawBytes &, EnergyRows *sums, char *is_booked, B &);
};
template <class B>
PairBookOn<B> pair_book_on(const ContactLaw &law);

// Each of the following functions has a group of laws that are compiled together, with a source file for each group and each backend
// (laws/CMakeLists.txt).
template <class B>
PairLawOn<B> granular_pair_on(const ContactLaw &law);
template <class B>
PairLawOn<B> granular_added_pair_on(const ContactLaw &law);
template <class B>
PairLawOn<B> plastic_pair_on(const ContactLaw &law);
template <class B>
PairLawOn<B> reaching_pair_on(const ContactLaw &law);
template <class B>
PairLawOn<B> added_pair_on(const ContactLaw &law);
template <class B>
PairLawOn<B> classic_pair_on(const ContactLaw &law);

template <class B>
PairLawOn<B> pair_law_on(const ContactLaw &law)
{
  if (law.is_classic()) return law.is_extended() ? added_pair_on<B>(law) : classic_pair_on<B>(law);
  if (law.reaches()) return reaching_pair_on<B>(law);
  if (law.yields()) return plastic_pair_on<B>(law);
  return law.is_extended() ? granular_added_pair_on<B>(law) : granular_pair_on<B>(law);
}

}    // namespace lsdcd
