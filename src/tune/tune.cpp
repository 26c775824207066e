#include "tune/tune.h"

#include "base/input_error.h"
#include "grid/plan/grid_plan.h"
#include "tune/tune_lengths.h"
#include "tune/wall_parts.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace lsdcd {

namespace {

constexpr int kSceneSpheres = 4096, kBandSpheres = 4096;
constexpr int kRepeats = 6, kFewRepeats = 2;    // of what may be taken, of the rest
constexpr Real kTie = 1.1;                      // times that differ by less are equal
// Of a million spheres the largest error is up to this much above that of a few thousand:
// errors of rounding fall with the 0.4th power of their rank, which makes nine; twelve was
// seen.
constexpr Real kUnseenError = 20;
constexpr double kCells = 150000;    // to build at the finest length; fewer with long lists

std::vector<int> shuffled(int n, Random &random)
{
  std::vector<int> order(n);
  for (int i = 0; i < n; i++) order[i] = i;
  for (int i = n - 1; i > 0; i--) std::swap(order[i], order[random() % (i + 1)]);
  return order;
}

// The parts of the wall that are tried: some chosen blindly, which stand for the whole
// where bytes are extrapolated, and some that hold spheres of the scene.
struct TriedParts {
  WallParts parts;
  std::vector<char> blind, tried;
  int n_blind = 0, n_tried = 0;

  TriedParts(const WallMesh &mesh, const GridSettings &grid, Real finest, const SphereSample &scene,
             Random &random) :
      parts(mesh, grid.cutoff, std::max(2 * grid.cutoff, kBrickSide * finest), grid.within),
      blind(parts.n(), 0), tried(parts.n(), 0)
  {
    // A sheet of wall through a cube, and the primitives of wall within the cutoff of a cell.
    const Real cutoff = grid.cutoff;
    const double across = parts.side() / finest, high = 2 * cutoff / finest + 2;
    const double primitives = mesh.faces.size() / mesh.report.area * M_PI * cutoff * cutoff;
    const double cells = kCells / (1 + primitives / 10);
    const int wanted = static_cast<int>(std::clamp(cells / (across * across * high), 12., 1e6));
    const std::vector<int> order = shuffled(parts.n(), random);
    for (int i = 0; i < std::min(wanted, parts.n()); i++) blind[order[i]] = tried[order[i]] = 1;
    n_blind = n_tried = std::min(wanted, parts.n());
    for (int i : shuffled(scene.n(), random)) {
      if (n_tried >= 2 * wanted) break;
      const int part = parts.part_of(scene.x[i]);
      if (part < 0 || tried[part]) continue;
      tried[part] = 1;
      n_tried++;
    }
  }

  bool holds(const Vec3 &x) const
  {
    const int part = parts.part_of(x);
    return part >= 0 && tried[part];
  }
  std::vector<Box> boxes() const
  {
    std::vector<Box> boxes;
    if (n_tried == parts.n()) return boxes;
    for (int i = 0; i < parts.n(); i++)
      if (tried[i]) boxes.push_back(parts.box(i));
    return boxes;
  }
};

// Of a trial's lists, which cells lie in parts chosen blindly, and how much of each brick.
struct BlindShare {
  std::vector<char> cell;
  double bricks = 0;

  BlindShare(const TriangleGrid &grid, const CellLists &lists, const TriedParts &tried)
  {
    cell.assign(lists.cells.size(), 1);
    bricks = static_cast<double>(lists.bricks.size());
    if (tried.n_blind == tried.parts.n()) return;
    bricks = 0;
    for (std::size_t place = 0; place < lists.brick_of.size(); place++) {
      if (lists.brick_of[place] < 0) continue;
      const Brick &brick = lists.bricks[lists.brick_of[place]];
      const Vec3 centre = brick_centre(grid, place);
      const Real middle = Real(0.5) * (kBrickSide - 1);
      int all = 0, inside = 0;
      for (int c = 0; c < kBrickCells; c++) {
        if (!has_candidates(brick, c)) continue;
        const int part =
            tried.parts.part_of(centre + grid.length * Vec3{(c & 7) - middle, (c >> 3 & 7) - middle,
                                                            (c >> 6) - middle});
        const bool in = part >= 0 && tried.blind[part];
        cell[cell_index(brick, c)] = in;
        all++;
        inside += in;
      }
      if (all > 0) bricks += double(inside) / all;
    }
  }

