// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The engine of a backend for a host whose arrays are in other memory: candidate spheres are copied packed,
// forces and torques are copied back, springs stay with the engine until the host asks for them.
#pragma once

#include "backend/backend_cpu.h"
#include "engine/broad_phase/selection_cpu.h"
#include "engine/engine_on.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace lsdcd {

// State of a sphere, copied to the engine in each step, and its force, copied back.
struct SphereMotion {
  Vec3 x, v, omega;
};
struct Response {
  Vec3 force, torque;
};

template <class B>
class HostAdapter : public WallEngine {
  template <class T>
  using Array = typename B::template Array<T>;

  // Memory of the CPU that copies quickly, and its twin.
  template <class T>
  struct Mirror {
    typename B::template CpuArray<T> host;
    Array<T> device;

    void reserve(std::size_t n)
    {
      host.reserve(n);
      device.reserve(n);
    }
    std::size_t bytes() const { return 2 * host.size() * sizeof(T); }
  };

 public:
  HostAdapter(const EngineSettings &settings, const CompiledLaw<B> &law, B backend) :
      settings_(settings), traits_(law.traits), engine_(settings, law, std::move(backend)),
      meshes_(settings.meshes), node_cells_(settings.meshes), waiting_(law.traits.n_extra)
  {
  }

  std::string backend() const override { return engine_.backend(); }

  void put_grid(const GridView &grid, int mesh) override
  {
    forget_choice();
    engine_.set_grid(grid, mesh);
    meshes_.at(mesh).grid = GridOn<CpuBackend>(cpu_, grid);
  }

  void set_pose(const Pose &pose, int mesh = 0) override
  {
    meshes_.at(mesh).pose = pose;
    engine_.set_pose(pose, mesh);
  }

  Real largest_radius(const Spheres &s) override
  {
    return cpu_.largest<Real>(s.n, [&](std::size_t i) -> Real {
      return !s.mask || (s.mask[i] & s.group_bit) ? s.radius[i] : 0;
    });
  }

  Real farthest_past(const Spheres &s, const PeriodicFaces &faces) override
  {
    return cpu_.largest<Real>(s.n, [&](std::size_t i) -> Real {
      return !s.mask || (s.mask[i] & s.group_bit) ? faces.past(s.x[i]) : 0;
    });
  }

  // The broad phase by cells runs on the host's copy of the grid, as copying all spheres would take longer; the
  // one by features runs on the engine.
  void choose(const Spheres &spheres, Real margin, bool watch = false) override
  {
    flush_diagnostics();
    const std::vector<int> was = std::exchange(candidates_, candidates_by_cells(spheres, margin));
    const std::size_t n = candidates_.size();
    motion_.reserve(n);
    size_.reserve(2 * n);
    response_.reserve(n);
    n_contacts_.reserve(n);
    if (traits_.heat) heat_.reserve(2 * n);
    if (settings_.laws.kinds > 1) send_types(spheres);
    pack(spheres);
    const std::vector<int> which = engine_.choose_among(packed(), margin);
    for (std::size_t k = 0; k < which.size(); k++) candidates_[k] = candidates_[which[k]];
    candidates_.resize(which.size());
    if (traits_.history) move_springs(was, spheres.n);
    if (watch) displacement_.store(cpu_, spheres, meshes_, margin);
  }

  bool has_moved(const Spheres &spheres) override
  {
    return displacement_.has_moved(cpu_, spheres, meshes_);
  }

  // The engine's stream is no one else's: its work is always beside the host's.
  void begin(When /*when*/ = When::in_turn) override { state_ = StepState::begun; }

  void submit(const Spheres &spheres, const StepSettings &step) override
  {
    require(StepState::begun);
    host_ = spheres;
    const std::size_t n = candidates_.size();
    B &b = engine_.backend_now();
    if (traits_.history && are_waiting_) move_springs(candidates_, spheres.n);
    if (n > 0) {
      pack(spheres);
      put_all(b, response_.device.data(), n, Response());
      if (traits_.heat) send_heat(spheres);
    }
    engine_.set_step(packed(), step);
    engine_.compute();
    state_ = StepState::submitted;
    if (n == 0) return;
    if (!uses_slots())
      b.copy_out(engine_.contacts_of_candidates().data(), n_contacts_.host.data(), n);
    b.copy_out(response_.device.data(), response_.host.data(), n);
    if (traits_.heat) b.copy_out(heat_.device.data(), heat_.host.data(), 2 * n);
  }
  bool is_under_way() const override { return state_ == StepState::submitted; }

