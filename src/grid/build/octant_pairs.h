// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Sorting features into octants of bricks, on any backend.
#pragma once

#include "grid/build/build_progress.h"
#include "grid/build/for_each_part.h"
#include "grid/build/rasterise.h"
#include "grid/lookup/locate.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace lsdcd {

// Pairs of an octant and a feature that meets it, sorted by octant, and by feature within
// an octant.
template <class B>
struct OctantPairs {
  template <class T>
  using Scratch = typename B::template Scratch<T>;

  std::size_t n = 0, n_bricks = 0;
  Scratch<std::uint32_t> octant, feature;    // of each pair
  Scratch<std::uint32_t> index;              // of each brick, in the table
  Scratch<std::uint32_t> first;              // pair of each octant of each brick, and n
};

// A run of features, and of the parts that they are cut into: the bricks of their boxes.
struct PartRun {
  std::size_t begin, end;
  std::uint64_t first, n;
};

// Runs of at most kMaxParts parts, or of one feature.
template <class B, class Offsets>
std::vector<PartRun> part_runs(B &b, const Offsets &offset, std::size_t n, std::uint64_t n_parts)
{
  if (n_parts <= kMaxParts<B>) return {{0, n, 0, n_parts}};
  const std::vector<std::uint64_t> at = to_cpu(b, offset, n + 1);
  std::vector<PartRun> runs;
  for (std::size_t i = 0; i < n;) {
    std::size_t end = i + 1;
    while (end < n && at[end + 1] - at[i] <= kMaxParts<B>) end++;
    runs.push_back({i, end, at[i], at[end] - at[i]});
    i = end;
  }
  return runs;
}

template <class B>
void count_octants(B &b, const BuildView &view, const std::uint64_t *offsets, const PartRun &run,
                   std::uint8_t *met, std::uint32_t *counts)
{
  for_each_part(
      b, offsets, run, [=] LSDCD_LAMBDA(std::size_t i, std::uint64_t part, std::uint64_t k) {
        const FeatureCode feature = view.features[i];
        const std::uint32_t index = brick_index(view.plan, brick_box(view, feature), part);
        const unsigned octants = octants_met(view, feature, index);
        met[k] = static_cast<std::uint8_t>(octants);
        counts[k] = static_cast<std::uint32_t>(count_bits(octants));
      });
}

template <class B>
void write_octants(B &b, const BuildView &view, const std::uint64_t *offsets, const PartRun &run,
                   const std::uint8_t *met, const std::uint32_t *counts, std::size_t base,
                   std::uint32_t *octants, std::uint32_t *features)
{
  for_each_part(
      b, offsets, run, [=] LSDCD_LAMBDA(std::size_t i, std::uint64_t part, std::uint64_t k) {
        const FeatureCode feature = view.features[i];
        const std::uint32_t index = brick_index(view.plan, brick_box(view, feature), part);
        std::size_t at = base + counts[k];
        for (unsigned o = 0; o < 8; o++) {
          if (!(met[k] >> o & 1)) continue;
          octants[at] = index * 8 + o;
          features[at++] = feature;
        }
      });
}

// Numbers the bricks in order of their indices and finds where each octant begins.
template <class B>
void number_bricks(B &b, OctantPairs<B> &out)
{
  using Pairs = OctantPairs<B>;
  const std::size_t n = out.n;
  const std::uint32_t *sorted = out.octant.data();
  typename Pairs::template Scratch<std::uint32_t> run(n);
  std::uint32_t *runs = run.data();
  // A brick is a run of octants that agree but for the last three bits.
  b.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
    runs[i] = i == 0 || sorted[i] >> 3 != sorted[i - 1] >> 3;
  });
  out.n_bricks = b.exclusive_scan(runs, n);
  out.index = typename Pairs::template Scratch<std::uint32_t>(out.n_bricks);
  out.first = typename Pairs::template Scratch<std::uint32_t>(out.n_bricks * 8 + 1);
  std::uint32_t *indices = out.index.data(), *first = out.first.data();
  const std::size_t n_octants = out.n_bricks * 8;
  // Each pair writes the beginning of the octants after that of the pair before, up to its own.
  b.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
    const bool new_brick = i == 0 || sorted[i] >> 3 != sorted[i - 1] >> 3;
    const std::size_t brick = new_brick ? runs[i] : runs[i] - 1;
    if (new_brick) indices[brick] = sorted[i] >> 3;
    const std::size_t own = brick * 8 + (sorted[i] & 7);
    std::size_t from = 0;
    if (i > 0) {
      const std::size_t before = new_brick ? brick - 1 : brick;
      from = before * 8 + (sorted[i - 1] & 7) + 1;
    }
    for (std::size_t o = from; o <= own; o++) first[o] = static_cast<std::uint32_t>(i);
    if (i == n - 1)
      for (std::size_t o = own + 1; o <= n_octants; o++) first[o] = static_cast<std::uint32_t>(n);
  });
}

// False if there are more pairs than can be numbered.
template <class B>
bool sort_into_octants(B &b, const BuildView &view, std::size_t n_features,
                       const BuildProgress &progress, OctantPairs<B> &out)
{
  using Pairs = OctantPairs<B>;
  typename Pairs::template Scratch<std::uint64_t> offset(n_features + 1);
  std::uint64_t *offsets = offset.data();
  b.for_each(n_features + 1, [=] LSDCD_LAMBDA(std::size_t i) {
    offsets[i] = i < n_features ? brick_box(view, view.features[i]).count() : 0;
  });
  const std::uint64_t n_parts = b.exclusive_scan(offsets, n_features + 1);
  const std::vector<PartRun> runs = part_runs(b, offset, n_features, n_parts);
  std::uint64_t most = 0;
  for (const PartRun &run : runs) most = std::max(most, run.n);
  typename Pairs::template Scratch<std::uint32_t> count(most);
  typename Pairs::template Scratch<std::uint8_t> met(most);    // octants of each part

  // With one run the counts are kept; with more they are made once more.
  std::uint64_t n = 0;
  for (const PartRun &run : runs) {
    progress.tell("counting bricks", double(run.first) / double(n_parts + 1));
    count_octants(b, view, offsets, run, met.data(), count.data());
    n += b.exclusive_scan(count.data(), run.n);
  }
  if (n >= 0xffffffffull) return false;
  out.n = n;
  out.octant = typename Pairs::template Scratch<std::uint32_t>(n);
  out.feature = typename Pairs::template Scratch<std::uint32_t>(n);
  std::size_t base = 0;
  for (const PartRun &run : runs) {
    progress.tell("sorting into bricks", double(run.first) / double(n_parts + 1));
    std::size_t in_run = n;
    if (runs.size() > 1) {
      count_octants(b, view, offsets, run, met.data(), count.data());
      in_run = b.exclusive_scan(count.data(), run.n);
    }
    write_octants(b, view, offsets, run, met.data(), count.data(), base, out.octant.data(),
                  out.feature.data());
    base += in_run;
  }
  b.sort_pairs(out.octant, out.feature, static_cast<std::uint32_t>(view.plan.table_size() * 8 - 1));
  number_bricks(b, out);
  return true;
}

}    // namespace lsdcd
