// The engine on one backend, for particles in its memory: one source for all.
#pragma once

#include "base/input_error.h"
#include "engine/force/compiled_law.h"
#include "engine/force/force_settings.h"
#include "engine/narrow/list_store.h"
#include "engine/choose/near_list.h"
#include "engine/resident_springs.h"
#include "engine/results/sphere_error.h"
#include "engine/results/step_notes.h"
#include "engine/results/step_results.h"

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
    if (settings.precision == Precision::single_ && !has_single(settings))
      throw InputError("precision single has neither granular, rolling, cohesion, a moving surface "
                       "or mesh, wear "
                       "nor mesh_fields: use mixed or double");
    clear_diagnostics(StepCounts());
    unlock_lanes();
  }

  std::string backend() const override { return b_.name(); }

  void set_grid(const GridView &grid, int /*mesh*/ = 0) override
  {
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

  void place_wall(const WallPose &pose, int /*mesh*/ = 0) override
  {
    if (pose.placed && !settings_.moves) throw std::logic_error("this engine's wall cannot move");
    pose_ = pose;
  }

  Real largest_radius(const Spheres &spheres) override
  {
    return b_.template largest<Real>(spheres.n, [=] LSDCD_LAMBDA(std::size_t i) -> Real {
      return !spheres.mask || (spheres.mask[i] & spheres.group_bit) ? spheres.radius[i] : 0;
    });
  }

  void choose(const Spheres &spheres, Real margin, bool watch = false) override
  {
    results_.outlive_choice(b_);
    springs_.grow(b_, spheres.n);
    all_near_ = false;
    near_.choose(b_, grid_, table_, spheres, pose_, margin, settings_.law.pull_off(),
                 counts_.data(), springs_.count());
    StepCounts seen = read_counts();
    if (seen.too_large) throw_for(spheres, seen);
    make_lists(spheres, seen, margin, springs_.count());
    margin_ = margin;
    if (watch) keep_centres(spheres);
  }

  // For an adapter that has chosen by cells: which of these spheres are near, as ascending numbers.
  // Steps are over these alone, one after the other.
  std::vector<int> choose_among(const Spheres &spheres, Real margin)
  {
    springs_.grow(b_, spheres.n);
    all_near_ = true;
    near_.choose_all(b_, spheres.n);
    StepCounts seen = read_counts();
    seen.n_near = spheres.n;
    make_lists(spheres, seen, margin, nullptr);
    return near_.to_host(b_, n_near_);
  }

  bool has_moved(const Spheres &spheres) override
  {
    const Real *was = centres_.data();
    const StridedView<const Real> x = spheres.x;
    const WallPose pose = pose_;
    return b_.template largest<Real>(spheres.n, [=] LSDCD_LAMBDA(std::size_t i) -> Real {
      return norm_sq(pose.to_mesh(x[i]) - Vec3{was[3 * i], was[3 * i + 1], was[3 * i + 2]});
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
    results_.begin(law_.traits, step_, spheres_, near(), n_near_, may_miss_any(grid_));
    if (n_near_ == 0) return;
    if (!B::kOnHost && left_.size() < n_near_) left_ = Array<int>(n_near_ + n_near_ / 8);
    LawJob job = job_of(grid_, force_settings(settings_, step_, pose_), spheres_);
    results_.put_into(job);
    job.near = near();
    job.lists = lists_.view();
    job.springs = springs_.view();
    job.counts = counts_.data();
    job.pool = springs_.next(results_.slot());
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
  void fetch() { results_.fetch(b_, springs_.records(step_.update_history)); }

  const WallTotals &totals() const override { return const_cast<EngineOn *>(this)->sum_totals(); }
  WallTotals mesh_totals(int /*mesh*/) const override { return totals(); }

  int n_touching() const override { return static_cast<int>(results_.touching().size()); }
  const int *touching() const override { return results_.touching().data(); }
  const SphereOutput *sphere_output() const override { return results_.output().data(); }
  const Real *sphere_heat() const override
  {
    return law_.traits.heat ? results_.sphere_heat().data() : nullptr;
  }
  int n_records() const override { return static_cast<int>(results_.records().size()); }
  const ContactRecord *records() const override { return results_.records().data(); }
  int n_near() const override { return static_cast<int>(n_near_); }

  StepDiagnostics read_diagnostics() override
  {
    const StepCounts seen = read_counts();
    if (seen.too_large || seen.lost || seen.grown) throw_for(spheres_, seen);
    clear_diagnostics(seen);
    return diagnostics_of(seen);
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
           lists_.bytes() + results_.bytes() + lanes_.size() * sizeof(Lane) +
           centres_.size() * sizeof(Real) + left_.size() * sizeof(int);
  }

  B &backend_now() { return b_; }
  const Array<int> &contacts_of_near() const { return results_.n_contacts(); }

  // The steps of the above. Public because nvcc takes no device lambda from a private function.

  // Of the seen.n_near spheres that are near by their cells.
  void make_lists(const Spheres &spheres, StepCounts seen, Real margin, int *n_springs)
  {
    const Real pull_off = settings_.law.pull_off();
    if (grid_.nearest == 0 && seen.n_near > 0) {
      near_.prune(b_, grid_, spheres, pose_, seen.n_near, margin, pull_off, counts_.data(),
                  n_springs);
      seen = read_counts();
    }
    n_near_ = seen.n_near;
    springs_.make_room(n_near_, seen);
    lists_.make(b_, grid_, spheres, pose_, near_.data(), n_near_, margin, pull_off, counts_.data());
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
    const StridedView<const Real> x = spheres.x;
    const WallPose pose = pose_;
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      const Vec3 at = pose.to_mesh(x[i]);
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
  void clear_diagnostics(const StepCounts &seen)
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

 private:
  const int *near() const { return all_near_ ? nullptr : near_.data(); }

  const WallTotals &sum_totals() { return results_.totals(b_); }

  StepCounts read_counts() { return b_.to_host(counts_, 1)[0]; }

  [[noreturn]] void throw_for(const Spheres &spheres, const StepCounts &seen)
  {
    clear_diagnostics(seen);
    if (seen.too_large) {
      const int i = static_cast<int>(kNoSphere - seen.too_large);
      Array<Real> radius(1);
      Real *to = radius.data();
      read_radius(spheres, i, to);
      throw_too_large(i, b_.to_host(radius, 1)[0], grid_.cutoff);
    }
    if (seen.grown) throw_has_grown(static_cast<int>(kNoSphere - seen.grown));
    throw_too_many_contacts(seen.lost, kMostContacts);
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
  ListStore<B> lists_;
  WallPose pose_;
  Array<Real> centres_;    // at the last choice, in the frame of the mesh
  Real margin_ = 0;        // of the last choice

  StepResults<B> results_;
  Array<int> left_;    // near spheres that a GPU's first kernel leaves to the second

  Array<StepCounts> counts_;
  int turn_ = 0, pool_written_ = -1;
  Array<Lane> lanes_;
};

}    // namespace lsdcd
