// The resident engine on one backend: one source for all.
#pragma once

#include "base/input_error.h"
#include "engine/force/compiled_law.h"
#include "engine/engine_base.h"
#include "engine/narrow/find_first.h"
#include "engine/narrow/found_contacts.h"
#include "engine/choose/near_choice.h"
#include "engine/narrow/resident_crowd.h"
#include "engine/resident_engine.h"
#include "engine/resident_springs.h"
#include "engine/choose/select_near.h"
#include "engine/results/totals.h"

#include <string>
#include <utility>
#include <vector>

namespace lsdcd {

template <class B>
class ResidentOn : public ResidentEngine {
  template <class T>
  using Array = typename B::template Array<T>;

  struct NearList {
    Array<int> near;
    std::size_t n = 0;
  };

  // What a step leaves behind: columns of its results, and of each its contacts, its heat and
  // its place in the pool; of each near sphere the place of its result and, where the grid may
  // miss any, what is uncertain, as overlap / radius.
  struct Results {
    ResultColumns columns;
    Array<Real> numbers, heat, uncertain;
    Array<int> n_contacts, pool_place, place;
  };

 public:
  ResidentOn(const EngineSettings &settings, const CompiledLaw<B> &law, B backend) :
      settings_(settings), law_(law), b_(std::move(backend)), springs_(law.traits), counts_(1)
  {
    clear_notes(StepCounts());
  }

  std::string backend() const override { return b_.name() + ", where the particles are"; }

  void set_grid(const GridView &grid) override
  {
    if (!grid.block) throw std::logic_error("an engine needs the view of a flat grid block");
    block_ = Array<char>(grid.block_bytes);
    b_.copy_in(grid.block, block_.data(), grid.block_bytes);
    grid_ = moved_view(grid, block_.data());
    const std::vector<BrickWord> words = brick_words(grid);
    words_ = b_.from_host(words);
    table_ = BrickTable(words, words_.data());
  }

  Real largest_radius(const Spheres &spheres) override
  {
    return b_.template largest<Real>(spheres.n, [=] LSDCD_LAMBDA(std::size_t i) -> Real {
      return !spheres.mask || (spheres.mask[i] & spheres.group_bit) ? spheres.radius[i] : 0;
    });
  }

  void choose(const Spheres &spheres, Real margin) override
  {
    const std::size_t n = spheres.n;
    drop_search();
    chosen_ = 1 - list_of_step_;
    NearList &list = lists_[chosen_];
    if (list.near.size() < n) list.near = Array<int>(n + n / 8);
    if (margin > 0)
      select<true>(spheres, margin);
    else
      select<false>(spheres, margin);
    const StepCounts seen = read_counts();
    if (seen.too_large) throw_for(spheres, seen);
    list.n = seen.n_near;
    springs_.make_room(list.n, seen);
    if constexpr (B::kFindsFirst) found_.reserve(b_, list.n);
    near_known_ = false;
  }

  void mark_places() override
  {
    if constexpr (B::kFindsFirst) {
      drop_search();
      if (lists_[chosen_].n == 0) return;
      beside_.mark(b_);
      marked_ = true;
    }
  }

  void search(const Spheres &spheres, const StepSettings &step) override
  {
    if constexpr (B::kFindsFirst) {
      if (!marked_) return;
      find_contacts(beside_.begin(b_), prepare(spheres, step));
      beside_.end();
      marked_ = false;
      searched_ = true;
    }
  }

  void start(const Spheres &spheres, const StepSettings &step, SpringStore *) override
  {
    spheres_ = spheres;
    step_ = step;
    totals_known_ = false;
    const bool searched = searched_;
    marked_ = searched_ = false;
    list_of_step_ = chosen_;
    const std::size_t n_near = lists_[chosen_].n;
    if (n_near == 0) return;
    LawJob job = prepare(spheres, step);
    last_ = 1 - last_;
    if constexpr (B::kFindsFirst) {
      if (searched)
        beside_.join(b_);
      else
        find_contacts(b_, job);
      job.found = found_.now(n_near);
      job.found.just_now = !searched;
      law_.start(law_.law, job, n_near, b_);
    } else {
      clear_counts(job.in_place);
      law_.start(law_.law, job, n_near, b_);
      find_crowd(b_, job, settings_.law.pull_off());
      job.in_place.crowd_lanes = kCrowdLawLanes;
      law_.start(law_.law, job, kCrowdLawLanes, b_);
    }
    if (step.update_history) springs_.swap();
  }

