// Choosing grid, lists and precision by measuring, and the trial grids this is done on.
#include "tune/tune.h"

#include "base/input_error.h"
#include "contact/find_contacts.h"
#include "mesh/triangle_soup.h"
#include "law/contact_slope.h"
#include "support/device.h"
#include "support/meshes.h"
#include "tune/wall_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <set>
#include <sstream>

namespace lsdcd {
namespace {

// A vessel in small: a wall of the finest facets, a funnel below and a flat lid of slivers.
TriangleSoup vessel()
{
  TriangleSoup soup = cylinder_mesh(60, 25, 1, 2.5);
  append(soup, cone_mesh(40, 1, 0.7));
  return soup;
}

// Flat sides 1.6 long: far larger than the spheres.
TriangleSoup cylinder()
{
  return cylinder_mesh(40, 1, 10, 12);
}

TuneSettings settings_for(Real cutoff, Real bound)
{
  TuneSettings s;
  s.bound = bound;
  s.grid.cutoff = cutoff;
  s.engine.device = test_device();
  s.engine.law.style = LawStyle::hertz_history;
  s.engine.law.k_normal = 1e5;
  s.engine.law.k_tangent = 2e4;
  s.engine.law.gamma_normal = 50;
  s.engine.law.mu = 0.5;
  return s;
}

bool anywhere(const Vec3 &)
{
  return true;
}

// ---- trial grids -----------------------------------------------------------------------

std::vector<char> flat(const TriangleGrid &grid)
{
  std::vector<char> block(flat_bytes(grid));
  flatten(grid, block.data());
  return block;
}

TEST(trial_grid, is_bit_for_bit_the_grid_that_a_build_makes)
{
  const WallMesh mesh = weld(vessel(), -1);
  GridSettings settings;
  settings.cutoff = 0.1;
  settings.length = 0.06;
  settings.sides = true;
  TrialGrid trial(mesh, settings, test_on_cuda());
  for (bool in_floats : {false, true})
    for (const ListKind &kind : list_kinds()) {
      GridSettings one = settings;
      one.nearest = kind.nearest;
      one.exact = kind.exact;
      one.in_floats = in_floats;
      EXPECT_TRUE(flat(trial.make(kind.nearest, kind.exact, in_floats)) ==
                  flat(build_grid(mesh, one, test_on_cuda())))
          << kind.nearest << kind.exact << in_floats;
    }
}

// Candidates of a cell, whether it holds one itself or a list.
std::vector<std::uint32_t> listed(const CellLists &lists, const Brick &brick, int c)
{
  if (!has_candidates(brick, c)) return {};
  const Cell cell = lists.cells[cell_index(brick, c)];
  if (cell.count == 1) return {cell.first};
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = cell.first; i < cell.first + cell.count; i++) {
    std::uint32_t bound;
    std::memcpy(&bound, &lists.candidates[i].bound, sizeof bound);
    out.insert(out.end(), {lists.candidates[i].feature, bound});
  }
  return out;
}

void expect_same_where_built(const CellLists &part, const CellLists &whole)
{
  ASSERT_EQ(part.brick_of.size(), whole.brick_of.size());
  long built = 0;
  for (std::size_t place = 0; place < whole.brick_of.size(); place++) {
    if (part.brick_of[place] < 0) continue;
    built++;
    ASSERT_GE(whole.brick_of[place], 0);
    const Brick &a = part.bricks[part.brick_of[place]], &b = whole.bricks[whole.brick_of[place]];
    for (int c = 0; c < kBrickCells; c++) ASSERT_EQ(listed(part, a, c), listed(whole, b, c));
  }
  EXPECT_GT(built, 5);
  EXPECT_LT(built, static_cast<long>(whole.bricks.size()) / 2);
}

TEST(restricted_grid, has_the_lists_of_the_whole_one_in_its_bricks)
{
  const WallMesh mesh = weld(vessel(), -1);
  GridSettings settings;
  settings.cutoff = 0.1;
  settings.length = 0.03;
  settings.nearest = 4;
  settings.exact = true;
  const TriangleGrid whole = build_grid(mesh, settings, test_on_cuda());
  settings.only = {{{0.8, -0.2, 0.9}, {1.1, 0.2, 1.3}}, {{-0.1, -0.1, -0.2}, {0.2, 0.2, 0.2}}};
  const TriangleGrid part = build_grid(mesh, settings, test_on_cuda());
  expect_same_where_built(part.lists, whole.lists);
  expect_same_where_built(part.complete, whole.complete);
}

TEST(restricted_grid, answers_as_the_whole_one_within_its_boxes)
{
  const WallMesh mesh = weld(vessel(), -1);
  GridSettings settings;
  settings.cutoff = 0.1;
  const TriangleGrid whole = build_grid(mesh, settings, test_on_cuda());
  const Box box = {{0.7, -0.3, 0.9}, {1.2, 0.3, 1.4}};
  settings.only = {box};
  const TriangleGrid part = build_grid(mesh, settings, test_on_cuda());
  Random random(3);
  long touching = 0;
  for (int i = 0; i < 20000; i++) {
    Vec3 q;
    for (int k = 0; k < 3; k++)
      q[k] = box.lo[k] + (box.hi[k] - box.lo[k]) * uniform_below_one(random);
    if (i % 3 == 0) q[i % 9 / 3] = (i & 1 ? box.lo : box.hi)[i % 9 / 3];    // on its rim
    ContactSet<64> a, b;
    find_contacts(part.view(), q, 0.1, a);
    find_contacts(whole.view(), q, 0.1, b);
    ASSERT_EQ(a.n, b.n);
    for (int k = 0; k < a.n; k++) ASSERT_EQ(a.feature[k], b.feature[k]);
    touching += a.n > 0;
  }
  EXPECT_GT(touching, 4000);
}

TEST(grid_length, that_may_coarsen_does_where_the_budget_asks_for_it)
{
  const WallMesh mesh = weld(vessel(), -1);
  GridSettings settings;
  settings.cutoff = 0.1;
  settings.length = 0.01;
  settings.memory_budget = 2 << 20;
  EXPECT_THROW(build_grid(mesh, settings, test_on_cuda()), InputError);
  settings.may_coarsen = true;
  EXPECT_GT(build_grid(mesh, settings, test_on_cuda()).length, 0.01);
}

TEST(wall_parts, hold_every_point_within_reach)
{
  const WallMesh mesh = weld(vessel(), -1);
  const WallParts parts(mesh, 0.1, 0.3);
  GridSettings settings;
  settings.cutoff = 0.1;
  const TriangleGrid grid = build_grid(mesh, settings);
  const GridView view = grid.view();
  Random random(4);
  long within = 0;
  for (int i = 0; i < 50000; i++) {
    Vec3 q;
    for (int k = 0; k < 3; k++) q[k] = -1.3 + 2.6 * uniform_below_one(random) + (k == 2);
    ContactSet<64> set;
    find_contacts(view, q, 0.1, set);
    if (set.n == 0) continue;
    within++;
    const int part = parts.part_of(q);
    ASSERT_GE(part, 0);
    for (int k = 0; k < 3; k++) {
      ASSERT_GE(q[k], parts.box(part).lo[k]);
      ASSERT_LE(q[k], parts.box(part).hi[k]);
    }
  }
  EXPECT_GT(within, 2000);
}

// ---- comparing answers -----------------------------------------------------------------

// One sphere of radius 1 with contacts on the given closest points, and a force along x.
WallAnswers answers_of(const std::vector<WallAnswers::Place> &places, Real force)
{
  WallAnswers a;
  a.places = places;
  a.first = {0, places.size()};
  a.force = {{force, 0, 0}};
  return a;
}

struct Compare : testing::Test {
  Compare()
  {
    sample.add({0, 0, 0}, 1);
    law.k_normal = 100;
  }
  AnswerError error(const WallAnswers &reference, const WallAnswers &trial) const
  {
    return compare(reference, trial, sample, law);
  }
  SphereSample sample;
  ContactLaw law;
  const WallAnswers::Place below = {{0, 0, -0.9}, 0.1, true}, beside = {{0.9, 0, 0}, 0.1, true};
};

TEST_F(Compare, a_contact_without_a_foot_beside_its_own_is_missed)
{
  const WallAnswers both = answers_of({below, beside}, 10);
  EXPECT_EQ(error(both, both).missed, 0);
  EXPECT_EQ(error(both, answers_of({beside}, 10)).missed, 1);
  WallAnswers::Place off = below;
  off.closest.x = 0.9e-3;
  EXPECT_EQ(error(both, answers_of({off, beside}, 10)).missed, 0);
  off.closest.x = 1.1e-3;
  EXPECT_EQ(error(both, answers_of({off, beside}, 10)).missed, 1);
  EXPECT_EQ(error(both, both).contacts, 2);
  EXPECT_DOUBLE_EQ(error(both, answers_of({beside}, 10)).missed_share(), 0.5);
}

TEST_F(Compare, a_contact_that_bears_nothing_cannot_be_missed)
{
  WallAnswers::Place idle = below;
  idle.bears = false;
  const AnswerError e = error(answers_of({idle, beside}, 10), answers_of({beside}, 10));
  EXPECT_EQ(e.contacts, 1);
  EXPECT_EQ(e.missed, 0);
}

TEST_F(Compare, forces_are_compared_to_their_own_size_or_a_usual_one)
{
  EXPECT_DOUBLE_EQ(error(answers_of({below}, 10), answers_of({below}, 10.5)).largest, 0.05);
  // An overlap of 1 % of the radius takes a force of 1 here.
  EXPECT_DOUBLE_EQ(error(answers_of({below}, 0.25), answers_of({below}, 0.5)).largest, 0.25);
  EXPECT_DOUBLE_EQ(error(answers_of({below}, 10), answers_of({}, 0)).largest, 1);
  EXPECT_DOUBLE_EQ(error(answers_of({}, 0), answers_of({below}, 3)).largest, 3);    // a false one
}

// A hard sphere that is hardly sticky is held at an overlap of 4e-8 of its radius.
TEST_F(Compare, overlaps_of_adhesive_laws_are_compared_to_those_that_hold)
{
  law = ContactLaw();
  law.style = LawStyle::granular;
  law.granular.modulus = 4e10;
  law.granular.k_normal = 4. / 3 * law.granular.modulus;
  law.granular.cohesion = 0.05;
  for (const NormalModel normal : {NormalModel::jkr, NormalModel::dmt}) {
    law.granular.normal = normal;
    // Hertz's force is the pull at the overlap `held`, where it rises by 3/2 of force over overlap.
    const Real pull = (normal == NormalModel::jkr ? 3 : 4) * M_PI * law.granular.cohesion,
               held = std::pow(pull / law.granular.k_normal, 2. / 3), off = 1e-10;
    const Real dmt = 1.5 * off / held, jkr = contact_slope(law, held, 1, 1).stiffness * off / pull;
    EXPECT_NEAR(error(answers_of({below}, 1e-3), answers_of({below}, 1e-3 + off)).largest,
                normal == NormalModel::jkr ? jkr : dmt, 1e-5 * dmt);
  }
}

// ---- choosing --------------------------------------------------------------------------

TuneRow row_of(int nearest, bool exact, Precision precision, Real largest, double ns, double bytes)
{
  TuneRow row = {};
  row.choice = {1, nearest, exact, precision};
  row.error.contacts = 1000;
  row.error.largest = largest;
  row.ns_per_sphere = ns;
  row.bytes = bytes;
  return row;
}

const Precision kDouble = Precision::double_, kMixed = Precision::mixed,
                kSingle = Precision::single_;

int chosen(std::vector<TuneRow> rows, Real bound, std::size_t budget = 1000)
{
  return choose(rows, bound, budget);
}

TEST(choose, takes_the_quickest)
{
  EXPECT_EQ(chosen({row_of(0, false, kDouble, 0, 100, 10), row_of(0, false, kMixed, 1e-6, 50, 90),
                    row_of(2, true, kDouble, 0, 80, 5)},
                   1e-3),
            1);
}

TEST(choose, of_times_that_are_a_tenth_apart_takes_the_more_precise_then_the_smaller)
{
  EXPECT_EQ(chosen({row_of(0, false, kSingle, 1e-6, 95, 1), row_of(0, false, kMixed, 1e-6, 96, 2),
                    row_of(0, false, kDouble, 0, 103, 50), row_of(2, true, kDouble, 0, 102, 60)},
                   1e-3),
            2);
  EXPECT_EQ(
      chosen({row_of(0, false, kDouble, 0, 105, 50), row_of(0, false, kDouble, 0, 96, 51)}, 1e-3),
      0);
}

TEST(choose, asks_of_floats_a_twentieth_of_the_bound_in_a_sample)
{
  for (Real largest : {0.49e-4, 0.51e-4})
    EXPECT_EQ(
        chosen({row_of(0, false, kDouble, 0, 100, 10), row_of(0, false, kMixed, largest, 10, 10)},
               1e-3),
        largest < 0.5e-4 ? 1 : 0);
}

TEST(choose, refuses_what_misses_contacts)
{
  TuneRow misses = row_of(0, false, kMixed, 0, 10, 10);
  misses.error.missed = 2;
  EXPECT_EQ(chosen({row_of(0, false, kDouble, 0, 100, 10), misses}, 1e-3), 0);
  EXPECT_EQ(chosen({row_of(0, false, kDouble, 0, 100, 10), misses}, 3e-3), 1);
}

TEST(choose, never_takes_nearest_lists_that_do_not_fall_back)
{
  EXPECT_EQ(
      chosen({row_of(0, false, kDouble, 0, 100, 10), row_of(3, false, kDouble, 0, 10, 1)}, 0.9), 0);
}

TEST(choose, keeps_to_the_budget_and_takes_the_smallest_where_nothing_fits)
{
  const std::vector<TuneRow> rows = {row_of(0, false, kDouble, 0, 50, 200),
                                     row_of(0, false, kDouble, 0, 90, 100),
                                     row_of(0, false, kMixed, 0.5, 9, 10)};
  EXPECT_EQ(chosen(rows, 1e-3, 300), 0);
  EXPECT_EQ(chosen(rows, 1e-3, 150), 1);
  EXPECT_EQ(chosen(rows, 1e-3, 50), 1);
}

TEST(choose, says_where_nothing_is_good)
{
  EXPECT_EQ(chosen({row_of(0, false, kMixed, 1e-4, 50, 200)}, 1e-6), -1);
}

// A report that several tests look at.
const TuneReport &vessel_report()
{
  static const TuneReport report = tune(weld(vessel(), -1), settings_for(0.1, 1e-3));
  return report;
}

// ---- tune ------------------------------------------------------------------------------

// The error of a choice on spheres that tune did not see, with a grid built as the fix does.
AnswerError fresh_error(const WallMesh &mesh, const TuneSettings &settings,
                        const GridChoice &choice, int n)
{
  GridSettings g;
  g.cutoff = settings.grid.cutoff;
  const TriangleGrid reference = build_grid(mesh, g);
  SphereSample sample;
  Random random(777);
  std::vector<Real> radii;
  for (int i = 0; i < 16; i++) radii.push_back(g.cutoff * (1 - 0.04 * i));
  add_band_spheres(reference, n, radii, random, anywhere, sample);
  EXPECT_EQ(sample.n(), n);
  g.length = choice.length;
  g.nearest = choice.nearest;
  g.exact = choice.exact;
  g.in_floats = choice.precision != Precision::double_;
  const TriangleGrid grid = build_grid(mesh, g);
  EngineSettings exact = settings.engine, chosen = settings.engine;
  chosen.precision = choice.precision;
  return compare(answer(reference.view(), exact, sample), answer(grid.view(), chosen, sample),
                 sample, settings.engine.law);
}

AnswerError expect_kept(const TriangleSoup &soup, Real cutoff, Real bound, int n)
{
  const WallMesh mesh = weld(soup, -1);
  const TuneSettings settings = settings_for(cutoff, bound);
  const TuneReport report = tune(mesh, settings);
  const AnswerError e = fresh_error(mesh, settings, report.choice(), n);
  EXPECT_GT(e.contacts, n / 10);
  EXPECT_LT(e.missed_share(), bound) << describe(report);
  EXPECT_LT(e.largest, bound) << describe(report);
  return e;
}

TEST(tune, keeps_its_bound_on_spheres_it_did_not_see)
{
  expect_kept(vessel(), 0.1, 1e-3, 40000);
  expect_kept(cylinder(), 0.5, 1e-3, 40000);

  // Beside these, meshes that are named: LSDCD_TUNE="FILE.stl REACH FILE.stl REACH ...".
  const char *named = std::getenv("LSDCD_TUNE");
  std::istringstream words(named ? named : "");
  std::string file;
  Real cutoff = 0;
  while (words >> file >> cutoff) {
    const AnswerError e = expect_kept(read_stl(file), cutoff, 1e-3, 1000000);
    std::printf("%s: of %ld contacts %ld missed, largest error %.2g\n", file.c_str(),
                static_cast<long>(e.contacts), static_cast<long>(e.missed), e.largest);
  }
}

// Whatever is quickest here, floats must not pass a bound that they do not keep.
TEST(tune, every_row_that_it_accepts_keeps_the_bound)
{
  const WallMesh mesh = weld(vessel(), -1);
  const TuneSettings settings = settings_for(0.1, 1e-3);
  long floats = 0;
  for (const TuneRow &row : vessel_report().rows) {
    if (!row.accepted || row.choice.nearest == 4 || row.choice.precision == kSingle) continue;
    floats += row.choice.precision != Precision::double_;
    const AnswerError e = fresh_error(mesh, settings, row.choice, 10000);
    EXPECT_LT(e.missed_share(), settings.bound);
    EXPECT_LT(e.largest, settings.bound);
  }
  EXPECT_GT(floats, 0);
}

TEST(tune, takes_complete_lists_in_double_for_a_bound_of_zero)
{
  std::vector<TuneRow> rows = vessel_report().rows;
  const int taken = choose(rows, 0, std::size_t(1) << 30);
  ASSERT_GE(taken, 0);
  EXPECT_TRUE(rows[taken].accepted);
  for (const TuneRow &row : rows)
    EXPECT_EQ(row.accepted, row.choice.complete() && row.choice.precision == Precision::double_);
}

TEST(tune, tries_every_length_with_every_kind_of_list_and_precision)
{
  const TuneReport &report = vessel_report();
  std::set<std::tuple<Real, int, bool, int>> seen;
  std::set<Real> lengths;
  for (const TuneRow &row : report.rows) {
    const GridChoice &c = row.choice;
    lengths.insert(c.length);
    EXPECT_TRUE(seen.insert({c.length, c.nearest, c.exact, static_cast<int>(c.precision)}).second);
    EXPECT_LE(c.length, 0.1);
    EXPECT_GT(row.ns_per_sphere, 0);
    EXPECT_GT(row.bytes, 0);
    EXPECT_GT(row.error.contacts, 100);
  }
  EXPECT_GE(lengths.size(), 2u);
  EXPECT_EQ(report.rows.size(), lengths.size() * list_kinds().size() * 3);
  ASSERT_GE(report.taken, 0);
  EXPECT_TRUE(report.rows[report.taken].accepted);
  const std::string text = describe(report);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4 + static_cast<long>(report.rows.size()));
}

