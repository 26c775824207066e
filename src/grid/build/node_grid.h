// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The grid of a mesh whose nodes move, built where a backend computes. A cell lists every primitive (a face with its edges
// and vertices, or a lone edge or vertex) whose distance from the cell is at most the cutoff and an allowance, by bounds
// alone: normals turn, so that no region of a feature decides. It takes a few passes over the primitives to build, and
// holds until a node has gone the allowance:
//
//   distance of a point of the cell to the primitive now <= cutoff
//   => the same distance when the grid was built <= cutoff + way of its nodes <= cutoff + allowance
//   => the cell lists the primitive,
//
// as a point of a primitive goes no farther than the farthest of its nodes. Lists do not depend on the order in which
// threads come to a cell: their entries are all different, and are sorted.
#pragma once

#include "backend/atomic.h"
#include "backend/backend.h"
#include "base/input_error.h"
#include "grid/build/entry_list.h"
#include "grid/lookup/locate.h"
#include "mesh/periodic_box.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace lsdcd {

// Cells that are this much nearer than they need be cover the rounding of distances and of cells.
constexpr Real kCellRounding = 1e-9;

// The primitives of a mesh, with its nodes where they are, in the memory of a backend.
struct NodePrimitives {
  const FeatureCode *code;
  std::size_t n;
  const int *faces, *edges;    // corners: three a face, two an edge
  const Vec3 *at;
  const FaceRecord *face_records;

  LSDCD_FN Box bounds(FeatureCode of) const
  {
    const std::uint32_t i = feature_index(of);
    const FeatureKind kind = feature_kind(of);
    if (kind == FeatureKind::vertex) return {at[i], at[i]};
    const int n_corners = kind == FeatureKind::face ? 3 : 2;
    const int *corner = (kind == FeatureKind::face ? faces : edges) + n_corners * std::size_t(i);
    Box box = {at[corner[0]], at[corner[0]]};
    for (int c = 1; c < n_corners; c++)
      for (int d = 0; d < 3; d++) {
        box.lo[d] = fmin(box.lo[d], at[corner[c]][d]);
        box.hi[d] = fmax(box.hi[d], at[corner[c]][d]);
      }
    return box;
  }
};

struct NodeGridSettings {
  Real cutoff;           // of spheres' centres (length, > 0)
  Real allowance;        // how far nodes may go (length)
  Real outside;          // as in GridView
  Box bounds;            // of the nodes
  std::string source;    // the name of the mesh, for messages
};

// Where cells lie, and which of them a primitive reaches.
struct NodeCells {
  Vec3 origin;
  Real length, allowance;
  Real reach;    // how far from a primitive cells list it
  std::int32_t n_bricks[3];

  // Cells [lo, hi) along each axis.
  struct Range {
    std::int32_t lo[3], hi[3];
  };
  LSDCD_FN Range range(const Box &box) const
  {
    Range cells;
    for (int d = 0; d < 3; d++) {
      const Real n = Real(n_bricks[d]) * kBrickSide;
      const auto number = [&](Real at) {
        return static_cast<std::int32_t>(fmin(fmax(at, Real(0)), n));
      };
      cells.lo[d] = number(floor((box.lo[d] - reach - origin[d]) / length));
      cells.hi[d] = number(floor((box.hi[d] + reach - origin[d]) / length) + 1);
    }
    return cells;
  }
  LSDCD_FN std::size_t index(std::int32_t i, std::int32_t j, std::int32_t k) const
  {
    return (static_cast<std::size_t>(k) * n_bricks[1] + j) * n_bricks[0] + i;
  }
  std::size_t table_size() const { return index(0, 0, n_bricks[2]); }

