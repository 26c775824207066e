// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The parts of the paper's study, and the study on a small number of spheres. LSDCD_QUICK: with coarse grids only, as
// to make a fine one takes seconds.
#include "support/device.h"
#include "support/random_mesh.h"

#include "base/input_error.h"
#include "mesh/welded_mesh.h"
#include "study/accuracy.h"
#include "study/one_triangle.h"
#include "study/paper_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace lsdcd::test_study {
namespace {

// ---- spheres ------------------------------------------------------------------------

constexpr std::size_t kMany = 400000;

TEST(spheres, every_number_is_uniform_and_so_are_pairs)
{
  // Chi squared of 16 x 16 cells, 255 degrees of freedom: five sigmas are 113. All four
  // numbers of a sphere, each with the next, and with the next sphere's first.
  constexpr int kSide = 16;
  for (int first = 0; first < 4; first++) {
    std::vector<int> count(kSide * kSide, 0);
    for (std::size_t i = 0; i < kMany; i++) {
      const Real u = uniform(7, 4 * i + first), v = uniform(7, 4 * i + first + 1);
      count[std::min(int(u * kSide), kSide - 1) * kSide + std::min(int(v * kSide), kSide - 1)]++;
    }
    const Real expected = Real(kMany) / count.size();
    Real chi_sq = 0;
    for (int n : count) chi_sq += (n - expected) * (n - expected) / expected;
    EXPECT_NEAR(chi_sq, 255, 5 * std::sqrt(2 * 255.)) << first;
  }
}

TEST(spheres, are_in_their_box_and_no_larger_than_the_largest)
{
  const SphereBox box = {{-3, 5, 100}, {-1, 9, 101}, 0.25, 4};
  for (const Sphere &s : make_spheres(box, kMany, Order::random)) {
    for (int k = 0; k < 3; k++) {
      ASSERT_GE(s.centre()[k], box.lo[k]);
      ASSERT_LE(s.centre()[k], box.hi[k]);
    }
    ASSERT_GT(s.r, 0);
    ASSERT_LE(s.r, box.largest);
  }
}

bool before(const Sphere &a, const Sphere &b)
{
  return std::array<Real, 4>{a.x, a.y, a.z, a.r} < std::array<Real, 4>{b.x, b.y, b.z, b.r};
}
bool same(const Sphere &a, const Sphere &b)
{
  return !before(a, b) && !before(b, a);
}

TEST(spheres, sorted_ones_are_the_same_closer_to_each_other)
{
  const SphereBox box = {{0, 0, 0}, {1, 2, 3}, 0.1, 4};
  std::vector<Sphere> random = make_spheres(box, 20000, Order::random),
                      sorted = make_spheres(box, 20000, Order::sorted);
  const auto path = [](const std::vector<Sphere> &s) {
    Real length = 0;
    for (std::size_t i = 1; i < s.size(); i++) length += norm(s[i].centre() - s[i - 1].centre());
    return length;
  };
  // Steps of the spacing n^(-1/3) of the box, a few times that where the curve jumps.
  EXPECT_LT(path(sorted), path(random) / 10);
  std::sort(random.begin(), random.end(), before);
  std::sort(sorted.begin(), sorted.end(), before);
  EXPECT_TRUE(std::equal(random.begin(), random.end(), sorted.begin(), same));
}

// ---- the cylinder -------------------------------------------------------------------

// In the half-plane (rho, z) the surface is three segments.
Real profile_distance(const Vec3 &q, Real radius, Real height)
{
  const Real rho = std::hypot(q.x, q.y);
  const auto to_segment = [&](Real ax, Real ay, Real bx, Real by) {
    const Real ux = bx - ax, uy = by - ay;
    const Real t = ((rho - ax) * ux + (q.z - ay) * uy) / (ux * ux + uy * uy);
    const Real s = std::clamp(t, Real(0), Real(1));
    return std::hypot(rho - ax - s * ux, q.z - ay - s * uy);
  };
  return std::min({to_segment(0, 0, radius, 0), to_segment(radius, 0, radius, height),
                   to_segment(radius, height, 0, height)});
}

TEST(function_three, is_the_distance_to_three_segments_of_a_profile)
{
  Numbers r(3);
  for (int i = 0; i < 200000; i++) {
    const Vec3 q = {r.in(-80, 80), r.in(-80, 80), r.in(-40, 140)};
    ASSERT_NEAR(cylinder_distance(q, 50, 100), profile_distance(q, 50, 100), 1e-13);
  }
}

CylinderMesh shape_of(int segments, int along, int slant, Caps caps)
{
  CylinderMesh shape;
  shape.segments = segments;
  shape.along = along;
  shape.slant = slant;
  shape.caps = caps;
  return shape;
}

// Triangles with an angle above 90 degrees, by more than rounding.
std::size_t n_obtuse(const TriangleSoup &soup)
{
  std::size_t n = 0;
  for (std::size_t t = 0; t < soup.corners.size(); t += 3)
    for (int k = 0; k < 3; k++) {
      const Vec3 p = soup.corners[t + k];
      n += dot(soup.corners[t + (k + 1) % 3] - p, soup.corners[t + (k + 2) % 3] - p) < -1e-9;
    }
  return n;
}

TEST(cylinder, is_the_same_closed_prism_however_it_is_cut)
{
  const Real sine = std::sin(2 * kPi / 12), area_of_end = 12 * 0.5 * 50 * 50 * sine,
             side = 2 * 50 * std::sin(kPi / 12);
  for (const Caps caps : {Caps::centre, Caps::rim})
    for (int along : {1, 2, 7})
      for (int slant : {0, 1, 3, 20}) {
        const WeldedMesh mesh = weld(make_cylinder(shape_of(12, along, slant, caps)), -1);
        const std::size_t per_end = caps == Caps::centre ? 12 : 10;
        EXPECT_EQ(mesh.faces.size(), 2 * (12 * along + per_end));
        EXPECT_TRUE(mesh.report.oriented);
        EXPECT_NEAR(mesh.report.volume, area_of_end * 100, 1e-9 * area_of_end * 100);
        EXPECT_NEAR(mesh.report.area, 2 * area_of_end + 12 * side * 100, 1e-6);
      }
}

TEST(cylinder, has_obtuse_triangles_only_where_they_are_asked_for)
{
  EXPECT_EQ(n_obtuse(make_cylinder(shape_of(12, 4, 0, Caps::centre))), 0u);
  EXPECT_GT(n_obtuse(make_cylinder(shape_of(12, 4, 1, Caps::centre))), 50u);
  EXPECT_GT(n_obtuse(make_cylinder(shape_of(12, 4, 0, Caps::rim))), 10u);
}

TEST(cylinder, that_is_none_is_refused)
{
  EXPECT_THROW(make_cylinder(shape_of(2, 1, 0, Caps::centre)), InputError);
  EXPECT_THROW(make_cylinder(shape_of(3, 0, 0, Caps::centre)), InputError);
  EXPECT_THROW(make_cylinder(shape_of(3, 1, -1, Caps::centre)), InputError);
}

// ---- the study ----------------------------------------------------------------------

// The finest grid, over the radius.
Real finest()
{
  return std::getenv("LSDCD_QUICK") ? 0.5 : 0.2;
}

AccuracyStudy study_of(const CylinderMesh &shape, Real cube, std::size_t n,
                       InsideTest inside = InsideTest::exact, Order order = Order::random)
{
  StudySettings settings;
  settings.device = test_device();
  settings.inside = inside;
  settings.order = order;
  settings.repeats = 1;
  AccuracyStudy study(shape, cube, 1, settings);
  study.set_spheres(n);
  return study;
}

StudyLists lists_of(int nearest, Real length)
{
  StudyLists lists;
  lists.nearest = nearest;
  lists.length = length;
  return lists;
}

TEST(study, never_touching_scores_the_space_away_from_the_cylinder)
{
  // The share touching is the mean over radii t of the volume within t of the surface,
  // outside with rims rounded (Pappus), inside a smaller cylinder; the cube holds all.
  const Real radius = 50, height = 100, cube = 102;
  Real touching = 0;
  const int n = 10000;
  for (int i = 0; i < n; i++) {
    const Real t = (i + 0.5) / n;
    const Real inside =
        kPi * (radius * radius * height - (radius - t) * (radius - t) * (height - 2 * t));
    const Real shell = kPi * ((radius + t) * (radius + t) - radius * radius) * height;
    const Real ends = 2 * kPi * radius * radius * t;
    const Real rims = 2 * (kPi * t * t / 4) * 2 * kPi * (radius + 4 * t / (3 * kPi));
    touching += (inside + shell + ends + rims) / n;
  }
  touching /= cube * cube * cube;
  AccuracyStudy study = study_of(CylinderMesh(), cube, kMany);
  EXPECT_NEAR(study.measure(lists_of(0, 0.5)).never, 1 - touching,
              5 * std::sqrt(touching * (1 - touching) / kMany));
}

TEST(study, complete_lists_are_the_wall_itself)
{
  AccuracyStudy study = study_of(CylinderMesh(), 100, kMany);
  StudyLists every = lists_of(0, std::getenv("LSDCD_QUICK") ? 0.8 : 0.5);
  every.every_face = true;
  for (const StudyLists &lists : {lists_of(0, 0.5), lists_of(0, 0.8), every}) {
    const StudyRow row = study.measure(lists);
    EXPECT_EQ(study.grid().length, lists.length);
    EXPECT_EQ(row.accuracy, row.best);
    EXPECT_EQ(row.error(), 0);
    EXPECT_EQ(row.missed, 0u);
    EXPECT_EQ(row.false_ones, 0u);
    EXPECT_EQ(row.certified, 1);
    EXPECT_LT(row.largest_overlap_error, 1e-10);
    EXPECT_GT(row.touching, kMany / 50);
  }
}

TEST(study, fewer_triangles_only_lose_contacts)
{
  AccuracyStudy study = study_of(CylinderMesh(), 100, kMany);
  std::size_t missed = kMany;
  Real certified = 0;
  for (int n : {1, 2, 3}) {
    const StudyRow row = study.measure(lists_of(n, 0.9));
    EXPECT_EQ(row.false_ones, 0u);
    EXPECT_LE(row.missed, missed);
    EXPECT_GT(row.certified, certified);
    if (n == 1) {
      EXPECT_GT(row.missed, 5u);
      EXPECT_LT(row.certified, 1);
      EXPECT_GT(row.largest_overlap_error, 0);
      EXPECT_GT(row.mean_force_error, 0);
    }
    missed = row.missed;
    certified = row.certified;
  }
}

TEST(study, repeats_table_two_of_the_paper_but_for_one_triangle)
{
  // 2e-4, the issue's, and three sigmas of 4e5 spheres at 0.6 % disagreement.
  const Real sampling = 3 * std::sqrt(0.006 / kMany);
  AccuracyStudy study = study_of(CylinderMesh(), 100, kMany);
  for (const PaperAccuracy &paper : kPaperTable2) {
    if (paper.length < finest()) continue;
    const StudyRow row = study.measure(lists_of(paper.n, paper.length));
    if (paper.n == 1)
      EXPECT_GT(row.accuracy, paper.accuracy + 0.02);
    else
      EXPECT_NEAR(row.accuracy, paper.accuracy, 2e-4 + sampling) << paper.n << " " << paper.length;
  }
}

TEST(study, one_triangle_of_the_paper_scores_as_no_contact_at_all)
{
  AccuracyStudy study = study_of(CylinderMesh(), 100, kMany);
  const std::vector<Guess> guesses = guess_one_triangle(study, finest());
  EXPECT_GT(guesses[0].accuracy, 0.993);
  const auto paper =
      std::find_if(std::begin(kPaperTable2), std::end(kPaperTable2),
                   [](const PaperAccuracy &row) { return row.n == 1 && row.length == finest(); });
  EXPECT_NEAR(guesses[1].accuracy, paper->accuracy, 3 * std::sqrt(0.037 * 0.963 / kMany));
}

TEST(study, formula_five_costs_nothing_without_obtuse_triangles_and_much_with_them)
{
  const auto every_face = [](const CylinderMesh &shape) {
    AccuracyStudy study = study_of(shape, 100, 40000, InsideTest::formula_five);
    StudyLists lists = lists_of(1, 0.5);
    lists.every_face = true;
    return study.measure(lists);
  };
  const StudyRow none = every_face(shape_of(39, 1, 0, Caps::centre)),
                 obtuse = every_face(shape_of(39, 4, 2, Caps::centre)),
                 ends = every_face(shape_of(39, 1, 0, Caps::rim));
  EXPECT_EQ(none.missed, 0u);
  EXPECT_LE(none.false_ones, 1u);    // a sliver past the rim of an end: 5e-7 of the spheres
  EXPECT_GT(obtuse.missed + obtuse.false_ones, 100u);
  EXPECT_GT(ends.missed, 0u);
}

TEST(study, gives_the_same_counts_on_both_devices)
{
  if (!test_on_cuda()) GTEST_SKIP() << "compares CUDA with the CPU";
  StudySettings settings;
  settings.repeats = 1;
  settings.device = Device::cpu;
  AccuracyStudy cpu(CylinderMesh(), 100, 1, settings);
  settings.device = Device::cuda;
  AccuracyStudy cuda(CylinderMesh(), 100, 1, settings);
  cpu.set_spheres(kMany);
  cuda.set_spheres(kMany);
  for (int n : {0, 1, 2}) {
    const StudyRow a = cpu.measure(lists_of(n, 0.4)), b = cuda.measure(lists_of(n, 0.4));
    EXPECT_EQ(a.accuracy, b.accuracy);
    EXPECT_EQ(a.missed, b.missed);
    EXPECT_EQ(a.certified, b.certified);
    EXPECT_EQ(a.entries, b.entries);
    EXPECT_EQ(a.mean_force_error, b.mean_force_error);
  }
}

TEST(study, force_error_of_a_missed_contact_is_all_of_it)
{
  // Two walls 0.2 apart, one triangle per cell of 1.6: in the upper one's cells only the
  // lower is listed, or the other way round.
  TriangleSoup soup;
  soup.corners = {{0, 0, 0}, {40, 0, 0}, {0, 40, 0}, {0, 0, 0.2}, {40, 0, 0.2}, {0, 40, 0.2}};
  StudySettings settings;
  settings.device = test_device();
  settings.repeats = 1;
  AccuracyStudy study(soup, 1, settings);
  study.set_spheres(kMany);
  const StudyRow row = study.measure(lists_of(1, 1.6));
  EXPECT_GT(row.missed, 0u);
  EXPECT_NEAR(row.largest_overlap_error, 0.2, 1e-3);    // their distance, over the radius 1
  EXPECT_EQ(row.best, 1);
  EXPECT_NEAR(row.accuracy, 1 - Real(row.missed) / kMany, 1e-15);

  // The mean once more, from the answers of both grids.
  const auto distances = [&] {
    const auto query = make_sphere_query(test_device());
    query->set_grid(study.grid(), study.mesh());
    query->set_spheres(study.spheres().data(), kMany);
    query->run(QuerySettings());
    return query->distance();
  };
  const std::vector<Real> short_list = distances();
  study.measure(lists_of(0, 1.6));
  const std::vector<Real> complete = distances();
  Real sum = 0;
  for (std::size_t i = 0; i < kMany; i++) {
    const Real r = study.spheres()[i].r, overlap = std::fmax(r - short_list[i], Real(0));
    if (complete[i] < r) sum += 1 - overlap / (r - complete[i]);
  }
  EXPECT_NEAR(row.mean_force_error, sum / row.touching, 1e-9);
}

}    // namespace
}    // namespace lsdcd::test_study
