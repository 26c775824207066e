// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The loads of a mesh's features. Those of a step are added in fixed point (sum_unit.h), whose units follow from its contacts on
// this process, and then to sums over steps: so they have the same bits in any order of threads.
#pragma once

#include "backend/backend.h"
#include "engine/loads/load_engine.h"
#include "engine/nodes/node_forces.h"

#include <algorithm>
#include <vector>

namespace lsdcd {

constexpr int kLoadSums = LoadEngine::kRow - 1;    // of a feature

struct LoadRange {
  std::uint64_t count;                  // of contacts
  std::uint64_t exponent[kLoadSums];    // the largest exponent_field() of each finite number

  LSDCD_FN SumUnit unit(int number) const { return SumUnit({count, exponent[number]}); }
};

// Contacts, and where the features of their mesh have their sums.
struct LoadContacts {
  NodeContacts of;
  std::size_t n_faces, n_edges;
  Real dt;

  LSDCD_FN std::size_t place(FeatureCode feature) const
  {
    const FeatureCode own = own_feature(of.wall, feature);
    const std::size_t i = feature_index(own);
    switch (feature_kind(own)) {
      case FeatureKind::face:
        return i;
      case FeatureKind::edge:
        return n_faces + i;
      default:
        return n_faces + n_edges + i;
    }
  }
  LSDCD_FN FeatureCode feature(std::size_t place) const
  {
    const auto code = [](FeatureKind kind, std::size_t i) {
      return feature_code(kind, static_cast<std::uint32_t>(i));
    };
    if (place < n_faces) return code(FeatureKind::face, place);
    if (place < n_faces + n_edges) return code(FeatureKind::edge, place - n_faces);
    return code(FeatureKind::vertex, place - n_faces - n_edges);
  }
  LSDCD_FN void numbers(const StepContact &contact, Real (&to)[kLoadSums]) const
  {
    to[0] = dt * contact.normal;
    to[1] = dt * contact.shear;
    to[2] = dt;
    to[3] = dt * contact.wear_power;
    for (int d = 0; d < 3; d++) to[4 + d] = dt * contact.force[d];
  }
  template <class F>
  LSDCD_FN void for_contacts(std::size_t k, const F &f) const
  {
    const int n = of.count(k);
    for (int c = 0; c < n; c++) f(of.contacts[of.first_contact[k] + c]);
  }
};

// Sees the range of a step, and clears that of the next one.
struct SeeLoads {
  LoadContacts in;
  std::size_t n_threads;
  LoadRange *range, *next_range;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t t) const
  {
    if (mine && t == 0) *next_range = LoadRange();
    std::uint32_t contacts = 0;
    unsigned most[kLoadSums] = {};
    for_each_of_thread(warp, t, n_threads, mine ? in.of.n : 0, [&](std::size_t k) {
      in.for_contacts(k, [&](const StepContact &contact) {
        Real number[kLoadSums];
        in.numbers(contact, number);
        for (int j = 0; j < kLoadSums; j++) {
          const unsigned e = exponent_field(number[j]);
          if (e > most[j] && e != kNotFinite) most[j] = e;
        }
        contacts++;
      });
    });
    if (!warp.any(contacts > 0)) return;
    if (contacts > 0) add_to(&range->count, contacts);
    for (int j = 0; j < kLoadSums; j++) {
      const unsigned of_warp = warp.largest(most[j]);
      if (warp.rank() == 0) raise_to(&range->exponent[j], of_warp);
    }
  }
};

// Adds the contacts of each candidate in units. Sums become no numbers where one of their numbers is not finite.
struct AddLoads {
  LoadContacts in;
  const LoadRange *range;
  std::int64_t *units;    // of each place
  Real *sums;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t k) const
  {
    const int n = mine ? in.of.count(k) : 0;
    for (int c = 0; warp.any(c < n); c++) {
      std::int64_t of_contact[kLoadSums] = {};
      std::size_t place = 0;
      if (c < n) {
        const StepContact &contact = in.of.contacts[in.of.first_contact[k] + c];
        place = in.place(contact.feature);
        Real number[kLoadSums];
        in.numbers(contact, number);
        for (int j = 0; j < kLoadSums; j++)
          if (exponent_field(number[j]) == kNotFinite)
            sums[kLoadSums * place + j] = HUGE_VAL - HUGE_VAL;
          else
            of_contact[j] = range->unit(j).units(number[j]);
      }
      if (!warp.sum_by_key(c < n, static_cast<int>(place), of_contact)) continue;
      for (int j = 0; j < kLoadSums; j++) add_signed(units + kLoadSums * place + j, of_contact[j]);
    }
  }
};

// Moves the units of a step to the sums over steps. Of contacts on a feature one finds its units.
struct KeepLoads {
  LoadContacts in;
  const LoadRange *range;
  std::int64_t *units;
  Real *sums;

