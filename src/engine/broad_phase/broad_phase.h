// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The broad phase: finds the candidate spheres of all meshes of a wall, and makes their lists of features.
#pragma once

#include "backend/backend.h"
#include "engine/broad_phase/candidate_slots.h"
#include "engine/broad_phase/candidate_test.h"
#include "engine/broad_phase/displacement_check.h"
#include "engine/broad_phase/feature_list_store.h"
#include "engine/broad_phase/selection.h"

#include <stdexcept>
#include <vector>

namespace lsdcd {

// The input of a candidate search at one mesh; see CandidateTest.
struct CandidateChoice {
  Spheres spheres;
  Real margin;
  LawReach reach;
  StepCounts *counts;
  int *n_springs;
  const SpringsView *last;    // the springs of the last step; null: there are no contacts to close
  std::uint32_t mesh;
};

template <class B>
class CandidateSelector {
 public:
  const int *data() const { return candidates_.data(); }

  // Finds the spheres that could touch the mesh after moving by up to the margin: by the mesh's cells and, if cells list all
  // features within the cutoff, by these features. Kernels put the number of candidates into the counts.
  void choose(B &b, const EngineMesh<B> &mesh, const CandidateChoice &choice)
  {
    candidates_.reserve(choice.spheres.n);
    if (excess_margin(mesh.grid.view, choice.margin) > 0)
      choice.last ? select<true, true>(b, mesh, choice) : select<true, false>(b, mesh, choice);
    else
      choice.last ? select<false, true>(b, mesh, choice) : select<false, false>(b, mesh, choice);
  }

  std::size_t bytes() const { return candidates_.size() * sizeof(int) + selection_.bytes(); }

 private:
  using Array = typename B::template Array<int>;

  template <bool kPast, bool kCloses>
  void select(B &b, const EngineMesh<B> &mesh, const CandidateChoice &choice)
  {
    const GridView &grid = mesh.grid.view;
    const Real past = excess_margin(grid, choice.margin);
    CandidateTest<kPast, kCloses> test = {
        grid,           mesh.grid.table,  BrickFilter<Real>(grid),
        choice.spheres, mesh.pose,        choice.margin,
        past,           choice.reach,     grid.list_kind.is_complete(),
        choice.counts,  choice.n_springs, choice.last ? *choice.last : SpringsView(),
        choice.mesh};
    test.fixed_margin = test.filter.margin(past * grid.inv_length / kBrickSide);
    selection_.run(b, choice.spheres.n, test, candidates_.data(), &choice.counts->n_candidates);
  }

  Array candidates_;
  Selection<B> selection_;
};

// `counts`: one StepCounts in the memory of kernels. A StepCounts that is returned is a copy of it.
template <class B>
class BroadPhase {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  explicit BroadPhase(const EngineSettings &settings) :
      reach_(longest_reach(settings.laws)), uses_slots_(lsdcd::uses_slots(settings)),
      laws_(settings.laws), meshes_(settings.meshes)
  {
  }

  void set_grid(B &b, const GridView &grid, int mesh)
  {
    meshes_.at(mesh).grid = GridOn<B>(b, grid);
    n_ = 0;
  }
  // Sets other lists for the same wall, which are in the caller's memory, on this backend.
  void set_lists(B &b, const GridView &grid, int mesh)
  {
    meshes_.at(mesh).grid.set_lists(b, grid);
    n_ = 0;
  }
  void place(const Pose &pose, int mesh) { meshes_.at(mesh).pose = pose; }

  bool uses_slots() const { return uses_slots_; }    // more than one mesh, or kind of spheres
  int n_meshes() const { return static_cast<int>(meshes_.size()); }
  const EngineMesh<B> &mesh(int m) const { return meshes_[m]; }

