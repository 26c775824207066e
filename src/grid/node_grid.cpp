// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "grid/node_grid.h"

#include "base/array_list.h"
#include "base/input_error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace lsdcd {

namespace {

// The corners of a primitive: one, two or three.
struct Corners {
  Vec3 at[3];
  int n;
};
Corners corners_of(const WeldedMesh &mesh, FeatureCode code)
{
  const std::uint32_t i = feature_index(code);
  Corners c = {};
  const auto add = [&](int vertex) { c.at[c.n++] = mesh.vertices[vertex]; };
  switch (feature_kind(code)) {
    case FeatureKind::face:
      for (const int v : mesh.faces[i]) add(v);
      break;
    case FeatureKind::edge:
      for (const int v : mesh.edges[i]) add(v);
      break;
    default:
      add(static_cast<int>(i));
  }
  return c;
}

Box bounds_of(const Corners &c)
{
  Box box = {c.at[0], c.at[0]};
  for (int k = 1; k < c.n; k++) extend(box, c.at[k]);
  return box;
}

Real distance_to(const Box &box, const Vec3 &x)
{
  Vec3 d;
  for (int k = 0; k < 3; k++) d[k] = std::max({box.lo[k] - x[k], x[k] - box.hi[k], Real(0)});
  return norm(d);
}

// The cells [lo, hi) that a primitive's bounds reach, along each axis.
struct CellRange {
  std::int32_t lo[3], hi[3];
};

// Cells that are this much nearer than they need be cover the rounding of distances and of cells.
constexpr Real kRounding = 1e-9;

}    // namespace

// Cells are twice as long as they reach, which keeps builds short and lists too, or longer where the mesh has large
// triangles or is large: lists and tables stay of the size of the mesh.
void NodeGrid::plan(const WeldedMesh &mesh, const MeshFeatures &features)
{
  Box box = {mesh.vertices.front(), mesh.vertices.front()};
  for (const Vec3 &x : mesh.vertices) extend(box, x);
  const Real diagonal = norm(box.hi - box.lo);
  if (!std::isfinite(diagonal))
    throw InputError("nodes of '" + mesh.source + "' have positions that are not finite");
  tolerance_ = 4e-13 * cutoff_ + 16 * kRoundoff * (diagonal + cutoff_);
  const Real reach = cutoff_ + allowance_ + tolerance_;
  constexpr double kMostCells = 48;    // that a primitive reaches, in the mean
  const auto n = static_cast<double>(features.primitives.size());
  for (length_ = 2 * (cutoff_ + allowance_);; length_ *= 2) {
    const Real pad = reach * (1 + kRounding) + Real(0.01) * length_;
    origin_ = box.lo - Vec3{pad, pad, pad};
    double table = 1;
    for (int d = 0; d < 3; d++) {
      const double bricks = std::ceil((box.hi[d] + pad - origin_[d]) / (kBrickSide * length_));
      table *= bricks;
      n_bricks_[d] = static_cast<std::int32_t>(std::clamp(bricks, 1., 1e6));
    }
    if (!(table <= 1e5 + 16 * n)) continue;
    double cells = 0;
    for (const FeatureCode code : features.primitives) {
      const Box b = bounds_of(corners_of(mesh, code));
      double of = 1;
      for (int d = 0; d < 3; d++) of *= (b.hi[d] - b.lo[d] + 2 * reach) / length_ + 1;
      cells += of;
    }
    if (cells <= 1e5 + kMostCells * n) break;
  }
}