  void collect() override
  {
    touching_.clear();
    output_.clear();
    sphere_heat_.clear();
    records_.clear();
    if (lists_[list_of_step_].n == 0) return;
    if (step_.per_sphere) fetch_output();
    if (law_.traits.records) fetch_records();
  }

  const WallTotals &totals() const override
  {
    if (!totals_known_) const_cast<ResidentOn *>(this)->sum_totals();
    return totals_;
  }

  int n_touching() const override { return static_cast<int>(touching_.size()); }
  const int *touching() const override { return touching_.data(); }
  const SphereOutput *sphere_output() const override { return output_.data(); }
  const Real *sphere_heat() const override
  {
    return law_.traits.heat ? sphere_heat_.data() : nullptr;
  }
  int n_records() const override { return static_cast<int>(records_.size()); }
  const ContactRecord *records() const override { return records_.data(); }
  int n_near() const override { return static_cast<int>(lists_[chosen_].n); }

  StepNotes look() override
  {
    const StepCounts seen = read_counts();
    if (seen.too_large || seen.lost) throw_for(spheres_, seen);
    clear_notes(seen);
    StepNotes notes;
    notes.deepest = from_ascending_bits(static_cast<std::uint32_t>(seen.deepest >> 32));
    notes.deepest_sphere = static_cast<int>(seen.deepest & 0xffffffffu) - 1;
    notes.uncertified = static_cast<std::int64_t>(seen.uncertified);
    notes.uncertain = from_ascending_bits(static_cast<std::uint32_t>(seen.uncertain));
    return notes;
  }

  void grow(int n) override { springs_.grow(b_, n); }
  int *first_spring() override { return springs_.first(); }
  int *n_springs() override { return springs_.count(); }
  void springs_to(SpringStore &store, int n) override { springs_.to_store(b_, store, n); }
  void springs_from(const SpringStore &store, int n) override { springs_.from_store(b_, store, n); }
  int largest_packed_size(int n) override { return springs_.largest_packed_size(b_, n); }
  int most_packed_size() const override { return springs_.most_packed_size(); }
  int pack(int n, const int *which, const int *from, double *buffer) override
  {
    return springs_.pack(b_, n, which, from, buffer);
  }
  void unpack(int n, const int *to, const double *buffer, int n_first, int second) override
  {
    springs_.unpack(b_, n, to, buffer, n_first, second, read_counts());
  }

  std::size_t bytes() const override
  {
    std::size_t bytes =
        block_.size() + words_.size() * sizeof(BrickWord) + springs_.bytes() + found_.bytes() +
        ResidentCrowd<B>::bytes() + touching_.capacity() * sizeof(int) +
        output_.capacity() * sizeof(SphereOutput) + sphere_heat_.capacity() * sizeof(Real) +
        records_.capacity() * sizeof(ContactRecord);
    for (const NearList &list : lists_) bytes += list.near.size() * sizeof(int);
    for (const Results &r : results_)
      bytes += (r.numbers.size() + r.heat.size() + r.uncertain.size()) * sizeof(Real) +
               (r.n_contacts.size() + r.pool_place.size() + r.place.size()) * sizeof(int);
    return bytes;
  }

  // The steps of start() and collect(). Public because nvcc takes no device lambda from a
  // private function.

  void read_radius(const Spheres &spheres, int i, Real *to)
  {
    b_.for_each(1, [=] LSDCD_LAMBDA(std::size_t) { to[0] = spheres.radius[i]; });
  }

  void clear_counts(const InPlace &in_place)
  {
    b_.for_each(1, [=] LSDCD_LAMBDA(std::size_t) { clear_step(in_place); });
  }

  // All but where springs are.
  void clear_notes(const StepCounts &seen)
  {
    StepCounts *counts = counts_.data();
    b_.for_each(1, [=] LSDCD_LAMBDA(std::size_t) {
      StepCounts cleared = {};
      for (int i = 0; i < 2; i++) cleared.shared_used[i] = seen.shared_used[i];
      *counts = cleared;
    });
  }

