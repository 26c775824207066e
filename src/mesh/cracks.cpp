// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/cracks.h"

#include "mesh/box.h"
#include "mesh/hash_index.h"
#include "mesh/union_find.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace lsdcd {

namespace {

constexpr int kNone = -1;

Real distance(const Vec3 &a, const Vec3 &b)
{
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);    // squares might underflow
}

Real diagonal(const Box &box)
{
  return distance(box.lo, box.hi);
}

int n_faces(const WeldedMesh &mesh, std::size_t edge)
{
  return mesh.edge_first[edge + 1] - mesh.edge_first[edge];
}

// The vertices, ascending, of edges and points that close nothing: those of an odd number of faces, or of none.
std::vector<int> open_vertices(const WeldedMesh &mesh)
{
  std::vector<char> is_open(mesh.vertices.size(), 1);    // until a face is there
  for (const auto &face : mesh.faces)
    for (const int v : face) is_open[v] = 0;
  for (std::size_t e = 0; e < mesh.edges.size(); e++)
    if (n_faces(mesh, e) % 2 == 1)
      for (const int v : mesh.edges[e]) is_open[v] = 1;
  std::vector<int> open;
  for (std::size_t v = 0; v < is_open.size(); v++)
    if (is_open[v]) open.push_back(static_cast<int>(v));
  return open;
}

// A grid of cubes, in several widths: widths are powers of two.
struct Cell {
  std::int64_t i, j, k;
  int width;

  bool operator==(const Cell &c) const
  {
    return i == c.i && j == c.j && k == c.k && width == c.width;
  }
};

class Cells {
 public:
  explicit Cells(const Box &box) : lo_(box.lo)
  {
    const Vec3 size = box.hi - box.lo;
    const Real extent = std::max({size.x, size.y, size.z});
    if (extent > 0) least_ = std::ilogb(extent) - 50;    // so that numbers are exact integers
  }

  // The width of cells that are some `reach` wide.
  int width_for(Real reach) const { return std::max(std::ilogb(reach) + 3, least_); }

  // Calls f(number) for each cell within `reach` of x; `add`: cells that nobody has asked for yet get a number.
  template <class F>
  void for_near(const Vec3 &x, Real reach, int width, bool add, const F &f)
  {
    const Vec3 past = {reach, reach, reach};
    const Cell lo = cell_of(x - past, width), hi = cell_of(x + past, width);
    for (std::int64_t i = lo.i; i <= hi.i; i++)
      for (std::int64_t j = lo.j; j <= hi.j; j++)
        for (std::int64_t k = lo.k; k <= hi.k; k++) {
          const int c = number({i, j, k, width}, add);
          if (c != kNone) f(c);
        }
  }
  std::size_t size() const { return cells_.size(); }

 private:
  Cell cell_of(const Vec3 &x, int width) const
  {
    const auto at = [&](int axis) {
      return static_cast<std::int64_t>(std::floor(std::ldexp(x[axis] - lo_[axis], -width)));
    };
    return {at(0), at(1), at(2), width};
  }
  int number(const Cell &cell, bool add)
  {
    constexpr auto kWidth = std::int64_t(1) << 52;    // beyond the numbers of cells
    const std::uint64_t hash =
        hash_three(cell.i, cell.j, cell.k ^ std::int64_t(cell.width) * kWidth);
    const auto is_same = [&](int c) { return cells_[c] == cell; };
    if (!add) return table_.find(hash, is_same);
    const int fresh = static_cast<int>(cells_.size());
    const int c = table_.find_or_insert(hash, fresh, is_same);
    if (c == fresh) cells_.push_back(cell);
    return c;
  }

  Vec3 lo_;
  int least_ = std::numeric_limits<Real>::min_exponent;
  HashIndex table_;
  std::vector<Cell> cells_;
};

