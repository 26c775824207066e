// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The sums of rows (feature_row.h) by feature of a mesh, in memory of the backend. What a step adds is added in fixed point
// (sum_unit.h), in units that follow from the rows of this process, and then to sums over steps. So sums have the same bits in any
// order of threads.
//
// The type Items has the items of a step, each with any number of records of features:
//   n()            returns the number of items
//   count(k)       returns the number of records of item k
//   at(k, c)       returns record c of item k
//   row(record)    returns the row that a record adds to its feature
//   note(record)   does the other work for a record, such as adding an impact to its spectrum
#pragma once

#include "backend/backend.h"
#include "backend/threads.h"
#include "backend/warp.h"
#include "engine/loads/feature_row.h"
#include "engine/nodes/shared_items.h"
#include "engine/results/sum_unit.h"
#include "mesh/mesh_features.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

template <int kSums>
struct RowRange {
  std::uint64_t count;              // of records
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

// Calls f for each record of item k.
template <class Items, class F>
LSDCD_FN void for_records(const Items &items, std::size_t k, const F &f)
{
  const int n = items.count(k);
  for (int c = 0; c < n; c++) f(items.at(k, c));
}

// Finds the range of a step, and clears that of the next one.
template <class Row, class Items>
struct SeeRows {
  static constexpr int kSums = Row::kSums;
  Items items;
  std::size_t n_threads;
  RowRange<kSums> *range, *next_range;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t t) const
  {
    if (mine && t == 0) *next_range = {};
    std::uint32_t records = 0;
    unsigned most[kSums] = {};
    for_each_of_thread(warp, t, n_threads, mine ? items.n() : 0, [&](std::size_t k) {
      for_records(items, k, [&](const auto &record) {
        const RowNumbers<Row> number(items.row(record));
        for (int j = 0; j < kSums; j++) {
          const unsigned e = exponent_field(number.of[j]);
          if (e > most[j] && e != kNotFinite) most[j] = e;
        }
        records++;
      });
    });
    if (!warp.any(records > 0)) return;
    if (records > 0) add_to(&range->count, records);
    for (int j = 0; j < kSums; j++) {
      const unsigned of_warp = warp.largest(most[j]);
      if (warp.rank() == 0) raise_to(&range->exponent[j], of_warp);
    }
  }
};

// The sums over steps, place after place.
template <class Row>
struct PlacedSums {
  Real *sums;
  std::uint64_t *most;    // the bits of the greatest numbers

  LSDCD_FN Real *sums_of(std::size_t place) const { return sums + Row::kSums * place; }
  LSDCD_FN std::uint64_t *most_of(std::size_t place) const { return most + Row::kMost * place; }
};

// Adds the records of each item, in units. A sum becomes not a number if one of its summands is not finite.
template <class Row, class Items>
struct AddRows {
  static constexpr int kSums = Row::kSums;
  Items items;
  FeaturePlaces places;
  const RowRange<kSums> *range;
  std::int64_t *units;    // of each place
  PlacedSums<Row> to;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t k) const
  {
    const int n = mine ? items.count(k) : 0;
    for (int c = 0; warp.any(c < n); c++) {
      std::int64_t of_record[kSums] = {};
      std::size_t place = 0;
      if (c < n) {
        const auto &record = items.at(k, c);
        place = places.place(record.feature);
        items.note(record);
        const RowNumbers<Row> number(items.row(record));
        for (int j = 0; j < kSums; j++)
          if (exponent_field(number.of[j]) == kNotFinite)
            to.sums_of(place)[j] = HUGE_VAL - HUGE_VAL;
          else
            of_record[j] = range->unit(j).units(number.of[j]);
        for (int j = 0; j < Row::kMost; j++)
          if (number.of[kSums + j] > 0)
            raise_to(to.most_of(place) + j, bits_of(number.of[kSums + j]));
      }
      if (!warp.sum_by_key(c < n, static_cast<int>(place), of_record)) continue;
      for (int j = 0; j < kSums; j++) add_signed(units + kSums * place + j, of_record[j]);
    }
  }
};

// Moves the units of a step to the sums over steps. If a feature has several records, only one of them finds its units.
template <class Row, class Items>
struct KeepRows {
  static constexpr int kSums = Row::kSums;
  Items items;
  FeaturePlaces places;
  const RowRange<kSums> *range;
  std::int64_t *units;
  PlacedSums<Row> to;