TEST(tune, measures_the_same_errors_again)
{
  const TuneReport &a = vessel_report(), b = tune(weld(vessel(), -1), settings_for(0.1, 1e-3));
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); i++) {
    EXPECT_EQ(a.rows[i].error.missed, b.rows[i].error.missed);
    EXPECT_EQ(a.rows[i].error.largest, b.rows[i].error.largest);
    EXPECT_EQ(a.rows[i].bytes, b.rows[i].bytes);
  }
}

TEST(tune, sees_what_short_lists_miss)
{
  for (const TuneRow &row : vessel_report().rows) {
    if (row.choice.complete()) {
      EXPECT_EQ(row.error.missed, 0);
      EXPECT_EQ(row.error.uncertified, 0);
      if (row.choice.precision == Precision::double_) {
        EXPECT_LT(row.error.largest, 1e-12);
      }
    } else if (row.choice.nearest == 1) {
      EXPECT_GT(row.error.missed, 0);
      EXPECT_DOUBLE_EQ(row.error.largest, 1);
    }
  }
}

// A wall large enough that only parts of it are tried.
// LSDCD_QUICK=1 looks at one length.
TEST(tune, extrapolates_the_bytes_of_the_whole_grid)
{
  const WallMesh mesh = weld(cylinder_mesh(120, 60, 10, 20), -1);
  const TuneSettings settings = settings_for(0.25, 1e-3);
  const TuneReport report = tune(mesh, settings);
  ASSERT_LT(report.parts, report.all_parts / 3);
  std::unique_ptr<TrialGrid> whole;
  for (const TuneRow &row : report.rows) {
    const GridChoice &c = row.choice;
    GridSettings g = settings.grid;
    g.length = c.length;
    if (whole && whole->base().length != c.length && std::getenv("LSDCD_QUICK")) break;
    if (!whole || whole->base().length != c.length)
      whole = std::make_unique<TrialGrid>(mesh, g, test_on_cuda());
    const double bytes = static_cast<double>(
        flat_bytes(whole->make(c.nearest, c.exact, c.precision != Precision::double_)));
    // The share of wall in a cube varies by half, in a mean of a hundred by a twentieth.
    EXPECT_NEAR(row.bytes / bytes, 1, 0.2) << c.length << " " << lists_name(c);
  }
}