  void collect() override
  {
    require(StepState::submitted);
    engine_.backend_now().wait();
    add_responses();
    engine_.fetch();
    touching_.assign(engine_.touching(), engine_.touching() + engine_.n_touching());
    for (int &i : touching_) i = candidates_[i];
    totals_known_ = false;
    state_ = StepState::none;
  }

  const WallTotals &totals() const override
  {
    if (!totals_known_) totals_ = engine_.totals();
    if (!totals_known_ && totals_.largest_overlap_sphere >= 0)
      totals_.largest_overlap_sphere = candidates_[totals_.largest_overlap_sphere];
    totals_known_ = true;
    return totals_;
  }
  WallTotals mesh_totals(int mesh) const override
  {
    if (!uses_slots()) return totals();
    return engine_.mesh_totals(mesh);
  }
  int n_touching() const override { return static_cast<int>(touching_.size()); }
  const int *touching() const override { return touching_.data(); }
  const SphereOutput *sphere_output() const override { return engine_.sphere_output(); }
  const TouchingSphere *touching_spheres() const override { return engine_.touching_spheres(); }
  const Real *sphere_heat() const override { return engine_.sphere_heat(); }
  int n_contacts() const override { return engine_.n_contacts(); }
  const StepContact *contacts() const override { return engine_.contacts(); }

  StepDiagnostics read_diagnostics() override
  {
    flush_diagnostics();
    const StepDiagnostics diagnostics = diagnostics_;
    diagnostics_ = StepDiagnostics();
    return diagnostics;
  }

  NodesInPlace *nodes_in_place() override { return engine_.nodes_in_place(); }
  void build_grid_of_nodes(int mesh, const NodeGridSettings &settings) override
  {
    forget_choice();
    engine_.build_node_grid(mesh, settings);
    meshes_.at(mesh).grid =
        GridOn<CpuBackend>(cpu_, engine_.occupied_cells(mesh, node_cells_[mesh]));
  }
  // Springs that wait are turned once the engine has them, in the step that comes.
  void turn_springs(int /*n*/, int mesh, const TurningMesh &turning) override
  {
    if (!traits_.history) return;
    if (are_waiting_)
      to_turn_.push_back({mesh, turning});
    else
      engine_.turn_springs(n_candidates(), mesh, turning);
  }
  void see_node_forces(int mesh, const NodesNow &now, const MeshFeaturesView &wall) override
  {
    engine_.see_node_forces(mesh, now, wall);
  }
  NodeForceRange node_force_range(int mesh) override
  {
    NodeForceRange range = engine_.node_force_range(mesh);
    if (range.not_finite) range.not_finite = kNoSphere - candidates_[kNoSphere - range.not_finite];
    return range;
  }
  void add_node_forces(int mesh, const NodeForceRange *of_all) override
  {
    engine_.add_node_forces(mesh, of_all);
  }
  Real fetch_node_forces(int mesh, std::int64_t *sums) override
  {
    return engine_.fetch_node_forces(mesh, sums);
  }

  void springs_to(ContactHistory &store, int n) override
  {
    springs_to_waiting();
    waiting_.grow(n);
    store = waiting_;
  }
  void springs_from(const ContactHistory &store, int /*n*/) override
  {
    waiting_ = store;
    are_waiting_ = true;
    to_turn_.clear();
  }

  int n_candidates() const override { return static_cast<int>(candidates_.size()); }
  std::size_t bytes() const override
  {
    return engine_.bytes() + motion_.bytes() + size_.bytes() + response_.bytes() +
           n_contacts_.bytes() + heat_.bytes() + type_.bytes() + selector_.bytes() +
           waiting_.bytes() + (candidates_.capacity() + touching_.capacity()) * sizeof(int) +
           displacement_.bytes();
  }

 private:
  bool uses_slots() const { return lsdcd::uses_slots(settings_); }

  // Before another grid.
  void forget_choice()
  {
    flush_diagnostics();
    springs_to_waiting();
    candidates_.clear();
  }

