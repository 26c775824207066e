// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Building the grid: octants -> cells -> lists, one source for every backend.
#pragma once

#include "base/array_list.h"
#include "base/give_back_memory.h"
#include "base/input_error.h"
#include "grid/build/estimate_lists.h"
#include "grid/build/fill_lists.h"
#include "grid/triangle_grid.h"
#include "mesh/meets_itself.h"

#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

namespace lsdcd {

template <class B>
class GridBuilder {
  template <class T>
  using Scratch = typename B::template Scratch<T>;

 public:
  // The wall and the listener for progress have to outlive the builder.
  GridBuilder(B backend, const MeshFeatures &wall, const ProgressListener &progress) :
      b_(std::move(backend)), progress_(progress)
  {
    view_.wall.faces = put(wall.faces);
    view_.wall.edges = put(wall.edges);
    view_.wall.vertices = put(wall.vertices);
    view_.wall.edge_inward = put(wall.edge_inward);
    view_.wall.vertex_direction = put(wall.vertex_direction);
    view_.wall.face_vertex = put(wall.face_vertex);
    view_.wall.edge_vertex = put(wall.edge_vertex);
    of_contact_ = put(wall.contact_features);
    of_primitives_ = put(wall.primitives);
    n_of_a_kind_ = std::max({wall.faces.size(), wall.edges.size(), wall.vertices.size()});
    n_contact_ = wall.contact_features.size();
    n_primitives_ = wall.primitives.size();
  }

  // Makes lists of the contact features or of primitives. Returns false,
  // with `lists` untouched, if they would not fit `budget` bytes. This is the preprocessing of the paper, its function (1),
  // the other way round: there each cell tries every triangle, here each feature finds its cells.
  bool build(const GridPlan &plan, const AnyGridSettings &settings, std::size_t budget,
             CellLists &lists, ListReport &report)
  {
    const ListKind list_kind = settings.list_kind();
    const auto start = std::chrono::steady_clock::now();
    view_.plan = plan;
    progress_.of(plan.length);
    view_.test = list_kind.has_primitives() ? CellTest::distances : CellTest::regions;
    view_.features = list_kind.has_primitives() ? of_primitives_ : of_contact_;
    OctantPairs<B> pairs;
    needed_ = HUGE_VAL;
    if (!sort_into_octants(b_, view_, list_kind.has_primitives() ? n_primitives_ : n_contact_,
                           progress_, pairs))
      return false;
    give_back_memory();    // what sorting took
    needed_ = double(brick_bytes(plan, pairs.n_bricks));
    if (needed_ > double(budget)) return false;
    Scratch<std::uint64_t> met(pairs.n);
    find_cells_met(b_, view_, pairs, progress_, met.data());
    pairs.octant = Scratch<std::uint32_t>();    // before entries take the most
    give_back_memory();
    // One primitive more than are read is stored, as a bound of what is left out.
    const std::uint32_t most = list_kind.has_primitives() ? list_kind.most() + 1 : 0xffffffffu;
    BuiltLists<B> built;
    const bool fits =
        fill_lists(b_, view_, pairs, met.data(), most, budget, progress_, built, report);
    needed_ =
        std::max(needed_, double(grid_bytes(plan, built.n_bricks, built.n_cells, built.n_entries)));
    if (!built.can_be_numbered()) needed_ = HUGE_VAL;
    if (!fits) return false;
    b_.wait();
    report.seconds = seconds_since(start);
    met = Scratch<std::uint64_t>();
    pairs = OctantPairs<B>();    // before the copies: here most memory is in use
    give_back_memory();
    lists.brick_of = to_cpu(b_, built.brick_of, built.brick_of.size());
    lists.bricks = to_cpu(b_, built.bricks, built.n_bricks);
    lists.cells = to_cpu(b_, built.cells, built.n_cells);
    if (settings.is_packed()) {
      lists.packing = EntryPacking(n_of_a_kind_, plan.cutoff + plan.widened() + plan.half_diagonal);
      lists.packed = packed(built, lists.packing);
      return true;
    }
    if constexpr (B::kOnCpu)
      lists.entries = drained(built.entries.data(), built.n_entries);
    else
      lists.entries = to_cpu(b_, built.entries, built.n_entries);
    return true;
  }

