// The engine on one backend, for particles in its memory: one source for all.
#pragma once

#include "base/input_error.h"
#include "engine/force/compiled_law.h"
#include "engine/force/force_settings.h"
#include "engine/choose/near_list.h"
#include "engine/resident_springs.h"
#include "engine/results/sphere_error.h"
#include "engine/results/totals.h"

#include <string>
#include <utility>
#include <vector>

namespace lsdcd {

template <class B>
class EngineOn : public InPlaceEngine {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  EngineOn(const EngineSettings &settings, const CompiledLaw<B> &law, B backend) :
      settings_(settings), law_(law), b_(std::move(backend)), springs_(law.traits), counts_(1),
      lanes_(kLanes)
  {
    clear_notes(StepCounts());
    unlock_lanes();
  }

  std::string backend() const override { return b_.name(); }

  void set_grid(const GridView &grid) override
  {
    totals();    // of the last step, whose near spheres are forgotten
    if (B::kOnHost) {
      grid_ = grid;
    } else {
      if (!grid.block) throw std::logic_error("an engine needs the view of a flat grid block");
      block_ = Array<char>(grid.block_bytes);
      b_.copy_in(grid.block, block_.data(), grid.block_bytes);
      grid_ = moved_view(grid, block_.data());
    }
    const std::vector<BrickWord> words = brick_words(grid);
    words_ = b_.from_host(words);
    table_ = BrickTable(words, words_.data());
    n_near_ = 0;
  }

  Real largest_radius(const Spheres &spheres) override
  {
    return b_.template largest<Real>(spheres.n, [=] LSDCD_LAMBDA(std::size_t i) -> Real {
      return !spheres.mask || (spheres.mask[i] & spheres.group_bit) ? spheres.radius[i] : 0;
    });
  }

  void choose(const Spheres &spheres, Real margin, bool watch = false) override
  {
    totals();    // of the last step, which had other near spheres
    springs_.grow(b_, spheres.n);
    all_near_ = false;
    near_.choose(b_, grid_, table_, spheres, margin, settings_.law.pull_off(), counts_.data(),
                 springs_.count());
    StepCounts seen = read_counts();
    if (seen.too_large) throw_for(spheres, seen);
    if (grid_.nearest == 0 && seen.n_near > 0) {
      near_.prune(b_, grid_, spheres, seen.n_near, margin, counts_.data(), springs_.count());
      seen = read_counts();
    }
    make_lists(spheres, seen.n_near, seen);
    margin_ = margin;
    if (watch) keep_centres(spheres);
  }

  // For an adapter that has chosen: all spheres are near.
  void choose_all(const Spheres &spheres)
  {
    springs_.grow(b_, spheres.n);
    all_near_ = true;
    make_lists(spheres, spheres.n, read_counts());
  }

  bool has_moved(const Spheres &spheres) override
  {
    const Real *was = centres_.data();
    const Rows<const Real> x = spheres.x;
    return b_.template largest<Real>(spheres.n, [=] LSDCD_LAMBDA(std::size_t i) -> Real {
      return norm_sq(x[i] - Vec3{was[3 * i], was[3 * i + 1], was[3 * i + 2]});
    }) > margin_ * margin_;
  }

  void start(const Spheres &spheres, const StepSettings &step) override
  {
    spheres_ = spheres;
    step_ = step;
  }

  void collect() override
  {
    run();
    fetch();
  }

  // The two halves of collect(): the work, without waiting for it, and what is asked for of it.
  void run()
  {
    totals_known_ = false;
    if (n_near_ == 0) return;
    make_room();
    LawJob job = job_of(grid_, force_settings(settings_, step_), spheres_);
    job.near = near();
    job.lists = lists_;
    job.springs = springs_.view();
    job.counts = counts_.data();
    job.result = columns_;
    job.heat = heat_.data();
    job.uncertain = uncertain_.data();
    job.pool = springs_.next(slot_.data());
    job.lanes = lanes_.data();
    job.left = left_.data();
    job.turn = turn_;
    // The last step cleared the counts of this one, if it wrote to the other pool.
    if (job.pool.which == pool_written_) clear_counts(job.pool.which);
    pool_written_ = job.pool.which;
    law_.start(law_.law, job, n_near_, b_);
    turn_ = 1 - turn_;
    if (step_.update_history) springs_.swap();
  }
  void fetch()
  {
    touching_.clear();
    output_.clear();
    sphere_heat_.clear();
    records_.clear();
    if (n_near_ == 0) return;
    if (step_.per_sphere) fetch_output();
    if (law_.traits.records) fetch_records();
  }

