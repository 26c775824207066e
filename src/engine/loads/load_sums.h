// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The loads of a mesh's features. The loads of a step are added in fixed point (sum_unit.h), in units that follow from the
// contacts of this process, and then to sums over steps. So they have the same bits in any order of threads.
#pragma once

#include "backend/backend.h"
#include "engine/loads/energy_engine.h"
#include "engine/loads/load_engine.h"
#include "engine/nodes/node_forces.h"

#include <algorithm>
#include <vector>

namespace lsdcd {

template <int kSums>
struct LoadRange {
  std::uint64_t count;              // of contacts
  std::uint64_t exponent[kSums];    // the largest exponent_field() of each finite number

  LSDCD_FN SumUnit unit(int number) const { return SumUnit({count, exponent[number]}); }
};

// Maps the features of a mesh to the places of their sums.
struct FeaturePlaces {
  MeshFeaturesView wall;
  std::size_t n_faces, n_edges;

  LSDCD_FN std::size_t place(FeatureCode feature) const
  {
    const FeatureCode own = own_feature(wall, feature);
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
};

// The quantity that is summed by feature: contacts. Items are candidates, which have any number of contacts.
struct LoadContacts {
  static constexpr int kSums = LoadEngine::kRow - 1, kMore = 0;
  FeaturePlaces places;
  NodeContacts of;
  Real dt;

  LSDCD_FN std::size_t n() const { return of.n; }
  LSDCD_FN int count(std::size_t k) const { return of.count(k); }
  LSDCD_FN const StepContact &at(std::size_t k, int c) const
  {
    return of.contacts[of.first_contact[k] + c];
  }
  LSDCD_FN void numbers(const StepContact &contact, Real (&to)[kSums]) const
  {
    to[0] = dt * contact.normal;
    to[1] = dt * contact.shear;
    to[2] = dt;
    to[3] = dt * contact.wear_power;
    for (int d = 0; d < 3; d++) to[4 + d] = dt * contact.force[d];
  }
  // Does further work for a contact, and for a place in a row: here none.
  LSDCD_FN void note(const StepContact &, std::size_t) const {}
  LSDCD_FN void take_more(std::size_t, Real *) const {}
};

// The quantity that is summed by feature: records of a step, of all meshes. An item has one record or none. For impacts the
// greatest speed is kept, and their spectrum.
struct LoadRecords {
  static constexpr int kSums = EnergyEngine::kRow - 2, kMore = 1;
  FeaturePlaces places;
  const EnergyRecord *records;
  std::size_t room;
  const int *n_records;
  std::uint32_t mesh;
  std::uint64_t *speeds;    // of each place, as bits
  ImpactBins bins;          // null where no impacts are recorded

  LSDCD_FN std::size_t n() const { return room; }
  LSDCD_FN int count(std::size_t k) const
  {
    return k < static_cast<std::size_t>(*n_records) && records[k].mesh == mesh;
  }
  LSDCD_FN const EnergyRecord &at(std::size_t k, int) const { return records[k]; }
  LSDCD_FN void numbers(const EnergyRecord &record, Real (&to)[kSums]) const
  {
    to[0] = record.dissipated;
    to[1] = record.impact > 0 ? 1 : 0;
    to[2] = record.impact;
  }
  LSDCD_FN void note(const EnergyRecord &record, std::size_t place) const
  {
    if (!(record.impact > 0)) return;
    raise_to(speeds + place, bits_of(record.speed));
    bins.add(record.impact);
  }
  LSDCD_FN void take_more(std::size_t place, Real *to) const
  {
    memcpy(to, speeds + place, sizeof *to);
    speeds[place] = 0;
  }
};

// Calls f for each contact of item k.
template <class In, class F>
LSDCD_FN void for_contacts(const In &in, std::size_t k, const F &f)
{
  const int n = in.count(k);
  for (int c = 0; c < n; c++) f(in.at(k, c));
}

// Finds the range of a step, and clears that of the next one.
template <class In>
struct SeeLoads {
  static constexpr int kSums = In::kSums;
  In in;
  std::size_t n_threads;
  LoadRange<In::kSums> *range, *next_range;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t t) const
  {
    if (mine && t == 0) *next_range = {};
    std::uint32_t contacts = 0;
    unsigned most[kSums] = {};
    for_each_of_thread(warp, t, n_threads, mine ? in.n() : 0, [&](std::size_t k) {
      for_contacts(in, k, [&](const auto &contact) {
        Real number[kSums];
        in.numbers(contact, number);
        for (int j = 0; j < kSums; j++) {
          const unsigned e = exponent_field(number[j]);
          if (e > most[j] && e != kNotFinite) most[j] = e;
        }
        contacts++;
      });
    });
    if (!warp.any(contacts > 0)) return;
    if (contacts > 0) add_to(&range->count, contacts);
    for (int j = 0; j < kSums; j++) {
      const unsigned of_warp = warp.largest(most[j]);
      if (warp.rank() == 0) raise_to(&range->exponent[j], of_warp);
    }
  }
};

// Adds the contacts of each candidate, in units. A sum becomes not a number if one of its summands is not finite.
template <class In>
struct AddLoads {
  static constexpr int kSums = In::kSums;
  In in;
  const LoadRange<In::kSums> *range;
  std::int64_t *units;    // of each place
  Real *sums;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t k) const
  {
    const int n = mine ? in.count(k) : 0;
    for (int c = 0; warp.any(c < n); c++) {
      std::int64_t of_contact[kSums] = {};
      std::size_t place = 0;
      if (c < n) {
        const auto &contact = in.at(k, c);
        place = in.places.place(contact.feature);
        in.note(contact, place);
        Real number[kSums];
        in.numbers(contact, number);
        for (int j = 0; j < kSums; j++)
          if (exponent_field(number[j]) == kNotFinite)
            sums[kSums * place + j] = HUGE_VAL - HUGE_VAL;
          else
            of_contact[j] = range->unit(j).units(number[j]);
      }
      if (!warp.sum_by_key(c < n, static_cast<int>(place), of_contact)) continue;
      for (int j = 0; j < kSums; j++) add_signed(units + kSums * place + j, of_contact[j]);
    }
  }
};

