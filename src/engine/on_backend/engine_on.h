// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The engine on one backend; all backends share this source. It works on arrays in the backend's memory: those of the host, or
// those of its mirror (mirror.h). It runs broad_phase/broad_phase.h when a candidate search is due, and step/mesh_step.h in
// each step.
#pragma once

#include "base/input_error.h"
#include "engine/broad_phase/broad_phase.h"
#include "engine/loads/sums_on.h"
#include "engine/nodes/moving_nodes.h"
#include "engine/on_backend/mirror.h"
#include "engine/on_backend/resident_springs.h"
#include "engine/on_backend/results_on.h"
#include "engine/on_backend/work_list_store.h"
#include "engine/results/step_errors.h"
#include "engine/step/compiled_law.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsdcd {

template <class B>
class EngineOn : public WallEngine {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  EngineOn(const EngineSettings &settings, const CompiledLaw<B> &law, B backend) :
      settings_(settings), law_(law), b_(std::move(backend)), broad_phase_(settings), counts_(1),
      springs_(b_, law.traits, counts_.data()), works_of_meshes_(settings.meshes),
      receded_(settings.meshes), overflow_(kOverflowScratches)
  {
    if (settings_.arrays != HostArrays::in_place)
      mirror_ = std::make_unique<SphereMirror<B>>(settings_.arrays, law.traits.heat);
    clear_diagnostics(StepCounts());
    unlock_scratches();
    if (broad_phase_.uses_slots()) put_laws();
    for (int m = 0; settings_.nodes && m < settings_.meshes; m++)
      nodes_.push_back(std::make_unique<MovingNodes<B>>(*this, m));
  }

  std::string backend() const override { return b_.name(); }

  void put_grid(const ViewOf<StepGrid> &grid, int mesh) override
  {
    works_of_meshes_[mesh].reset();
    where_step_runs([&] { broad_phase_.set_grid(b_, grid, mesh); });
  }

  void set_pose(const Pose &pose, int mesh = 0) override
  {
    if (pose.placed && !settings_.moves && !broad_phase_.uses_slots())
      throw std::logic_error("this engine's wall cannot move");
    works_of_meshes_[mesh].reset();
    broad_phase_.place(pose, mesh);
  }

  Real largest_radius(const Spheres &host) override
  {
    const Spheres spheres = mirror_ ? mirror_->bring_radii(b_, host) : host;
    return b_.template largest<Real>(spheres.n, [=] LSDCD_LAMBDA(std::size_t i) -> Real {
      return !spheres.mask || (spheres.mask[i] & spheres.group_bit) ? spheres.radius[i] : 0;
    });
  }

  Real farthest_past(const Spheres &host, const PeriodicFaces &faces) override
  {
    const Spheres spheres = with_places(host);
    return b_.template largest<Real>(spheres.n, [=] LSDCD_LAMBDA(std::size_t i) -> Real {
      const bool is_in_group = !spheres.mask || (spheres.mask[i] & spheres.group_bit);
      return is_in_group ? faces.past(spheres.x[i]) : 0;
    });
  }

  void choose(const Spheres &host, Real margin, bool watch = false) override
  {
    where_step_runs([&] {
      const Spheres spheres = mirror_ ? mirror_->bring_for_choice(b_, host) : host;
      results_.detach_from_candidates(b_);
      springs_.grow(spheres.n);
      const SpringsView last = springs_.view();
      make_room(spheres, broad_phase_.choose(b_, spheres, margin, counts_, springs_.count(),
                                             law_.traits.energy ? &last : nullptr));
      if (mirror_) mirror_->make_room(b_, broad_phase_, spheres.n);
      // Drops springs on meshes that the sphere is no candidate of: they would be taken for those of another mesh.
      if (broad_phase_.uses_slots())
        springs_.forget_others(broad_phase_.slots().n_spheres(), broad_phase_.slots().meshes_of());
      if (watch) broad_phase_.store_positions(b_, spheres, margin);
    });
  }

  bool has_moved(const Spheres &host) override
  {
    bool has = false;
    where_step_runs([&] { has = broad_phase_.has_moved(b_, with_places(host)); });
    return has;
  }

  void begin(When when = When::in_turn) override
  {
    when_ =
        is_apart() ? When::in_turn : when;    // on its own stream it runs beside the host anyway
    if (when_ != When::in_turn) beside_.ready(b_);
    state_ = StepState::begun;
  }