  const WallTotals &totals() const override
  {
    if (!totals_known_) const_cast<EngineOn *>(this)->sum_totals();
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
  int n_near() const override { return static_cast<int>(n_near_); }

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
    notes.lists = static_cast<std::int64_t>(seen.lists);
    notes.listed = static_cast<std::int64_t>(seen.listed);
    notes.by_cells = static_cast<std::int64_t>(seen.by_cells);
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
    return block_.size() + words_.size() * sizeof(BrickWord) + springs_.bytes() + near_.bytes() +
           list_reals_.size() * sizeof(Real) + list_ints_.size() * sizeof(int) +
           lanes_.size() * sizeof(Lane) +
           (numbers_.size() + heat_.size() + uncertain_.size() + centres_.size()) * sizeof(Real) +
           (n_contacts_.size() + slot_.size() + left_.size()) * sizeof(int) +
           touching_.capacity() * sizeof(int) + output_.capacity() * sizeof(SphereOutput) +
           sphere_heat_.capacity() * sizeof(Real) + records_.capacity() * sizeof(ContactRecord);
  }

  B &backend_now() { return b_; }
  const Array<int> &contacts_of_near() const { return n_contacts_; }

  // The steps of the above. Public because nvcc takes no device lambda from a private function.

  void make_lists(const Spheres &spheres, std::size_t n, const StepCounts &seen)
  {
    n_near_ = n;
    near_known_ = false;
    springs_.make_room(n, seen);
    lists_ = WallLists();
    if (grid_.nearest > 0 || n == 0) return;
    if (list_ints_.size() < n * WallLists::kInts) {
      const std::size_t room = n + n / 8;
      list_reals_ = Array<Real>(room * WallLists::kReals);
      list_ints_ = Array<std::int32_t>(room * WallLists::kInts);
    }
    lists_ =
        WallLists::of(list_reals_.data(), list_ints_.data(), list_ints_.size() / WallLists::kInts);
    const int *near = this->near();
    const GridView grid = grid_;
    const Real pull_off = settings_.law.pull_off();
    const WallLists lists = lists_;
    StepCounts *counts = counts_.data();
    const Rows<const Real> x = spheres.x;
    const Real *radius = spheres.radius;
    b_.for_each(
        n,
        [=] LSDCD_LAMBDA(std::size_t k) {
          const std::size_t i = near ? near[k] : k;
          const Searcher s = {x[i], radius[i], reach_of(radius[i], pull_off), nullptr, 0};
          WallList made;
          gather(grid, s, made);
          lists.put(k, made);
          count_one(&counts->lists);
          add_to(&counts->listed, made.n);
        },
        128);
  }

  void unlock_lanes()
  {
    Lane *lanes = lanes_.data();
    b_.for_each(kLanes, [=] LSDCD_LAMBDA(std::size_t i) { lanes[i].locked = 0; });
  }

