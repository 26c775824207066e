// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How many times a closed surface winds around a point, without rounding and at any distance.
#pragma once

#include "base/progress.h"
#include "geometry/triangles_meet.h"
#include "mesh/box.h"
#include "mesh/box_tree.h"
#include "mesh/welded_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

// Along every edge as many facets run one way as the other. Shells may cut, touch and contain each
// other. Where two facets have the same corners and opposite windings neither counts, as in a sheet; where
// they are wound alike, one does. Sheets may not enclose a space, as those of a double-sided export do, and
// there must be more than sheets.
bool has_inside(const WeldedMesh &mesh);

// Why it has none: facets or edges, where the first is, and the remedy. Empty where it has.
std::string why_no_inside(const WeldedMesh &mesh);

// It copies what it needs of the mesh, and any number of threads may ask it at once.
//
// A point's number is that of another point plus the facets that their connection crosses. Cells
// without facets know theirs. From another cell a ray goes along an axis to such a cell; where that
// passes many facets, a tree finds those near it. Signs of orientation() decide what it crosses. Where
// it meets an edge, the point is taken to be moved by e along one other axis and by e^2 along the next,
// with e below any number (Edelsbrunner and Muecke 1990).
class WindingNumber {
 public:
  // Throws InputError, with why_no_inside(), where a mesh has no inside.
  explicit WindingNumber(const WeldedMesh &mesh, const ProgressListener &progress = {});
  // The facets of a closed surface: along every edge as many run one way as the other.
  explicit WindingNumber(std::vector<Triangle> closed, const ProgressListener &progress = {});

  // 1 inside a shell whose normals point out, -1 inside one whose normals point in; the sum for
  // several. On the surface, also of a sheet, only `on_surface` is set.
  struct Answer {
    bool on_surface;
    int number;
  };
  Answer at(const Vec3 &q) const;

  // -1 where the number is not 0, that is inside; 1 outside, and on the surface. A cavity whose normals
  // point into it is outside, a shell of either winding inside.
  int side(const Vec3 &q) const
  {
    const Answer a = at(q);
    return a.on_surface || a.number == 0 ? 1 : -1;
  }

  const std::vector<Triangle> &facets() const { return facets_; }
  std::size_t bytes() const;

 private:
  using Index = std::array<int, 3>;
  // Without facets, `first` is kEmpty and `number` that of all its points. With facets, these are
  // `listed_` from `first` on.
  struct Cell {
    std::uint32_t first;
    std::int32_t number;    // of times, or of facets
  };
  // A ray along an axis, and where it ends; without an end it leaves the box.
  struct Ray {
    Vec3 from, end;
    int axis;
    bool up, ends;
  };
  static constexpr std::uint32_t kEmpty = 0xffffffffu;

  Real largest_coordinate() const;
  void choose_cells();
  void list_facets(const ProgressListener &progress);
  std::uint32_t choose_directions(const ProgressListener &progress);
  void build_tree();
  void number_empty_cells(const ProgressListener &progress);
  Answer walk(const Vec3 &q, const Index &at, int direction) const;
  static int crossing(const Triangle &facet, const Ray &ray, bool &on_surface);

  int cell_along(int axis, Real x) const
  {
    const int i = static_cast<int>((x - box_.lo[axis]) * per_length_[axis]);
    return i < n_[axis] ? i : n_[axis] - 1;
  }
  std::size_t cell_number(const Index &at) const
  {
    return (static_cast<std::size_t>(at[0]) * n_[1] + at[1]) * n_[2] + at[2];
  }

  std::vector<Triangle> facets_;
  Box box_;
  Index n_ = {1, 1, 1};    // cells along each axis
  Vec3 length_ = {0, 0, 0}, per_length_ = {0, 0, 0};
  std::array<std::ptrdiff_t, 3> stride_ = {0, 0, 0};
  std::vector<Cell> cells_;
  std::vector<std::uint8_t> direction_;    // of the ray from a cell with facets: 2 axis + (1: down)
  std::vector<std::uint32_t> listed_;
  std::unique_ptr<const BoxTree> tree_;    // of facets, where some cells have many
};

}    // namespace lsdcd
