// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "grid/triangle_grid.h"

#include "base/array_list.h"
#include "base/give_back_memory.h"
#include "base/number_words.h"

#include <cstdio>
#include <cstring>
#include <type_traits>

namespace lsdcd {

namespace {

constexpr std::size_t kAlign = 64;

std::size_t rounded(std::size_t bytes)
{
  return (bytes + kAlign - 1) / kAlign * kAlign;
}

constexpr int kArrays = count_arrays<GridView>();

// Front of a flat block: the scalars in a view without pointers, and where each
// array starts (0: it is empty).
struct FlatHeader {
  GridView scalars;
  std::uint64_t offset[kArrays];
};

// So many bytes of records fit the cache of one core beside the spheres of a step.
constexpr std::size_t kCacheBytes = std::size_t(1) << 20;

std::string amount(double bytes)
{
  char text[32];
  if (bytes < 1e6)
    std::snprintf(text, sizeof text, "%.1f kB", bytes / 1e3);
  else
    std::snprintf(text, sizeof text, "%.1f MB", bytes / 1e6);
  return text;
}

template <class Grid>
std::size_t bytes_of_arrays(const Grid &grid)
{
  std::size_t total = rounded(sizeof(FlatHeader));
  GridView::each_array(grid, [&](const auto &a) { total += rounded(array_bytes(a)); });
  return total;
}

// Puts each array where it belongs in the block by copy(array, address).
template <class Grid, class Copy>
void flatten_arrays(Grid &grid, char *block, const Copy &copy)
{
  // Copied from zeroed memory, so that equal grids make equal blocks.
  FlatHeader header;
  std::memset(static_cast<void *>(&header), 0, sizeof header);
  header.scalars = grid.view();
  const void *nowhere[kArrays] = {};
  point(header.scalars, nowhere);
  std::size_t at = rounded(sizeof(FlatHeader));
  int i = 0;
  GridView::each_array(grid, [&](auto &a) {
    const std::size_t bytes = array_bytes(a);
    header.offset[i++] = bytes > 0 ? at : 0;
    if (bytes > 0) copy(a, block + at);
    std::memset(block + at + bytes, 0, rounded(bytes) - bytes);
    at += rounded(bytes);
  });
  header.scalars.block_bytes = at;
  std::memset(block, 0, rounded(sizeof header));
  std::memcpy(block, &header, sizeof header);
}

template <class Grid>
void copy_arrays(const Grid &grid, char *block)
{
  flatten_arrays(grid, block,
                 [](const auto &a, char *to) { std::memcpy(to, a.data(), array_bytes(a)); });
}

}    // namespace

Vec3 brick_centre(const TriangleGrid &grid, std::size_t index)
{
  const std::size_t nx = grid.n_bricks[0], ny = grid.n_bricks[1];
  const Real side = kBrickSide * grid.length, half = Real(0.5);
  const std::size_t x = index % nx, y = index / nx % ny, z = index / nx / ny;
  return grid.origin + side * Vec3{x + half, y + half, z + half};
}

GridView TriangleGrid::view() const
{
  GridView v = {};
  v.wall = wall.view();
  v.origin = origin;
  v.length = length;
  v.inv_length = 1 / length;
  v.cutoff = cutoff;
  v.tolerance = tolerance;
  v.margin = margin;
  v.outside = outside;
  v.list_kind = list_kind;
  v.in_floats = in_floats;
  v.is_large =
      array_bytes(wall.faces) + array_bytes(wall.edges) + array_bytes(wall.vertices) > kCacheBytes;
  for (int k = 0; k < 3; k++) v.n_bricks[k] = n_bricks[k];
  point_to(v, *this);
  v.lists.packing = lists.packing;
  return v;
}

std::size_t flat_bytes(const TriangleGrid &grid)
{
  return bytes_of_arrays(grid);
}
std::size_t flat_bytes(const GridParts &grid)
{
  return bytes_of_arrays(grid);
}

std::size_t flat_wall_bytes(const TriangleGrid &grid)
{
  std::size_t total = rounded(sizeof(FlatHeader)) + kArrays * kAlign;
  MeshFeaturesView::each_array(grid.wall, [&](const auto &a) { total += rounded(array_bytes(a)); });
  return total;
}

std::size_t budget_of(const GridSettings &settings, const TriangleGrid &grid)
{
  return settings.memory_budget > 0 ? settings.memory_budget : kListBudget + flat_wall_bytes(grid);
}

void flatten(const TriangleGrid &grid, char *block)
{
  copy_arrays(grid, block);
}
void flatten(const GridParts &grid, char *block)
{
  copy_arrays(grid, block);
}

void move_flat(TriangleGrid &grid, char *block)
{
  flatten_arrays(grid, block, [](auto &a, char *to) {
    const bool large = array_bytes(a) > (1 << 20);
    move_and_release(a.data(), a.size(), [&](const auto *begin, const auto *end) {
      std::memcpy(to, begin, (end - begin) * sizeof *begin);
      to += (end - begin) * sizeof *begin;
    });
    std::decay_t<decltype(a)>().swap(a);
    if (large) give_back_memory();
  });
}

GridView flat_view(const char *block)
{
  FlatHeader header;
  std::memcpy(static_cast<void *>(&header), block, sizeof header);
  const void *at[kArrays];
  for (int i = 0; i < kArrays; i++)
    at[i] = header.offset[i] > 0 ? block + header.offset[i] : nullptr;
  GridView v = header.scalars;
  point(v, at);
  v.block = block;
  return v;
}

GridView moved_view(const GridView &view, const char *to)
{
  GridView moved = view;
  GridView::each_array(moved, [&](auto *&pointer) {
    if (pointer)
      pointer = reinterpret_cast<std::remove_reference_t<decltype(pointer)>>(
          to + (reinterpret_cast<const char *>(pointer) - view.block));
  });
  moved.block = to;
  return moved;
}

std::string describe(const GridReport &r)
{
  char text[1024];
  int n = std::snprintf(text, sizeof text, "  grid %.6g (%s", r.length,
                        r.length_chosen ? "chosen" : "given");
  if (r.too_fine > 0)
    n += std::snprintf(text + n, sizeof text - n, "; %.6g takes too much time or memory",
                       r.too_fine);
  n += std::snprintf(text + n, sizeof text - n, "), cutoff %.6g: ", r.cutoff);
  if (r.list_kind.is_every())
    n += std::snprintf(text + n, sizeof text - n, "every triangle, ");
  else if (r.list_kind.has_primitives())
    n += std::snprintf(text + n, sizeof text - n, "the nearest %u and a bound, ",
                       r.list_kind.most());
  const ListReport &l = r.lists;
  n += std::snprintf(text + n, sizeof text - n, "%s, %s, %s, lists %.2f on average, %zu at most",
                     counted(l.bricks, "brick").c_str(), counted(l.cells, "cell").c_str(),
                     counted(l.entries, "entry", "entries").c_str(), l.mean, l.longest);
  if (r.records > 0)
    n += std::snprintf(text + n, sizeof text - n, "\n  %zu features in float, by brick, %s",
                       r.records, amount(double(r.record_bytes)).c_str());
  std::snprintf(
      text + n, sizeof text - n, "\n  %s, built in %.3f s with %.3g distance tests at most on %s",
      amount(double(r.bytes)).c_str(), r.seconds, double(l.distance_tests), r.device.c_str());
  return text;
}

}    // namespace lsdcd
