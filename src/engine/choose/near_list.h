// Choosing the spheres that could be near the wall: the broad phase.
#pragma once

#include "engine/choose/near_choice.h"

#include <vector>

namespace lsdcd {

template <class B>
class NearList {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  const int *data() const { return near_.data(); }

  // Into `counts`, where the kernels run, goes how many there are. `n_springs`: of each sphere, or
  // null; those of spheres that are far are forgotten.
  void choose(B &b, const GridView &grid, const BrickTable &table, const Spheres &spheres,
              Real margin, Real pull_off, StepCounts *counts, int *n_springs)
  {
    const std::size_t n = spheres.n;
    if (near_.size() < n) near_ = Array<int>(n + n / 8);
    if (margin > 0)
      select<true>(b, grid, table, spheres, margin, pull_off, counts, n_springs);
    else
      select<false>(b, grid, table, spheres, margin, pull_off, counts, n_springs);
  }

  std::vector<int> to_host(B &b, std::size_t n) { return b.to_host(near_, n); }
  std::size_t bytes() const { return near_.size() * sizeof(int); }

 private:
  template <bool kMoves>
  void select(B &b, const GridView &grid, const BrickTable &table, const Spheres &spheres,
              Real margin, Real pull_off, StepCounts *counts, int *n_springs)
  {
    const NearChoice<kMoves> choice = {grid,   table,    BrickFilter<Real>(grid), spheres,
                                       margin, pull_off, counts,                  n_springs};
    b.select(spheres.n, choice, room_, near_.data(), &counts->n_near);
  }

  Array<int> near_;
  typename B::SelectRoom room_;
};

}    // namespace lsdcd