  // Returns the candidates of any mesh by cells, ascending.
  std::vector<int> candidates_by_cells(const Spheres &spheres, Real margin)
  {
    std::vector<int> candidates;
    for (const EngineMesh<CpuBackend> &mesh : meshes_) {
      StepCounts seen = {};
      selector_.choose(cpu_, mesh, spheres, margin, largest_pull_off(settings_.laws), false, &seen,
                       nullptr);
      if (seen.too_large) {
        const int i = static_cast<int>(kNoSphere - seen.too_large);
        throw_too_large(i, spheres.radius[i], mesh.grid.view.cutoff);
      }
      const std::vector<int> more = selector_.to_cpu(cpu_, seen.n_candidates),
                             before = std::move(candidates);
      candidates.clear();
      std::set_union(before.begin(), before.end(), more.begin(), more.end(),
                     std::back_inserter(candidates));
    }
    return candidates;
  }

  StepDiagnostics read_engine()
  {
    try {
      return engine_.read_diagnostics();
    } catch (const InputError &e) {
      if (e.sphere < 0) throw;
      throw InputError(candidates_[e.sphere], e.problem);
    }
  }

  // Gives what steps left behind the host's indices, before other spheres are candidates.
  void flush_diagnostics()
  {
    totals();
    const StepDiagnostics seen = read_engine();
    if (seen.deepest > diagnostics_.deepest) {
      diagnostics_.deepest = seen.deepest;
      diagnostics_.deepest_sphere = candidates_[seen.deepest_sphere];
      diagnostics_.deepest_mesh = seen.deepest_mesh;
      diagnostics_.deepest_meshes = seen.deepest_meshes;
      diagnostics_.deepest_step = seen.deepest_step;
    }
    diagnostics_.uncertified += seen.uncertified;
    diagnostics_.uncertain = std::max(diagnostics_.uncertain, seen.uncertain);
    diagnostics_.lists += seen.lists;
    diagnostics_.listed += seen.listed;
    diagnostics_.by_cells += seen.by_cells;
  }

  // Temperatures there, heat flows back.
  void send_heat(const Spheres &s)
  {
    const std::size_t n = candidates_.size();
    Real *to = heat_.host.data();
    for (std::size_t k = 0; k < n; k++) {
      to[k] = s.temperature[candidates_[k]];
      to[n + k] = 0;
    }
    engine_.backend_now().copy_in(heat_.host.data(), heat_.device.data(), 2 * n);
  }

  void send_types(const Spheres &s)
  {
    const std::size_t n = candidates_.size();
    type_.reserve(n);
    int *to = type_.host.data();
    for (std::size_t k = 0; k < n; k++) to[k] = s.type[candidates_[k]];
    engine_.backend_now().copy_in(type_.host.data(), type_.device.data(), n);
  }

  // The candidates as the engine has them.
  Spheres packed()
  {
    constexpr std::ptrdiff_t row = sizeof(SphereMotion) / sizeof(Real);
    const std::size_t n = candidates_.size();
    Spheres s;
    s.n = static_cast<int>(n);
    if (n == 0) return s;
    const SphereMotion *motion = motion_.device.data();
    Response *response = response_.device.data();
    s.x = {&motion->x.x, row, 1};
    s.v = {&motion->v.x, row, 1};
    s.omega = {&motion->omega.x, row, 1};
    s.radius = size_.device.data();
    s.mass = size_.device.data() + n;
    s.force = {&response->force.x, 6, 1};
    s.torque = {&response->torque.x, 6, 1};
    if (settings_.laws.kinds > 1) s.type = type_.device.data();
    if (traits_.heat) {
      s.temperature = heat_.device.data();
      s.heat_flow = heat_.device.data() + n;
    }
    return s;
  }