  // Calls visit() with the index of each brick that its bounds reach; some of them have no cell that lists it.
  template <class Visit>
  LSDCD_FN void each_brick(const Box &box, const Visit &visit) const
  {
    const Range cells = range(box);
    for (std::int32_t k = cells.lo[2] >> 3; k << 3 < cells.hi[2]; k++)
      for (std::int32_t j = cells.lo[1] >> 3; j << 3 < cells.hi[1]; j++)
        for (std::int32_t i = cells.lo[0] >> 3; i << 3 < cells.hi[0]; i++) visit(index(i, j, k));
  }
  // Calls visit(index of the brick, cell in the brick, off, past) for each cell that lists the primitive: how far the cell's
  // centre is off the plane of a face, and past the bounds.
  template <class Visit>
  LSDCD_FN void each_cell(const NodePrimitives &of, FeatureCode code, const Visit &visit) const
  {
    const Box box = of.bounds(code);
    const Range cells = range(box);
    const bool is_face = feature_kind(code) == FeatureKind::face;
    const FaceRecord *face = is_face ? of.face_records + feature_index(code) : nullptr;
    const Vec3 normal = is_face ? face->normal : Vec3{0, 0, 0};
    const Real half_across =
        Real(0.5) * length * (fabs(normal.x) + fabs(normal.y) + fabs(normal.z));
    for (std::int32_t k = cells.lo[2]; k < cells.hi[2]; k++)
      for (std::int32_t j = cells.lo[1]; j < cells.hi[1]; j++)
        for (std::int32_t i = cells.lo[0]; i < cells.hi[0]; i++) {
          const Vec3 centre = origin + length * Vec3{i + Real(0.5), j + Real(0.5), k + Real(0.5)};
          const Real off = is_face ? fabs(dot(normal, centre - face->anchor)) : 0;
          if (off > reach + half_across) continue;
          Vec3 past;    // the bounds
          for (int d = 0; d < 3; d++)
            past[d] = fmax(fmax(box.lo[d] - centre[d], centre[d] - box.hi[d]), Real(0));
          visit(index(i >> 3, j >> 3, k >> 3), cell_in_brick(i, j, k), off, past);
        }
  }
  // Its bound is rounded down, and less by what the nodes may go.
  LSDCD_FN CellEntry entry(FeatureCode code, Real off, const Vec3 &past) const
  {
    const Real bound = fmax(off, norm(past));
    const Real least = bound - allowance - kCellRounding * (bound + length);
    return {code, static_cast<float>(least - Real(1e-6) * fabs(least))};
  }
};

template <class B>
class NodeGrid {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // Throws InputError where the mesh spans more cells than can be numbered; the grid is then as it was.
  void build(B &b, const NodePrimitives &of, const NodeGridSettings &settings)
  {
    NodeGrid to;
    to.fill(b, of, settings);
    b.wait();
    std::swap(*this, to);
  }

  // `wall`: the records of the mesh in the memory of the backend.
  GridView view(const MeshFeaturesView &wall) const
  {
    GridView v = {};
    v.wall = wall;
    v.origin = cells_.origin;
    v.length = cells_.length;
    v.inv_length = 1 / cells_.length;
    v.cutoff = cutoff_;
    v.tolerance = tolerance_;
    v.outside = outside_;
    for (int d = 0; d < 3; d++) v.n_bricks[d] = cells_.n_bricks[d];
    v.list_kind = ListKind::every();
    v.lists.brick_of = brick_of_.data();
    v.lists.bricks = bricks_.data();
    v.lists.cells = cell_.data();
    v.lists.entries = entry_.data();
    return v;
  }
  // What says where cells are that have entries.
  const Array<std::int32_t> &brick_of() const { return brick_of_; }
  const Array<Brick> &bricks() const { return bricks_; }

  std::size_t bytes() const
  {
    return brick_of_.size() * sizeof(std::int32_t) + bricks_.size() * sizeof(Brick) +
           cell_.size() * sizeof(Cell) + entry_.size() * sizeof(CellEntry);
  }

  // The steps of the above. Public because nvcc takes no device lambda from a private function.

