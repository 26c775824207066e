// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "grid/brick_records.h"

#include "backend/threads.h"
#include "base/input_error.h"
#include "grid/triangle_grid.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lsdcd {

namespace {

BrickPlane plane_at(const Vec3 &normal, Real height_at_origin)
{
  return {vec_cast<float>(normal), static_cast<float>(height_at_origin)};
}

BrickFace face_at(const FaceRecord &f, const Vec3 &origin)
{
  const Vec3 d = origin - f.anchor;
  BrickFace out;
  out.plane = plane_at(f.normal, dot(f.normal, d));
  for (int k = 0; k < 3; k++)
    out.side[k] = plane_at(f.inward[k], dot(f.inward[k], d) + (k == 1 ? f.height : 0));
  return out;
}

BrickEdge edge_at(const EdgeRecord &e, const Vec3 &origin)
{
  const Vec3 d = origin - e.anchor;
  const Real along = dot(e.direction, d);
  BrickEdge out;
  out.anchor = vec_cast<float>(along * e.direction - d);
  out.direction = vec_cast<float>(e.direction);
  out.lo = static_cast<float>(-along);
  out.hi = static_cast<float>(e.length - along);
  for (int k = 0; k < 2; k++) out.inward[k] = vec_cast<float>(e.inward[k]);
  out.n_faces = e.n_faces;
  out.more = e.more;
  return out;
}

// The features that this brick has listed so far: the cells of a brick list the same ones
// many times.
class Named {
 public:
  explicit Named(const MeshFeatures &wall) :
      by_{std::vector<std::uint32_t>(wall.faces.size(), 0),
          std::vector<std::uint32_t>(wall.edges.size(), 0),
          std::vector<std::uint32_t>(wall.vertices.size(), 0)}
  {
  }
  void next_brick() { brick_++; }
  bool first_time(FeatureCode code)
  {
    std::uint32_t &by = by_[static_cast<int>(feature_kind(code))][feature_index(code)];
    if (by == brick_) return false;
    by = brick_;
    return true;
  }

