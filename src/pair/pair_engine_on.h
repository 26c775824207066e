// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The engine of pairs on a backend. What touching pairs keep is in two pools; a step reads one and writes the other. While lists are
// made anew, the other pool has it by grain and partner.
#pragma once

#include "backend/backend.h"
#include "base/countable.h"
#include "engine/on_backend/rows_on.h"
#include "engine/results/energy_sums.h"
#include "pair/partner_kernels.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace lsdcd {

// The partners of grains, in an array that others may use when there are none.
template <class B>
class PartnersOn : public RowsOn<B, PartnerRows> {
  using Base = RowsOn<B, PartnerRows>;
  using Base::b_;
  using Base::count_;
  using Base::end_;
  using Base::first_;
  using Numbers = typename B::template Array<Real>;

 public:
  PartnersOn(B &backend, Numbers &numbers) :
      Base(backend, "numbers of pairs in one process"), numbers_(&numbers)
  {
  }

  const PartnerForm &form() const { return form_; }
  // Forgets all partners; those to come have this form, and are in this array.
  void begin(const PartnerForm &form, Numbers &numbers)
  {
    this->forget();
    form_ = form;
    numbers_ = &numbers;
  }
  PartnerRows rows() override { return {form_, numbers_->data()}; }
  PartnersView view() { return view_of(static_cast<int>(count_.size())); }
  PartnersView view_of(int n) { return {n, first_.data(), count_.data(), rows()}; }

  // Reserves places for as many partners as grains have by their counts. Counts are 0 then.
  void reserve_counted()
  {
    copy_all(b_, count_.data(), first_.data(), count_.size());
    const std::size_t n = this->numbered(b_.exclusive_scan(first_.data(), first_.size()));
    this->forget();
    make_room(n);
    end_ = n;
  }
  std::size_t bytes() const { return (first_.size() + count_.size()) * sizeof(int); }

 private:
  void make_room(std::size_t n) override
  {
    const std::size_t size = form_.row_size();
    if (numbers_->size() >= n * size) return;
    Numbers wider(with_spare(n * size));
    copy_all(b_, numbers_->data(), wider.data(), end_ * size);
    b_.wait();
    *numbers_ = std::move(wider);
  }

  PartnerForm form_;
  Numbers *numbers_;
};

template <class B>
class PairEngineOn : public PairEngine {
  template <class T>
  using Array = typename B::template Array<T>;
  static constexpr unsigned kStep = B::kOnCpu ? 1 : kGpuPairStep;

 public:
  // `most_bytes`: if what all pairs of a list would keep takes no more than this, memory for all of them is reserved, and a step need
  // not wait until the number of touching pairs is known. A step of few grains takes no longer on a GPU than its start.
  explicit PairEngineOn(B backend, std::size_t most_bytes = std::size_t(256) << 20) :
      b_(std::move(backend)), most_bytes_(most_bytes), n_pairs_(2), places_(1), seen_(1)
  {
    put_all(b_, n_pairs_.data(), n_pairs_.size(), 0);
  }

  void set_laws(const PairLaws &given) override
  {
    if (given.width != width_) forget();
    width_ = given.width;
    kept_ = given.kept;
    const bool books = kept_.n > 0;
    of_law_ = given.width - kept_.n;
    by_law_ = given.by_law;
    n_types_ = given.n_types;
    laws_.clear();
    std::vector<LawBytes> bytes;
    std::vector<int> kinds, history;
    std::vector<LawReach> reach;
    std::vector<std::uint32_t> flips;
    kinds_.clear();
    beyond_ = false;
    books_.clear();
    std::vector<LawBytes> booked;
    std::vector<int> booked_kinds;
    for (const ContactLaw &law : given.laws) {
      laws_.push_back(pair_law_on<B>(law));
      const auto same = [&](const PairLawOn<B> &other) { return other.run == laws_.back().run; };
      const auto kind = std::find_if(kinds_.begin(), kinds_.end(), same);
      kinds.push_back(static_cast<int>(kind - kinds_.begin()));
      if (kind == kinds_.end()) kinds_.push_back(laws_.back());
      bytes.push_back(laws_.back().law);
      reach.push_back(law.reach());
      history.push_back(law.history_kind());
      flips.push_back(law.flips() | (books ? kept_.flips() << kept_.first : 0));
      if (books) {
        const PairBookOn<B> book = pair_book_on<B>(law);
        const auto of = std::find_if(books_.begin(), books_.end(), [&](const PairBookOn<B> &other) {
          return other.run == book.run;
        });
        booked_kinds.push_back(static_cast<int>(of - books_.begin()));
        booked.push_back(book.law);
        if (of == books_.end()) books_.push_back(book);
      }
      beyond_ = beyond_ || law.reach().acts();
    }
    bytes_ = from_cpu_array(bytes);
    kind_of_ = from_cpu_array(kinds);
    reach_ = from_cpu_array(reach);
    flips_ = from_cpu_array(flips);
    history_kind_ = from_cpu_array(history);
    law_of_ = from_cpu_array(given.law_of);
    booked_bytes_ = from_cpu_array(booked);
    booked_kind_of_ = from_cpu_array(booked_kinds);
  }

