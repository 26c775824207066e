// Choosing the spheres that could be near the wall: the broad phase.
#pragma once

#include "engine/choose/near_choice.h"

#include <utility>
#include <vector>

namespace lsdcd {

// Can near sphere k touch anything after a way of up to the margin?
struct PruneWork {
  GridView grid;
  WallPose pose;
  SpheresAtChoice spheres;
  Real margin;
  char *flags;       // the answers
  int *n_springs;    // of each sphere, or null; those of spheres that cannot are forgotten

  template <class Group>
  LSDCD_FN void operator()(const Group &group, bool mine, std::size_t k) const
  {
    spheres.ask_ahead(grid, pose, k);
    const bool touches = can_touch(group, mine, grid, spheres.seen_from(pose, k), margin);
    if (!mine) return;
    flags[k] = touches;
    if (!touches && n_springs) n_springs[spheres.near[k]] = 0;
  }
};

template <class B>
class NearList {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  const int *data() const { return near_.data(); }

  // Into `counts`, where the kernels run, goes how many there are. `n_springs`: of each sphere, or
  // null; those of spheres that are far are forgotten.
  void choose(B &b, const GridView &grid, const BrickTable &table, const Spheres &spheres,
              const WallPose &pose, Real margin, Real pull_off, StepCounts *counts, int *n_springs)
  {
    const std::size_t n = spheres.n;
    if (near_.size() < n) near_ = Array<int>(n + n / 8);
    const Real past = past_lists(grid, margin);
    if (past > 0)
      select<true>(b, grid, table, spheres, pose, past, pull_off, counts, n_springs);
    else
      select<false>(b, grid, table, spheres, pose, past, pull_off, counts, n_springs);
  }

  // Takes all n spheres for near.
  void choose_all(B &b, std::size_t n)
  {
    if (near_.size() < n) near_ = Array<int>(n + n / 8);
    int *near = near_.data();
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) { near[k] = static_cast<int>(k); });
  }

  // Of the n spheres that were chosen leaves those that can touch something after a way of up to
  // `margin`. How many are left goes into `counts`.
  void prune(B &b, const GridView &grid, const Spheres &spheres, const WallPose &pose,
             std::size_t n, Real margin, Real pull_off, StepCounts *counts, int *n_springs)
  {
    if (flags_.size() < n) flags_ = Array<char>(n + n / 8);
    if (other_.size() < near_.size()) other_ = Array<int>(near_.size());
    char *flags = flags_.data();
    const int *near = near_.data();
    const SpheresAtChoice at_choice = {spheres.x, spheres.radius, pull_off, near, n};
    b.for_each_together(n, PruneWork{grid, pose, at_choice, margin, flags, n_springs});
    b.keep(n, near, flags, room_, other_.data(), &counts->n_near);
    std::swap(near_, other_);
  }

  std::vector<int> to_host(B &b, std::size_t n) { return b.to_host(near_, n); }
  std::size_t bytes() const { return (near_.size() + other_.size()) * sizeof(int) + flags_.size(); }

 private:
  template <bool kMoves>
  void select(B &b, const GridView &grid, const BrickTable &table, const Spheres &spheres,
              const WallPose &pose, Real margin, Real pull_off, StepCounts *counts, int *n_springs)
  {
    NearChoice<kMoves> choice = {
        grid, table, BrickFilter<Real>(grid), spheres, pose, margin, pull_off, counts, n_springs};
    choice.fixed_margin = choice.filter.margin(margin * grid.inv_length / kBrickSide);
    b.select(spheres.n, choice, room_, near_.data(), &counts->n_near);
  }

  Array<int> near_, other_;
  Array<char> flags_;
  typename B::SelectScratch room_;
};

}    // namespace lsdcd