 private:
  std::vector<std::uint32_t> by_[3];    // the last brick that listed it, by kind of feature
  std::uint32_t brick_ = 0;
};

// The codes in the lists of a brick, ascending, each once. With nearest lists also the
// parts of its faces.
void codes_of(const TriangleGrid &grid, const Brick &brick, std::size_t n_cells, Named &named,
              std::vector<FeatureCode> &codes)
{
  const CellLists &lists = grid.lists;
  codes.clear();
  named.next_brick();
  const auto add = [&](FeatureCode code) {
    if (named.first_time(code)) codes.push_back(code);
  };
  for (std::size_t c = brick.layer[0].first_cell; c < brick.layer[0].first_cell + n_cells; c++) {
    const Cell cell = lists.cells[c];
    if (cell.count == 1)
      add(cell.first);
    else
      for (std::uint32_t i = cell.first; i < cell.first + cell.count; i++)
        add(lists.entries[i].feature);
  }
  const std::size_t n = grid.list_kind.has_primitives() ? codes.size() : 0;
  for (std::size_t i = 0; i < n; i++)
    if (feature_kind(codes[i]) == FeatureKind::face)
      for (FeatureCode part : grid.wall.face_parts[feature_index(codes[i])].part)
        if (part != kNoFeature) add(part);
  std::sort(codes.begin(), codes.end());
}

void add_records(TriangleGrid &grid, BrickRecords &out)
{
  CellLists &lists = grid.lists;
  const std::int64_t n_bricks = static_cast<std::int64_t>(lists.bricks.size());
  std::vector<std::size_t> table_of(n_bricks);
  for (std::size_t i = 0; i < lists.brick_of.size(); i++)
    if (lists.brick_of[i] >= 0) table_of[lists.brick_of[i]] = i;
  const auto n_cells = [&](std::int64_t b) {
    return (b + 1 < n_bricks ? lists.bricks[b + 1].layer[0].first_cell : lists.cells.size()) -
           lists.bricks[b].layer[0].first_cell;
  };

  // How many records of each kind a brick needs, then where they begin.
  std::vector<std::array<std::uint32_t, 3>> first(n_bricks + 1);
#pragma omp parallel num_threads(threads())
  {
    std::vector<FeatureCode> codes;
    Named named(grid.wall);
#pragma omp for schedule(dynamic, 64)
    for (std::int64_t b = 0; b < n_bricks; b++) {
      codes_of(grid, lists.bricks[b], n_cells(b), named, codes);
      first[b] = {0, 0, 0};
      for (FeatureCode code : codes) first[b][static_cast<int>(feature_kind(code))]++;
    }
  }
  std::array<std::uint64_t, 3> at = {0, 0, 0};
  for (std::int64_t b = 0; b <= n_bricks; b++)
    for (int k = 0; k < 3; k++)
      at[k] += std::exchange(first[b][k], static_cast<std::uint32_t>(at[k]));
  for (const std::uint64_t n : at) check_record_number(n);
  const bool with_parts = grid.list_kind.has_primitives();
  out.faces.resize(first[n_bricks][0]);
  out.face_of.resize(first[n_bricks][0]);
  if (with_parts) out.face_parts.resize(first[n_bricks][0]);
  out.edges.resize(first[n_bricks][1]);
  out.edge_of.resize(first[n_bricks][1]);
  out.vertices.resize(first[n_bricks][2]);
  out.vertex_of.resize(first[n_bricks][2]);

#pragma omp parallel num_threads(threads())
  {
    std::vector<FeatureCode> codes;
    Named named(grid.wall);
#pragma omp for schedule(dynamic, 64)
    for (std::int64_t b = 0; b < n_bricks; b++) {
      const Brick &brick = lists.bricks[b];
      codes_of(grid, brick, n_cells(b), named, codes);
      std::array<std::size_t, 4> begin;    // of each kind in `codes`
      for (int k = 0; k < 4; k++)
        begin[k] =
            std::lower_bound(codes.begin(), codes.end(), FeatureCode(k) << 30) - codes.begin();
      const auto record_code = [&](FeatureCode code) {
        const int kind = static_cast<int>(feature_kind(code));
        const std::size_t rank =
            std::lower_bound(codes.begin(), codes.end(), code) - codes.begin() - begin[kind];
        return feature_code(feature_kind(code), first[b][kind] + static_cast<std::uint32_t>(rank));
      };
      const Vec3 origin = brick_centre(grid, table_of[b]);
      for (FeatureCode code : codes) {
        const std::uint32_t i = feature_index(code), to = feature_index(record_code(code));
        switch (feature_kind(code)) {
          case FeatureKind::face:
            out.faces[to] = face_at(grid.wall.faces[i], origin);
            out.face_of[to] = i;
            if (!with_parts) break;
            for (int k = 0; k < 6; k++) {
              const FeatureCode part = grid.wall.face_parts[i].part[k];
              out.face_parts[to].part[k] = part == kNoFeature ? kNoFeature : record_code(part);
            }
            break;
          case FeatureKind::edge:
            out.edges[to] = edge_at(grid.wall.edges[i], origin);
            out.edge_of[to] = i;
            break;
          default:
            const VertexRecord &v = grid.wall.vertices[i];
            out.vertices[to] = {vec_cast<float>(v.position - origin), v.first, v.count};
            out.vertex_of[to] = i;
        }
      }
      for (std::size_t c = brick.layer[0].first_cell; c < brick.layer[0].first_cell + n_cells(b);
           c++) {
        Cell &cell = lists.cells[c];
        if (cell.count == 1)
          cell.first = record_code(cell.first);
        else
          for (std::uint32_t i = cell.first; i < cell.first + cell.count; i++)
            lists.entries[i].feature = record_code(lists.entries[i].feature);
      }
    }
  }
}

std::vector<Vec3f> floats(const std::vector<Vec3> &in)
{
  std::vector<Vec3f> out;
  out.reserve(in.size());
  for (const Vec3 &v : in) out.push_back(vec_cast<float>(v));
  return out;
}

}    // namespace

void check_record_number(std::uint64_t n)
{
  if (n > kMaxFeatures)
    throw InputError("each brick of the grid has copies of its mesh features in float, and " +
                     std::to_string(n) + " copies are more than the " +
                     std::to_string(kMaxFeatures) +
                     " that can be numbered: use precision double, or longer cells");
}

void add_brick_records(TriangleGrid &grid)
{
  BrickRecords &out = grid.records;
  add_records(grid, out);
  out.edge_inward = floats(grid.wall.edge_inward);
  out.vertex_direction = floats(grid.wall.vertex_direction);
  grid.in_floats = true;
}

}    // namespace lsdcd
