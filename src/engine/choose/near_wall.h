// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The meshes of a wall, the spheres that a choice finds near them, and their lists of the wall.
#pragma once

#include "engine/choose/kept_centres.h"
#include "engine/choose/list_store.h"
#include "engine/choose/near_list.h"
#include "engine/choose/near_meshes.h"

#include <numeric>
#include <stdexcept>
#include <vector>

namespace lsdcd {

// `counts` in what follows: where kernels count, one StepCounts. What is returned has been read there.
template <class B>
class NearWall {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  explicit NearWall(const EngineSettings &settings) :
      pull_off_(largest_pull_off(settings.laws)), has_several_(lsdcd::has_several(settings)),
      laws_(settings.laws), meshes_(settings.meshes)
  {
  }

  void set_grid(B &b, const GridView &grid, int mesh)
  {
    meshes_.at(mesh).grid = GridOn<B>(b, grid);
    n_ = 0;
  }
  void place(const Pose &pose, int mesh) { meshes_.at(mesh).pose = pose; }

  bool has_several() const { return has_several_; }    // meshes, or kinds of spheres
  int n_meshes() const { return static_cast<int>(meshes_.size()); }
  const EngineMesh<B> &mesh(int m) const { return meshes_[m]; }

  // Chooses among spheres in memory of the backend. `n_springs` of those that are far from the one mesh
  // becomes 0. A sphere that is too large is in what is returned, and nothing else is valid then.
  // `alone`: near spheres will be alone in steps, one after the other, and near() of one mesh is null.
  StepCounts choose(B &b, const Spheres &spheres, Real margin, Array<StepCounts> &counts,
                    int *n_springs, bool alone = false)
  {
    are_alone_ = alone && !has_several();
    if (has_several()) return choose_slots(b, spheres, margin, counts);
    const GridView &grid = meshes_[0].grid.view;
    SpheresAtChoice at_choice = {spheres.x, spheres.radius, pull_off_, nullptr, 0};
    StepCounts seen;
    std::size_t early = 0;
    do {
      start_choice(b, meshes_[0], spheres, margin, counts, n_springs);
      b.copy_out(counts.data(), seen_.data(), 1);
      counted_.record(b);
      // A GPU need not wait until the host knows how many there are.
      at_choice.near = near_.data();
      early = lists_.make_early(b, grid, meshes_[0].pose, at_choice, margin, counts.data());
      counted_.wait();
      seen = *seen_.data();
    } while (!seen.too_large && !near_.had_room(b, seen));
    if (seen.too_large) return seen;
    n_ = at_choice.n = seen.n_near;
    lists_.make(b, grid, meshes_[0].pose, at_choice, margin, counts.data(), early);
    return seen;
  }
  // Of spheres that are alone, which are near.
  std::vector<int> chosen(B &b, int n_spheres)
  {
    if (!has_several()) return near_.to_host(b, n_);
    std::vector<int> all(n_spheres);
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  std::size_t n() const { return n_; }    // near spheres, or slots of several meshes
  const int *near() const
  {
    return has_several() ? slots_.near() : are_alone_ ? nullptr : near_.data();
  }
  // Of each, does it seem to touch several features now? Null: not known.
  const char *seem_several() const { return has_several() ? nullptr : lists_.several(); }
  const WallLists &lists() const { return lists_.view(); }
  const NearMeshes<B> &slots() const { return slots_; }

  // Which law each of these spheres has.
  SphereKinds kinds_of(B &b, const Spheres &spheres)
  {
    if (laws_.kinds == 1) return {};
    if (!spheres.type && spheres.n > 0)
      throw std::logic_error("laws by atom type need the types of spheres");
    return {spheres.type, put_kinds(b), static_cast<int>(laws_.kind_of_type.size()) - 1};
  }
  int n_kinds() const { return laws_.kinds; }

  // Public because nvcc takes no device lambda from a private function. These do not wait.
  const int *put_kinds(B &b)
  {
    const std::size_t n = laws_.kind_of_type.size();
    if (kind_of_type_.size() == n) return kind_of_type_.data();
    kind_of_type_ = Array<int>(n);
    int *to = kind_of_type_.data();
    for (const int kind : laws_.kind_of_type) {
      b.for_each(1, [=] LSDCD_LAMBDA(std::size_t) { *to = kind; });
      to++;
    }
    return kind_of_type_.data();
  }
  const PlacedGrid *put_grids(B &b)
  {
    if (placed_.size() < meshes_.size()) placed_ = Array<PlacedGrid>(meshes_.size());
    PlacedGrid *to = placed_.data();
    for (int m = 0; m < n_meshes(); m++, to++) {
      const PlacedGrid placed = {meshes_[m].grid.view, meshes_[m].pose};
      b.for_each(1, [=] LSDCD_LAMBDA(std::size_t) { *to = placed; });
    }
    return placed_.data();
  }

  // See KeptCentres.
  void keep_centres(B &b, const Spheres &spheres, Real margin)
  {
    centres_.keep(b, spheres, meshes_, margin);
  }
  bool has_moved(B &b, const Spheres &spheres) { return centres_.has_moved(b, spheres, meshes_); }

  std::size_t bytes() const
  {
    std::size_t bytes = near_.bytes() + slots_.bytes() + lists_.bytes() + centres_.bytes() +
                        placed_.size() * sizeof(PlacedGrid) + kind_of_type_.size() * sizeof(int);
    for (const EngineMesh<B> &mesh : meshes_) bytes += mesh.grid.bytes();
    return bytes;
  }

 private:
  // By features, where these are listed with bounds on all that is near.
  void start_choice(B &b, const EngineMesh<B> &mesh, const Spheres &spheres, Real margin,
                    Array<StepCounts> &counts, int *n_springs)
  {
    near_.choose(b, mesh, spheres, margin, pull_off_, mesh.grid.view.nearest == 0, counts.data(),
                 n_springs);
  }

  StepCounts choose_slots(B &b, const Spheres &spheres, Real margin, Array<StepCounts> &counts)
  {
    StepCounts seen = {};
    slots_.clear(b, spheres.n);
    for (const EngineMesh<B> &mesh : meshes_) {
      do {
        start_choice(b, mesh, spheres, margin, counts, nullptr);
        seen = read_one(b, counts.data());
      } while (!seen.too_large && !near_.had_room(b, seen));
      if (seen.too_large) return seen;
      slots_.add(b, near_.data(), seen.n_near);
    }
    slots_.finish(b, kinds_of(b, spheres), n_kinds());
    n_ = slots_.n_slots();
    const PlacedGrid *grids = put_grids(b);
    bool large = false;
    for (const EngineMesh<B> &mesh : meshes_) large |= mesh.grid.view.is_large;
    lists_.make(b, meshes_[0].grid.view, large, grids, slots_.mesh(),
                {spheres.x, spheres.radius, pull_off_, slots_.near(), n_}, margin, counts.data());
    return seen;
  }

  Real pull_off_;
  bool has_several_;
  LawTable laws_;
  Array<int> kind_of_type_;
  std::vector<EngineMesh<B>> meshes_;
  NearList<B> near_;
  NearMeshes<B> slots_;
  ListStore<B> lists_;
  Array<PlacedGrid> placed_;
  bool are_alone_ = false;
  std::size_t n_ = 0;
  typename B::template HostArray<StepCounts> seen_ = typename B::template HostArray<StepCounts>(1);
  typename B::Event counted_;    // once they are in seen_
  KeptCentres<B> centres_;
};

}    // namespace lsdcd
