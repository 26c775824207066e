// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Lists of the N nearest triangles: what they hold, and what their certificates promise.
#include "contact/find_contacts.h"
#include "support/brute_force_long.h"
#include "support/device.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/random_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace lsdcd::test_nearest {
namespace {

constexpr int kMost = 512;

StepGrid grid_of(const WeldedMesh &mesh, Real cutoff, Real length, int nearest)
{
  StepGridSettings settings;
  settings.cutoff = cutoff;
  settings.length = length;
  settings.nearest = nearest;
  return build_grid(mesh, settings, test_on_cuda());
}

// The distances from a point to the triangles near it, ascending, by another formula.
std::vector<Real> distances(const std::vector<LongTriangle<long double>> &triangles, const Vec3 &c)
{
  std::vector<Real> out;
  for (const auto &t : triangles)
    out.push_back(std::sqrt(static_cast<Real>(distance_sq<long double>(t, c))));
  std::sort(out.begin(), out.end());
  return out;
}

struct Named {
  const char *name;
  TriangleSoup soup;
  Real cutoff, length;
};

std::vector<Named> walls()
{
  return {{"cylinder", cylinder_mesh(40, 5, 5, 10), 1, 0.4},
          {"shuffled floor", floor_mesh(12, 3, 5), 0.3, 0.2},
          {"cone", cone_mesh(50, 1, 1), 0.4, 0.15},
          {"box", box_mesh({0, 0, 0}, {3, 2, 1}), 0.5, 0.25}};
}

// Bounds are floats rounded down by up to 1e-6 of themselves and a float's last bit.
constexpr Real kBelow = 1.2e-6;

TEST(nearest_lists, hold_the_nearest_triangles_in_order_and_the_next_as_a_bound)
{
  for (const Named &w : walls())
    for (int n : {1, 3, 8}) {
      const WeldedMesh mesh = weld(w.soup, -1);
      const StepGrid grid = grid_of(mesh, w.cutoff, w.length, n);
      const GridView view = grid.view();
      const auto triangles = long_triangles<long double>(w.soup);
      Numbers random(n);
      int cells = 0;
      while (cells < 300) {
        const Vec3 q = random_centre(random, w.soup.corners.data(), int(w.soup.n_triangles()),
                                     mesh.report.lo, mesh.report.hi, w.cutoff);
        CellAddress at;
        Cell cell;
        if (!find_cell(view, q, at, cell)) continue;
        cells++;
        const std::vector<Real> d = distances(triangles, q - at.from_centre);
        // A list holds what is within the cutoff and half a diagonal, and the next as a bound.
        const Real limit = w.cutoff + grid.tolerance + 0.5 * std::sqrt(3.) * w.length * (1 + 1e-6);
        const auto within = std::upper_bound(d.begin(), d.end(), limit) - d.begin();
        // Rounding may decide about a triangle at the very limit.
        const auto surely = std::upper_bound(d.begin(), d.end(), limit * (1 - 1e-9)) - d.begin();
        ASSERT_LE(cell.count, std::min<long>(n + 1, within)) << w.name;
        ASSERT_GE(cell.count, std::min<long>(n + 1, surely)) << w.name;
        if (cell.count == 1) continue;
        for (std::uint32_t k = 0; k < cell.count; k++) {
          const Real bound = view.lists.entries[cell.first + k].bound;
          EXPECT_LE(bound, d[k] + grid.tolerance) << w.name << ", N " << n;
          EXPECT_GE(bound, d[k] * (1 - kBelow) - grid.tolerance) << w.name << ", N " << n;
        }
      }
    }
}

// The common part of two answers: features and distances, in any order.
using Contacts = std::vector<std::pair<FeatureCode, Real>>;

Contacts contacts(const GridView &view, const Vec3 &q, Real radius, Real *exact_within = nullptr)
{
  ContactSet<kMost> set;
  const Real exact = find_contacts(view, q, radius, set);
  if (exact_within) *exact_within = exact;
  Contacts out;
  for (int i = 0; i < set.n; i++) out.push_back({set.feature[i], set.distance[i]});
  std::sort(out.begin(), out.end());
  return out;
}

struct Shares {
  long certified = 0, uncertified = 0, differ = 0;
};

// Good and bad random meshes; feature records are the same, so that equal means equal.
// LSDCD_QUICK: a third of them.
Shares compare_with_complete(int nearest)
{
  Shares shares;
  const std::uint64_t last = std::getenv("LSDCD_QUICK") ? 20 : 60;
  for (std::uint64_t seed = 1; seed <= last; seed++) {
    const RandomMesh made = random_mesh(seed);
    const WeldedMesh mesh = weld(made.soup, 0);
    if (norm(mesh.report.hi - mesh.report.lo) > 60 * made.cutoff) continue;
    const Real length = 0.4 * made.cutoff;
    const StepGrid some = grid_of(mesh, made.cutoff, length, nearest),
                   all = grid_of(mesh, made.cutoff, length, 0);
    const GridView some_view = some.view(), all_view = all.view();
    Numbers random(seed);
    for (int i = 0; i < 500; i++) {
      const Vec3 q = random_centre(random, made.soup.corners.data(), int(made.soup.n_triangles()),
                                   mesh.report.lo, mesh.report.hi, made.cutoff);
      const Real radius = made.cutoff * random.in(0, 1);
      Real exact_within = 0;
      const Contacts found = contacts(some_view, q, radius, &exact_within);
      const bool equal = found == contacts(all_view, q, radius);
      if (exact_within >= radius) {
        shares.certified++;
        EXPECT_TRUE(equal) << "mesh " << seed << " (" << made.kind << "), sphere " << i << ", N "
                           << nearest;
      } else {
        shares.uncertified++;
        shares.differ += !equal;
      }
    }
  }
  return shares;
}

TEST(certificates, are_never_wrong)
{
  for (int n : {1, 3, 8}) {
    const Shares s = compare_with_complete(n);
    EXPECT_GT(s.certified, 100) << n;
    EXPECT_GT(s.uncertified, s.differ) << n;
    if (n == 1) {    // contacts are missed, and no certificate is given
      EXPECT_GT(s.differ, 100);
    }
  }
}

// A facet with no area leaves its edges; they stand for themselves.
TEST(nearest_lists, hold_edges_and_points_that_have_no_face)
{
  TriangleSoup soup;
  soup.source = "needle";
  soup.corners = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const StepGrid grid = grid_of(weld(soup, 0), 0.3, 0.1, 4);
  ContactSet<kMost> set;
  EXPECT_EQ(find_contacts(grid.view(), {1.5, 0, 0.2}, 0.25, set), kAnyDistance);
  ASSERT_EQ(set.n, 1);
  EXPECT_DOUBLE_EQ(set.distance[0], 0.2);
}

struct Box {
  Scene scene;