// What edges connect, and of what has open vertices, parts of these: nearer to each other than 1e-6 of the part.
class Parts {
 public:
  Parts(const WeldedMesh &mesh, const std::vector<int> &open) :
      mesh_(mesh), connected_(mesh.vertices.size())
  {
    for (const auto &edge : mesh.edges) connected_.join(edge[0], edge[1]);
    std::vector<int> piece_of(mesh.vertices.size(), kNone);
    for (std::size_t v = 0; v < mesh.vertices.size(); v++) {
      const int root = connected_.of(static_cast<int>(v));
      if (piece_of[root] == kNone) {
        piece_of[root] = static_cast<int>(pieces_.size());
        pieces_.push_back({{mesh.vertices[v], mesh.vertices[v]}, {}, 0});
      }
      extend(pieces_[piece_of[root]].box, mesh.vertices[v]);
    }
    for (const int v : open) pieces_[piece_of[connected_.of(v)]].open.push_back(v);
    std::vector<int> all(pieces_.size());
    std::iota(all.begin(), all.end(), 0);
    divide(std::move(all));
    tolerance_.reserve(open.size());
    for (const int v : open) tolerance_.push_back(pieces_[piece_of[connected_.of(v)]].tolerance);
  }

  const std::vector<Real> &tolerance() const { return tolerance_; }    // of each open vertex
  Real largest() const { return largest_; }

 private:
  struct Piece {
    Box box;
    std::vector<int> open;
    Real tolerance;
  };

  void divide(std::vector<int> all)
  {
    std::vector<std::vector<int>> to_do = {std::move(all)};
    while (!to_do.empty()) {
      const std::vector<int> some = std::move(to_do.back());
      to_do.pop_back();
      Box box = pieces_[some[0]].box;
      for (const int p : some) {
        extend(box, pieces_[p].box.lo);
        extend(box, pieces_[p].box.hi);
      }
      const Real tolerance = kDefaultWeld * diagonal(box);
      std::vector<std::vector<int>> apart;
      if (some.size() > 1 && tolerance > 0) apart = linked(some, box, tolerance);
      if (apart.size() > 1) {
        for (auto &part : apart) to_do.push_back(std::move(part));
        continue;
      }
      for (const int p : some) pieces_[p].tolerance = tolerance;
      largest_ = std::max(largest_, tolerance);
    }
  }

  // Pieces with open vertices in the same cell are linked: those that are `gap` apart, and some that are several.
  std::vector<std::vector<int>> linked(const std::vector<int> &some, const Box &box, Real gap)
  {
    Cells cells(box);
    const int width = cells.width_for(gap);
    UnionFind links(some.size());
    std::vector<int> first;    // in each cell
    for (std::size_t i = 0; i < some.size(); i++)
      for (const int v : pieces_[some[i]].open)
        cells.for_near(mesh_.vertices[v], gap / 2, width, true, [&](int c) {
          if (c == static_cast<int>(first.size())) first.push_back(static_cast<int>(i));
          links.join(first[c], static_cast<int>(i));
        });
    std::vector<int> part_of(some.size(), kNone);
    std::vector<std::vector<int>> parts;
    for (std::size_t i = 0; i < some.size(); i++) {
      const int root = links.of(static_cast<int>(i));
      if (part_of[root] == kNone) {
        part_of[root] = static_cast<int>(parts.size());
        parts.emplace_back();
      }
      parts[part_of[root]].push_back(some[i]);
    }
    return parts;
  }

  const WeldedMesh &mesh_;
  UnionFind connected_;
  std::vector<Piece> pieces_;
  std::vector<Real> tolerance_;
  Real largest_ = 0;
};

// Of each vertex of `open`, the shortest edge of a face there.
std::vector<Real> shortest_edges(const WeldedMesh &mesh, const std::vector<int> &open)
{
  std::vector<int> number(mesh.vertices.size(), kNone);
  for (std::size_t i = 0; i < open.size(); i++) number[open[i]] = static_cast<int>(i);
  std::vector<Real> shortest(open.size(), std::numeric_limits<Real>::infinity());
  for (std::size_t e = 0; e < mesh.edges.size(); e++) {
    const auto &ends = mesh.edges[e];
    if (n_faces(mesh, e) == 0 || (number[ends[0]] == kNone && number[ends[1]] == kNone)) continue;
    const Real length = distance(mesh.vertices[ends[0]], mesh.vertices[ends[1]]);
    for (const int v : ends)
      if (number[v] != kNone) shortest[number[v]] = std::min(shortest[number[v]], length);
  }
  return shortest;
}

