// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The neighbour lists of candidate spheres, which hold features, in the memory of the engine's backend.
#pragma once

#include "backend/atomic.h"
#include "backend/backend.h"
#include "engine/broad_phase/candidate_test.h"
#include "engine/results/step_counts.h"

#include <algorithm>

namespace lsdcd {

// Marks candidate-mesh pair k as having no list yet, if the nodes of its mesh move: such lists are made in
// steps (nodes/node_list.h).
struct LeaveOut {
  const PosedGrid *meshes;
  const int *mesh;
  float *lengths;

  LSDCD_FN void operator()(std::size_t k) const
  {
    if (!meshes || meshes[mesh[k]].grid.list_kind.is_every()) lengths[k] = -1;
  }
};

// Makes the list of candidate k.
struct GatherWork {
  GridView grid;
  Pose pose;
  CandidateSpheres spheres;
  Real margin;
  FeatureLists lists;
  char *multi_contact;    // does each seem to touch more than one feature now? Null: not asked for
  StepCounts *counts;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t k) const
  {
    spheres.prefetch_ahead(grid, pose, k);
    const QuerySphere s = spheres.in_frame_of(pose, k);
    FeatureList made;
    gather(warp, mine, grid, s, margin, made);
    if (!mine) return;
    if (multi_contact) multi_contact[k] = touches_more_than_one(grid, s, made);
    lists.put(k, made, grid.wall);
    count_one(&counts->lists);
    add_to(&counts->listed, made.n);
  }
};

// Makes the list of candidate-mesh pair k, for more than one mesh.
struct GatherSlotWork {
  const PosedGrid *meshes;
  const int *mesh;    // of each candidate-mesh pair
  CandidateSpheres spheres;
  Real margin;
  FeatureLists lists;
  StepCounts *counts;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t k) const
  {
    for_each_distinct(warp, mine, mesh[k], [&](bool of_mesh, int m) {
      const PosedGrid &of = meshes[m];
      if (of.grid.list_kind.has_primitives()) return;    // see LeaveOut
      const GatherWork work = {of.grid, of.pose, spheres, margin, lists, nullptr, counts};
      work(warp, of_mesh, k);
    });
  }
};

template <class B>
class FeatureListStore {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // Returns the lists; none if the lists of cells hold the nearest primitives.
  const FeatureLists &view() const { return lists_; }

  // Makes the lists of candidates, which will not move farther than `margin` before the next candidate
  // search. On a GPU the kernel starts before the CPU knows counts->n_candidates, for as many lists as
  // there is memory for. Returns that number; 0 on a CPU.
  std::size_t make_early(B &b, const GridView &grid, const Pose &pose,
                         const CandidateSpheres &spheres, Real margin, StepCounts *counts)
  {
    if (B::kOnCpu || grid.list_kind.has_primitives()) return 0;
    const std::size_t room = std::min(multi_contact_.size(), ints_.size() / FeatureLists::kInts);
    set_view(grid);
    b.for_each_in_warps(room, gather_work(grid, pose, spheres, margin, counts),
                        &counts->n_candidates);
    return room;
  }
  // Makes the lists of spheres.n candidates, except the first `early`, which already have them.
  void make(B &b, const GridView &grid, const Pose &pose, const CandidateSpheres &spheres,
            Real margin, StepCounts *counts, std::size_t early)
  {
    const std::size_t n = spheres.n;
    if (!reserve(grid, grid.is_large, n) || n <= early) return;
    if (grid.list_kind.is_every()) return leave_out(b, n, nullptr, nullptr);
    if (!B::kOnCpu) multi_contact_.reserve(n);
    b.for_each_in_warps(n, gather_work(grid, pose, spheres, margin, counts));
  }
  // Makes the lists of n candidate-mesh pairs of more than one mesh. `large`: any of the meshes is large.
  void make(B &b, const GridView &first_grid, bool large, const PosedGrid *meshes, const int *mesh,
            const CandidateSpheres &spheres, Real margin, StepCounts *counts)
  {
    if (!reserve(first_grid, large, spheres.n)) return;
    b.for_each_in_warps(spheres.n, GatherSlotWork{meshes, mesh, spheres, margin, lists_, counts});
    leave_out(b, spheres.n, meshes, mesh);
  }

  // Returns, for each candidate of one mesh, whether it seems to touch more than one feature now. Steps on
  // a GPU begin with these. Null: not known.
  const char *multi_contact() const { return lists_.n ? multi_contact_.data() : nullptr; }

  std::size_t bytes() const
  {
    return multi_contact_.size() + reals_.size() * sizeof(Real) +
           ints_.size() * sizeof(std::int32_t) + copy_ranges_.size() * sizeof(RecordCopies::Range) +
           used_ * sizeof(FeatureRecord);
  }

 private:
  // Marks n candidate-mesh pairs as having no list yet, if nodes of their mesh move. `meshes` null: all of
  // them are of one mesh.
  void leave_out(B &b, std::size_t n, const PosedGrid *meshes, const int *mesh)
  {
    b.for_each(n, LeaveOut{meshes, mesh, lists_.lengths});
  }

  GatherWork gather_work(const GridView &grid, const Pose &pose, const CandidateSpheres &spheres,
                         Real margin, StepCounts *counts)
  {
    return {grid, pose, spheres, margin, lists_, multi_contact_.data(), counts};
  }

  void set_view(const GridView &grid)
  {
    lists_ = FeatureLists::of(reals_.data(), ints_.data(), ints_.size() / FeatureLists::kInts,
                              grid.length);
  }

  // Reserves memory for n lists. `large`: the records of the wall are read faster as copies. Returns false
  // if there are no lists to make.
  bool reserve(const GridView &grid, bool large, std::size_t n)
  {
    lists_ = FeatureLists();
    // Meshes whose nodes move have lists of the kind `every`.
    if ((grid.list_kind.has_primitives() && !grid.list_kind.is_every()) || n == 0) return false;
    if (ints_.size() < n * FeatureLists::kInts) {
      const std::size_t room = with_spare(n);
      reals_ = Array<Real>(room * FeatureLists::kReals);
      ints_ = Array<std::int32_t>(room * FeatureLists::kInts);
    }
    set_view(grid);
    if (B::kOnCpu && large) reserve_copies(n);
    return true;
  }

  // Reserves memory for the copies of n lists. Pages that are never written take no memory.
  void reserve_copies(std::size_t n)
  {
    if (copy_ranges_.size() < n) {
      copy_ranges_.reserve(n);
      records_ = Array<FeatureRecord>(kCopies * copy_ranges_.size());
    }
    std::fill_n(copy_ranges_.data(), n, RecordCopies::Range());
    used_ = 0;
    const std::size_t room = std::min<std::size_t>(records_.size(), 1u << 30);
    lists_.copies = {records_.data(), copy_ranges_.data(), &used_, static_cast<int>(room)};
  }

  static constexpr int kCopies = 4;    // for each list, on average; lists have 1 to 4 features

  FeatureLists lists_;
  Array<Real> reals_;
  Array<std::int32_t> ints_;
  Array<char> multi_contact_;       // not on a CPU
  Array<FeatureRecord> records_;    // on a CPU
  Array<RecordCopies::Range> copy_ranges_;
  int used_ = 0;
};

}    // namespace lsdcd
