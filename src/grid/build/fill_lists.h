// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// From sorted octants to occupancy masks, cells and lists, on any backend.
#pragma once

#include "grid/build/entry_list.h"
#include "grid/build/octant_pairs.h"

#include <cstdint>

namespace lsdcd {

// The lists of one kind, in the memory of the backend.
template <class B>
struct BuiltLists {
  template <class T>
  using Array = typename B::template Array<T>;

  std::size_t n_bricks = 0, n_cells = 0, n_entries = 0;

  // Cells and entries are numbered in 32 bits.
  bool can_be_numbered() const { return n_cells <= 0xffffffffull && n_entries < 0xffffffffull; }

  Array<std::int32_t> brick_of;
  Array<Brick> bricks;
  Array<Cell> cells;
  Array<CellEntry> entries;
};

template <class B>
void find_cells_of(B &b, const BuildView &view, const std::uint32_t *octants,
                   const std::uint32_t *features, std::size_t n, std::uint64_t *met)
{
  b.for_each(
      n, [=] LSDCD_LAMBDA(std::size_t p) { met[p] = cells_met(view, features[p], octants[p]); });
}

// The cells of its octant that each pair's feature meets.
template <class B>
void find_cells_met(B &b, const BuildView &view, const OctantPairs<B> &pairs,
                    const BuildProgress &progress, std::uint64_t *met)
{
  const std::uint32_t *octants = pairs.octant.data(), *features = pairs.feature.data();
  progress.in_parts(B::kOnCpu, "finding cells", pairs.n, [&](std::size_t from, std::size_t n) {
    find_cells_of(b, view, octants + from, features + from, n, met + from);
  });
}

template <class B>
void count_cells(B &b, const OctantPairs<B> &pairs, const std::uint64_t *met, std::uint32_t most,
                 std::uint32_t *counts)
{
  const std::uint32_t *first = pairs.first.data();
  b.for_each(pairs.n_bricks * kBrickCells, [=] LSDCD_LAMBDA(std::size_t i) {
    const std::size_t octant = i / kOctantCells;
    const int k = static_cast<int>(i % kOctantCells);
    std::uint32_t n = 0;
    for (std::uint32_t p = first[octant]; p < first[octant + 1]; p++) n += met[p] >> k & 1;
    counts[octant / 8 * kBrickCells + cell_of_octant(static_cast<int>(octant % 8), k)] =
        n < most ? n : most;
  });
}

// A word is 64 cells, a layer of a brick: sums the bits of the masks.
template <class B>
void sum_words(B &b, std::size_t n_words, const std::uint32_t *counts, Brick *bricks,
               std::uint32_t *offsets, std::uint64_t *lists, std::uint64_t *cells,
               std::uint32_t *singles, std::uint32_t *longests)
{
  b.for_each(n_words, [=] LSDCD_LAMBDA(std::size_t w) {
    std::uint64_t mask = 0;
    std::uint64_t list = 0;    // may exceed 32 bits
    std::uint32_t single = 0, longest = 0;
    for (int c = 0; c < 64; c++) {
      const std::uint32_t n = counts[w * 64 + c];
      offsets[w * 64 + c] = static_cast<std::uint32_t>(list);
      if (n == 0) continue;
      mask |= std::uint64_t(1) << c;
      if (n > 1)
        list += n;
      else
        single++;
      if (n > longest) longest = n;
    }
    bricks[w / kLayers].layer[w % kLayers].mask = mask;
    lists[w] = list;
    cells[w] = static_cast<std::uint64_t>(count_bits(mask));
    singles[w] = single;
    longests[w] = longest;
  });
}

template <class B>
void finish_bricks(B &b, const OctantPairs<B> &pairs, const std::uint64_t *cells,
                   std::size_t table_size, Brick *bricks, std::int32_t *brick_of)
{
  const std::uint32_t *indices = pairs.index.data();
  put_all(b, brick_of, table_size, -1);
  b.for_each(pairs.n_bricks, [=] LSDCD_LAMBDA(std::size_t i) {
    for (int k = 0; k < kLayers; k++) {
      bricks[i].layer[k].first_cell = static_cast<std::uint32_t>(cells[i * kLayers + k]);
      bricks[i].layer[k].pad = 0;
    }
    brick_of[indices[i]] = static_cast<std::int32_t>(i);
  });
}

// The lists of n cells from a first one on.
template <class B>
void write_lists(B &b, const BuildView &view, const OctantPairs<B> &pairs, const std::uint64_t *met,
                 const std::uint32_t *counts, const std::uint32_t *offsets,
                 const std::uint64_t *lists, const Brick *bricks, std::size_t from, std::size_t n,
                 Cell *cells, CellEntry *entries)
{
  const std::uint32_t *first = pairs.first.data(), *features = pairs.feature.data(),
                      *indices = pairs.index.data();
  b.for_each(n, [=] LSDCD_LAMBDA(std::size_t of_part) {
    const std::size_t i = from + of_part, octant = i / kOctantCells, brick = octant / 8;
    const int k = static_cast<int>(i % kOctantCells),
              c = cell_of_octant(static_cast<int>(octant % 8), k);
    const std::uint32_t count = counts[brick * kBrickCells + c];
    if (count == 0) return;
    const std::uint32_t start = static_cast<std::uint32_t>(lists[brick * kLayers + (c >> 6)] +
                                                           offsets[brick * kBrickCells + c]);
    Cell out = {start, count};
    const Vec3 centre = CellCentres(view.plan, indices[brick]).at(c);
    std::uint32_t at = 0;
    for (std::uint32_t p = first[octant]; p < first[octant + 1]; p++) {
      if (!(met[p] >> k & 1)) continue;
      if (count == 1) {
        out.first = features[p];
        break;
      }
      Real distance = 0;
      if (view.test == CellTest::bounds)
        distance = PrimitiveBounds(view.wall, features[p]).least_distance(view.plan, centre);
      else
        meets(view, features[p], centre, view.plan.half_diagonal, distance);
      const CellEntry entry = make_entry(features[p], distance);
      if (count <= kLongList)
        insert_nearest(entries + start, at++, count, entry);
      else
        entries[start + at++] = entry;
    }
    if (count > kLongList) heap_sort(entries + start, count);
    cells[cell_index(bricks[brick], c)] = out;
  });
}

template <class B>
void pack_part(B &b, const EntryPacking &packing, const CellEntry *entries, std::size_t n,
               PackedEntry *packed)
{
  b.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) { packed[i] = packing.pack(entries[i]); });
}

