// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Memory for the lists of the wall of near spheres, where the engine computes.
#pragma once

#include "backend/atomic.h"
#include "engine/choose/engine_mesh.h"
#include "engine/choose/spheres_at_choice.h"
#include "engine/results/step_counts.h"

#include <algorithm>

namespace lsdcd {

// Makes the list of near sphere k.
struct GatherWork {
  GridView grid;
  Pose pose;
  SpheresAtChoice spheres;
  Real margin;
  WallLists lists;
  char *several;    // does each seem to touch several features now? Null: not asked for
  StepCounts *counts;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t k) const
  {
    spheres.prefetch_ahead(grid, pose, k);
    const QuerySphere s = spheres.seen_from(pose, k);
    WallList made;
    gather(warp, mine, grid, s, margin, made);
    if (!mine) return;
    if (several) several[k] = touches_several(grid, s, made);
    lists.put(k, made, grid.wall);
    count_one(&counts->lists);
    add_to(&counts->listed, made.n);
  }
};

// The same for slots of several meshes.
struct GatherSlotWork {
  const PlacedGrid *meshes;
  const int *mesh;    // of each slot
  SpheresAtChoice spheres;
  Real margin;
  WallLists lists;
  StepCounts *counts;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t k) const
  {
    for_each_distinct(warp, mine, mesh[k], [&](bool of_mesh, int m) {
      const PlacedGrid &of = meshes[m];
      const GatherWork work = {of.grid, of.pose, spheres, margin, lists, nullptr, counts};
      work(warp, of_mesh, k);
    });
  }
};

template <class B>
class ListStore {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // None where lists of cells hold the nearest primitives.
  const WallLists &view() const { return lists_; }

  // Makes the lists of near spheres, which will not go farther than `margin` before the next choice.
  // Early, on a GPU: of the counts->n_near that there will be, if there is room for them. Returns the room.
  std::size_t make_early(B &b, const GridView &grid, const Pose &pose,
                         const SpheresAtChoice &spheres, Real margin, StepCounts *counts)
  {
    if (B::kOnHost || grid.nearest > 0) return 0;
    const std::size_t room = std::min(several_.size(), ints_.size() / WallLists::kInts);
    set_view(grid);
    b.for_each_in_warps(room, gather(grid, pose, spheres, margin, counts), &counts->n_near);
    return room;
  }
  // Of spheres.n, unless they are among the `early` that there was room for.
  void make(B &b, const GridView &grid, const Pose &pose, const SpheresAtChoice &spheres,
            Real margin, StepCounts *counts, std::size_t early)
  {
    const std::size_t n = spheres.n;
    if (!reserve(grid, grid.is_large, n) || n <= early) return;
    if (!B::kOnHost) several_ = Array<char>(n + n / 8);
    b.for_each_in_warps(n, gather(grid, pose, spheres, margin, counts));
  }
  // The same for n slots of several meshes; `large`: is any of them?
  void make(B &b, const GridView &first_grid, bool large, const PlacedGrid *meshes, const int *mesh,
            const SpheresAtChoice &spheres, Real margin, StepCounts *counts)
  {
    if (reserve(first_grid, large, spheres.n))
      b.for_each_in_warps(spheres.n, GatherSlotWork{meshes, mesh, spheres, margin, lists_, counts});
  }

  // Of each of the n of one mesh, does it seem to touch several features now? For steps on a GPU, which
  // begin with those; null: not known.
  const char *several() const { return lists_.n ? several_.data() : nullptr; }

  std::size_t bytes() const
  {
    return several_.size() + reals_.size() * sizeof(Real) + ints_.size() * sizeof(std::int32_t) +
           places_.size() * sizeof(RecordCopies::Place) + used_ * sizeof(FeatureRecord);
  }

 private:
  GatherWork gather(const GridView &grid, const Pose &pose, const SpheresAtChoice &spheres,
                    Real margin, StepCounts *counts)
  {
    return {grid, pose, spheres, margin, lists_, several_.data(), counts};
  }

  void set_view(const GridView &grid)
  {
    lists_ =
        WallLists::of(reals_.data(), ints_.data(), ints_.size() / WallLists::kInts, grid.length);
  }

  // `large`: a wall whose records are read faster as copies. False: there are no lists to make.
  bool reserve(const GridView &grid, bool large, std::size_t n)
  {
    lists_ = WallLists();
    if (grid.nearest > 0 || n == 0) return false;
    if (ints_.size() < n * WallLists::kInts) {
      const std::size_t room = n + n / 8;
      reals_ = Array<Real>(room * WallLists::kReals);
      ints_ = Array<std::int32_t>(room * WallLists::kInts);
    }
    set_view(grid);
    if (B::kOnHost && large && !grid.in_floats) reserve_copies(n);
    return true;
  }

  // What is not written takes no memory.
  void reserve_copies(std::size_t n)
  {
    if (places_.size() < n) {
      places_ = Array<RecordCopies::Place>(n + n / 8);
      records_ = Array<FeatureRecord>(kCopies * places_.size());
    }
    std::fill_n(places_.data(), n, RecordCopies::Place());
    used_ = 0;
    const std::size_t room = std::min<std::size_t>(records_.size(), 1u << 30);
    lists_.copies = {records_.data(), places_.data(), &used_, static_cast<int>(room)};
  }

  static constexpr int kCopies = 4;    // for each list, in the mean; lists have 1 to 4 features

  WallLists lists_;
  Array<Real> reals_;
  Array<std::int32_t> ints_;
  Array<char> several_;             // not on a host
  Array<FeatureRecord> records_;    // on a host
  Array<RecordCopies::Place> places_;
  int used_ = 0;
};

}    // namespace lsdcd