struct Pair {
  Real apart;
  int a, b;    // of the open vertices; a < b

  bool operator<(const Pair &p) const
  {
    return std::tie(apart, a, b) < std::tie(p.apart, p.a, p.b);
  }
};

// Pairs of points that are within the limits of both, the nearest first. Where limits are a part of the distance to
// others few points are in a cell as wide as their limit.
std::vector<Pair> near_pairs(const std::vector<Vec3> &x, const std::vector<Real> &limit)
{
  Box box = {x[0], x[0]};
  for (const Vec3 &at : x) extend(box, at);
  Cells cells(box);
  std::vector<int> widths, first, next(x.size(), kNone);
  for (std::size_t i = 0; i < x.size(); i++) {
    if (!(limit[i] > 0)) continue;
    const int width = cells.width_for(limit[i]);
    widths.push_back(width);
    cells.for_near(x[i], 0, width, true, [&](int c) {
      if (c == static_cast<int>(first.size())) first.push_back(kNone);
      next[i] = first[c];
      first[c] = static_cast<int>(i);
    });
  }
  std::sort(widths.begin(), widths.end());
  widths.erase(std::unique(widths.begin(), widths.end()), widths.end());

  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < x.size(); i++) {
    if (!(limit[i] > 0)) continue;
    const int a = static_cast<int>(i), own = cells.width_for(limit[i]);
    for (auto width = std::lower_bound(widths.begin(), widths.end(), own); width != widths.end();
         ++width)
      cells.for_near(x[i], 1.001 * limit[i], *width, false, [&](int c) {
        for (int b = first[c]; b != kNone; b = next[b]) {
          // A pair in cells of one width is found from both.
          if (a == b || (*width == own && b < a)) continue;
          const Real apart = distance(x[a], x[b]);
          if (apart <= std::min(limit[a], limit[b]))
            pairs.push_back({apart, std::min(a, b), std::max(a, b)});
        }
      });
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}    // namespace

Cracks find_cracks(const WeldedMesh &mesh, const FileRounding &rounding)
{
  Cracks cracks;
  const std::vector<int> open = open_vertices(mesh);
  const Parts parts(mesh, open);
  cracks.tolerance = parts.largest();
  if (open.empty()) return cracks;

  const std::vector<Real> shortest = shortest_edges(mesh, open);
  std::vector<Vec3> x;
  std::vector<Real> limit;
  for (std::size_t i = 0; i < open.size(); i++) {
    x.push_back(mesh.vertices[open[i]]);
    const Real step = rounding.at(x[i]), less_than_half = 0.499 * shortest[i];
    limit.push_back(std::max(std::min(parts.tolerance()[i], shortest[i] / 4),
                             std::min(2 * step, less_than_half)));
    if (2 * step <= less_than_half) continue;
    cracks.coarse++;
    cracks.step = std::max(cracks.step, step);
  }

  // Groups of points that are one, each a list from its first.
  std::vector<int> group(open.size()), next(open.size(), kNone), last(open.size());
  std::iota(group.begin(), group.end(), 0);
  std::iota(last.begin(), last.end(), 0);
  for (const Pair &pair : near_pairs(x, limit)) {
    int to = group[pair.a], from = group[pair.b];
    if (to == from) continue;
    if (to > from) std::swap(to, from);
    bool fits = true;
    for (int i = from; i != kNone && fits; i = next[i])
      fits = distance(x[i], x[to]) <= std::min(limit[i], limit[to]);
    if (!fits) continue;
    for (int i = from; i != kNone; i = next[i]) group[i] = to;
    next[last[to]] = from;
    last[to] = last[from];
  }
  for (std::size_t i = 0; i < open.size(); i++) {
    if (group[i] == static_cast<int>(i)) continue;
    if (cracks.closed++ == 0) {
      cracks.onto.resize(mesh.vertices.size());
      std::iota(cracks.onto.begin(), cracks.onto.end(), 0);
    }
    cracks.onto[open[i]] = open[group[i]];
    cracks.widest = std::max(cracks.widest, distance(x[i], x[group[i]]));
  }
  return cracks;
}

}    // namespace lsdcd