  std::string name() const { return b_.name(); }
  // Returns the bytes that the last build needs, also while it runs. If it did not fit: a lower bound.
  double needed() const { return needed_; }

  static double seconds_since(std::chrono::steady_clock::time_point start)
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

 private:
  // Returns the entries, packed where they are, a part after the other. On a CPU they are lost.
  std::vector<PackedEntry> packed(BuiltLists<B> &built, const EntryPacking &packing)
  {
    const std::size_t n = built.n_entries;
    std::vector<PackedEntry> out(B::kOnCpu ? 0 : n);
    if constexpr (B::kOnCpu) {
      out.reserve(n);
      const auto pack = [&](const CellEntry *begin, const CellEntry *end) {
        for (const CellEntry *c = begin; c < end; c++) out.push_back(packing.pack(*c));
      };
      move_and_release(built.entries.data(), n, pack);
    } else {
      constexpr std::size_t kPart = 1 << 22;
      Scratch<PackedEntry> part(std::min(n, kPart));
      for (std::size_t from = 0; from < n; from += kPart) {
        const std::size_t n_part = std::min(n - from, kPart);
        pack_part(b_, packing, built.entries.data() + from, n_part, part.data());
        b_.copy_out(part.data(), out.data() + from, n_part);
        b_.wait();
      }
    }
    return out;
  }

  // Puts an array where the backend can read it: on a device, a copy that lives as long as the builder.
  template <class T>
  const T *put(const std::vector<T> &from)
  {
    if constexpr (B::kOnCpu) return from.data();
    Scratch<char> &copy = copies_.emplace_back(array_bytes(from));
    b_.copy_in(reinterpret_cast<const char *>(from.data()), copy.data(), copy.size());
    b_.wait();
    return reinterpret_cast<const T *>(copy.data());
  }