  void keep_centres(const Spheres &spheres)
  {
    const std::size_t n = spheres.n;
    if (centres_.size() < 3 * n) centres_ = Array<Real>(3 * (n + n / 8));
    Real *to = centres_.data();
    const Rows<const Real> x = spheres.x;
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      const Vec3 at = x[i];
      for (int d = 0; d < 3; d++) to[3 * i + d] = at[d];
    });
  }

  void read_radius(const Spheres &spheres, int i, Real *to)
  {
    b_.for_each(1, [=] LSDCD_LAMBDA(std::size_t) { to[0] = spheres.radius[i]; });
  }

  void clear_counts(int pool)
  {
    StepCounts *counts = counts_.data();
    b_.for_each(1, [=] LSDCD_LAMBDA(std::size_t) { counts->shared_used[pool] = 0; });
  }

  // What has been counted since the host looked.
  void clear_notes(const StepCounts &seen)
  {
    StepCounts *counts = counts_.data();
    b_.for_each(1, [=] LSDCD_LAMBDA(std::size_t) {
      StepCounts cleared = {};
      for (int i = 0; i < 2; i++) {
        cleared.shared_used[i] = seen.shared_used[i];
        cleared.n_left[i] = seen.n_left[i];
      }
      *counts = cleared;
    });
  }

  void fetch_output()
  {
    const std::size_t n = n_near_;
    const bool has_heat = law_.traits.heat;
    Array<SphereOutput> out(n);
    Array<Real> heat_out(has_heat ? n : 0);
    SphereOutput *to = out.data();
    Real *to_heat = heat_out.data();
    const Real *from_heat = heat_.data();
    const ResultColumns result = columns_;
    const int *near = this->near();
    const Spheres spheres = spheres_;
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      const std::size_t i = near ? near[k] : k;
      const bool touches = result.n_contacts[k] > 0;    // nothing is written of others
      to[k] = SphereOutput();
      if (touches) to[k] = output_of(result.get(k), spheres.x[i], spheres.radius[i]);
      if (has_heat) to_heat[k] = touches ? from_heat[k] : 0;
    });
    const std::vector<SphereOutput> all = b_.to_host(out, n);
    const std::vector<Real> heat = b_.to_host(heat_out, heat_out.size());
    know_near();
    for (std::size_t k = 0; k < n; k++) {
      if (!(all[k].contacts > 0)) continue;
      touching_.push_back(all_near_ ? static_cast<int>(k) : near_host_[k]);
      output_.push_back(all[k]);
      if (has_heat) sphere_heat_.push_back(heat[k]);
    }
  }

  void fetch_records()
  {
    const std::size_t n = n_near_;
    Array<int> offset(n);
    int *at = offset.data();
    const int *n_contacts = n_contacts_.data();
    const int *slot = slot_.data();
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) { at[k] = n_contacts[k]; });
    const std::size_t total = b_.exclusive_scan(at, n);
    // What lies between them was never written.
    Array<ContactRecord> packed(total);
    ContactRecord *to = packed.data();
    const ContactRecord *from = springs_.records(step_.update_history);
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      for (int c = 0; c < n_contacts[k]; c++) to[at[k] + c] = from[slot[k] + c];
    });
    records_ = b_.to_host(packed, total);
  }

  void sum_totals()
  {
    totals_known_ = true;
    totals_ = WallTotals();
    if (n_near_ == 0) return;
    const std::size_t n = n_near_, n_blocks = (n + kTotalsBlock - 1) / kTotalsBlock;
    Array<WallTotals> block(n_blocks);
    WallTotals *to = block.data();
    const ResultColumns result = columns_;
    const int *near = this->near();
    const Real *uncertain = uncertain_.data();
    b_.for_each(n_blocks, [=] LSDCD_LAMBDA(std::size_t b) {
      WallTotals t;
      const std::size_t end = (b + 1) * kTotalsBlock < n ? (b + 1) * kTotalsBlock : n;
      for (std::size_t k = b * kTotalsBlock; k < end; k++) {
        if (uncertain && uncertain[k] > 0) add_uncertain(t, uncertain[k]);
        if (result.n_contacts[k] == 0) continue;
        const SphereResult r = result.get(k);
        add_result(t, r, r.torque, near ? near[k] : static_cast<int>(k));
      }
      to[b] = t;
    });
    const std::size_t n_sums = (n_blocks + kTotalsBlock - 1) / kTotalsBlock;
    Array<WallTotals> sums(n_sums);
    WallTotals *to_sums = sums.data();
    b_.for_each(n_sums, [=] LSDCD_LAMBDA(std::size_t b) {
      WallTotals t;
      const std::size_t end = (b + 1) * kTotalsBlock;
      for (std::size_t k = b * kTotalsBlock; k < end && k < n_blocks; k++) add_block(t, to[k]);
      to_sums[b] = t;
    });
    for (const WallTotals &t : b_.to_host(sums, n_sums)) add_block(totals_, t);
  }

 private:
  const int *near() const { return all_near_ ? nullptr : near_.data(); }

  // For the results of a step.
  void make_room()
  {
    const std::size_t n = n_near_;
    if (n_contacts_.size() < n) {
      const std::size_t room = n + n / 8;
      n_contacts_ = Array<int>(room);
      if (!B::kOnHost) left_ = Array<int>(room);
      if (law_.traits.heat) heat_ = Array<Real>(room);
      if (law_.traits.records) slot_ = Array<int>(room);
    }
    if (!may_miss_any(grid_))
      uncertain_ = Array<Real>();
    else if (uncertain_.size() < n)
      uncertain_ = Array<Real>(n + n / 8);
    const bool with_point = step_.per_sphere;
    const std::size_t room = n_contacts_.size(),
                      numbers = room * (with_point ? ResultColumns::kRealsWithPoint
                                                   : ResultColumns::kReals);
    if (numbers_.size() < numbers) numbers_ = Array<Real>(numbers);
    columns_ = ResultColumns::of(numbers_.data(), room, with_point, n_contacts_.data());
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
                     std::to_string(kMostContacts) +
                     " each); the mesh is far finer than its overlap");
  }

  void know_near()
  {
    if (!near_known_ && !all_near_) near_host_ = near_.to_host(b_, n_near_);
    near_known_ = true;
  }

  EngineSettings settings_;
  CompiledLaw<B> law_;
  B b_;
  GridView grid_ = {};
  Array<char> block_;
  Array<BrickWord> words_;
  BrickTable table_;
  Spheres spheres_;
  StepSettings step_;
  ResidentSprings<B> springs_;

  NearList<B> near_;
  bool all_near_ = false;
  std::size_t n_near_ = 0;
  WallLists lists_;    // of near spheres; none where lists of cells hold the nearest pieces
  Array<Real> list_reals_;
  Array<std::int32_t> list_ints_;
  Array<Real> centres_;    // at the last choice
  Real margin_ = 0;        // of the last choice

  // What a step leaves behind of near spheres.
  ResultColumns columns_;
  Array<Real> numbers_, heat_, uncertain_;
  Array<int> n_contacts_, slot_, left_;

  Array<StepCounts> counts_;
  int turn_ = 0, pool_written_ = -1;
  Array<Lane> lanes_;

  WallTotals totals_;
  bool totals_known_ = true;
  std::vector<int> near_host_, touching_;
  bool near_known_ = false;
  std::vector<SphereOutput> output_;
  std::vector<Real> sphere_heat_;
  std::vector<ContactRecord> records_;
};

}    // namespace lsdcd