  // Searches for candidates among spheres in memory of the backend, and makes their lists. With one mesh `n_springs` of all
  // other spheres becomes 0. `last`: the springs of the last step, whose contacts are closed; or null. If a sphere is too
  // large, the returned counts have too_large set, and nothing else is valid.
  StepCounts choose(B &b, const Spheres &spheres, Real margin, Array<StepCounts> &counts,
                    int *n_springs, const SpringsView *last)
  {
    if (uses_slots()) return choose_slots(b, spheres, margin, counts, last);
    const GridView &grid = meshes_[0].grid.view;
    CandidateSpheres candidates = {spheres.x, spheres.radius, reach_, nullptr, 0};
    selector_.choose(b, meshes_[0], {spheres, margin, reach_, counts.data(), n_springs, last, 0});
    b.copy_out(counts.data(), counts_on_cpu_.data(), 1);
    counted_.record(b);
    // The lists are started before the CPU knows how many candidates there are, so that a GPU need not wait.
    candidates.index = selector_.data();
    const std::size_t early =
        lists_.make_early(b, grid, meshes_[0].pose, candidates, margin, counts.data());
    counted_.wait();
    const StepCounts seen = *counts_on_cpu_.data();
    if (seen.too_large) return seen;
    n_ = candidates.n = seen.n_candidates;
    lists_.make(b, grid, meshes_[0].pose, candidates, margin, counts.data(), early);
    return seen;
  }
  std::size_t n() const { return n_; }    // candidates, or candidate-mesh pairs (slots)
  const int *candidates() const { return uses_slots() ? slots_.sphere() : selector_.data(); }
  // Returns, for each candidate, whether it seems to touch more than one feature now. Null: not known.
  const char *seem_multi_contact() const { return uses_slots() ? nullptr : lists_.multi_contact(); }
  const FeatureLists &lists() const { return lists_.view(); }
  const CandidateSlots<B> &slots() const { return slots_; }

  // Returns the kind of each of these spheres, which says which laws it has.
  SphereKinds kinds_of(B &b, const Spheres &spheres)
  {
    if (laws_.kinds == 1) return {};
    if (!spheres.type && spheres.n > 0)
      throw std::logic_error("laws by type need the types of spheres");
    return {spheres.type, put_kinds(b), static_cast<int>(laws_.kind_of_type.size()) - 1};
  }
  int n_kinds() const { return laws_.kinds; }

  // Stores positions for has_moved(); see DisplacementCheck.
  void store_positions(B &b, const Spheres &spheres, Real margin)
  {
    displacement_.store(b, spheres, meshes_, margin);
  }
  bool has_moved(B &b, const Spheres &spheres)
  {
    return displacement_.has_moved(b, spheres, meshes_);
  }

  std::size_t bytes() const
  {
    std::size_t bytes = selector_.bytes() + slots_.bytes() + lists_.bytes() +
                        displacement_.bytes() + posed_.size() * sizeof(PosedGrid) +
                        kind_of_type_.size() * sizeof(int);
    for (const EngineMesh<B> &mesh : meshes_) bytes += mesh.grid.bytes();
    return bytes;
  }

 private:
  // The following functions do not wait.
  const int *put_kinds(B &b)
  {
    const std::size_t n = laws_.kind_of_type.size();
    if (kind_of_type_.size() == n) return kind_of_type_.data();
    kind_of_type_ = Array<int>(n);
    int *to = kind_of_type_.data();
    for (const int kind : laws_.kind_of_type) put_one(b, to++, kind);
    return kind_of_type_.data();
  }
  const PosedGrid *put_grids(B &b)
  {
    if (posed_.size() < meshes_.size()) posed_ = Array<PosedGrid>(meshes_.size());
    PosedGrid *to = posed_.data();
    for (const EngineMesh<B> &mesh : meshes_)
      put_one(b, to++, PosedGrid{mesh.grid.view, mesh.pose});
    return posed_.data();
  }

  StepCounts choose_slots(B &b, const Spheres &spheres, Real margin, Array<StepCounts> &counts,
                          const SpringsView *last)
  {
    StepCounts seen = {};
    slots_.clear(b, spheres.n);
    std::uint32_t number = 0;
    for (const EngineMesh<B> &mesh : meshes_) {
      selector_.choose(b, mesh, {spheres, margin, reach_, counts.data(), nullptr, last, number++});
      seen = read_one(b, counts.data());
      if (seen.too_large) return seen;
      slots_.add(b, selector_.data(), seen.n_candidates);
    }
    slots_.finish(b, kinds_of(b, spheres), n_kinds());
    n_ = slots_.n_slots();
    const PosedGrid *grids = put_grids(b);
    bool large = false;
    for (const EngineMesh<B> &mesh : meshes_) large |= mesh.grid.view.is_large;
    lists_.make(b, meshes_[0].grid.view, large, grids, slots_.mesh(),
                {spheres.x, spheres.radius, reach_, slots_.sphere(), n_}, margin, counts.data());
    return seen;
  }

  LawReach reach_;
  bool uses_slots_;
  LawTable laws_;
  Array<int> kind_of_type_;
  std::vector<EngineMesh<B>> meshes_;
  CandidateSelector<B> selector_;
  CandidateSlots<B> slots_;
  FeatureListStore<B> lists_;
  Array<PosedGrid> posed_;
  std::size_t n_ = 0;
  typename B::template CpuArray<StepCounts> counts_on_cpu_ =
      typename B::template CpuArray<StepCounts>(1);
  typename B::Event counted_;    // the counts are in counts_on_cpu_
  DisplacementCheck<B> displacement_;
};

}    // namespace lsdcd
