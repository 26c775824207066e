// Building the grid: rasterise -> sort -> per brick, one source for every backend.
#pragma once

#include "base/input_error.h"
#include "grid/candidate_list.h"
#include "grid/rasterise.h"
#include "grid/triangle_grid.h"

#include <chrono>
#include <cmath>

namespace lsdcd {

template <class B>
class GridBuilder {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  GridBuilder(B backend, const WallFeatures &wall) :
      b_(std::move(backend)), faces_(b_.from_host(wall.faces)), edges_(b_.from_host(wall.edges)),
      vertices_(b_.from_host(wall.vertices)), edge_inward_(b_.from_host(wall.edge_inward)),
      vertex_direction_(b_.from_host(wall.vertex_direction)),
      face_vertex_(b_.from_host(wall.face_vertex)), edge_vertex_(b_.from_host(wall.edge_vertex)),
      contact_features_(b_.from_host(wall.contact_features)), pieces_(b_.from_host(wall.pieces))
  {
    view_.wall = {faces_.data(),
                  edges_.data(),
                  vertices_.data(),
                  edge_inward_.data(),
                  vertex_direction_.data(),
                  face_vertex_.data(),
                  edge_vertex_.data(),
                  nullptr,
                  nullptr,
                  nullptr};
  }

  // Lists of the contact features (nearest 0) or of the nearest pieces. Returns false,
  // with `lists` untouched, if they would not fit `budget` bytes.
  bool build(const GridPlan &plan, int nearest, std::size_t budget, CellLists &lists,
             ListReport &report)
  {
    view_.plan = plan;
    view_.pieces = nearest > 0;
    view_.features = nearest > 0 ? pieces_.data() : contact_features_.data();
    const std::size_t n = rasterise_all(nearest > 0 ? pieces_.size() : contact_features_.size());
    return n != too_many_ && bricks_fit(plan, n, budget) && fill(nearest, budget, lists, report);
  }

  // Builds only the bricks whose bit is set from now on; empty: all.
  void restrict_to(const std::vector<std::uint64_t> &bricks)
  {
    only_ = b_.from_host(bricks);
    view_.only = bricks.empty() ? nullptr : only_.data();
  }

  std::string name() const { return b_.name(); }

  // The two steps of build(). Public because nvcc takes no device lambda from a private
  // function.

