// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the features of the wall that a sphere could touch after a short way, from the cells near it.
#pragma once

#include "backend/warp.h"
#include "contact/mesh_geometry.h"
#include "geometry/wall_records.h"
#include "grid/lookup/occupied_within.h"

namespace lsdcd {

// Iterates over the cells that a ball meets and that have entries.
class CellsInBall {
 public:
  // `mine` false: there are no cells. With a radius of 0 it is the cell that holds q.
  LSDCD_FN CellsInBall(bool mine, const GridView &grid, const Vec3 &q, Real radius)
  {
    if (radius > 0) {
      open_ = mine && cells_in_ball(grid, q, radius, lo_, hi_);
    } else {
      const CellIndex p = cell_index_of(grid, q);
      open_ = mine && p.inside;
      const int at[3] = {p.i, p.j, p.k};
      for (int d = 0; d < 3; d++) hi_[d] = (lo_[d] = open_ ? at[d] : 0) + 1;
    }
    i_ = lo_[0] - 1;
    j_ = lo_[1];
    k_ = lo_[2];
  }
  LSDCD_FN void close() { open_ = false; }
  // Gives the next cell. Returns false if there is none left.
  LSDCD_FN bool next(const GridView &grid, Cell &cell)
  {
    while (open_ && step()) {
      const Brick *brick = brick_at(grid, i_, j_, k_);
      const int in_brick = cell_in_brick(i_, j_, k_);
      if (!brick || !has_entries(*brick, in_brick)) continue;
      cell = grid.lists.cells[cell_index(*brick, in_brick)];
      return true;
    }
    return open_ = false;
  }
  LSDCD_FN Vec3 centre(const GridView &grid) const
  {
    const Real half = Real(0.5);
    return grid.origin + grid.length * Vec3{i_ + half, j_ + half, k_ + half};
  }

 private:
  LSDCD_FN bool step()
  {
    if (++i_ < hi_[0]) return true;
    i_ = lo_[0];
    if (++j_ < hi_[1]) return true;
    j_ = lo_[1];
    return ++k_ < hi_[2];
  }

  bool open_;
  int lo_[3] = {0, 0, 0}, hi_[3] = {0, 0, 0}, i_, j_, k_;
};

// The number of entries by which a CPU requests records ahead.
constexpr std::uint32_t kAhead = 8;

// Returns where the list of a cell with more than one entry begins.
inline const void *first_entry(const GridView &grid, const Cell &cell)
{
  if (grid.lists.packed) return grid.lists.packed + cell.first;
  return grid.lists.entries + cell.first;
}

// Prefetches, on a CPU, the first entries of a sphere at q, whose turn comes soon.
inline void prefetch_entries(const GridView &grid, const Vec3 &q)
{
  CellAddress at;
  Cell cell;
  if (!find_cell(grid, q, at, cell)) return;
  if (cell.count > 1) __builtin_prefetch(first_entry(grid, cell));
  asm volatile("");    // as in prefetch()
}

// Prefetches, on a CPU, what a search from q will read first. It works part by part, because each part is found
// in the one before: the brick's number, the brick, the cell, its first entries, their records. So many
// searches wait for one part at the same time.
class SearchAhead {
 public:
  static constexpr int kParts = 5;

  SearchAhead() = default;
  SearchAhead(const GridView &grid, const Vec3 &q)
  {
    const CellIndex p = cell_index_of(grid, q);
    if (!p.inside) return;
    in_brick_ = cell_in_brick(p);
    at_ = grid.lists.brick_of + brick_index(grid, p);
  }

  // Prefetches part 0, then 1, and so on.
  void prefetch(const GridView &grid, int part)
  {
    if (!at_) return;
    if (part == 1) {
      const std::int32_t brick = *static_cast<const std::int32_t *>(at_);
      at_ = brick < 0 ? nullptr : grid.lists.bricks[brick].layer + (in_brick_ >> 6);
    } else if (part == 2) {
      const BrickLayer &layer = *static_cast<const BrickLayer *>(at_);
      at_ =
          has_entries(layer, in_brick_) ? grid.lists.cells + cell_index(layer, in_brick_) : nullptr;
    } else if (part == 3) {
      const Cell cell = *static_cast<const Cell *>(at_);
      n_ = cell.count < kAhead ? cell.count : kAhead;
      at_ = first_entry(grid, cell);
      if (n_ == 1) {    // the cell has it inline
        lsdcd::prefetch(grid.wall, cell.first);
        at_ = nullptr;
      }
    } else if (part == 4) {
      for (std::uint32_t i = 0; i < n_; i++)
        lsdcd::prefetch(grid.wall,
                        grid.lists.packed
                            ? grid.lists.packing.feature(static_cast<const PackedEntry *>(at_)[i])
                            : static_cast<const CellEntry *>(at_)[i].feature);
      return;
    }
    __builtin_prefetch(at_);
  }