  LSDCD_FN void operator()(std::size_t k) const
  {
    in.for_contacts(k, [&](const StepContact &contact) {
      const std::size_t first = kLoadSums * in.place(contact.feature);
      for (int j = 0; j < kLoadSums; j++) {
        const std::int64_t found = take(units + first + j);
        if (found != 0) sums[first + j] += range->unit(j).value(found);
      }
    });
  }

 private:
  LSDCD_FN static std::int64_t take(std::int64_t *at)
  {
#if LSDCD_ON_GPU()
    return static_cast<std::int64_t>(atomicExch(reinterpret_cast<unsigned long long *>(at), 0ull));
#else
    return __atomic_exchange_n(at, std::int64_t(0), __ATOMIC_RELAXED);
#endif
  }
};

struct FlagLoads {
  const Real *sums;
  char *flags;
  // The number of contacts is 0 where there was none.
  LSDCD_FN void operator()(std::size_t place) const
  {
    flags[place] = sums[kLoadSums * place + 2] != 0;
  }
};

// Puts the rows of chosen places, and forgets their sums.
struct TakeLoads {
  LoadContacts in;
  const int *chosen;
  Real *sums, *rows;

  LSDCD_FN void operator()(std::size_t m) const
  {
    const std::size_t place = chosen[m];
    Real *const row = rows + LoadEngine::kRow * m;
    row[0] = in.feature(place);
    for (int j = 0; j < kLoadSums; j++) {
      row[1 + j] = sums[kLoadSums * place + j];
      sums[kLoadSums * place + j] = 0;
    }
  }
};

// Of one mesh.
template <class B>
class LoadSums {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  void add(B &b, const NodeContacts &of, const FeatureCounts &counts, Real dt)
  {
    in_ = {of, counts.faces, counts.edges, dt};
    const std::size_t n_sums = kLoadSums * (counts.faces + counts.edges + counts.vertices);
    if (sums_.size() != n_sums) {
      sums_ = Array<Real>(n_sums);
      units_ = Array<std::int64_t>(n_sums);
      put_all(b, sums_.data(), n_sums, 0);
      put_all(b, units_.data(), n_sums, 0);
      ranges_ = from_cpu(b, std::vector<LoadRange>(2));
    }
    if (of.n == 0) return;
    now_ = 1 - now_;
    LoadRange *const range = ranges_.data() + now_;
    const std::size_t n = threads_for<B>(of.n, kMostThreads);
    b.for_each_in_warps(n, SeeLoads{in_, n, range, ranges_.data() + 1 - now_});
    b.for_each_in_warps(of.n, AddLoads{in_, range, units_.data(), sums_.data()});
    b.for_each(of.n, KeepLoads{in_, range, units_.data(), sums_.data()});
  }

  std::vector<Real> take(B &b)
  {
    const std::size_t n = sums_.size() / kLoadSums;
    if (n == 0) return {};
    Array<char> flags(n);
    Array<int> chosen(n);
    Array<std::uint32_t> count(1);
    b.for_each(n, FlagLoads{sums_.data(), flags.data()});
    b.compact(n, nullptr, flags.data(), chosen.data(), count.data());
    const std::size_t n_rows = read_one(b, count.data());
    Array<Real> rows(LoadEngine::kRow * n_rows);
    b.for_each(n_rows, TakeLoads{in_, chosen.data(), sums_.data(), rows.data()});
    return to_cpu(b, rows, LoadEngine::kRow * n_rows);
  }

  std::size_t bytes() const
  {
    return sums_.size() * sizeof(Real) + units_.size() * sizeof(std::int64_t) +
           ranges_.size() * sizeof(LoadRange);
  }

 private:
  static constexpr std::size_t kMostThreads = 1 << 17;

  LoadContacts in_ = {};         // of the last step; its contacts are not read after it
  Array<Real> sums_;             // place after place
  Array<std::int64_t> units_;    // the same, 0 between steps
  Array<LoadRange> ranges_;      // two, of which one is clear
  int now_ = 0;
};

template <class B>
class EngineOn;

template <class B>
class LoadsOn : public LoadEngine {
 public:
  // The engine must outlive it.
  explicit LoadsOn(EngineOn<B> &engine) : e_(engine) {}

  void add(int mesh, const FeatureCounts &counts, Real dt) override
  {
    if (sums_.empty()) sums_ = std::vector<LoadSums<B>>(e_.settings_.meshes);
    sums_.at(mesh).add(e_.b_, e_.contacts_on(mesh), counts, dt);
  }
  std::vector<Real> take(int mesh) override
  {
    return sums_.empty() ? std::vector<Real>() : sums_.at(mesh).take(e_.b_);
  }
  std::size_t bytes() const
  {
    std::size_t bytes = 0;
    for (const LoadSums<B> &sums : sums_) bytes += sums.bytes();
    return bytes;
  }

 private:
  EngineOn<B> &e_;
  std::vector<LoadSums<B>> sums_;    // of each mesh
};

}    // namespace lsdcd
