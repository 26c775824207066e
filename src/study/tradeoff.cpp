// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "study/tradeoff.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "grid/flat_grid.h"
#include "grid/plan/grid_plan.h"
#include "study/drift.h"
#include "study/lengths_to_try.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace lsdcd {

namespace {

// Ends a build for which there is no time.
struct TooLate {};

constexpr int kGpuFactor = 50;    // times the spheres, to fill a GPU several times

ContactLaw law_to_time()
{
  ContactLaw law;
  law = classic_law(NormalModel::hooke, true);
  law.k_normal = 1e5;
  law.k_tangent = 3e4;
  law.eta = 50;
  law.gamma_tangent = 25;
  law.mu = 0.5;
  return law;
}

class Measuring {
 public:
  Measuring(const WeldedMesh &mesh, const TradeoffSettings &settings,
            const std::function<void(const TradeoffRow &)> &progress) :
      mesh_(mesh),
      settings_(settings), progress_(progress)
  {
    grid_settings_.cutoff = *std::max_element(settings.radii.begin(), settings.radii.end());
    grid_settings_.memory_budget = settings.memory_budget;
    grid_settings_.progress = [this](const std::string &, double) {
      if (is_late()) throw TooLate();
    };
    plan_settings_ = grid_settings_;
    plan_settings_.for_gpu = settings.cuda;
    engine_.law() = law_to_time();
  }

  Tradeoff run()
  {
    std::vector<Real> lengths = lengths_to_try(mesh_, plan_settings_);
    // The default first, then what costs least to build.
    for (bool gpu : {false, true}) {
      StepGridSettings of_device = plan_settings_;
      of_device.for_gpu = gpu;
      const Real standard = plan_grid(mesh_, of_device).length;
      standard_[gpu] = *std::min_element(lengths.begin(), lengths.end(), [&](Real a, Real b) {
        return std::fabs(a - standard) < std::fabs(b - standard);
      });
    }
    const Real first = standard_[!settings_.cpu];
    std::sort(lengths.begin(), lengths.end(),
              [&](Real a, Real b) { return a != b && (a == first || (b != first && a > b)); });
    for (Real length : lengths) {
      if (length < finest_) {
        leave_out("grid " + number_text(length) + ": finer than " + number_text(finest_) +
                  ", the finest that the memory holds");
        continue;
      }
      for (int nearest : kTriedNearest) {
        if (is_late()) {
          late_++;
          continue;
        }
        const std::unique_ptr<StepGrid> built = build(length, nearest);
        if (!built) continue;
        if (sample_.n() == 0) make_sample(*built);
        try_options(*built, {length, nearest});
      }
    }
    if (late_ > 0) leave_out(std::to_string(late_) + " settings for which there was no time");
    mark_front(result_.rows);
    return std::move(result_);
  }

 private:
  // The first setting is measured however long it takes.
  bool is_late() const
  {
    const auto now = std::chrono::steady_clock::now();
    return !result_.rows.empty() &&
           std::chrono::duration<double>(now - start_).count() > settings_.seconds;
  }

  // The first grid is as coarse as memory asks for, as the fix makes it; `length` becomes that. Null: left out.
  std::unique_ptr<StepGrid> build(Real &length, int nearest)
  {
    grid_settings_.length = length;
    grid_settings_.nearest = nearest;
    grid_settings_.may_coarsen = sample_.n() == 0;
    try {
      auto grid = std::make_unique<StepGrid>(build_grid(mesh_, grid_settings_, settings_.cuda));
      if (grid->length == length) return grid;
      length = finest_ = rounded_up(grid->length);
      for (Real &standard : standard_) standard = std::max(standard, length);
      grid.reset();    // before the next one takes memory
      return build(length, nearest);
    } catch (const TooLate &) {
      late_++;
    } catch (const InputError &e) {
      leave_out(words_of({length, nearest}) + ": " + e.what());
    }
    return nullptr;
  }
  void leave_out(const std::string &what) { result_.left_out.push_back(what); }

  // `grid`: the first one. Spheres are those near the cells of a CPU's default, whatever the device.
  void make_sample(const StepGrid &grid)
  {
    if (grid.length == standard_[false]) return make_sample_in(grid);
    StepGridSettings of_cpu = grid_settings_;
    of_cpu.length = standard_[false];
    of_cpu.nearest = 0;
    of_cpu.may_coarsen = true;
    make_sample_in(build_grid(mesh_, of_cpu, settings_.cuda));
  }
  void make_sample_in(const StepGrid &grid)
  {
    Random random(settings_.seed);
    add_band_spheres(grid, settings_.spheres, settings_.radii, random, sample_);
    sort_by_bins(sample_, 2 * grid_settings_.cutoff);
    starts_ = drift_starts(mesh_, grid.view(), grid_settings_.cutoff, settings_.moving, random,
                           settings_.memory_budget);
    for (Corner corner : {Corner::blend, Corner::sum}) {
      engine_.corner = corner;
      reference_[corner == Corner::sum] = evaluate_sample(grid.view(), engine_, sample_);
    }
    if (settings_.cpu) timers_[false] = make_sample_timer(false, sample_);
    if (!settings_.cuda) return;
    SphereSample many;
    add_band_spheres(grid, kGpuFactor * settings_.spheres, settings_.radii, random, many);
    sort_by_bins(many, 2 * grid_settings_.cutoff);
    n_on_gpu_ = many.n();
    timers_[true] = make_sample_timer(true, many);
  }

