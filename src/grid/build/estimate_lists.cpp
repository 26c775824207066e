// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "grid/build/estimate_lists.h"

#include "backend/bits.h"
#include "backend/threads.h"
#include "grid/build/rasterise.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

// A part is one brick of a feature's box. This many parts are sampled, or this share of all, so that
// the estimate is much quicker than the build.
constexpr std::uint64_t kMaxSamples = 1 << 14, kMinSamples = 256, kOneOf = 64;
constexpr double kPartWork = 8;    // the time to look at a part, in distance tests

struct Sum {
  double n = 0, total = 0, squares = 0;

  void add(double x)
  {
    n++;
    total += x;
    squares += x * x;
  }
  double mean() const { return total / n; }
  // Four standard errors below the mean.
  double least() const
  {
    const double variance = std::max(0., squares / n - mean() * mean());
    return std::max(0., mean() - 4 * std::sqrt(variance / n));
  }
};

}    // namespace

ListEstimate estimate_lists(const MeshFeatures &wall, const GridPlan &plan, bool primitives)
{
  const std::vector<FeatureCode> &features = primitives ? wall.primitives : wall.contact_features;
  BuildView view = {};
  view.wall = wall.view();
  view.features = features.data();
  view.test = primitives ? CellTest::distances : CellTest::regions;
  view.plan = plan;

  const std::int64_t n = static_cast<std::int64_t>(features.size());
  std::uint64_t n_parts = 0;
#pragma omp parallel for schedule(static) num_threads(threads()) reduction(+ : n_parts) if (n > 4096)
  for (std::int64_t i = 0; i < n; i++) n_parts += brick_box(view, features[i]).count();
  const std::uint64_t n_samples = std::min(kMaxSamples, n_parts / kOneOf);
  if (n_samples < kMinSamples) return {};

  // One part of each run of parts, by multiples of the golden ratio, which no mesh repeats.
  const double run = double(n_parts) / double(n_samples);
  const auto sample_at = [&](std::uint64_t s) {
    const double within = double(s) * 0.6180339887498949;
    return static_cast<std::uint64_t>((double(s) + within - std::floor(within)) * run);
  };
  Sum entries, pairs;
  std::uint64_t first = 0, sample = 0;
  for (std::int64_t i = 0; i < n && sample < n_samples; i++) {
    const BrickBox box = brick_box(view, features[i]);
    const std::uint64_t end = first + box.count();
    for (; sample < n_samples && sample_at(sample) < end; sample++) {
      const std::uint32_t index = brick_index(plan, box, sample_at(sample) - first);
      const unsigned octants = octants_met(view, features[i], index);
      int cells = 0;
      for (unsigned o = 0; o < 8; o++)
        if (octants >> o & 1) cells += count_bits(cells_met(view, features[i], index * 8 + o));
      entries.add(cells);
      pairs.add(count_bits(octants));
    }
    first = end;
  }
  const double all = double(n_parts);
  return {all * entries.mean(), all * entries.least(), all * pairs.least(),
          all * (kPartWork + kOctantCells * pairs.mean())};
}

BuildEstimate estimate_build(const MeshFeatures &wall, const GridPlan &plan,
                             const AnyGridSettings &settings)
{
  BuildEstimate out;
  if (!std::isfinite(plan.least_bytes())) return out;
  const ListEstimate lists = estimate_lists(wall, plan, settings.list_kind().has_primitives());
  constexpr double kMaxNumbers = 0xffffffff;
  if (lists.least_pairs > kMaxNumbers) out.least_bytes = out.enough_bytes = HUGE_VAL;
  out.work = lists.work;
  const bool cut_short = settings.list_kind().has_primitives() && !settings.list_kind().is_every();
  if (!cut_short && lists.least_entries > kMaxNumbers)
    out.least_bytes = out.enough_bytes = HUGE_VAL;
  // A cell that holds a single entry has it inline, and is counted as one.
  static_assert(sizeof(CellEntry) == sizeof(Cell), "counted as one");
  if (!cut_short) out.least_bytes += lists.least_entries * sizeof(CellEntry);
  out.enough_bytes += 1.25 * lists.entries * sizeof(CellEntry);
  return out;
}

}    // namespace lsdcd