  void run(const PairInput &step, Real *sums) override
  {
    const std::size_t rows = step.list.rows;
    Pool &next = pool_[1 - now_], &last = pool_[now_];
    PairStepView s;
    static_cast<PairInput &>(s) = step;
    s.words = words_of_row(step.list);
    next.reserve_rows(rows, s.words, width_ > 0);
    s.now = next.view(width_);
    if (width_ > 0 && has_last_) s.old = last.view(width_);
    s.width = width_;
    s.kept = kept_;
    s.step = kStep;
    s.n_pairs = n_pairs_.data() + turn_;
    s.n_pairs_next = n_pairs_.data() + 1 - turn_;
    s.laws = bytes_.data();
    s.n_laws = static_cast<int>(laws_.size());
    s.law_of = law_of_.data();
    s.n_types = n_types_;
    s.kind_of = kind_of_.data();
    s.reach = reach_.data();
    for (int k = 0; k < 4; k++)
      if (step.factor[k] == 0) s.left_out |= 1u << k;
    s.alone = B::kOnCpu && threads() == 1;
    if (sums) {
      sums_.reserve(kPairSums * std::size_t(step.n_all));
      put_all(b_, sums_.data(), kPairSums * std::size_t(step.n_all), Real(0));
      s.sums = sums_.data();
      sums_n_ = step.n_all;
    }
    if (rows > 0) {
      if (fits_all(most_places_)) make_room(next, most_places_);
      find(s, rows);
      const bool may_not_fit = width_ > 0 && next.room(width_) < most_places_;
      if (may_not_fit) {
        b_.copy_out(s.n_pairs, seen_.data(), 1);
        counted_.record(b_);
      }
      // The pairs are started before it is known whether there is enough memory, so that a GPU need not wait for the CPU.
      add(s, next);
      if (may_not_fit) {
        counted_.wait();
        const std::size_t places = *seen_.data();
        if (places > next.room(width_)) {
          next.reserve(places, width_);
          add(s, next);
        }
      }
      if (width_ > 0 && !step.update) b_.for_each_in_warps(rows, KeepNumbers{s});
    }
    if (width_ > 0) {
      now_ = 1 - now_;
      has_last_ = true;
    }
    if (sums) add_up(step.both_sides ? step.n_all : step.n_own, sums);
    if (!books_.empty()) last_step_ = s;
  }