// Makes lists of at most `most` entries a cell, the nearest to its centre, as function (1) of the paper does; `met` is what find_cells_met() has found. False if they would not fit
// `budget` bytes or cannot be numbered; `out` then has the counts only.
template <class B>
bool fill_lists(B &b, const BuildView &view, const OctantPairs<B> &pairs, const std::uint64_t *met,
                std::uint32_t most, std::size_t budget, const BuildProgress &progress,
                BuiltLists<B> &out, ListReport &report)
{
  using Built = BuiltLists<B>;
  const std::size_t n_bricks = pairs.n_bricks, n_words = n_bricks * kLayers,
                    n_cells = n_bricks * kBrickCells;
  typename B::template Scratch<std::uint64_t> list(n_words), cell(n_words);
  typename B::template Scratch<std::uint32_t> count(n_cells), offset(n_cells), single(n_words),
      longest(n_words);
  typename Built::template Array<Brick> brick(n_bricks);
  count_cells(b, pairs, met, most, count.data());
  sum_words(b, n_words, count.data(), brick.data(), offset.data(), list.data(), cell.data(),
            single.data(), longest.data());
  const std::uint64_t n_list = b.exclusive_scan(list.data(), n_words);
  const std::size_t n_occupied = b.exclusive_scan(cell.data(), n_words);
  out.n_bricks = n_bricks;
  out.n_cells = n_occupied;
  out.n_entries = n_list;
  if (!out.can_be_numbered() || grid_bytes(view.plan, n_bricks, n_occupied, n_list) > budget)
    return false;
  report = ListReport();
  report.bricks = n_bricks;
  report.cells = n_occupied;
  report.entries = n_list + b.exclusive_scan(single.data(), n_words);
  report.mean = n_occupied ? Real(report.entries) / n_occupied : 0;
  const std::uint32_t *longest_of_word = longest.data();
  report.longest = b.template largest<std::uint32_t>(
      n_words, [=] LSDCD_LAMBDA(std::size_t w) -> std::uint32_t { return longest_of_word[w]; });
  report.distance_tests = pairs.n * kOctantCells;

  out.brick_of = typename Built::template Array<std::int32_t>(view.plan.table_size());
  out.cells = typename Built::template Array<Cell>(n_occupied);
  out.entries = typename Built::template Array<CellEntry>(n_list);
  finish_bricks(b, pairs, cell.data(), view.plan.table_size(), brick.data(), out.brick_of.data());
  progress.in_parts(B::kOnCpu, "writing lists", n_cells, [&](std::size_t from, std::size_t n) {
    write_lists(b, view, pairs, met, count.data(), offset.data(), list.data(), brick.data(), from,
                n, out.cells.data(), out.entries.data());
  });
  out.bricks = std::move(brick);
  return true;
}

}    // namespace lsdcd