  B b_;
  std::vector<Scratch<char>> copies_;
  const FeatureCode *of_contact_, *of_primitives_;
  std::size_t n_contact_, n_primitives_, n_of_a_kind_;
  BuildView view_ = {};
  BuildProgress progress_;
  double needed_ = 0;
};

// Builds the lists and the copies in float, and returns whether they fit the budget. `needed`:
// the bytes that they take, or a lower bound if they do not fit.
template <class B>
bool fill_grid(GridBuilder<B> &builder, const GridPlan &plan, const AnyGridSettings &settings,
               double budget, TriangleGrid &grid, double &needed)
{
  const std::size_t of_wall = flat_wall_bytes(grid);
  const double for_lists = budget - double(of_wall);
  needed = of_wall + plan.least_bytes();
  if (needed > budget) return false;
  const bool lists_fit = builder.build(plan, settings, static_cast<std::size_t>(for_lists),
                                       grid.lists, grid.report.lists);
  needed = std::max(needed, of_wall + builder.needed());
  if (!lists_fit) return false;
  grid.origin = plan.origin;
  grid.length = plan.length;
  grid.cutoff = plan.cutoff;
  grid.tolerance = plan.tolerance;
  grid.margin = settings.list_kind().is_complete() ? plan.margin : 0;
  for (int k = 0; k < 3; k++) grid.n_bricks[k] = plan.n_bricks[k];
  grid.list_kind = settings.list_kind();
  if (settings.in_floats) add_brick_records(grid);
  needed = std::max(needed, double(flat_bytes(grid)));
  return needed <= budget;
}

// Returns how many coarser plans can be skipped if this one is `over` times too large: no part of a grid grows faster
// than length^-3.
inline int least_steps(double over)
{
  if (!std::isfinite(over)) return 1;
  return std::max(1, static_cast<int>(std::log(over) / (3 * std::log(kCoarser))));
}

// Plans and builds. If the length is chosen here, it tries coarser ones until budget and limit hold.
template <class B>
TriangleGrid build_grid_on(B backend, const WeldedMesh &mesh, const AnyGridSettings &settings)
{
  const auto start = std::chrono::steady_clock::now();
  TriangleGrid grid;
  grid.wall = make_features(mesh, settings.sides, settings.list_kind().has_primitives());
  GridBuilder<B> builder(std::move(backend), grid.wall, settings.progress);
  GridPlan plan = plan_grid(mesh, settings);
  const double budget = double(budget_of(settings, grid));
  const BuildLimit limit(mesh.faces.size());
  const bool is_limited = settings.is_limited();
  constexpr double kNoBudget = 1e18;
  const bool may_coarsen = settings.length <= 0 || settings.may_coarsen;
  const Real first_length = plan.length;
  const auto fits = [&](double budget_here, double &needed) {
    grid.lists = CellLists();
    grid.records = BrickRecords();
    grid.report = GridReport();
    return fill_grid(builder, plan, settings, budget_here, grid, needed);
  };
  const double of_wall = double(flat_wall_bytes(grid));
  // A plan was too large, by at least `needed` bytes; found exactly if that is quick.
  const auto refuse = [&](const BuildEstimate &e, double needed) {
    if (may_coarsen && e.enough_bytes == 0)
      fits(kNoBudget, needed);
    else if (may_coarsen)
      needed = std::max(needed, of_wall + e.enough_bytes);
    throw_over_budget(settings, needed, budget);
  };
  for (;;) {
    const BuildEstimate e = estimate_build(grid.wall, plan, settings);
    const bool at_end = !may_coarsen || is_coarsest(plan, mesh);
    const double least = std::max(e.least_bytes, plan.least_bytes()),
                 too_much = std::max(e.work / limit.work, least / limit.bytes);
    const bool is_over_limit = is_limited && too_much > 1 && !(may_coarsen && at_end);
    double needed = of_wall + least;
    if (of_wall + e.least_bytes <= budget && !is_over_limit && fits(budget, needed)) break;
    if (at_end && is_over_limit && of_wall + least <= budget) throw_over_limit(settings, too_much);
    if (at_end) refuse(e, needed);
    if (plan.length == first_length) {
      // An error now is better than after all coarser plans.
      const GridPlan tried = plan;
      while (!is_coarsest(plan, mesh)) plan = coarser(plan, mesh, settings);
      const BuildEstimate last = estimate_build(grid.wall, plan, settings);
      if (of_wall + last.least_bytes > budget) refuse(last, of_wall + last.least_bytes);
      plan = tried;
    }
    const double over =
        std::max((needed - of_wall) / std::max(budget - of_wall, 1.), is_limited ? too_much : 0);
    for (int i = least_steps(over); i > 0 && !is_coarsest(plan, mesh); i--)
      plan = coarser(plan, mesh, settings);
  }

  grid.outside = mesh.report.volume < 0 ? -1 : 1;
  if (settings.sides && meets_itself(mesh).pairs > 0) grid.outside = 0;
  grid.report.list_kind = settings.list_kind();
  grid.report.records =
      grid.records.faces.size() + grid.records.edges.size() + grid.records.vertices.size();
  BrickRecordsView::each_array(grid.records,
                               [&](const auto &a) { grid.report.record_bytes += array_bytes(a); });
  grid.report.device = builder.name();
  grid.report.length = plan.length;
  grid.report.cutoff = plan.cutoff;
  grid.report.length_chosen = settings.length <= 0;
  grid.report.too_fine = plan.length > first_length ? first_length : 0;
  grid.report.bytes = flat_bytes(grid);
  grid.report.seconds = GridBuilder<B>::seconds_since(start);
  return grid;
}

}    // namespace lsdcd