TEST(tune, tries_spheres_of_the_scene_where_they_are)
{
  const WallMesh mesh = weld(cylinder_mesh(120, 60, 10, 20), -1);
  TuneSettings settings = settings_for(0.25, 1e-3);
  settings.grid.length = 0.2;
  for (int i = 0; i < 300; i++) settings.scene.add({9.9 - 1e-4 * i, 0.01 * i, 5}, 0.2);
  const TuneReport report = tune(mesh, settings);
  EXPECT_GT(report.scene, 100);
  EXPECT_GT(report.band, 1000);
}

TEST(tune, keeps_what_is_given)
{
  const WallMesh mesh = weld(vessel(), -1);
  TuneSettings settings = settings_for(0.1, 1e-3);
  settings.keep_lists = true;
  settings.grid.length = 0.08;
  settings.grid.nearest = 5;
  settings.grid.exact = true;
  for (const TuneRow &row : tune(mesh, settings).rows)
    EXPECT_TRUE(row.choice.nearest == 5 && row.choice.exact);
  settings = settings_for(0.1, 1e-3);
  settings.keep_precision = true;
  settings.engine.precision = Precision::single_;
  settings.grid.length = 0.07;
  const TuneReport report = tune(mesh, settings);
  for (const TuneRow &row : report.rows)
    EXPECT_TRUE(row.choice.length == 0.07 && row.choice.precision == Precision::single_);
  EXPECT_EQ(report.rows.size(), list_kinds().size());
}

