// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The grid of a mesh whose nodes move, in the memory of a backend: built by CellTest::bounds, from where its records are.
#pragma once

#include "base/input_error.h"
#include "grid/build/fill_lists.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace lsdcd {

struct MovingGridSettings {
  Real cutoff;           // of spheres' centres (length, > 0)
  Real allowance;        // how far nodes may go until it is built again (length)
  Real outside;          // as in GridView
  Box bounds;            // of the nodes
  std::string source;    // the name of the mesh, for messages
};

// Primitives, in the memory of a backend.
struct PrimitiveList {
  const FeatureCode *code;
  std::size_t n;
};

template <class B>
class MovingGrid {
  template <class T>
  using Scratch = typename B::template Scratch<T>;

 public:
  // `wall`: the records of the mesh, which `b` has made. Throws InputError where the mesh spans more cells than can be
  // numbered; the grid is then as it was.
  void build(B &b, const MeshFeaturesView &wall, const PrimitiveList &primitives,
             const MovingGridSettings &settings)
  {
    b.wait();
    BuildView view = {wall, primitives.code, CellTest::bounds, {}};
    view.plan = plan(view, primitives.n, settings);
    const ProgressListener nobody;
    const BuildProgress progress(nobody);
    OctantPairs<B> pairs;
    BuiltLists<B> lists;
    ListReport report;
    bool fits = sort_into_octants(builder_, view, primitives.n, progress, pairs);
    if (fits) {
      Scratch<std::uint64_t> met(pairs.n);
      find_cells_met(builder_, view, pairs, progress, met.data());
      fits = fill_lists(builder_, view, pairs, met.data(), kNoLimitOfEntries, kNoBudget, progress,
                        lists, report);
    }
    if (!fits)
      throw InputError("the nodes of '" + settings.source +
                       "' lie so close that the entries of cells cannot be numbered: use a "
                       "coarser mesh");
    builder_.wait();
    plan_ = view.plan;
    outside_ = settings.outside;
    std::swap(lists_, lists);
  }

  // `wall`: the records of the mesh in the memory of the backend.
  GridView view(const MeshFeaturesView &wall) const
  {
    GridView v = {};
    v.wall = wall;
    v.origin = plan_.origin;
    v.length = plan_.length;
    v.inv_length = 1 / plan_.length;
    v.cutoff = plan_.cutoff;
    v.tolerance = plan_.tolerance;
    v.outside = outside_;
    for (int d = 0; d < 3; d++) v.n_bricks[d] = plan_.n_bricks[d];
    v.list_kind = ListKind::every();
    v.lists.brick_of = lists_.brick_of.data();
    v.lists.bricks = lists_.bricks.data();
    v.lists.cells = lists_.cells.data();
    v.lists.entries = lists_.entries.data();
    return v;
  }
  const BuiltLists<B> &lists() const { return lists_; }

  std::size_t bytes() const
  {
    return grid_bytes(plan_, lists_.n_bricks, lists_.n_cells, lists_.n_entries) +
           builder_.scratch_bytes();
  }

  // The steps of the above. Public because nvcc takes no device lambda from a private function.

  // Cells are twice as long as they reach, which keeps builds short and lists too, or longer where the mesh has large
  // triangles or is large: lists and tables stay of the size of the mesh.
  GridPlan plan(const BuildView &of, std::size_t n_primitives, const MovingGridSettings &settings)
  {
    const Box &box = settings.bounds;
    const Real diagonal = norm(box.hi - box.lo);
    if (!std::isfinite(diagonal))
      throw InputError("nodes of '" + settings.source + "' have positions that are not finite");
    GridPlan plan = {};
    plan.cutoff = settings.cutoff;
    plan.margin = settings.allowance;
    plan.tolerance = list_tolerance(plan.cutoff, diagonal);
    constexpr double kMostCells = 48;    // that a primitive reaches, in the mean
    const auto n = static_cast<double>(n_primitives);
    for (plan.length = 2 * (plan.cutoff + plan.margin);; plan.length *= 2) {
      const Real pad = reach_of_moving(plan) + Real(0.01) * plan.length;
      plan.origin = box.lo - Vec3{pad, pad, pad};
      double table = 1;
      for (int d = 0; d < 3; d++) {
        const double bricks =
            std::ceil((box.hi[d] + pad - plan.origin[d]) / (kBrickSide * plan.length));
        table *= bricks;
        plan.n_bricks[d] = static_cast<std::int32_t>(std::clamp(bricks, 1., 1e6));
      }
      if (table <= std::min(1e5 + 16 * n, kMostBricks) &&
          double(n_cells_reached(of, plan, n_primitives)) <= 1e5 + kMostCells * n)
        return plan;
    }
  }

  // Whole cells of each primitive, so that their sum does not depend on the order.
  std::uint64_t n_cells_reached(const BuildView &of, const GridPlan &plan, std::size_t n)
  {
    Scratch<std::uint64_t> reached(n);
    std::uint64_t *to = reached.data();
    const Real reach = reach_of_moving(plan), length = plan.length;
    builder_.for_each(n, [=] LSDCD_LAMBDA(std::size_t p) {
      Vec3 lo, hi;
      feature_box(of.wall, of.features[p], lo, hi);
      Real cells = 1;
      for (int d = 0; d < 3; d++) cells *= (hi[d] - lo[d] + 2 * reach) / length + 1;
      to[p] = static_cast<std::uint64_t>(cells);
    });
    return builder_.exclusive_scan(to, n);
  }

 private:
  static constexpr std::uint32_t kNoLimitOfEntries = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t kNoBudget = std::numeric_limits<std::size_t>::max();

  // On the default stream of a GPU, in whose order scratch memory comes and goes.
  B builder_;
  GridPlan plan_ = {};
  Real outside_ = 1;
  BuiltLists<B> lists_;
};

}    // namespace lsdcd