  void submit(const Spheres &spheres, const StepSettings &step) override
  {
    require(StepState::begun);
    spheres_ = spheres;
    if (settings_.nodes || !are_alike(step, step_)) forget_works();
    step_ = step;
    if (starts_at_submit())
      where_step_runs([&] { compute(next_results_, when_ != When::in_turn); });
    if (when_ == When::beside_adding_early) next_results_.add_forces(b_);
    if (mirror_ && gives_back_at_submit()) mirror_->start_back(b_);
    state_ = StepState::submitted;
  }
  bool is_under_way() const override
  {
    return state_ == StepState::submitted && starts_at_submit();
  }

  void collect() override
  {
    require(StepState::submitted);
    if (starts_at_submit())
      std::swap(results_, next_results_);
    else
      compute(results_, false);
    if (when_ == When::beside) results_.add_forces(b_);
    if (mirror_) {
      if (!gives_back_at_submit()) mirror_->start_back(b_);
      mirror_->collect(b_);
    }
    state_ = StepState::none;
    results_.fetch(b_, springs_.contacts());
    if (law_.traits.losses) results_.fetch_losses(b_, springs_.extra_of_contacts());
  }

  StepResults &results() override { return results_; }
  ResidentRows &springs() override { return springs_; }
  int n_candidates() const override { return static_cast<int>(broad_phase_.n()); }

  StepDiagnostics read_diagnostics() override
  {
    const StepCounts seen = read_counts();
    if (seen.too_large || seen.no_scratch || seen.no_places || seen.grown)
      throw_for(spheres_, seen);
    clear_diagnostics(seen);
    StepDiagnostics diagnostics = diagnostics_of(seen, first_step_);
    if (mirror_) diagnostics.deepest_radius = mirror_->radius_of(b_, diagnostics.deepest_sphere);
    return diagnostics;
  }

  NodeEngine *nodes(int mesh) override { return nodes_.empty() ? nullptr : nodes_[mesh].get(); }
  void take_nodes(WallEngine &from) override
  {
    auto &other = dynamic_cast<EngineOn &>(from);
    other.b_.wait();
    nodes_.swap(other.nodes_);
    for (const auto &nodes : nodes_) nodes->set_engine(*this);
  }
  FeatureEngine<Load> *loads() override { return B::kOnCpu ? nullptr : &loads_; }
  EnergyEngine *energies() override { return B::kOnCpu ? nullptr : &energies_; }
  std::size_t bytes() const override
  {
    std::size_t bytes = broad_phase_.bytes() + springs_.bytes() + results_.bytes() +
                        next_results_.bytes() + overflow_.size() * sizeof(OverflowScratch) +
                        work_lists_.bytes() + loads_.bytes() + energies_.bytes() +
                        b_.scratch_bytes() + beside_.scratch_bytes();
    if (mirror_) bytes += mirror_->bytes();
    for (const auto &nodes : nodes_) bytes += nodes->bytes();
    for (const auto &receded : receded_) bytes += receded.size() * sizeof(Vec3);
    return bytes;
  }

 protected:
  // Returns the sphere of each candidate.
  const int *candidates() const { return broad_phase_.candidates(); }

 private:
  // Returns whether the engine works on a step while the host does something else. Forces that are copied must have arrived by
  // collect().
  bool starts_at_submit() const { return when_ != When::in_turn || is_apart(); }
  bool gives_back_at_submit() const { return when_ == When::beside_adding_early || is_apart(); }
  bool is_apart() const { return settings_.arrays == HostArrays::apart; }
  Spheres with_places(const Spheres &host)
  {
    return mirror_ ? mirror_->bring_places(b_, host) : host;
  }

  // Returns the features of a mesh with their periodic images. Records of nodes that move have no images.
  MeshFeaturesView features(int mesh) const
  {
    const bool has_nodes = !nodes_.empty() && nodes_[mesh]->field().velocity;
    return has_nodes ? MeshFeaturesView() : broad_phase_.mesh(mesh).grid.view.wall;
  }
  // Return the contacts on a mesh, and its records of energy.
  NodeContacts contacts_on(int mesh) const
  {
    return results_.node_contacts(springs_.contacts(), mesh, features(mesh), nullptr);
  }
  EnergyItems energy_items(int mesh, const ImpactBins &bins) const
  {
    return results_.energy_items(mesh, bins);
  }

  void unlock_scratches()
  {
    for (int i = 0; i < kOverflowScratches; i++) put_one(b_, &overflow_.data()[i].locked, 0);
  }

  // Copies the laws for multi-mesh spheres to memory of the backend.
  void put_laws()
  {
    const std::vector<ContactLaw> &laws = settings_.laws.laws;
    laws_ = Array<LawEntry>(laws.size());
    for (std::size_t k = 0; k < laws_.size(); k++)
      put_one(b_, laws_.data() + k, LawEntry{law_.laws[k], laws[k].reach()});
  }