void NodeGrid::build(const WeldedMesh &mesh, const MeshFeatures &features, Real cutoff,
                     Real allowance)
{
  features_ = &features;
  flat_ = FlatGrid();
  cutoff_ = cutoff;
  allowance_ = allowance;
  outside_ = mesh.report.volume < 0 ? -1 : 1;
  plan(mesh, features);
  const Real reach = (cutoff_ + allowance_ + tolerance_) * (1 + kRounding) + kRounding * length_,
             half = Real(0.5) * length_;

  const auto range_of = [&](const Box &box) {
    CellRange cells;
    for (int d = 0; d < 3; d++) {
      const Real n = Real(n_bricks_[d]) * kBrickSide;
      cells.lo[d] = static_cast<std::int32_t>(
          std::clamp(std::floor((box.lo[d] - reach - origin_[d]) / length_), Real(0), n));
      cells.hi[d] = static_cast<std::int32_t>(
          std::clamp(std::floor((box.hi[d] + reach - origin_[d]) / length_) + 1, Real(0), n));
    }
    return cells;
  };
  const auto slot_of = [&](std::int32_t i, std::int32_t j, std::int32_t k) {
    return (static_cast<std::size_t>(k) * n_bricks_[1] + j) * n_bricks_[0] + i;
  };
  // Visits the cells that a primitive may reach: visit(slot of the brick, cell in the brick, off, box, centre), where the
  // centre of the cell is `off` the plane of a face.
  const auto for_cells = [&](FeatureCode code, const auto &visit) {
    const Corners c = corners_of(mesh, code);
    const Box box = bounds_of(c);
    const CellRange cells = range_of(box);
    const bool is_face = c.n == 3;
    const FaceRecord *face = is_face ? &features.faces[feature_index(code)] : nullptr;
    const Vec3 normal = is_face ? face->normal : Vec3{0, 0, 0};
    const Real half_across =
        half * (std::fabs(normal.x) + std::fabs(normal.y) + std::fabs(normal.z));
    for (std::int32_t k = cells.lo[2]; k < cells.hi[2]; k++)
      for (std::int32_t j = cells.lo[1]; j < cells.hi[1]; j++)
        for (std::int32_t i = cells.lo[0]; i < cells.hi[0]; i++) {
          const Vec3 centre = origin_ + length_ * Vec3{i + Real(0.5), j + Real(0.5), k + Real(0.5)};
          const Real off = is_face ? std::fabs(dot(normal, centre - face->anchor)) : 0;
          if (off > reach + half_across) continue;
          visit(slot_of(i >> 3, j >> 3, k >> 3), (k & 7) << 6 | (j & 7) << 3 | (i & 7), off, box,
                centre);
        }
  };

  // Bricks in the order of their slots; some that bounds alone reach have no cells.
  lists_.brick_of.assign(std::size_t(n_bricks_[0]) * n_bricks_[1] * n_bricks_[2], -1);
  for (const FeatureCode code : features.primitives) {
    const CellRange cells = range_of(bounds_of(corners_of(mesh, code)));
    for (std::int32_t k = cells.lo[2] >> 3; k << 3 < cells.hi[2]; k++)
      for (std::int32_t j = cells.lo[1] >> 3; j << 3 < cells.hi[1]; j++)
        for (std::int32_t i = cells.lo[0] >> 3; i << 3 < cells.hi[0]; i++)
          lists_.brick_of[slot_of(i, j, k)] = 0;
  }
  std::int32_t n_bricks = 0;
  for (std::int32_t &brick : lists_.brick_of)
    if (brick == 0) brick = n_bricks++;

  count_.assign(std::size_t(n_bricks) * kBrickCells, 0);
  for (const FeatureCode code : features.primitives)
    for_cells(code, [&](std::size_t slot, int cell, Real, const Box &, const Vec3 &) {
      count_[std::size_t(lists_.brick_of[slot]) * kBrickCells + cell]++;
    });

  // Each cell's first candidate; a cell with one has it inline.
  lists_.bricks.assign(n_bricks, Brick());
  lists_.cells.clear();
  std::uint64_t n_candidates = 0;
  for (std::int32_t b = 0; b < n_bricks; b++)
    for (int layer = 0; layer < kLayers; layer++) {
      BrickLayer &of = lists_.bricks[b].layer[layer];
      of = {0, static_cast<std::uint32_t>(lists_.cells.size()), 0};
      for (int bit = 0; bit < 64; bit++) {
        const std::uint32_t n = count_[std::size_t(b) * kBrickCells + 64 * layer + bit];
        if (n == 0) continue;
        of.mask |= std::uint64_t(1) << bit;
        lists_.cells.push_back({n == 1 ? 0 : static_cast<std::uint32_t>(n_candidates), n});
        if (n > 1) n_candidates += n;
      }
    }
  if (n_candidates > 0xfffffff0u)
    throw InputError("the nodes of '" + mesh.source + "' lie so close that " +
                     std::to_string(n_candidates) +
                     " candidates of cells cannot be numbered: use a coarser mesh");
  lists_.candidates.resize(n_candidates);

  // From here on a cell's count is that of its candidates that are there.
  std::fill(count_.begin(), count_.end(), 0);
  for (const FeatureCode code : features.primitives)
    for_cells(code, [&](std::size_t slot, int cell, Real off, const Box &box, const Vec3 &centre) {
      const std::int32_t b = lists_.brick_of[slot];
      const BrickLayer &layer = lists_.bricks[b].layer[cell >> 6];
      const std::uint64_t before = layer.mask & ((std::uint64_t(1) << (cell & 63)) - 1);
      Cell &to =
          lists_.cells[layer.first_cell + static_cast<std::uint32_t>(__builtin_popcountll(before))];
      if (to.count == 1) {
        to.first = code;
        return;
      }
      const std::uint32_t at = to.first + count_[std::size_t(b) * kBrickCells + cell]++;
      const Real bound = std::max(off, distance_to(box, centre));
      // Rounded down, and less by what the nodes may go.
      const Real least = bound - allowance_ - kRounding * (bound + length_);
      lists_.candidates[at] = {code, static_cast<float>(least - Real(1e-6) * std::fabs(least))};
    });
  for (const Cell &cell : lists_.cells)
    if (cell.count > 1)
      std::sort(lists_.candidates.begin() + cell.first,
                lists_.candidates.begin() + cell.first + cell.count,
                [](const Candidate &a, const Candidate &b) {
                  return a.bound < b.bound || (a.bound == b.bound && a.feature < b.feature);
                });
}

void NodeGrid::make_flat()
{
  flat_ = FlatGrid();
  const BrickRecords none;
  flat_ = FlatGrid(GridParts{*features_, lists_, none, view()});
}

GridView NodeGrid::view() const
{
  if (flat_.bytes() > 0) return flat_.view();
  GridView v = {};
  v.wall = features_->view();
  v.origin = origin_;
  v.length = length_;
  v.inv_length = 1 / length_;
  v.cutoff = cutoff_;
  v.tolerance = tolerance_;
  v.outside = outside_;
  for (int d = 0; d < 3; d++) v.n_bricks[d] = n_bricks_[d];
  v.list_kind = ListKind::every();
  v.lists.brick_of = lists_.brick_of.data();
  v.lists.bricks = lists_.bricks.data();
  v.lists.cells = lists_.cells.data();
  v.lists.candidates = lists_.candidates.data();
  return v;
}

std::size_t NodeGrid::bytes() const
{
  std::size_t total = count_.size() * sizeof(std::uint32_t) + flat_.bytes();
  CellListsView::each_array(lists_, [&](const auto &a) { total += array_bytes(a); });
  return total;
}

}    // namespace lsdcd
