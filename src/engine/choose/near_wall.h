// The meshes of a wall, the spheres that a choice finds near them, and their lists of the wall.
#pragma once

#include "engine/choose/kept_centres.h"
#include "engine/choose/near_list.h"
#include "engine/choose/near_meshes.h"
#include "engine/narrow/list_store.h"

#include <numeric>
#include <vector>

namespace lsdcd {

// `counts` in what follows: where kernels count, one StepCounts. What is returned has been read there.
template <class B>
class NearWall {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  explicit NearWall(const EngineSettings &settings) :
      pull_off_(settings.law.pull_off()), meshes_(settings.meshes)
  {
  }

  void set_grid(B &b, const GridView &grid, int mesh)
  {
    meshes_.at(mesh).grid = GridOn<B>(b, grid);
    n_ = 0;
  }
  void place(const WallPose &pose, int mesh) { meshes_.at(mesh).pose = pose; }

  bool has_several() const { return meshes_.size() > 1; }
  int n_meshes() const { return static_cast<int>(meshes_.size()); }
  const EngineMesh<B> &mesh(int m) const { return meshes_[m]; }

  // Chooses among spheres in memory of the backend. `n_springs` of those that are far from the one mesh
  // becomes 0. A sphere that is too large is in what is returned, and nothing else is valid then.
  StepCounts choose(B &b, const Spheres &spheres, Real margin, Array<StepCounts> &counts,
                    int *n_springs)
  {
    all_near_ = false;
    if (has_several()) return choose_slots(b, spheres, margin, true, counts);
    const StepCounts seen = choose_by_cells(b, meshes_[0], spheres, margin, counts, n_springs);
    return seen.too_large ? seen : make_lists(b, spheres, seen, margin, counts, n_springs);
  }
  // All spheres are near by their cells, says the host, and will be alone in steps: near() is null.
  // With several meshes all stay.
  StepCounts choose_among(B &b, const Spheres &spheres, Real margin, Array<StepCounts> &counts)
  {
    all_near_ = !has_several();
    if (has_several()) return choose_slots(b, spheres, margin, false, counts);
    near_.choose_all(b, spheres.n);
    StepCounts seen = b.read_one(counts.data());
    seen.n_near = spheres.n;
    return make_lists(b, spheres, seen, margin, counts, nullptr);
  }
  // Of the latter, which are near.
  std::vector<int> chosen_among(B &b, int n_spheres)
  {
    if (!has_several()) return near_.to_host(b, n_);
    std::vector<int> all(n_spheres);
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  std::size_t n() const { return n_; }    // near spheres, or slots of several meshes
  const int *near() const
  {
    return has_several() ? slots_.near() : all_near_ ? nullptr : near_.data();
  }
  // Of each, does it seem to touch several features now? Null: not known.
  const char *seem_several() const { return has_several() ? nullptr : lists_.several(); }
  const WallLists &lists() const { return lists_.view(); }
  const NearMeshes<B> &slots() const { return slots_; }

  // What steps need of the meshes, to where they run, without waiting.
  const MeshWork *put_works(B &b, const EngineSettings &settings, const StepSettings &step)
  {
    if (works_.size() < meshes_.size()) works_ = Array<MeshWork>(meshes_.size());
    MeshWork *to = works_.data();
    for (int m = 0; m < n_meshes(); m++, to++) {
      const MeshWork work = meshes_[m].work(settings, step, m);
      b.for_each(1, [=] LSDCD_LAMBDA(std::size_t) { *to = work; });
    }
    return works_.data();
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
                        works_.size() * sizeof(MeshWork);
    for (const EngineMesh<B> &mesh : meshes_) bytes += mesh.grid.bytes();
    return bytes;
  }

 private:
  StepCounts choose_by_cells(B &b, const EngineMesh<B> &mesh, const Spheres &spheres, Real margin,
                             Array<StepCounts> &counts, int *n_springs)
  {
    near_.choose(b, mesh.grid.view, mesh.grid.table, spheres, mesh.pose, margin, pull_off_,
                 counts.data(), n_springs);
    return b.read_one(counts.data());
  }

  // Of the seen.n_near spheres that are near by their cells leaves those that can touch the mesh.
  StepCounts prune(B &b, const EngineMesh<B> &mesh, const Spheres &spheres, const StepCounts &seen,
                   Real margin, Array<StepCounts> &counts, int *n_springs)
  {
    if (mesh.grid.view.nearest > 0 || seen.n_near == 0) return seen;
    near_.prune(b, mesh.grid.view, spheres, mesh.pose, seen.n_near, margin, pull_off_,
                counts.data(), n_springs);
    return b.read_one(counts.data());
  }

  StepCounts make_lists(B &b, const Spheres &spheres, const StepCounts &by_cells, Real margin,
                        Array<StepCounts> &counts, int *n_springs)
  {
    const EngineMesh<B> &mesh = meshes_[0];
    const StepCounts seen = prune(b, mesh, spheres, by_cells, margin, counts, n_springs);
    n_ = seen.n_near;
    lists_.make(b, mesh.grid.view, mesh.pose, at_choice(spheres, near_.data()), n_, margin,
                counts.data());
    return seen;
  }

  StepCounts choose_slots(B &b, const Spheres &spheres, Real margin, bool by_cells,
                          Array<StepCounts> &counts)
  {
    StepCounts seen = {};
    slots_.clear(b, spheres.n);
    for (const EngineMesh<B> &mesh : meshes_) {
      if (by_cells) {
        seen = choose_by_cells(b, mesh, spheres, margin, counts, nullptr);
        if (seen.too_large) return seen;
      } else {
        near_.choose_all(b, spheres.n);
        seen = b.read_one(counts.data());
        seen.n_near = spheres.n;
      }
      seen = prune(b, mesh, spheres, seen, margin, counts, nullptr);
      slots_.add(b, near_.data(), seen.n_near);
    }
    slots_.finish(b);
    n_ = slots_.n_slots();
    const MeshWork *works = put_works(b, EngineSettings(), StepSettings());
    bool large = false;
    for (const EngineMesh<B> &mesh : meshes_) large |= mesh.grid.view.is_large;
    lists_.make(b, meshes_[0].grid.view, large, works, slots_.mesh(),
                at_choice(spheres, slots_.near()), n_, margin, counts.data());
    return seen;
  }

  SpheresAtChoice at_choice(const Spheres &spheres, const int *near) const
  {
    return {spheres.x, spheres.radius, pull_off_, near, n_};
  }

  Real pull_off_;
  std::vector<EngineMesh<B>> meshes_;
  NearList<B> near_;
  NearMeshes<B> slots_;
  ListStore<B> lists_;
  Array<MeshWork> works_;
  bool all_near_ = false;
  std::size_t n_ = 0;
  KeptCentres<B> centres_;
};

}    // namespace lsdcd