TEST(tune, says_so_where_what_is_given_is_not_good_enough)
{
  TuneSettings settings = settings_for(0.1, 1e-9);
  settings.keep_precision = true;
  settings.engine.precision = Precision::mixed;
  settings.grid.length = 0.08;
  try {
    tune(weld(vessel(), -1), settings);
    FAIL();
  } catch (const InputError &e) {
    for (const char *word : {"tune 1e-09", "precision mixed", "raise the bound"})
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
  }
}

TEST(tune, works_without_a_stiffness)
{
  TuneSettings settings = settings_for(0.1, 1e-3);
  settings.engine.law.k_normal = 0;
  settings.grid.length = 0.08;
  EXPECT_GE(tune(weld(vessel(), -1), settings).taken, 0);
}

TEST(tune, works_with_laws_that_stick_conduct_and_remember)
{
  TuneSettings settings = settings_for(0.1, 1e-3);
  settings.grid.length = 0.08;
  ContactLaw &law = settings.engine.law;
  law.style = LawStyle::granular;
  law.granular.normal = NormalModel::jkr;
  law.granular.k_normal = 1e5;
  law.granular.modulus = 0.75e5;
  law.granular.cohesion = 20;
  law.granular.tangential = TangentialModel::mindlin_rescale;
  law.granular.k_tangent = 1e4;
  law.granular.rolling = true;
  law.granular.heat = HeatModel::radius;
  ASSERT_GT(cutoff_of(law, 0.09), 0.09 * 1.01);
  const TuneReport report = tune(weld(vessel(), -1), settings);
  EXPECT_GE(report.taken, 0);
  for (const TuneRow &row : report.rows) EXPECT_GT(row.error.contacts, 100);
}

TEST(band_spheres, are_all_within_reach_and_none_is_deep)
{
  const WallMesh mesh = weld(vessel(), -1);
  GridSettings g;
  g.cutoff = 0.1;
  const TriangleGrid grid = build_grid(mesh, g);
  SphereSample sample;
  Random random(5);
  add_band_spheres(grid, 5000, {0.1, 0.06}, random, anywhere, sample);
  ASSERT_EQ(sample.n(), 5000);
  long touching = 0;
  for (int i = 0; i < sample.n(); i++) {
    EXPECT_TRUE(near_wall(grid.view(), sample.x[i]));
    ContactSet<64> set;
    find_contacts(grid.view(), sample.x[i], sample.radius[i], set);
    for (int k = 0; k < set.n; k++) EXPECT_GE(set.distance[k], 0.5 * sample.radius[i]);
    touching += set.n > 0;
  }
  EXPECT_GT(touching, 500);
}

}    // namespace
}    // namespace lsdcd