  LSDCD_FN void operator()(std::size_t k) const
  {
    for_records(items, k, [&](const auto &record) {
      const std::size_t place = places.place(record.feature);
      for (int j = 0; j < kSums; j++) {
        const std::int64_t found = take(units + kSums * place + j);
        if (found != 0) to.sums_of(place)[j] += range->unit(j).value(found);
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

template <class Row>
struct FlagRows {
  PlacedSums<Row> from;
  char *flags;
  LSDCD_FN void operator()(std::size_t place) const
  {
    bool any = false;
    for (int j = 0; j < Row::kSums; j++) any |= from.sums_of(place)[j] != 0;
    flags[place] = any;
  }
};

// Writes the rows of selected places, and clears their sums.
template <class Row>
struct TakeRows {
  FeaturePlaces places;
  const int *chosen;
  PlacedSums<Row> from;
  RowOfFeature<Row> *rows;

  LSDCD_FN void operator()(std::size_t m) const
  {
    const std::size_t place = chosen[m];
    Real *const sums = from.sums_of(place);
    std::uint64_t *const most = from.most_of(place);
    RowNumbers<Row> number;
    memcpy(number.of, sums, Row::kSums * sizeof(Real));
    memcpy(number.of + Row::kSums, most, Row::kMost * sizeof(Real));
    for (int j = 0; j < Row::kSums; j++) sums[j] = 0;
    for (int j = 0; j < Row::kMost; j++) most[j] = 0;
    rows[m] = {places.feature(place), number.row()};
  }
};

// The sums by feature of one mesh.
template <class B, class Row>
class FeatureSums {
  template <class T>
  using Array = typename B::template Array<T>;
  static constexpr int kSums = Row::kSums, kMost = Row::kMost;
  using Range = RowRange<kSums>;

 public:
  // Adds a step. `places` has the same numbers in each call.
  template <class Items>
  void add(B &b, const Items &items, const FeaturePlaces &places, std::size_t n_places)
  {
    places_ = places;
    if (n_places_ != n_places) {
      n_places_ = n_places;
      sums_ = cleared<Real>(b, kSums * n_places);
      most_ = cleared<std::uint64_t>(b, kMost * n_places);
      units_ = cleared<std::int64_t>(b, kSums * n_places);
      ranges_ = from_cpu(b, std::vector<Range>(2));
    }
    const std::size_t n = items.n(), n_threads = threads_for<B>(n, kMostThreads);
    if (n == 0) return;
    now_ = 1 - now_;
    Range *const range = ranges_.data() + now_, *const next = ranges_.data() + 1 - now_;
    std::int64_t *const units = units_.data();
    b.for_each_in_warps(n_threads, SeeRows<Row, Items>{items, n_threads, range, next});
    b.for_each_in_warps(n, AddRows<Row, Items>{items, places, range, units, placed()});
    b.for_each(n, KeepRows<Row, Items>{items, places, range, units, placed()});
  }

  std::vector<RowOfFeature<Row>> take(B &b)
  {
    if (n_places_ == 0) return {};
    Array<char> flags(n_places_);
    Array<int> chosen(n_places_);
    Array<std::uint32_t> count(1);
    b.for_each(n_places_, FlagRows<Row>{placed(), flags.data()});
    b.compact(n_places_, nullptr, flags.data(), chosen.data(), count.data());
    const std::size_t n_rows = read_one(b, count.data());
    Array<RowOfFeature<Row>> rows(n_rows);
    b.for_each(n_rows, TakeRows<Row>{places_, chosen.data(), placed(), rows.data()});
    return to_cpu(b, rows, n_rows);
  }

  std::size_t bytes() const
  {
    return sums_.size() * sizeof(Real) + most_.size() * sizeof(std::uint64_t) +
           units_.size() * sizeof(std::int64_t) + ranges_.size() * sizeof(Range);
  }

 private:
  static constexpr std::size_t kMostThreads = 1 << 17;

  template <class T>
  static Array<T> cleared(B &b, std::size_t n)
  {
    Array<T> array(n);
    put_all(b, array.data(), n, 0);
    return array;
  }
  PlacedSums<Row> placed() { return {sums_.data(), most_.data()}; }

  FeaturePlaces places_ = {};    // of the last step; only their numbers are read after it
  std::size_t n_places_ = 0;
  Array<Real> sums_;
  Array<std::uint64_t> most_;
  Array<std::int64_t> units_;    // as sums_; 0 between steps
  Array<Range> ranges_;          // two, of which one is clear
  int now_ = 0;
};

}    // namespace lsdcd