  void fetch_output()
  {
    const NearList &list = lists_[list_of_step_];
    const std::size_t n = list.n;
    const bool has_heat = law_.traits.heat;
    Array<SphereOutput> out(n);
    Array<Real> heat_out(has_heat ? n : 0);
    SphereOutput *to = out.data();
    Real *to_heat = heat_out.data();
    const Real *from_heat = results_[last_].heat.data();
    const ResultColumns result = results_[last_].columns;
    const int *near = list.near.data();
    const Spheres spheres = spheres_;
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      const int i = near[k], at = result.of_near(k);
      const bool touches = at >= 0;    // nothing is written of others
      to[k] = SphereOutput();
      if (touches) to[k] = output_of(result.get(at), spheres.x[i], spheres.radius[i]);
      if (has_heat) to_heat[k] = touches ? from_heat[at] : 0;
    });
    const std::vector<SphereOutput> all = b_.to_host(out, n);
    const std::vector<Real> heat = b_.to_host(heat_out, heat_out.size());
    know_near();
    for (std::size_t k = 0; k < n; k++) {
      if (!(all[k].contacts > 0)) continue;
      touching_.push_back(near_host_[k]);
      output_.push_back(all[k]);
      if (has_heat) sphere_heat_.push_back(heat[k]);
    }
  }

  void fetch_records()
  {
    const std::size_t n = lists_[list_of_step_].n;
    Array<int> offset(n);
    int *at = offset.data();
    const ResultColumns result = results_[last_].columns;
    const int *place = results_[last_].pool_place.data();
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      const int r = result.of_near(k);
      at[k] = r >= 0 ? result.n_contacts[r] : 0;
    });
    const std::size_t total = b_.exclusive_scan(at, n);
    // What lies between them was never written.
    Array<ContactRecord> packed(total);
    ContactRecord *to = packed.data();
    const ContactRecord *from = springs_.records(step_.update_history);
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      const int r = result.of_near(k);
      if (r < 0) return;
      for (int c = 0; c < result.n_contacts[r]; c++) to[at[k] + c] = from[place[r] + c];
    });
    records_ = b_.to_host(packed, total);
  }

  void sum_totals()
  {
    totals_known_ = true;
    totals_ = WallTotals();
    const NearList &list = lists_[list_of_step_];
    if (list.n == 0) return;
    const std::size_t n = list.n, n_blocks = (n + kTotalsBlock - 1) / kTotalsBlock;
    Array<WallTotals> block(n_blocks);
    WallTotals *to = block.data();
    const ResultColumns result = results_[last_].columns;
    const int *near = list.near.data();
    const Real *uncertain = results_[last_].uncertain.data();
    b_.for_each(n_blocks, [=] LSDCD_LAMBDA(std::size_t b) {
      WallTotals t;
      const std::size_t end = (b + 1) * kTotalsBlock < n ? (b + 1) * kTotalsBlock : n;
      for (std::size_t k = b * kTotalsBlock; k < end; k++) {
        if (uncertain && uncertain[k] > 0) add_uncertain(t, uncertain[k]);
        const int at = result.of_near(k);
        if (at < 0) continue;
        const SphereResult r = result.get(at);
        add_result(t, r, r.torque, near[k]);
      }
      to[b] = t;
    });
    for (const WallTotals &t : b_.to_host(block, n_blocks)) add_block(totals_, t);
  }

 private:
  static constexpr int kCrowdLawLanes = 128;    // that compute forces of crowded spheres

  LawJob prepare(const Spheres &spheres, const StepSettings &step)
  {
    LawJob job = job_of(grid_, force_settings(settings_, step), spheres);
    Results &results = results_[1 - last_];
    make_room(results, step.per_sphere);
    job.near = lists_[chosen_].near.data();
    job.springs = springs_.view();
    job.uncertain = {results.uncertain.data()};
    job.sink = {nullptr, nullptr, results.heat.data(), nullptr};
    job.in_place.counts = counts_.data();
    job.in_place.force = spheres.force;
    job.in_place.torque = spheres.torque;
    job.in_place.heat_flow = spheres.heat_flow;
    job.in_place.result = results.columns;
    job.in_place.pool = springs_.next(results.pool_place.data());
    job.in_place.crowd = crowd_.view();
    return job;
  }

  // Springs are read where a sphere is near; others have none.
  template <bool kMoves>
  void select(const Spheres &spheres, Real margin)
  {
    const NearChoice<kMoves> choice = {grid_,          table_,          BrickFilter<Real>(grid_),
                                       spheres,        margin,          settings_.law.pull_off(),
                                       counts_.data(), springs_.count()};
    b_.select(spheres.n, choice, select_room_, lists_[chosen_].near.data(),
              &counts_.data()->n_near);
  }

  // One that was begun writes where the next one will.
  void drop_search()
  {
    if (searched_) beside_.join(b_);
    marked_ = searched_ = false;
  }

  void find_contacts(B &b, LawJob job)
  {
    const std::size_t n = lists_[chosen_].n;
    job.found = found_.next(n);
    find_first(b, job, n, settings_.law.pull_off());
  }

  // Of a step over the near spheres that begins; `with_point`: its outputs will be asked for.
  void make_room(Results &r, bool with_point)
  {
    const std::size_t n = lists_[chosen_].n;
    if (r.n_contacts.size() < n) {
      const std::size_t room = n + n / 8;
      r.n_contacts = Array<int>(room);
      if (B::kFindsFirst) r.place = Array<int>(room);
      if (law_.traits.heat) r.heat = Array<Real>(room);
      if (law_.traits.records) r.pool_place = Array<int>(room);
    }
    if (!may_miss_any(grid_))
      r.uncertain = Array<Real>();
    else if (r.uncertain.size() < n)
      r.uncertain = Array<Real>(n + n / 8);
    const std::size_t room = r.n_contacts.size(),
                      numbers = room * (with_point ? ResultColumns::kRealsWithPoint
                                                   : ResultColumns::kReals);
    if (r.numbers.size() < numbers) r.numbers = Array<Real>(numbers);
    r.columns =
        ResultColumns::of(r.numbers.data(), room, with_point, r.n_contacts.data(), r.place.data());
  }

  StepCounts read_counts() { return b_.to_host(counts_, 1)[0]; }

  [[noreturn]] void throw_for(const Spheres &spheres, const StepCounts &seen)
  {
    clear_notes(seen);
    if (seen.too_large) {
      const int i = static_cast<int>(kNoSphere - seen.too_large);
      Array<Real> radius(1);
      Real *to = radius.data();
      read_radius(spheres, i, to);
      throw_too_large(i, b_.to_host(radius, 1)[0], grid_.reach);
    }
    throw InputError(std::to_string(seen.lost) +
                     " spheres touch the wall in more separate places than there is memory for (" +
                     std::to_string(kMostPlaces) + " each, " + std::to_string(kCrowdContacts) +
                     " for all that touch it in more than " + std::to_string(kPlaces) +
                     "); the mesh is far finer than its overlap");
  }

  void know_near()
  {
    const NearList &list = lists_[list_of_step_];
    if (!near_known_) near_host_ = b_.to_host(list.near, list.n);
    near_known_ = true;
  }

  EngineSettings settings_;
  CompiledLaw<B> law_;
  B b_;
  GridView grid_ = {};
  Array<char> block_;
  Array<BrickWord> words_;
  BrickTable table_;
  typename B::SelectRoom select_room_;
  Spheres spheres_;
  StepSettings step_;
  ResidentSprings<B> springs_;

  // Two of each, as what is left of the last step may be asked for until the next one starts,
  // though spheres have been chosen and their contacts searched for.
  NearList lists_[2];
  int chosen_ = 0, list_of_step_ = 0;
  Results results_[2];
  int last_ = 0;

  Array<StepCounts> counts_;
  ResidentCrowd<B> crowd_;
  typename B::Beside beside_;
  bool marked_ = false, searched_ = false;    // for the next step
  FoundContacts<B> found_;                    // where they are found first

  WallTotals totals_;
  bool totals_known_ = true;
  std::vector<int> near_host_, touching_;
  bool near_known_ = false;
  std::vector<SphereOutput> output_;
  std::vector<Real> sphere_heat_;
  std::vector<ContactRecord> records_;
};

}    // namespace lsdcd
