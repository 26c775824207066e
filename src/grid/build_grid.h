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
      features_(b_.from_host(wall.contact_features))
  {
    view_.wall = {faces_.data(),
                  edges_.data(),
                  vertices_.data(),
                  edge_inward_.data(),
                  vertex_direction_.data(),
                  face_vertex_.data(),
                  edge_vertex_.data(),
                  nullptr,
                  nullptr};
    view_.features = features_.data();
  }

  // Sorts features into octants. Returns the number of bricks near the wall.
  std::size_t rasterise_all(const GridPlan &plan)
  {
    view_.plan = plan;
    const BuildView view = view_;
    const std::size_t n = features_.size();
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

  static bool too_many(std::size_t n_bricks) { return n_bricks == too_many_; }

  // Fills cells, brick by brick; rasterise_all() must have been called.
  // Returns false, with grid untouched, if lists would not fit `budget` bytes.
  bool fill(TriangleGrid &grid, std::size_t budget)
  {
    const BuildView view = view_;
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
      counts[b * kBrickCells + c] = n;
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
          insert_sorted(lists + start, at++, candidate);
        else
          lists[start + at++] = candidate;
      }
      if (n > kLongList) heap_sort(lists + start, n);
      cells[cell_index(bricks[b], c)] = out;
    });

    grid.bricks = b_.to_host(brick, n_bricks_);
    grid.cells = b_.to_host(cell, n_occupied);
    grid.candidates = b_.to_host(list, n_list);
    const std::vector<std::uint32_t> keys = b_.to_host(brick_key_, n_bricks_);
    grid.brick_of.assign(view.plan.table_size(), -1);
    for (std::size_t b = 0; b < n_bricks_; b++)
      grid.brick_of[keys[b]] = static_cast<std::int32_t>(b);

    grid.report.bricks = n_bricks_;
    grid.report.cells = n_occupied;
    std::size_t inlined = 0;
    for (const Cell &c : grid.cells) inlined += c.count == 1;
    grid.report.candidates = n_list + inlined;
    grid.report.mean_list = n_occupied ? Real(grid.report.candidates) / n_occupied : 0;
    for (std::uint32_t n : longest_host)
      if (n > grid.report.longest_list) grid.report.longest_list = n;
    grid.report.distance_tests = b_.sum(n_tests, n_bricks_);
    grid.report.device = b_.name();
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
  Array<FeatureCode> features_;
  BuildView view_ = {};
  Array<std::uint32_t> pair_feature_, brick_key_, octant_pair_;
  std::size_t n_bricks_ = 0;
};

// Plans, builds, and where the length was left to us tries coarser ones until
// the budget holds.
template <class B>
TriangleGrid build_grid_on(B backend, const WallMesh &mesh, const GridSettings &settings)
{
  const auto start = std::chrono::steady_clock::now();
  TriangleGrid grid;
  grid.wall = make_features(mesh, settings.sides);
  GridBuilder<B> builder(std::move(backend), grid.wall);
  GridPlan plan = plan_grid(mesh, settings);
  const Real asked = plan.length;
  bool fits = false;
  while (!fits) {
    fits = plan.may_fit(settings.memory_budget);
    if (fits) {
      const std::size_t n = builder.rasterise_all(plan);
      fits = !GridBuilder<B>::too_many(n) && bricks_fit(plan, n, settings.memory_budget) &&
             builder.fill(grid, settings.memory_budget);
    }
    if (!fits) plan = coarser(plan, mesh, settings);
  }
  if (settings.length > 0 && plan.length != asked) throw_over_budget(settings, asked, plan.length);

  grid.origin = plan.origin;
  grid.length = plan.length;
  grid.reach = plan.reach;
  grid.slack = plan.slack;
  grid.outside = mesh.report.volume < 0 ? -1 : 1;
  for (int k = 0; k < 3; k++) grid.n_bricks[k] = plan.n_bricks[k];
  grid.report.length = plan.length;
  grid.report.reach = plan.reach;
  grid.report.length_chosen = settings.length <= 0;
  grid.report.bytes = flat_bytes(grid);
  grid.report.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return grid;
}

}    // namespace lsdcd