  // Sorts features into octants. Returns the number of bricks near the wall.
  std::size_t rasterise_all(std::size_t n)
  {
    const BuildView view = view_;
    const GridPlan &plan = view_.plan;
    Array<std::uint64_t> offset(n + 1);
    std::uint64_t *offsets = offset.data();
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      std::uint64_t count = 0;
      rasterise(view, view.features[i], [&](std::uint32_t) { count++; });
      offsets[i] = count;
    });
    const std::uint64_t n_pairs = b_.exclusive_scan(offsets, n);
    if (n_pairs >= 0xffffffffull) return too_many_;
    Array<std::uint32_t> pair_key(n_pairs);
    pair_feature_ = Array<std::uint32_t>(n_pairs);
    std::uint32_t *keys = pair_key.data(), *values = pair_feature_.data();
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      std::uint64_t at = offsets[i];
      rasterise(view, view.features[i], [&](std::uint32_t octant) {
        keys[at] = octant;
        values[at++] = view.features[i];
      });
    });
    b_.sort_pairs(pair_key, pair_feature_, static_cast<std::uint32_t>(plan.table_size() * 8 - 1));

    // A brick is a run of keys that agree but for the octant.
    const std::uint32_t *sorted = pair_key.data();
    Array<std::uint32_t> run(n_pairs);
    std::uint32_t *runs = run.data();
    b_.for_each(n_pairs, [=] LSDCD_LAMBDA(std::size_t i) {
      runs[i] = i == 0 || sorted[i] >> 3 != sorted[i - 1] >> 3;
    });
    n_bricks_ = b_.exclusive_scan(runs, n_pairs);
    brick_key_ = Array<std::uint32_t>(n_bricks_);
    octant_pair_ = Array<std::uint32_t>(n_bricks_ * 8 + 1);
    std::uint32_t *key = brick_key_.data(), *first = octant_pair_.data();
    const std::size_t n_octants = n_bricks_ * 8;
    // Each pair opens the octants from after its forerunner's up to its own.
    b_.for_each(n_pairs, [=] LSDCD_LAMBDA(std::size_t i) {
      const bool new_brick = i == 0 || sorted[i] >> 3 != sorted[i - 1] >> 3;
      const std::size_t b = new_brick ? runs[i] : runs[i] - 1;
      if (new_brick) key[b] = sorted[i] >> 3;
      const std::size_t own = b * 8 + (sorted[i] & 7);
      std::size_t from = 0;
      if (i > 0) {
        const std::size_t before = new_brick ? b - 1 : b;
        from = before * 8 + (sorted[i - 1] & 7) + 1;
      }
      for (std::size_t o = from; o <= own; o++) first[o] = static_cast<std::uint32_t>(i);
      if (i == n_pairs - 1)
        for (std::size_t o = own + 1; o <= n_octants; o++)
          first[o] = static_cast<std::uint32_t>(n_pairs);
    });
    return n_bricks_;
  }

  // Fills cells, brick by brick; rasterise_all() must have been called.
  bool fill(int nearest, std::size_t budget, CellLists &out_lists, ListReport &report)
  {
    const BuildView view = view_;
    // Of nearest pieces the first that is left out stays, as a bound.
    const std::uint32_t most = nearest > 0 ? nearest + 1 : 0xffffffffu;
    const std::size_t n_cells = n_bricks_ * kBrickCells;
    Array<std::uint32_t> count(n_cells), offset(n_cells);
    std::uint32_t *counts = count.data(), *offsets = offset.data();
    const std::uint32_t *key = brick_key_.data(), *first = octant_pair_.data(),
                        *features = pair_feature_.data();
    b_.for_each(n_cells, [=] LSDCD_LAMBDA(std::size_t i) {
      const std::size_t octant = i / kOctantCells, b = octant / 8;
      const int c =
          cell_of_octant(static_cast<int>(octant % 8), static_cast<int>(i % kOctantCells));
      const Vec3 centre = view.plan.cell_centre(key[b], c);
      std::uint32_t n = 0;
      Real distance;
      for (std::uint32_t p = first[octant]; p < first[octant + 1]; p++)
        n += meets(view, features[p], centre, view.plan.half_diagonal, distance);
      counts[b * kBrickCells + c] = n < most ? n : most;
    });

    // Per brick: the occupancy mask, and where its cells and lists begin.
    Array<Brick> brick(n_bricks_);
    Array<std::uint32_t> cell_first(n_bricks_), list_first(n_bricks_), longest(n_bricks_);
    Array<std::uint64_t> tests(n_bricks_);
    Brick *bricks = brick.data();
    std::uint32_t *cells_of = cell_first.data(), *lists_of = list_first.data(),
                  *longests = longest.data();
    std::uint64_t *n_tests = tests.data();
    b_.for_each(n_bricks_, [=] LSDCD_LAMBDA(std::size_t b) {
      Brick out = {};
      std::uint32_t cells = 0, list = 0, most = 0;
      for (int w = 0; w < kMaskWords; w++) {
        out.below[w] = static_cast<std::uint16_t>(cells);
        for (int c = 0; c < 64; c++) {
          const std::size_t i = b * kBrickCells + w * 64 + c;
          const std::uint32_t n = counts[i];
          offsets[i] = list;
          if (n == 0) continue;
          out.mask[w] |= std::uint64_t(1) << c;
          cells++;
          if (n > 1) list += n;
          if (n > most) most = n;
        }
      }
      bricks[b] = out;
      cells_of[b] = cells;
      lists_of[b] = list;
      longests[b] = most;
      n_tests[b] = std::uint64_t(first[b * 8 + 8] - first[b * 8]) * kOctantCells;
    });
    const std::vector<std::uint32_t> longest_host = b_.to_host(longest, n_bricks_);
    const std::vector<std::uint32_t> list_host = b_.to_host(list_first, n_bricks_);
    std::uint64_t n_list = 0;
    for (std::uint32_t n : list_host) n_list += n;
    const std::size_t n_occupied = b_.exclusive_scan(cells_of, n_bricks_);
    if (n_list >= 0xffffffffull || grid_bytes(view.plan, n_bricks_, n_occupied, n_list) > budget)
      return false;
    b_.exclusive_scan(lists_of, n_bricks_);

    b_.for_each(n_bricks_, [=] LSDCD_LAMBDA(std::size_t b) { bricks[b].first_cell = cells_of[b]; });

    Array<Cell> cell(n_occupied);
    Array<Candidate> list(n_list);
    Cell *cells = cell.data();
    Candidate *lists = list.data();
    b_.for_each(n_cells, [=] LSDCD_LAMBDA(std::size_t i) {
      const std::size_t octant = i / kOctantCells, b = octant / 8;
      const int c =
          cell_of_octant(static_cast<int>(octant % 8), static_cast<int>(i % kOctantCells));
      const std::uint32_t n = counts[b * kBrickCells + c];
      if (n == 0) return;
      const std::uint32_t start = lists_of[b] + offsets[b * kBrickCells + c];
      Cell out = {start, n};
      const Vec3 centre = view.plan.cell_centre(key[b], c);
      std::uint32_t at = 0;
      for (std::uint32_t p = first[octant]; p < first[octant + 1]; p++) {
        Real distance;
        if (!meets(view, features[p], centre, view.plan.half_diagonal, distance)) continue;
        if (n == 1) {
          out.first = features[p];
          break;
        }
        const Candidate candidate = make_candidate(features[p], distance);
        if (n <= kLongList)
          insert_nearest(lists + start, at++, n, candidate);
        else
          lists[start + at++] = candidate;
      }
      if (n > kLongList) heap_sort(lists + start, n);
      cells[cell_index(bricks[b], c)] = out;
    });

    out_lists.bricks = b_.to_host(brick, n_bricks_);
    out_lists.cells = b_.to_host(cell, n_occupied);
    out_lists.candidates = b_.to_host(list, n_list);
    const std::vector<std::uint32_t> brick_keys = b_.to_host(brick_key_, n_bricks_);
    out_lists.brick_of.assign(view.plan.table_size(), -1);
    for (std::size_t b = 0; b < n_bricks_; b++)
      out_lists.brick_of[brick_keys[b]] = static_cast<std::int32_t>(b);

    report = ListReport();
    report.bricks = n_bricks_;
    report.cells = n_occupied;
    std::size_t inlined = 0;
    for (const Cell &c : out_lists.cells) inlined += c.count == 1;
    report.candidates = n_list + inlined;
    report.mean = n_occupied ? Real(report.candidates) / n_occupied : 0;
    for (std::uint32_t n : longest_host)
      if (n > report.longest) report.longest = n;
    report.distance_tests = b_.sum(n_tests, n_bricks_);
    return true;
  }

 private:
  static constexpr std::size_t too_many_ = ~std::size_t(0);

  B b_;
  Array<FaceRecord> faces_;
  Array<EdgeRecord> edges_;
  Array<VertexRecord> vertices_;
  Array<Vec3> edge_inward_, vertex_direction_;
  Array<FaceVertices> face_vertex_;
  Array<EdgeVertices> edge_vertex_;
  Array<FeatureCode> contact_features_, pieces_;
  Array<std::uint64_t> only_;
  BuildView view_ = {};
  Array<std::uint32_t> pair_feature_, brick_key_, octant_pair_;
  std::size_t n_bricks_ = 0;
};