  // Springs that the engine has of the spheres `was`, or that wait, to the candidates of now.
  void move_springs(const std::vector<int> &was, int n_spheres)
  {
    if (!are_waiting_) spread(was, n_spheres);
    waiting_.grow(n_spheres);
    ContactHistory candidates(traits_.n_extra);
    candidates.grow(n_candidates());
    for (int k = 0; k < n_candidates(); k++) {
      const int i = candidates_[k];
      if (waiting_.count(i) > 0)
        candidates.set(k, waiting_.of(i), waiting_.extra_of(i), waiting_.count(i));
    }
    engine_.springs_from(candidates, n_candidates());
    engine_.forget_far_meshes();
    for (const auto &[mesh, turning] : to_turn_)
      engine_.turn_springs(n_candidates(), mesh, turning);
    to_turn_.clear();
    are_waiting_ = false;
  }
  void springs_to_waiting()
  {
    if (!traits_.history || are_waiting_) return;
    spread(candidates_, 0);
    are_waiting_ = true;
  }
  // The engine's springs by the indices of the host.
  void spread(const std::vector<int> &candidates, int n_spheres)
  {
    ContactHistory packed(traits_.n_extra);
    engine_.springs_to(packed, static_cast<int>(candidates.size()));
    waiting_ = ContactHistory(traits_.n_extra);
    if (!candidates.empty()) waiting_.grow(candidates.back() + 1);
    waiting_.grow(n_spheres);
    for (std::size_t k = 0; k < candidates.size(); k++)
      if (packed.count(k) > 0)
        waiting_.set(candidates[k], packed.of(k), packed.extra_of(k), packed.count(k));
  }

  // Adds the engine's forces to those of the host.
  void add_responses()
  {
    const int n = static_cast<int>(candidates_.size());
    const int *candidates = candidates_.data(), *n_contacts = n_contacts_.host.data();
    const Response *response = response_.host.data();
    const Spheres host = host_;
    const bool all = uses_slots();    // contacts are not counted by spheres
#pragma omp parallel for schedule(static) num_threads(threads()) if (n > 4096)
    for (int k = 0; k < n; k++) {
      if (!all && n_contacts[k] == 0) continue;
      const int i = candidates[k];
      host.force.add(i, response[k].force);
      host.torque.add(i, response[k].torque);
      if (traits_.heat) host.heat_flow[i] += heat_.host.data()[n + k];
    }
  }

  // Rows of candidates are far apart in the host's memory: they are asked for ahead of their turn.
  void pack(const Spheres &s)
  {
    constexpr int kAhead = 16;
    const int n = static_cast<int>(candidates_.size());
    const int *candidates = candidates_.data();
    SphereMotion *to = motion_.host.data();
    Real *radius = size_.host.data(), *mass = radius + n;
#pragma omp parallel for schedule(static) num_threads(threads()) if (n > 4096)
    for (int k = 0; k < n; k++) {
      if (k + kAhead < n) {
        const int next = candidates[k + kAhead];
        __builtin_prefetch(s.x.of(next));
        __builtin_prefetch(s.v.of(next));
        __builtin_prefetch(s.omega.of(next));
      }
      const int i = candidates[k];
      to[k] = {s.x[i], s.v[i], s.omega[i]};
      radius[k] = s.radius[i];
      mass[k] = s.mass[i];
    }
    engine_.backend_now().copy_in(motion_.host.data(), motion_.device.data(), n);
    engine_.backend_now().copy_in(size_.host.data(), size_.device.data(),
                                  2 * static_cast<std::size_t>(n));
  }

  EngineSettings settings_;
  LawTraits traits_;
  EngineOn<B> engine_;

  CpuBackend cpu_;
  std::vector<EngineMesh<CpuBackend>> meshes_;
  std::vector<OccupiedCells> node_cells_;    // of meshes whose nodes move
  CandidateSelector<CpuBackend> selector_;
  std::vector<int> candidates_, touching_;
  DisplacementCheck<CpuBackend> displacement_;

  Mirror<SphereMotion> motion_;
  Mirror<Real> size_;    // radii, then masses
  Mirror<Real> heat_;    // temperatures, then heat flows
  Mirror<int> type_;     // since the choice
  Mirror<Response> response_;
  Mirror<int> n_contacts_;    // the host's half only
  Spheres host_;              // of the step that runs

  ContactHistory waiting_;    // springs by the host's indices, while they are not with the engine
  bool are_waiting_ = true;
  std::vector<std::pair<int, TurningMesh>> to_turn_;    // meshes with which they have to turn

  StepDiagnostics diagnostics_;    // since the host looked
  mutable WallTotals totals_;
  mutable bool totals_known_ = true;
};

}    // namespace lsdcd