  void fill(B &b, const NodePrimitives &of, const NodeGridSettings &settings)
  {
    plan(b, of, settings);
    number_bricks(b, of);
    Array<std::uint32_t> count(bricks_.size() * kBrickCells);
    Array<std::uint64_t> first_cell(bricks_.size() * kLayers), first(first_cell.size());
    count_entries(b, of, count.data());
    sum_layers(b, count.data(), first_cell.data(), first.data());
    const std::uint64_t n_cells = b.exclusive_scan(first_cell.data(), first_cell.size()),
                        n_entries = b.exclusive_scan(first.data(), first.size());
    if (n_entries > 0xfffffff0u)
      throw InputError("the nodes of '" + settings.source + "' lie so close that " +
                       std::to_string(n_entries) +
                       " entries of cells cannot be numbered: use a coarser mesh");
    cell_ = Array<Cell>(n_cells);
    entry_ = Array<CellEntry>(n_entries);
    put_cells(b, count.data(), first_cell.data(), first.data());
    put_entries(b, of, count.data());
    sort_lists(b);
    b.wait();    // before what it reads is freed
  }

  // Cells are twice as long as they reach, which keeps builds short and lists too, or longer where the mesh has large
  // triangles or is large: lists and tables stay of the size of the mesh.
  void plan(B &b, const NodePrimitives &of, const NodeGridSettings &settings)
  {
    const Box &box = settings.bounds;
    const Real diagonal = norm(box.hi - box.lo);
    if (!std::isfinite(diagonal))
      throw InputError("nodes of '" + settings.source + "' have positions that are not finite");
    cutoff_ = settings.cutoff;
    outside_ = settings.outside;
    tolerance_ = 4e-13 * cutoff_ + 16 * kRoundoff * (diagonal + cutoff_);
    cells_.allowance = settings.allowance;
    const Real reach = cutoff_ + cells_.allowance + tolerance_;
    constexpr double kMostCells = 48;    // that a primitive reaches, in the mean
    const auto n = static_cast<double>(of.n);
    for (cells_.length = 2 * (cutoff_ + cells_.allowance);; cells_.length *= 2) {
      cells_.reach = reach * (1 + kCellRounding) + kCellRounding * cells_.length;
      const Real pad = reach * (1 + kCellRounding) + Real(0.01) * cells_.length;
      cells_.origin = box.lo - Vec3{pad, pad, pad};
      double table = 1;
      for (int d = 0; d < 3; d++) {
        const double bricks =
            std::ceil((box.hi[d] + pad - cells_.origin[d]) / (kBrickSide * cells_.length));
        table *= bricks;
        cells_.n_bricks[d] = static_cast<std::int32_t>(std::clamp(bricks, 1., 1e6));
      }
      if (table <= 1e5 + 16 * n && double(cells_reached(b, of, reach)) <= 1e5 + kMostCells * n)
        break;
    }
  }

  // Whole cells of each primitive, so that their sum does not depend on the order.
  std::uint64_t cells_reached(B &b, const NodePrimitives &of, Real reach)
  {
    Array<std::uint64_t> reached(of.n);
    std::uint64_t *to = reached.data();
    const Real length = cells_.length;
    b.for_each(of.n, [=] LSDCD_LAMBDA(std::size_t p) {
      const Box box = of.bounds(of.code[p]);
      Real cells = 1;
      for (int d = 0; d < 3; d++) cells *= (box.hi[d] - box.lo[d] + 2 * reach) / length + 1;
      to[p] = static_cast<std::uint64_t>(cells);
    });
    return b.exclusive_scan(to, of.n);
  }