 private:
  const void *at_ = nullptr;    // address to prefetch; null: there is nothing left
  std::int32_t in_brick_ = 0;
  std::uint32_t n_ = 0;
};

// A search for the features that a sphere at q could touch after moving by up to `margin`. Lengths.
struct FeatureSearch {
  Vec3 q;
  Real cutoff, margin;
  Real past;     // radius around q of the cells that are searched
  Real close;    // the search ends when an entry may be nearer
};

// Calls found(code) for each feature until that returns false; returns true if it never did. No feature is
// missed: a contact on the way is in the complete list of the cell in which the sphere is at that time, that
// cell meets the ball around q, and lists of cells are valid for a margin of their own. Each thread of a warp
// has a search, or none if it is not `mine`. The threads share the entries; found() gets those of the thread's
// own search.
template <unsigned kSize, class Found>
LSDCD_FN bool for_each_within(const Warp<kSize> &warp, bool mine, const GridView &grid,
                              const FeatureSearch &search, const Found &found)
{
  using Entries = PackedEntries;
  const Entries entries(grid.lists);
  // Each half-space of a feature's region moves by the margin at most; one more tolerance covers rounding.
  const Real more = search.margin + MeshGeometry::tolerance(grid),
             within = (1 + Real(2e-6)) * search.cutoff + more;
  CellsInBall cells(mine, grid, search.q, search.past);
  std::uint32_t at = 0, end = 0;    // the entries of the cell that are left
  Entries::Limit enough = {};       // no entry past this bound is near
  bool complete = true;
  for (;;) {
    Cell cell = {};
    while (at == end && cells.next(grid, cell)) {
      if (cell.count == 1) {
        if (!MeshGeometry(grid, search.q).may_be_closest(cell.first, within, more)) continue;
        complete = found(cell.first);
      } else {
        // A list ascends in its bounds on the distance from the cell's centre.
        const Real away = norm(search.q - cells.centre(grid));
        const Entries::Entry least = entries[cell.first];
        enough = entries.limit(within + away);
        complete = !(entries.is_below(least, away, search.close));
        if (complete && entries.is_within(least, enough)) {
          at = cell.first;
          end = at + cell.count;
          MeshGeometry::prefetch(grid, entries, at, cell.count < kAhead ? cell.count : kAhead);
        }
      }
      if (!complete) cells.close();
    }
    const unsigned busy = warp.vote(at < end);
    if (busy == 0) return complete;
    const WorkSplit<kSize> split(warp, busy);
    const Vec3 q = warp.of(search.q, split.owner);
    const Entries::Limit its_enough = warp.of(enough, split.owner);
    const Real its_within = warp.of(within, split.owner), its_more = warp.of(more, split.owner);
    const std::uint32_t c = warp.of(at, split.owner) + split.turn,
                        c_end = warp.of(end, split.owner);
    bool near = split.helps && c < c_end;
    if (near && c + kAhead < c_end) MeshGeometry::prefetch(grid, entries, c + kAhead, 1);
    const Entries::Entry entry = near ? entries[c] : Entries::Entry();
    near = near && entries.is_within(entry, its_enough);
    const FeatureCode its_code = entries.feature(entry);
    unsigned hits =
        warp.vote(near && MeshGeometry(grid, q).may_be_closest(its_code, its_within, its_more)) &
        split.own;
    const bool all_near = (warp.vote(near) & split.own) == split.own;
    if (at < end) at = all_near ? at + split.size : end;
    for (; warp.vote(hits != 0); hits &= hits - 1) {
      const FeatureCode code = warp.of(its_code, warp.first(hits));
      if (hits == 0 || found(code)) continue;
      complete = false;
      cells.close();
      at = end;
      hits = 0;
    }
  }
}

}    // namespace lsdcd