// Lists of one kind or both, and the copies in float: whether they fit the budget.
template <class B>
bool fill_grid(GridBuilder<B> &builder, const GridPlan &plan, const GridSettings &settings,
               TriangleGrid &grid)
{
  const std::size_t budget = settings.memory_budget;
  std::size_t taken = 0;
  const auto take = [&](const CellLists &l) {
    taken += grid_bytes(plan, l.bricks.size(), l.cells.size(), l.candidates.size());
  };
  if (!plan.may_fit(budget)) return false;
  builder.restrict_to(bricks_that_meet(plan, settings.only));
  if (!builder.build(plan, settings.nearest, budget, grid.lists, grid.report.lists)) return false;
  take(grid.lists);
  if (settings.nearest > 0 && settings.exact) {
    if (taken >= budget ||
        !builder.build(plan, 0, budget - taken, grid.complete, grid.report.complete))
      return false;
    take(grid.complete);
  }
  grid.origin = plan.origin;
  grid.length = plan.length;
  grid.reach = plan.reach;
  grid.slack = plan.slack;
  for (int k = 0; k < 3; k++) grid.n_bricks[k] = plan.n_bricks[k];
  grid.nearest = settings.nearest;
  if (settings.in_floats) add_brick_records(grid);
  return taken + grid.records.bytes() <= budget;
}

// Plans, builds, and where the length was left to us tries coarser ones until
// the budget holds.
template <class B>
TriangleGrid build_grid_on(B backend, const WallMesh &mesh, const GridSettings &settings)
{
  const auto start = std::chrono::steady_clock::now();
  TriangleGrid grid;
  grid.wall = make_features(mesh, settings.sides, settings.nearest > 0);
  GridBuilder<B> builder(std::move(backend), grid.wall);
  GridPlan plan = plan_grid(mesh, settings);
  const Real asked = plan.length;
  while (!fill_grid(builder, plan, settings, grid)) {
    plan = coarser(plan, mesh, settings);
    grid.lists = grid.complete = CellLists();
    grid.records = BrickRecords();
    grid.report = GridReport();
  }
  if (settings.length > 0 && plan.length != asked && !settings.may_coarsen)
    throw_over_budget(settings, asked, plan.length);

  grid.outside = mesh.report.volume < 0 ? -1 : 1;
  grid.report.nearest = settings.nearest;
  grid.report.records =
      grid.records.faces.size() + grid.records.edges.size() + grid.records.vertices.size();
  grid.report.record_bytes = grid.records.bytes();
  grid.report.device = builder.name();
  grid.report.length = plan.length;
  grid.report.reach = plan.reach;
  grid.report.length_chosen = settings.length <= 0;
  grid.report.bytes = flat_bytes(grid);
  grid.report.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return grid;
}

}    // namespace lsdcd