  void book(EnergyRows &rows) override
  {
    PairStepView s = last_step_;
    constexpr std::size_t kRows = B::kOnCpu ? 1 : kWarpSize;    // rows that share a sum
    const std::size_t n = (static_cast<std::size_t>(s.list.rows) + kRows - 1) / kRows;
    if (books_.empty() || n == 0) return;
    s.laws = booked_bytes_.data();
    s.kind_of = booked_kind_of_.data();
    energy_.reserve(n);
    is_booked_.reserve(n);
    EnergyRows *const energy = energy_.data();
    char *const is_booked = is_booked_.data();
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      energy[k] = EnergyRows();
      is_booked[k] = 0;
    });
    for (std::size_t kind = 0; kind < books_.size(); kind++) {
      s.kind = static_cast<int>(kind);
      books_[kind].run(s, books_[kind].law, energy, is_booked, b_);
    }
    EnergyRows sum;
    energy_sums_.sum(b_, {n, energy, is_booked, nullptr}, 1, &sum);
    rows.add(sum);
  }

  void sums_of_grains(int n, std::vector<Real> &to) override
  {
    to.resize(kPairSums * std::size_t(n));
    for (int k = 0; k < kPairSums; k++)
      b_.copy_out(sums_.data() + std::size_t(k) * sums_n_, to.data() + std::size_t(k) * n,
                  static_cast<std::size_t>(n));
    b_.wait();
  }

  void collect(const PairRows &list, const ListedGrains &given, int n) override
  {
    const std::size_t rows = list.rows;
    most_places_ = kUnknown;
    partners_.grow(n);
    partners_.begin({width_, by_law_, given.near > 0}, pool_[1 - now_].numbers);
    ListedGrains grains = given;
    if (by_law_) grains.type = types_.data();
    if (!has_last_ || rows == 0) return;
    const int words = words_of_row(list);
    const TouchingPairs from = pool_[now_].view(width_);
    b_.for_each(rows, CountPartners{list, words, from.words, partners_.view_of(n)});
    partners_.reserve_counted();
    b_.for_each(rows, FillPartners{list, words, from, grains, kinds_of_laws(), kStep,
                                   partners_.view_of(n)});
    b_.wait();
  }

  bool hand_out(const PairRows &list, const ListedGrains &grains) override
  {
    Pool &to = pool_[now_];
    const std::size_t rows = list.rows;
    const int words = words_of_row(list);
    to.reserve_rows(rows, words, true);
    *cleared_.data() = 0;
    if (rows > 0) {
      put_one(b_, places_.data(), PlaceCounts{0, 0});
      b_.for_each_in_warps(rows,
                           TakePlaces{list, partners_.count(), places_.data(), to.first.data()});
      const PlaceCounts places = read_one(b_, places_.data());
      most_places_ = places.most;
      // In a half list a grain also has partners in the rows of other grains.
      to.reserve(std::max<std::size_t>(places.taken, fits_all(most_places_) ? most_places_ : 0),
                 width_);
      b_.for_each(rows, HandOut{list, words, to.view(width_), grains, kinds_of_laws(), of_law_,
                                kStep, partners_.view(), cleared_.data()});
    }
    has_last_ = true;
    return by_law_ && keep_types(grains);
  }

  bool note_types(const PairRows &list, const ListedGrains &grains) override
  {
    *cleared_.data() = 0;
    if (list.rows > 0 && has_last_)
      b_.for_each(list.rows, ClearOfOtherLaws{list, words_of_row(list), pool_[now_].view(width_),
                                              kinds_of_laws(), types_.data(), grains.type, of_law_,
                                              kStep, cleared_.data()});
    return keep_types(grains);
  }

  void to_cpu(Partners &partners, int n) override
  {
    partners.begin(partners_.form());
    partners_.to_cpu(partners, n);
  }
  void from_cpu(const Partners &partners, int n) override
  {
    partners_.begin(partners.form(), pool_[1 - now_].numbers);
    partners_.from_cpu(partners, n);
  }
  ResidentRows &partners() override { return partners_; }

  std::size_t bytes() const override
  {
    return pool_[0].bytes() + pool_[1].bytes() + partners_.bytes() + types_.size() * sizeof(int) +
           sums_.size() * sizeof(Real) + energy_.size() * sizeof(EnergyRows) + is_booked_.size();
  }

 private:
  struct Pool {
    Array<std::uint32_t> words;
    Array<int> first;
    Array<Real> numbers;

    void reserve_rows(std::size_t rows, int of_row, bool keeps)
    {
      words.reserve(rows * of_row);
      if (keeps) first.reserve(rows);
    }
    // Columns begin at multiples of 32 bytes.
    std::size_t room(int width) const
    {
      return width > 0 ? numbers.size() / width / kStep * kStep : 0;
    }
    void reserve(std::size_t places, int width)
    {
      const std::size_t n = with_spare(places) / kStep * kStep + kStep;
      countable_here(static_cast<std::int64_t>(n), "touching pairs in one process",
                     "use more processes");
      if (room(width) < places) numbers = Array<Real>(n * width);
    }
    TouchingPairs view(int width)
    {
      return {words.data(), first.data(), numbers.data(), room(width)};
    }
    std::size_t bytes() const
    {
      return words.size() * sizeof(std::uint32_t) + first.size() * sizeof(int) +
             numbers.size() * sizeof(Real);
    }
  };

  static int words_of_row(const PairRows &list)
  {
    return std::max(1, (list.longest + kWordBits - 1) / kWordBits);
  }
  // Returns whether both pools have memory for all pairs of a list.
  bool fits_all(std::size_t places) const
  {
    return width_ > 0 && places <= most_bytes_ / (2 * sizeof(Real) * width_);
  }
  // Reserves memory in a pool in which nothing is kept, but which kernels may still read.
  void make_room(Pool &pool, std::size_t places)
  {
    if (pool.room(width_) >= places) return;
    b_.wait();
    pool.reserve(places, width_);
  }
  KindsOfLaws kinds_of_laws() const
  {
    return {law_of_.data(), n_types_, flips_.data(), history_kind_.data()};
  }
  // Stores the types of grains after kernels have read the previous ones. Returns whether one of the kernels has cleared numbers.
  bool keep_types(const ListedGrains &grains)
  {
    b_.wait();
    const auto n = static_cast<std::size_t>(grains.n_all);
    types_.reserve(n);
    copy_all(b_, grains.type, types_.data(), n);
    return *cleared_.data() != 0;
  }

  template <class T>
  Array<T> from_cpu_array(const std::vector<T> &host)
  {
    return lsdcd::from_cpu(b_, host);
  }
  void forget()
  {
    for (Pool &pool : pool_) pool = Pool();
    partners_.forget();
    has_last_ = false;
    most_places_ = kUnknown;
  }

  void find(const PairStepView &s, std::size_t rows)
  {
    turn_ = 1 - turn_;
    if (beyond_)
      b_.for_each_in_warps(rows, FindTouching<true>{s});
    else
      b_.for_each_in_warps(rows, FindTouching<false>{s});
  }

  void add(PairStepView &s, Pool &to)
  {
    s.now = to.view(width_);
    for (std::size_t kind = 0; kind < kinds_.size(); kind++) {
      s.kind = static_cast<int>(kind);
      kinds_[kind].run(s, kinds_[kind].law, b_);
    }
  }

  // Computes a sum as the total of a scan.
  void add_up(int n, Real *sums)
  {
    more_.reserve(static_cast<std::size_t>(n));
    for (int k = 0; k < kPairSums; k++) {
      copy_all(b_, sums_.data() + std::size_t(k) * sums_n_, more_.data(),
               static_cast<std::size_t>(n));
      sums[k] = b_.exclusive_scan(more_.data(), static_cast<std::size_t>(n));
    }
  }

  B b_;
  std::size_t most_bytes_;
  std::vector<PairLawOn<B>> laws_, kinds_;    // of all laws; the first of each kind
  Array<LawBytes> bytes_;
  Array<int> kind_of_, law_of_, history_kind_;
  Array<LawReach> reach_;
  Array<std::uint32_t> flips_;
  int n_types_ = 0, width_ = 0, of_law_ = 0;
  KeptOfPair kept_;
  bool by_law_ = false;
  bool beyond_ = false;    // does adhesion act beyond contact?

  Pool pool_[2];
  int now_ = 0;                     // the pool that the last step has written
  bool has_last_ = false;           // has the last step written anything to it?
  Array<std::uint32_t> n_pairs_;    // of two steps in turn; each step clears that of the next one
  int turn_ = 0;                    // of the next step
  static constexpr std::size_t kUnknown = ~std::size_t(0);
  std::size_t most_places_ = kUnknown;    // the most places for pairs in any step of this list
  Array<PlaceCounts> places_;
  typename B::template CpuArray<std::uint32_t> seen_;
  typename B::Event counted_;
  Array<Real> sums_, more_;
  std::size_t sums_n_ = 0;

  // For the energy balance: the laws of each kind, all laws, the last step, and the energy of pairs of rows that share a sum.
  std::vector<PairBookOn<B>> books_;
  Array<LawBytes> booked_bytes_;
  Array<int> booked_kind_of_;
  PairStepView last_step_;
  Array<EnergyRows> energy_;
  Array<char> is_booked_;
  EnergySums<B> energy_sums_;

  PartnersOn<B> partners_ = {b_, pool_[1].numbers};    // in the pool that the next step writes
  Array<int> types_;    // of grains, at the last lookup of laws of several kinds
  typename B::template CpuArray<int> cleared_ = typename B::template CpuArray<int>(1);
};

}    // namespace lsdcd