  double bytes(const CellLists &lists) const
  {
    double sum = bricks * sizeof(Brick);
    for (std::size_t c = 0; c < lists.cells.size(); c++)
      if (cell[c])
        sum += sizeof(Cell) +
               (lists.cells[c].count > 1 ? lists.cells[c].count : 0) * sizeof(Candidate);
    return sum;
  }
};

// Bytes of the whole grid of which `grid` is the tried part.
double whole_bytes(const TriangleGrid &grid, const BlindShare &lists, const BlindShare &complete,
                   const TriedParts &tried)
{
  const double scale = double(tried.parts.n()) / tried.n_blind;
  const auto add = [](double &sum, const CellLists &l, const BlindShare &share) {
    if (!l.bricks.empty()) sum += share.bytes(l);
  };
  double varies = 0, bricks = 0, share = 0;
  for (const auto &[l, s] :
       {std::pair(&grid.lists, &lists), std::pair(&grid.complete, &complete)}) {
    add(varies, *l, *s);
    bricks += l->bricks.size();
    if (!l->bricks.empty()) share += s->bricks;
  }
  const double records =
      grid.records.bytes() - double(sizeof(Vec3f)) * (grid.records.edge_inward.size() +
                                                      grid.records.vertex_direction.size());
  double fixed = static_cast<double>(flat_bytes(grid)) - records;
  for (const CellLists *l : {&grid.lists, &grid.complete})
    fixed -= static_cast<double>(
        grid_bytes({}, l->bricks.size(), l->cells.size(), l->candidates.size()));
  if (bricks > 0) varies += records * share / bricks;
  return fixed + scale * varies;
}

[[noreturn]] void throw_none_good(const TuneReport &report, const TuneSettings &settings)
{
  Real least = report.rows[0].error.largest;
  for (const TuneRow &row : report.rows) least = std::min(least, row.error.largest);
  char text[200];
  std::snprintf(text, sizeof text,
                "tune %g: with precision %s forces are wrong by up to %.2g, in a sample, and tune "
                "asks for a twentieth of its bound there; raise the bound or leave precision out",
                settings.bound, precision_name(settings.engine.precision), least);
  throw InputError(text);
}

}    // namespace

int choose(std::vector<TuneRow> &rows, Real bound, std::size_t memory_budget)
{
  const auto good = [bound](const TuneRow &row) {
    const Real error = std::max(row.error.missed_share(), kUnseenError * row.error.largest);
    // In double, complete lists are the reference, whatever the cells.
    return row.choice.complete() && (row.choice.precision == Precision::double_ || error < bound);
  };
  double quickest = 0;
  int best = -1;
  for (int i = 0; i < static_cast<int>(rows.size()); i++) {
    TuneRow &row = rows[i];
    row.accepted = good(row) && row.bytes <= double(memory_budget);
    if (good(row) && (best < 0 || row.bytes < rows[best].bytes)) best = i;
    if (row.accepted && (quickest == 0 || row.ns_per_sphere < quickest))
      quickest = row.ns_per_sphere;
  }
  if (quickest == 0) return best;    // none fits: the smallest
  best = -1;
  for (int i = 0; i < static_cast<int>(rows.size()); i++) {
    const TuneRow &row = rows[i];
    if (!row.accepted || row.ns_per_sphere > kTie * quickest) continue;
    if (best < 0 || row.choice.precision < rows[best].choice.precision ||
        (row.choice.precision == rows[best].choice.precision && row.bytes < rows[best].bytes))
      best = i;
  }
  return best;
}