  explicit Box(int nearest) :
      scene(box_mesh({0, 0, 0}, {3, 2, 1}), 0.3, hooke(1e4), 0.2, -1, nearest)
  {
    Numbers random(4);
    for (int i = 0; i < 3000; i++)
      scene.add_sphere({random.in(0, 3), random.in(0, 2), random.in(0, 1)}, random.in(0.1, 0.3), 1);
    scene.compute(1e-6);
  }
};

// By hand: a sphere in the corner touches three faces, two triangles each, of which one
// stands for its face; the nearest triangle alone gives one of the three contacts.
TEST(nearest_in_the_engine, counts_uncertified_spheres_and_bounds_what_they_miss)
{
  Scene scene(box_mesh({0, 0, 0}, {3, 3, 3}), 0.5, hooke(1e4), 0.25, -1, 1);
  scene.add_sphere({0.4, 0.41, 0.42}, 0.5, 1);
  scene.add_sphere({1.5, 1.5, 0.45}, 0.1, 1);    // touches nothing, and that is certain
  scene.compute(1e-6);
  const WallTotals &t = scene.engine->results().totals();
  EXPECT_EQ(t.contacts, 1);
  EXPECT_EQ(t.uncertified, 1);
  // The deepest it misses overlaps by 0.5 - 0.41; the bound is of the second triangle of
  // the face it has, less than half a cell's diagonal nearer.
  EXPECT_GE(t.largest_uncertain, (0.5 - 0.41) / 0.5);
  EXPECT_LE(t.largest_uncertain, (0.5 - 0.4 + std::sqrt(3.) * 0.25) / 0.5);
}

// Spheres that touch nothing that is listed count as well.
TEST(nearest_in_the_engine, counts_every_sphere_that_is_not_certified)
{
  Box box(1);
  long uncertified = 0, without_contact = 0;
  for (int i = 0; i < box.scene.n(); i++) {
    Real exact_within = 0;
    const Contacts found =
        contacts(box.scene.grid.view(), box.scene.x(i), box.scene.radius(i), &exact_within);
    uncertified += exact_within < box.scene.radius(i);
    without_contact += exact_within < box.scene.radius(i) && found.empty();
  }
  EXPECT_EQ(box.scene.engine->results().totals().uncertified, uncertified);
  EXPECT_GT(without_contact, 0);
}

TEST(nearest_in_the_engine, complete_lists_are_certain)
{
  Box all(0);
  EXPECT_EQ(all.scene.engine->results().totals().uncertified, 0);
  EXPECT_EQ(all.scene.engine->results().totals().largest_uncertain, 0);
}

}    // namespace
}    // namespace lsdcd::test_nearest