  // Copies the grids and settings of all meshes for the next step. Does not wait.
  const MeshWork *put_works()
  {
    const std::size_t n = broad_phase_.n_meshes();
    if (works_.size() < n) works_ = Array<MeshWork>(n);
    for (int m = 0; m < broad_phase_.n_meshes(); m++) put_one(b_, works_.data() + m, mesh_work(m));
    return works_.data();
  }

  // Clears the counts since the CPU last read them.
  void clear_diagnostics(const StepCounts &seen)
  {
    StepCounts cleared = {};
    for (int i = 0; i < 2; i++) {
      cleared.shared_used[i] = seen.shared_used[i];
      cleared.n_found[i] = seen.n_found[i];
      cleared.n_multi_contact[i] = seen.n_multi_contact[i];
    }
    put_one(b_, counts_.data(), cleared);
    are_counts_clear_ = true;
  }

  // Returns what the step reads of a mesh; it is reused from the last step if nothing of it has changed.
  const MeshWork &mesh_work(int m)
  {
    std::optional<MeshWork> &work = works_of_meshes_[m];
    if (work) return *work;
    const EngineMesh<B> &mesh = broad_phase_.mesh(m);
    const NodeField nodes = nodes_.empty() ? NodeField() : nodes_[m]->field();
    return work.emplace(MeshWork{
        mesh.grid.view, force_settings(settings_, step_, mesh.pose, nodes, m, receded_of(m))});
  }
  // Returns how far wear has moved the vertices of a mesh since the last step, in memory of kernels; null: not at all.
  const Vec3 *receded_of(int m)
  {
    if (!step_.receded || step_.receded[m].empty()) return nullptr;
    return (receded_[m] = from_cpu(b_, step_.receded[m])).data();
  }
  void forget_works() { works_of_meshes_.assign(works_of_meshes_.size(), std::nullopt); }
  // Runs this part of a step where the step runs. If the step was begun beside the host's work, that is the engine's own
  // stream.
  template <class Work>
  void where_step_runs(const Work &work)
  {
    if (state_ != StepState::begun || when_ == When::in_turn) return work();
    beside_.begin(b_);
    try {
      work();
    } catch (...) {    // a program may continue after an error
      beside_.end(b_);
      throw;
    }
    beside_.end(b_);
  }

  // Does the work of the step, without waiting for it. `adds_later`: the results add the forces later.
  void compute(ResultsOn<B> &results, bool adds_later)
  {
    const std::size_t n = broad_phase_.n();
    const bool several = broad_phase_.uses_slots();
    if (mirror_) spheres_ = mirror_->bring_candidates(b_, spheres_);
    results.begin(law_.traits, step_, spheres_, broad_phase_.candidates(), n,
                  may_miss_any(broad_phase_.mesh(0).grid.view), adds_later,
                  several ? &broad_phase_.slots() : nullptr);
    if (n == 0) return;
    const MeshWork &work = mesh_work(0);
    StepJob job = job_of(work.grid, work.settings, spheres_);
    job.pool = springs_.next();
    results.put_into(job);
    job.candidates = broad_phase_.candidates();
    job.lists = broad_phase_.lists();
    job.springs = springs_.view();
    job.counts = counts_.data();
    job.friction_heat = step_.dt != 0 ? settings_.friction_heat : 0;
    if (are_counts_clear_) first_step_ = step_.number;
    are_counts_clear_ = false;
    job.step = static_cast<std::uint64_t>(std::max<std::int64_t>(0, step_.number - first_step_)) &
               DeepestOverlap::kRest;
    if (law_.traits.records) {
      // A contact that begins may have two records: one of what it dissipates, and one of its impact.
      const bool both = law_.traits.energy && settings_.impact_speed > 0;
      const std::size_t of_last = springs_.places_read(), of_both_steps = springs_.places();
      job.records = results.begin_records(of_both_steps + (both ? of_both_steps - of_last : 0),
                                          of_last, settings_);
    }
    job.overflow = overflow_.data();
    if (several)
      run_slots(job);
    else
      run_law(job, n, law_of(0, 0));
    // A setup that stores swaps the pools, too, with springs whose values have not changed.
    if (job.settings.stores) springs_.swap();
    if (step_.totals && !B::kOnCpu) results.start_sums(b_);
  }