TuneReport tune(const WallMesh &mesh, const TuneSettings &settings)
{
  const auto start = std::chrono::steady_clock::now();
  const Real cutoff = settings.grid.cutoff;
  EngineSettings engine_settings = settings.engine;
  std::string why;
  const bool on_cuda = settings.engine.device != Device::cpu && cuda_available(&why);

  const std::vector<Real> lengths = lengths_to_try(mesh, settings.grid);
  Random random(settings.seed);
  const TriedParts tried(mesh, settings.grid, lengths.front(), settings.scene, random);

  TuneReport report = {};
  report.bound = settings.bound;
  report.parts = tried.n_tried;
  report.all_parts = tried.parts.n();
  report.part_side = tried.parts.side();

  SphereSample sample;
  for (int i : shuffled(settings.scene.n(), random)) {
    if (sample.n() == kSceneSpheres) break;
    if (tried.holds(settings.scene.x[i])) sample.add(settings.scene.x[i], settings.scene.radius[i]);
  }
  report.scene = sample.n();
  std::vector<Real> radii = settings.scene.radius;
  if (radii.empty()) {
    Real radius = cutoff;    // of which adhesion may take a part
    while (cutoff_of(settings.engine.law, radius) > cutoff) radius *= Real(0.99);
    radii.push_back(radius);
  }

  std::vector<ListKind> kinds = list_kinds();
  if (settings.keep_lists) kinds = {{settings.grid.nearest, settings.grid.exact}};
  GridSettings trial = settings.grid;
  trial.memory_budget = std::size_t(1) << 40;    // of the parts that are tried
  trial.only = tried.boxes();
  WallAnswers reference;
  std::size_t budget = 0;
  for (Real length : lengths) {
    trial.length = length;
    TrialGrid grid(mesh, trial, on_cuda);
    const BlindShare lists(grid.base(), grid.base().lists, tried),
        complete(grid.base(), grid.base().complete, tried);
    if (reference.first.empty()) {
      const auto holds = [&](const Vec3 &x) { return tried.holds(x); };
      add_band_spheres(grid.make(0, false, false), kBandSpheres, radii, random, holds, sample);
      report.band = sample.n() - report.scene;
      sort_by_bins(sample, 2 * cutoff);
      EngineSettings exact = engine_settings;
      exact.precision = Precision::double_;
      reference = answer(grid.make(0, false, false).view(), exact, sample);
    }
    budget = budget_of(settings.grid, grid.made());
    for (const ListKind &kind : kinds) {
      for (Precision precision : {Precision::double_, Precision::mixed, Precision::single_}) {
        if (settings.keep_precision && precision != settings.engine.precision) continue;
        if (precision == Precision::single_ && !has_single(settings.engine)) continue;
        TuneRow row = {};
        row.choice = {length, kind.nearest, kind.exact, precision};
        engine_settings.precision = precision;
        // Single precision reads what mixed does.
        const bool same_grid = precision == Precision::single_ && !settings.keep_precision;
        if (!same_grid) grid.make(kind.nearest, kind.exact, precision != Precision::double_);
        const TriangleGrid &made = grid.made();
        row.bytes = whole_bytes(made, kind.nearest > 0 ? lists : complete, complete, tried);
        row.error = compare(reference, answer(made.view(), engine_settings, sample), sample,
                            engine_settings.law);
        const auto engine = make_engine(engine_settings);
        engine->set_grid(on_cuda ? grid.flat() : made.view());
        row.ns_per_sphere =
            1e9 / std::max(1, sample.n()) *
            step_seconds(*engine, on_cuda, sample, row.choice.complete() ? kRepeats : kFewRepeats);
        report.device = engine->backend();
        report.rows.push_back(row);
      }
    }
  }
  report.taken = choose(report.rows, settings.bound, budget);
  if (report.taken < 0) throw_none_good(report, settings);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}    // namespace lsdcd