// Moves the units of a step to the sums over steps. If a feature has several contacts, only one of them finds its units.
template <class In>
struct KeepLoads {
  static constexpr int kSums = In::kSums;
  In in;
  const LoadRange<In::kSums> *range;
  std::int64_t *units;
  Real *sums;

  LSDCD_FN void operator()(std::size_t k) const
  {
    for_contacts(in, k, [&](const auto &contact) {
      const std::size_t first = kSums * in.places.place(contact.feature);
      for (int j = 0; j < kSums; j++) {
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

template <int kSums>
struct FlagLoads {
  const Real *sums;
  char *flags;
  LSDCD_FN void operator()(std::size_t place) const
  {
    bool any = false;
    for (int j = 0; j < kSums; j++) any |= sums[kSums * place + j] != 0;
    flags[place] = any;
  }
};

// Writes the rows of selected places, and clears their sums.
template <class In>
struct TakeLoads {
  static constexpr int kSums = In::kSums;
  In in;
  const int *chosen;
  Real *sums, *rows;

  LSDCD_FN void operator()(std::size_t m) const
  {
    constexpr int kRow = 1 + kSums + In::kMore;
    const std::size_t place = chosen[m];
    Real *const row = rows + kRow * m;
    row[0] = in.places.feature(place);
    for (int j = 0; j < kSums; j++) {
      row[1 + j] = sums[kSums * place + j];
      sums[kSums * place + j] = 0;
    }
    in.take_more(place, row + 1 + kSums);
  }
};

// The sums by feature of one mesh.
template <class B, class In>
class FeatureSums {
  template <class T>
  using Array = typename B::template Array<T>;
  static constexpr int kSums = In::kSums;
  using Range = LoadRange<kSums>;

 public:
  void add(B &b, const In &in, std::size_t n_places)
  {
    in_ = in;
    const std::size_t n_sums = kSums * n_places;
    if (sums_.size() != n_sums) {
      sums_ = Array<Real>(n_sums);
      units_ = Array<std::int64_t>(n_sums);
      put_all(b, sums_.data(), n_sums, 0);
      put_all(b, units_.data(), n_sums, 0);
      ranges_ = from_cpu(b, std::vector<Range>(2));
    }
    if (in.n() == 0) return;
    now_ = 1 - now_;
    Range *const range = ranges_.data() + now_;
    const std::size_t n = threads_for<B>(in.n(), kMostThreads);
    b.for_each_in_warps(n, SeeLoads<In>{in_, n, range, ranges_.data() + 1 - now_});
    b.for_each_in_warps(in.n(), AddLoads<In>{in_, range, units_.data(), sums_.data()});
    b.for_each(in.n(), KeepLoads<In>{in_, range, units_.data(), sums_.data()});
  }

  std::vector<Real> take(B &b)
  {
    constexpr int kRow = 1 + kSums + In::kMore;
    const std::size_t n = sums_.size() / kSums;
    if (n == 0) return {};
    Array<char> flags(n);
    Array<int> chosen(n);
    Array<std::uint32_t> count(1);
    b.for_each(n, FlagLoads<kSums>{sums_.data(), flags.data()});
    b.compact(n, nullptr, flags.data(), chosen.data(), count.data());
    const std::size_t n_rows = read_one(b, count.data());
    Array<Real> rows(kRow * n_rows);
    b.for_each(n_rows, TakeLoads<In>{in_, chosen.data(), sums_.data(), rows.data()});
    return to_cpu(b, rows, kRow * n_rows);
  }

  std::size_t bytes() const
  {
    return sums_.size() * sizeof(Real) + units_.size() * sizeof(std::int64_t) +
           ranges_.size() * sizeof(Range);
  }

 private:
  static constexpr std::size_t kMostThreads = 1 << 17;

  In in_ = {};                   // of the last step; its contacts are not read afterwards
  Array<Real> sums_;             // place after place
  Array<std::int64_t> units_;    // the same, 0 between steps
  Array<Range> ranges_;          // two, of which one is clear
  int now_ = 0;
};

template <class B>
class EngineOn;

// The sums by feature of all meshes of an engine, made when they are first added to.
template <class B>
class LoadsOn : public LoadEngine {
 public:
  // The engine must outlive this object.
  explicit LoadsOn(EngineOn<B> &engine) : e_(engine) {}

  void add(int mesh, const FeatureCounts &counts, Real dt) override
  {
    if (sums_.empty()) sums_ = std::vector<FeatureSums<B, LoadContacts>>(e_.settings_.meshes);
    const NodeContacts of = e_.contacts_on(mesh);
    sums_.at(mesh).add(e_.b_, {{of.wall, counts.faces, counts.edges}, of, dt}, counts.all());
  }
  std::vector<Real> take(int mesh) override
  {
    return sums_.empty() ? std::vector<Real>() : sums_.at(mesh).take(e_.b_);
  }
  std::size_t bytes() const
  {
    std::size_t bytes = 0;
    for (const auto &sums : sums_) bytes += sums.bytes();
    return bytes;
  }

 private:
  EngineOn<B> &e_;
  std::vector<FeatureSums<B, LoadContacts>> sums_;    // of each mesh
};

template <class B>
class EnergiesOn : public EnergyEngine {
  template <class T>
  using Array = typename B::template Array<T>;

  struct OfMesh {
    FeatureSums<B, LoadRecords> sums;
    Array<std::uint64_t> speeds;    // of each place
    Array<ImpactBin> bins;
  };

 public:
  // The engine must outlive this object.
  explicit EnergiesOn(EngineOn<B> &engine) : e_(engine) {}

  void add(int mesh, const FeatureCounts &counts) override
  {
    if (meshes_.empty()) {
      meshes_ = std::vector<OfMesh>(e_.settings_.meshes);
      begins_ = from_cpu(e_.b_, begins_of_bins());
    }
    OfMesh &to = meshes_.at(mesh);
    if (to.speeds.size() != counts.all()) {
      to.speeds = Array<std::uint64_t>(counts.all());
      put_all(e_.b_, to.speeds.data(), counts.all(), 0);
      to.bins = Array<ImpactBin>(kImpactBins);
      put_all(e_.b_, to.bins.data(), kImpactBins, ImpactBin());
    }
    LoadRecords records = e_.records_on(mesh);
    records.places.n_faces = counts.faces;
    records.places.n_edges = counts.edges;
    records.speeds = to.speeds.data();
    records.bins = {to.bins.data(), begins_.data()};
    to.sums.add(e_.b_, records, counts.all());
  }
  std::vector<Real> take(int mesh) override
  {
    return meshes_.empty() ? std::vector<Real>() : meshes_.at(mesh).sums.take(e_.b_);
  }
  std::vector<ImpactBin> take_bins(int mesh) override
  {
    if (meshes_.empty()) return {};
    Array<ImpactBin> &bins = meshes_.at(mesh).bins;
    std::vector<ImpactBin> taken = to_cpu(e_.b_, bins, bins.size());
    put_all(e_.b_, bins.data(), bins.size(), ImpactBin());
    return taken;
  }
  std::size_t bytes() const
  {
    std::size_t bytes = begins_.size() * sizeof(Real);
    for (const OfMesh &m : meshes_)
      bytes += m.sums.bytes() + m.speeds.size() * sizeof(std::uint64_t) +
               m.bins.size() * sizeof(ImpactBin);
    return bytes;
  }

 private:
  EngineOn<B> &e_;
  std::vector<OfMesh> meshes_;
  Array<Real> begins_;    // of bins
};

}    // namespace lsdcd