  void try_options(const StepGrid &grid, const GridOptions &choice)
  {
    if (is_late()) {
      late_++;
      return;
    }
    const std::size_t bytes = flat_bytes(grid);
    if (bytes > settings_.memory_budget)
      return leave_out(words_of(choice) + ": " + std::to_string(bytes >> 20) + " MB");
    const FlatOf flat(grid);
    const auto view = flat.view();
    Spread search[2];    // on a CPU, on a GPU
    for (bool on_cuda : {false, true})
      if (timers_[on_cuda]) search[on_cuda] = timers_[on_cuda]->search(view, settings_.repeats);
    for (Corner corner : {Corner::blend, Corner::sum}) {
      engine_.corner = corner;
      TradeoffRow row = {};
      row.choice = choice;
      row.corner = corner;
      row.bytes = bytes;
      row.error = compare(reference_[corner == Corner::sum],
                          evaluate_sample(view, engine_, sample_), sample_, engine_.law().k_normal);
      row.bounce_drift = bounce_drift(view, engine_, starts_);
      row.roll_drift = roll_drift(view, engine_, starts_);
      for (bool on_cuda : {false, true}) {
        if (!timers_[on_cuda]) continue;
        row.search = search[on_cuda];
        time(view, row, on_cuda);
      }
    }
  }

  void time(const ViewOf<StepGrid> &grid, TradeoffRow row, bool on_cuda)
  {
    SampleTimer &timer = *timers_[on_cuda];
    row.on_cuda = on_cuda;
    row.is_default = row.choice.length == standard_[on_cuda] && row.choice.nearest == 0 &&
                     row.corner == Corner::blend;
    row.device = timer.device();
    row.checked = sample_.n();
    row.spheres = on_cuda ? n_on_gpu_ : sample_.n();
    row.times = timer.steps(grid, engine_, settings_.repeats);
    result_.rows.push_back(row);
    progress_(row);
  }

  const WeldedMesh &mesh_;
  const TradeoffSettings &settings_;
  const std::function<void(const TradeoffRow &)> &progress_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  StepGridSettings grid_settings_, plan_settings_;
  EngineSettings engine_;
  Real standard_[2] = {};    // the default length on a CPU, on a GPU
  Real finest_ = 0;          // length that fits, where the default does not
  SphereSample sample_;
  std::unique_ptr<SampleTimer> timers_[2];    // of a CPU, of a GPU; null where it is not asked for
  int n_on_gpu_ = 0;                          // spheres
  DriftStarts starts_;
  WallAnswers reference_[2];    // of corner blend, of corner sum
  int late_ = 0;
  Tradeoff result_;
};

}    // namespace

std::string nearest_word(const GridOptions &choice)
{
  return choice.nearest == 0 ? "all" : std::to_string(choice.nearest);
}

std::string words_of(const GridOptions &choice)
{
  char length[32];
  std::snprintf(length, sizeof length, "%.4g", choice.length);
  return std::string("grid ") + length + " nearest " + nearest_word(choice);
}

const TradeoffRow *fastest_below(const std::vector<TradeoffRow> &rows, Real bound, bool on_cuda)
{
  constexpr double kNoise = 1.1;
  std::vector<const TradeoffRow *> good;
  for (const TradeoffRow &row : rows)
    if (row.on_cuda == on_cuda && row.corner == Corner::blend && row.error.uncertified == 0 &&
        row.error.missed_share() < bound && row.error.largest < bound)
      good.push_back(&row);
  const auto faster = [](const TradeoffRow *a, const TradeoffRow *b) {
    return a->times.step.least < b->times.step.least;
  };
  const auto fastest = std::min_element(good.begin(), good.end(), faster);
  const TradeoffRow *best = nullptr;
  for (const TradeoffRow *row : good)
    if (row->times.step.least <= kNoise * (*fastest)->times.step.least &&
        (!best || row->error.largest < best->error.largest))
      best = row;
  return best;
}

void mark_front(std::vector<TradeoffRow> &rows)
{
  const auto beats = [](const TradeoffRow &a, const TradeoffRow &b) {
    return a.on_cuda == b.on_cuda && a.error.mean <= b.error.mean &&
           a.times.step.least <= b.times.step.least &&
           (a.error.mean < b.error.mean || a.times.step.least < b.times.step.least);
  };
  for (TradeoffRow &row : rows)
    row.on_front = std::none_of(rows.begin(), rows.end(),
                                [&](const TradeoffRow &other) { return beats(other, row); });
}

Tradeoff measure_tradeoff(const WeldedMesh &mesh, const TradeoffSettings &settings,
                          const std::function<void(const TradeoffRow &)> &progress)
{
  return Measuring(mesh, settings, progress).run();
}

}    // namespace lsdcd
