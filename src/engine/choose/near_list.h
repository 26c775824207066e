// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Choosing the spheres that could be near a mesh: the broad phase.
#pragma once

#include "backend/backend.h"
#include "engine/choose/engine_mesh.h"
#include "engine/choose/near_choice.h"
#include "engine/choose/selection.h"

#include <vector>

namespace lsdcd {

template <class B>
class NearList {
 public:
  const int *data() const { return near_.data(); }

  // The spheres that could touch the mesh after a way of up to `margin`, by its cells or, with
  // `by_features`, by what these list. Into `counts`, where the kernels run, goes how many there are,
  // once had_room() agrees. `n_springs`: of each sphere, or null; those of spheres that are far are
  // forgotten.
  void choose(B &b, const EngineMesh<B> &mesh, const Spheres &spheres, Real margin, Real pull_off,
              bool by_features, StepCounts *counts, int *n_springs)
  {
    const std::size_t n = spheres.n;
    if (near_.size() < n) near_ = Array(n + n / 8);
    if (excess_margin(mesh.grid.view, margin) > 0)
      select<true>(b, mesh, spheres, margin, pull_off, by_features, counts, n_springs);
    else
      select<false>(b, mesh, spheres, margin, pull_off, by_features, counts, n_springs);
  }
  // Of the above, given what it counted. False: choose again.
  bool had_room(B &b, const StepCounts &seen) { return selection_.had_room(b, seen.n_near); }

  std::vector<int> to_host(B &b, std::size_t n) { return lsdcd::to_host(b, near_, n); }
  std::size_t bytes() const { return near_.size() * sizeof(int) + selection_.bytes(); }

 private:
  using Array = typename B::template Array<int>;

  template <bool kPast>
  void select(B &b, const EngineMesh<B> &mesh, const Spheres &spheres, Real margin, Real pull_off,
              bool by_features, StepCounts *counts, int *n_springs)
  {
    const GridView &grid = mesh.grid.view;
    const Real past = excess_margin(grid, margin);
    NearChoice<kPast> choice = {grid,    mesh.grid.table, BrickFilter<Real>(grid),
                                spheres, mesh.pose,       margin,
                                past,    pull_off,        by_features,
                                counts,  n_springs};
    choice.fixed_margin = choice.filter.margin(past * grid.inv_length / kBrickSide);
    selection_.start(b, spheres.n, choice, near_.data(), &counts->n_near);
  }

  Array near_;
  Selection<B> selection_;
};

}    // namespace lsdcd