  // Reserves memory for steps over the candidates of a search. Throws InputError if a sphere was too large for it.
  void make_room(const Spheres &spheres, const StepCounts &seen)
  {
    if (seen.too_large) throw_for(spheres, seen);
    springs_.reserve_places(broad_phase_.n(), seen);
    if (B::kOnCpu) return;
    const bool several = broad_phase_.uses_slots();
    work_lists_.clear(b_, broad_phase_.n(), several ? broad_phase_.slots().n_multi_mesh() : 0,
                      !several, !several && broad_phase_.lists().n,
                      broad_phase_.seem_multi_contact(), counts_.data(), seen);
  }

  void run_law(StepJob &job, std::size_t n, const LawBytes &law)
  {
    if (!B::kOnCpu) job.work_lists = work_lists_.next(counts_.data());
    law_.run(law, job, n, b_);
  }

  const LawBytes &law_of(int mesh, int kind) const
  {
    return law_.laws[mesh * settings_.laws.of_mesh() + kind];
  }

  // Runs a step over candidate-mesh pairs: first candidates of a single mesh, mesh after mesh and kind after kind, then
  // multi-mesh spheres.
  void run_slots(const StepJob &job)
  {
    const CandidateSlots<B> &slots = broad_phase_.slots();
    for (int m = 0; m < broad_phase_.n_meshes(); m++)
      for (int kind = 0; kind < broad_phase_.n_kinds(); kind++) {
        const std::size_t begin = slots.begin(m, kind), n = slots.begin(m, kind + 1) - begin;
        if (n == 0) continue;
        StepJob of_mesh = from_slot(job, begin);
        const MeshWork &work = mesh_work(m);
        of_mesh.grid = work.grid;
        of_mesh.settings = work.settings;
        if (work.settings.nodes.velocity) of_mesh.lists.copies = RecordCopies();
        run_law(of_mesh, n, law_of(m, kind));
      }
    if (slots.n_multi_mesh() == 0) return;
    StepJob multi_mesh = job;
    // Lists of multi-mesh spheres name features, and are not valid while nodes move.
    if (settings_.nodes) multi_mesh.lists = FeatureLists();
    multi_mesh.multi_mesh = {put_works(), slots.first(), slots.mesh()};
    multi_mesh.multi_mesh.laws = {laws_.data(), settings_.laws.of_mesh(),
                                  broad_phase_.kinds_of(b_, spheres_)};
    run_law(multi_mesh, slots.n_multi_mesh(), law_of(0, 0));
  }

  StepCounts read_counts() { return read_one(b_, counts_.data()); }

  [[noreturn]] void throw_for(const Spheres &spheres, const StepCounts &seen)
  {
    clear_diagnostics(seen);
    if (seen.too_large) {
      const int i = static_cast<int>(kNoSphere - seen.too_large);
      throw_too_large(i, read_one(b_, spheres.radius + i), broad_phase_.mesh(0).grid.view.cutoff);
    }
    if (seen.grown) throw_has_grown(static_cast<int>(kNoSphere - seen.grown), settings_.names);
    if (seen.no_scratch) throw_too_many_contacts(kMaxContacts);
    throw_no_places(settings_.names);
  }

  EngineSettings settings_;
  CompiledLaw<B> law_;
  B b_;
  typename B::SideStream beside_;
  When when_ = When::in_turn;    // when the step that was begun does its work
  BroadPhase<B> broad_phase_;
  std::unique_ptr<SphereMirror<B>> mirror_;    // null: the host's arrays are used as they are
  Spheres spheres_;                            // of the step: those of the mirror once it runs
  StepSettings step_;
  Array<StepCounts> counts_;
  bool are_counts_clear_ = true;
  std::int64_t first_step_ = 0;    // number of the first step since counts were cleared
  ResidentSprings<B> springs_;

  ResultsOn<B> results_{b_}, next_results_{b_};    // of the last step, and of one submitted beside
  WorkListStore<B> work_lists_;
  friend class MovingNodes<B>;
  std::vector<std::unique_ptr<MovingNodes<B>>> nodes_;    // of each mesh; empty if no nodes move
  friend class LoadsOn<B>;
  friend class EnergiesOn<B>;
  LoadsOn<B> loads_{*this};
  EnergiesOn<B> energies_{*this};
  std::vector<std::optional<MeshWork>>
      works_of_meshes_;                 // empty: something of it may have changed
  std::vector<Array<Vec3>> receded_;    // of each mesh, see StepSettings
  Array<MeshWork> works_;               // the same in memory of kernels
  Array<LawEntry> laws_;                // of all meshes

  Array<OverflowScratch> overflow_;
};

}    // namespace lsdcd