  // In the order of their indices.
  void number_bricks(B &b, const NodePrimitives &of)
  {
    const NodeCells cells = cells_;
    const std::size_t n = cells.table_size();
    brick_of_ = Array<std::int32_t>(n);
    Array<std::uint32_t> numbers(n);
    std::int32_t *brick_of = brick_of_.data();
    std::uint32_t *number = numbers.data();
    put_all(b, brick_of, n, 0);
    b.for_each(of.n, [=] LSDCD_LAMBDA(std::size_t p) {
      cells.each_brick(of.bounds(of.code[p]),
                       [&](std::size_t index) { set_flag(brick_of + index); });
    });
    copy_all(b, brick_of, number, n);
    bricks_ = Array<Brick>(b.exclusive_scan(number, n));
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t index) {
      brick_of[index] = brick_of[index] ? static_cast<std::int32_t>(number[index]) : -1;
    });
    b.wait();    // before the numbers are freed
  }

  // Of each cell of each brick.
  void count_entries(B &b, const NodePrimitives &of, std::uint32_t *count)
  {
    const NodeCells cells = cells_;
    const std::int32_t *brick_of = brick_of_.data();
    put_all(b, count, bricks_.size() * kBrickCells, 0);
    b.for_each(of.n, [=] LSDCD_LAMBDA(std::size_t p) {
      cells.each_cell(of, of.code[p],
                      [&](std::size_t index, std::int32_t cell, Real, const Vec3 &) {
                        fetch_add(count + (std::size_t(brick_of[index]) * kBrickCells + cell), 1u);
                      });
    });
  }

  // The cells of each layer that have entries, and the entries that are not inline: a cell with one has it so.
  void sum_layers(B &b, const std::uint32_t *count, std::uint64_t *n_cells,
                  std::uint64_t *n_entries)
  {
    Brick *bricks = bricks_.data();
    b.for_each(bricks_.size() * kLayers, [=] LSDCD_LAMBDA(std::size_t layer) {
      BrickLayer of = {0, 0, 0};
      std::uint64_t n = 0;
      for (int bit = 0; bit < 64; bit++) {
        const std::uint32_t here = count[64 * layer + bit];
        if (here > 0) of.mask |= std::uint64_t(1) << bit;
        if (here > 1) n += here;
      }
      bricks[layer / kLayers].layer[layer % kLayers] = of;
      n_cells[layer] = static_cast<std::uint64_t>(count_bits(of.mask));
      n_entries[layer] = n;
    });
  }

  // From here on a cell's count is that of its entries that are there.
  void put_cells(B &b, std::uint32_t *count, const std::uint64_t *first_cell,
                 const std::uint64_t *first_entry)
  {
    Brick *bricks = bricks_.data();
    Cell *cells = cell_.data();
    b.for_each(bricks_.size() * kLayers, [=] LSDCD_LAMBDA(std::size_t layer) {
      std::uint64_t at = first_cell[layer], first = first_entry[layer];
      bricks[layer / kLayers].layer[layer % kLayers].first_cell = static_cast<std::uint32_t>(at);
      for (int bit = 0; bit < 64; bit++) {
        const std::uint32_t n = count[64 * layer + bit];
        count[64 * layer + bit] = 0;
        if (n == 0) continue;
        cells[at++] = {n == 1 ? 0 : static_cast<std::uint32_t>(first), n};
        if (n > 1) first += n;
      }
    });
  }

  void put_entries(B &b, const NodePrimitives &of, std::uint32_t *count)
  {
    const NodeCells cells = cells_;
    const std::int32_t *brick_of = brick_of_.data();
    const Brick *bricks = bricks_.data();
    Cell *cell = cell_.data();
    CellEntry *entries = entry_.data();
    b.for_each(of.n, [=] LSDCD_LAMBDA(std::size_t p) {
      const FeatureCode code = of.code[p];
      cells.each_cell(of, code, [&](std::size_t index, std::int32_t c, Real off, const Vec3 &past) {
        const std::int32_t brick = brick_of[index];
        Cell &to = cell[cell_index(bricks[brick], c)];
        if (to.count == 1)
          to.first = code;
        else
          entries[to.first + fetch_add(count + (std::size_t(brick) * kBrickCells + c), 1u)] =
              cells.entry(code, off, past);
      });
    });
  }

  void sort_lists(B &b)
  {
    const Cell *cells = cell_.data();
    CellEntry *entries = entry_.data();
    b.for_each(cell_.size(), [=] LSDCD_LAMBDA(std::size_t c) {
      const std::uint32_t n = cells[c].count;
      if (n == 1) return;
      CellEntry *list = entries + cells[c].first;
      if (n > kLongList) return heap_sort(list, n);
      for (std::uint32_t k = 1; k < n; k++) {
        const CellEntry next = list[k];
        insert_sorted(list, k, next);
      }
    });
  }

 private:
  Real cutoff_ = 0, tolerance_ = 0, outside_ = 1;
  NodeCells cells_ = {};
  Array<std::int32_t> brick_of_;
  Array<Brick> bricks_;
  Array<Cell> cell_;
  Array<CellEntry> entry_;
};

}    // namespace lsdcd
