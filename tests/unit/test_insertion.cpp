// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// When grains are due, how large they are, and where they fit: closed forms and brute force.
#include "base/input_error.h"
#include "input/insert_settings.h"
#include "insert/inlet_face.h"
#include "insert/insertion.h"
#include "shape/placed_grain.h"
#include "support/says.h"
#include "support/shape_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <random>
#include <sstream>
#include <vector>

namespace lsdcd::test_insertion {
namespace {

InsertionPlan plan_of(FeedSettings::Kind kind, Real rate)
{
  InsertionPlan plan;
  plan.feed.kind = kind;
  plan.feed.rate = rate;
  plan.grains.sizes = {{1, 1}};
  plan.grains.smallest = plan.grains.largest = 1;
  plan.grains.density_lo = plan.grains.density_hi = 6 / kPi;    // a mass of 1
  return plan;
}

// So many grains, all of them due at once.
InsertionPlan at_once(std::int64_t number)
{
  InsertionPlan plan = plan_of(FeedSettings::at_once, 0);
  plan.feed.number = number;
  return plan;
}

// Anywhere in a cube, without walls.
struct Cube : InsertionSite {
  Real side = 100;
  bool draw(RandomStream &random, Real, Vec3 &at) override
  {
    for (int k = 0; k < 3; k++) at[k] = random.uniform(0, side);
    return true;
  }
  bool is_clear_of_walls(const PackedSphere &grain) override { return grain.radius < too_large; }
  void check_has_room(const Grain &) override {}
  Real too_large = 1e9;    // radius
  Box zone() const { return {{0, 0, 0}, {side, side, side}}; }
};

// An insertion into a cube, and the grains that are there.
template <class Site = Cube>
struct Feed : Insertion {
  Site site;
  std::vector<PackedSphere> there;

  explicit Feed(const InsertionPlan &plan, std::int64_t step = 0, Real dt = 1) :
      Insertion(plan, step, dt)
  {
  }
  // Returns how many grains come in a step.
  std::size_t insert(std::int64_t step)
  {
    draw_due(step);
    Packing packing(there, site.zone(), source().largest_radius(), PeriodicBox());
    Refused refused;
    const std::vector<Placed> placed = place(step, site, packing, refused);
    for (const Placed &p : placed) there.push_back(packed(owed()[p.index], p.at, p.turn, 0));
    accept(step, placed, refused);
    return placed.size();
  }
  std::size_t insert_next() { return insert(next_step()); }
};

TEST(insertion, a_grain_comes_in_the_first_step_in_which_the_rate_has_reached_it)
{
  // Grain k has been reached at (k + 1) / 0.3 time units, that is (k + 1) / 0.03 steps.
  for (const auto kind : {FeedSettings::by_mass, FeedSettings::by_number}) {
    Feed<> insertion(plan_of(kind, 0.3), 7, 0.1);
    for (int k = 0; k < 200; k++) {
      const auto due = static_cast<std::int64_t>(std::ceil((k + 1) / 0.03L - 1e-6L));
      EXPECT_EQ(insertion.next_step(), 7 + due) << k;
      EXPECT_EQ(insertion.insert_next(), 1U);
    }
  }
}

TEST(insertion, every_n_steps_brings_all_that_is_due_by_then)
{
  InsertionPlan plan = plan_of(FeedSettings::by_number, 1);
  plan.feed.every = 25;
  Feed<> insertion(plan, 0, 0.1);
  EXPECT_EQ(insertion.next_step(), 25);
  EXPECT_EQ(insertion.insert(25), 2U);
  EXPECT_EQ(insertion.next_step(), 50);
  EXPECT_EQ(insertion.insert(50), 3U);
}

TEST(insertion, it_ends_with_the_number_or_mass_asked_for)
{
  for (const bool by_mass : {false, true}) {
    InsertionPlan plan = plan_of(FeedSettings::by_number, 10);
    if (by_mass)
      plan.feed.mass = 10.999;    // the 11th would be past it
    else
      plan.feed.number = 10;
    Feed<> insertion(plan);
    EXPECT_EQ(insertion.insert(1), 10U);
    EXPECT_EQ(insertion.next_step(), FeedSchedule::kNever);
    EXPECT_NEAR(insertion.inserted_mass(), 10, 1e-12);
  }
}

// Tablets of 3 by 3 by 1.6 with round outlines and flat sides.
GrainKind tablet()
{
  return {make_superellipsoid({1.5, 1.5, 0.8}, 6, 2)};
}

GrainKind ellipsoid(const Vec3 &half, Real least, Real most, Real share)
{
  return {make_superellipsoid(half, 2, 2), least, most, share};
}

TEST(insertion, shapes_have_their_shares_of_the_number_or_of_the_mass)
{
  // Volumes of 4/3 pi (1, 6, 3), times the mean of a cube: 1, (2^4 - 1^4) / 4, 1.
  const std::vector<GrainKind> kinds = {ellipsoid({1, 1, 1}, 1, 1, 0.2),
                                        ellipsoid({1, 2, 3}, 1, 2, 0.5),
                                        ellipsoid({3, 1, 1}, 1, 1, 0.3)};
  const Real mass[] = {1, 6 * 15 / 4.0, 3};
  for (const bool is_by_mass : {false, true}) {
    InsertionPlan plan = at_once(1);
    plan.grains.set_kinds(kinds, is_by_mass);
    Real sum = 0, mean = 0, share[3];
    for (int k = 0; k < 3; k++) sum += share[k] = kinds[k].share / (is_by_mass ? mass[k] : 1);
    for (int k = 0; k < 3; k++) mean += (share[k] /= sum) * mass[k];
    // The density is 6 / pi.
    EXPECT_NEAR(plan.grains.mean_mass() / 8, mean, 1e-12 * mean);
    const GrainSource source(plan.grains, 7);
    constexpr int kN = 20000;
    Real number[3] = {}, all = 0;
    for (int i = 0; i < kN; i++) {
      const Grain grain = source.grain(i);
      number[grain.kind]++;
      all += grain.mass() / 8;
      const Vec3 half = source.shape(grain).half;
      EXPECT_NEAR(grain.mass() / 8, half.x * half.y * half.z, 1e-12 * half.x * half.y * half.z);
    }
    // Five standard deviations; no mass is above 48.
    for (int k = 0; k < 3; k++)
      EXPECT_NEAR(number[k], kN * share[k], 5 * std::sqrt(kN * share[k] * (1 - share[k]))) << k;
    EXPECT_NEAR(all / kN, mean, 5 * std::sqrt(48 * mean / kN));
  }
}

TEST(insertion, turns_are_uniform_among_all_rotations)
{
  InsertionPlan plan = at_once(1);
  plan.grains.set_kinds({tablet()}, false);
  const GrainSource source(plan.grains, 5);
  RandomStream random({1});
  constexpr int kN = 20000;
  // Of each axis, the mean of a component has the variance 1/3, of two the mean square 1/3 and that the variance 4/45. The angle of
  // a rotation has the density (1 - cos) / pi, so its cosine the mean -1/2 and the variance 1/4.
  Real sum[3][3] = {}, square[3][3] = {}, cosine = 0;
  for (int i = 0; i < kN; i++) {
    const Quaternion q = source.turn(random);
    Vec3 row[3];
    rows_of(q, row);
    cosine += (row[0].x + row[1].y + row[2].z - 1) / 2;
    for (int k = 0; k < 3; k++)
      for (int l = 0; l < 3; l++) {
        sum[k][l] += row[k][l];
        square[k][l] += row[k][l] * row[k][l];
      }
  }
  for (int k = 0; k < 3; k++)
    for (int l = 0; l < 3; l++) {
      EXPECT_NEAR(sum[k][l] / kN, 0, 5 * std::sqrt(1 / 3.0 / kN));
      EXPECT_NEAR(square[k][l] / kN, 1 / 3.0, 5 * std::sqrt(4 / 45.0 / kN));
    }
  EXPECT_NEAR(cosine / kN, -0.5, 5 * std::sqrt(0.25 / kN));
}

// The least distance of two grains that do not overlap, from below: by a plane between them, found by steps towards the nearest
// difference of their points (Gilbert 1966) with the support function in long double.
Real apart_by(const ShapeOracle &oracle, const PackedSphere &a, const PackedSphere &b)
{
  const PlacedGrain *of[2] = {&a.shape->grain, &b.shape->grain};
  const auto point = [&](int i, const Vec3 &n) {
    const LongVec x = oracle.point(vec_cast<Long>(of[i]->to_own(n)));
    return of[i]->turned({Real(x.x), Real(x.y), Real(x.z)});
  };
  Vec3 nearest = b.at - a.at;
  Real best = -HUGE_VAL;
  for (int i = 0; i < 3000 && best < -1e-7; i++) {
    const Vec3 n = (1 / norm(nearest)) * nearest;
    const Vec3 corner = b.at + point(1, -n) - a.at - point(0, n);
    best = std::max(best, dot(corner, n));
    const Vec3 side = corner - nearest;
    nearest += std::clamp(-dot(nearest, side) / norm_sq(side), Real(0), Real(1)) * side;
  }
  return best;
}

TEST(insertion, tablets_come_clear_of_each_other_and_denser_than_the_spheres_around_them)
{
  InsertionPlan plan = at_once(3000);
  plan.attempts = 1000;
  plan.grains.set_kinds({tablet()}, false);
  Feed<> insertion(plan);
  insertion.site.side = 30;
  insertion.insert(1);
  // Spheres that come one by one fill 0.38 at most.
  const Real tablets = static_cast<Real>(insertion.there.size()) * volume(tablet().shape) / 27000;
  const Real spheres =
      0.38 * volume(tablet().shape) / (kBallVolume * std::pow(tablet().shape.farthest, 3));
  EXPECT_GT(tablets, spheres);
  const ShapeOracle oracle(tablet().shape);
  const Real reach = 2 * tablet().shape.farthest;
  int near = 0;
  for (std::size_t i = 0; i < insertion.there.size(); i++)
    for (std::size_t j = 0; j < i; j++) {
      if (norm(insertion.there[i].at - insertion.there[j].at) >= reach) continue;
      near++;
      EXPECT_GE(apart_by(oracle, insertion.there[i], insertion.there[j]), -1e-6);
    }
  EXPECT_GT(near, 500);
}

TEST(insertion, a_tablet_keeps_clear_of_a_sphere_by_its_shape)
{
  const PackedSphere flat = {{0, 0, 0},
                             tablet().shape.farthest,
                             std::make_shared<const PackedShape>(
                                 PackedShape{place_grain(tablet().shape, {0, 0, 0}, {}), 0})};
  const Packing packing({flat}, {{-9, -9, -9}, {9, 9, 9}}, 2, PeriodicBox());
  EXPECT_FALSE(packing.overlaps({{0, 0, 1.8001}, 1}));
  EXPECT_TRUE(packing.overlaps({{0, 0, 1.7999}, 1}));
  EXPECT_FALSE(packing.overlaps({{2.5001, 0, 0}, 1}));
  EXPECT_TRUE(packing.overlaps({{2.4999, 0, 0}, 1}));
}

TEST(insertion, grains_that_touch_as_spheres_keep_clear_by_these_too)
{
  const auto at = [](Real z, Real touch) {
    return PackedSphere{{0, 0, z},
                        tablet().shape.farthest,
                        std::make_shared<const PackedShape>(
                            PackedShape{place_grain(tablet().shape, {0, 0, 0}, {}), touch})};
  };
  const auto overlap = [&](Real z, Real touch) {
    return Packing({at(0, touch)}, {{-9, -9, -9}, {9, 9, 9}}, 2, PeriodicBox())
        .overlaps(at(z, touch));
  };
  EXPECT_FALSE(overlap(1.7, 0));
  EXPECT_TRUE(overlap(1.7, 1));
  EXPECT_FALSE(overlap(2.01, 1));
}

TEST(insertion, after_a_restart_shapes_go_on_as_they_were)
{
  InsertionPlan plan = plan_of(FeedSettings::by_number, 1);
  plan.grains.set_kinds({tablet(), ellipsoid({1, 2, 3}, 0.5, 1, 1)}, true);
  Feed<> whole(plan), first(plan), second(plan, 5);
  for (int step = 1; step <= 10; step++) whole.insert(step);
  for (int step = 1; step <= 5; step++) first.insert(step);
  const std::vector<Real> saved = first.state(5).numbers();
  EXPECT_TRUE(second.restore(saved.data(), saved.size(), 5));
  second.there = first.there;
  for (int step = 6; step <= 10; step++) second.insert(step);
  ASSERT_EQ(second.there.size(), 10U);
  for (std::size_t i = 0; i < 10; i++) {
    const PackedSphere &a = whole.there[i], &b = second.there[i];
    EXPECT_TRUE(a.at == b.at && a.radius == b.radius &&
                a.shape->grain.row[0] == b.shape->grain.row[0])
        << i;
  }
  plan.grains.set_kinds({tablet()}, true);
  Feed<> other(plan, 5);
  EXPECT_FALSE(other.restore(saved.data(), saved.size(), 5));
}

TEST(insertion, words_of_shapes_that_make_no_grains_are_refused)
{
  const auto says = [](const char *words, const char *what) {
    const bool has_density = std::string(words).rfind("mol", 0) != 0;    // clumps have their own
    std::istringstream text(std::string("region a number 5 ") + (has_density ? "dens 1 " : "") +
                            words);
    const std::vector<std::string> all{std::istream_iterator<std::string>(text), {}};
    EXPECT_TRUE(fails_with(what, [&] { parse_insert(all); })) << words;
  };
  says("shape 3 3 1.6 fraction 0.5", "the fractions add up to 0.5, not to 1");
  says("shape 3 3 1.6 shape 1 1 1 fraction 1",
       "there are 2 shapes, and 1 of them without 'fraction F'");
  says("shape 3 3 1.6 fraction 0.5 shape 1 1 1 massfraction 0.5",
       "give one of the two to all shapes");
  says("shape 3 3 1.6 block 1 2", "an exponent of a shape is 1");
  says("shape 3 3 1.6 spread 2 1", "HI = 1 is out of range");
  says("shape 3 3 1.6 block 6 2 block 6 2", "'block' is given twice");
  says("shape 3 3 1.6 diam one 1", "diam is of spheres and shape of other grains");
  says("diam one 1 orient random", "orient turns grains with a shape");
  says("mol stones rigid bodies diam one 1", "leave diam out");
  says("mol stones dens 1 rigid bodies", "leave dens out");
  says("mol stones", "rigid is missing");
  says("diam one 1 rigid bodies", "rigid is of clumps");
  says("mol stones fraction 0.3 0.3 rigid bodies", "the fractions add up to 0.6");
  says("shape 3 3 1.6 orient 0 0 0 30", "the axis is 0 0 0");
  says("shape 3 3 1e-200", "a half-axis of a shape is 5e-201");
}

TEST(insertion, shares_of_mass_are_shares_of_number_over_the_cube)
{
  GrainRecipe recipe;
  recipe.set_mass_shares({{1, 0.5}, {2, 0.5}});
  EXPECT_NEAR(recipe.sizes[0].share, 8.0 / 9, 1e-15);
  EXPECT_NEAR(recipe.sizes[1].share, 1.0 / 9, 1e-15);
  recipe.density_lo = recipe.density_hi = 6 / kPi;
  EXPECT_NEAR(recipe.mean_mass(), 8.0 / 9 + 8.0 / 9, 1e-14);
}

TEST(insertion, a_range_is_uniform_by_number)
{
  InsertionPlan plan = plan_of(FeedSettings::at_once, 0);
  plan.grains.sizes.clear();
  plan.grains.smallest = 1;
  plan.grains.largest = 3;
  const GrainSource source(plan.grains, 5);
  constexpr int kN = 40000;
  Real sum = 0, mass = 0;
  for (int i = 0; i < kN; i++) {
    sum += 2 * source.grain(i).radius;
    mass += source.grain(i).mass();
  }
  // The deviation of a uniform number is its width over sqrt(12); five of the mean's.
  EXPECT_NEAR(sum / kN, 2, 5 * 2 / std::sqrt(12.0 * kN));
  // d^3 has a variance of (3^7 - 1) / 14 - 10^2 = 56.1.
  EXPECT_NEAR(plan.grains.mean_mass(), 10, 1e-12);
  EXPECT_NEAR(mass / kN, 10, 5 * std::sqrt(56.2 / kN));
}

// Of n draws of a law: bounds of five standard errors, which one law in 1.7 million passes by chance.
struct Draws {
  std::vector<Vec3> v;
  Draws(const Vec3 &jitter, bool gaussian)
  {
    InsertionPlan plan = at_once(1);
    plan.grains.jitter = jitter;
    plan.grains.gaussian = gaussian;
    const GrainSource source(plan.grains, 5);
    for (int i = 0; i < 200000; i++) v.push_back(source.velocity_jitter(i));
  }
  template <class F>
  Real mean(F &&f) const
  {
    Real sum = 0;
    for (const Vec3 &a : v) sum += f(a);
    return sum / static_cast<Real>(v.size());
  }
  Real error(Real variance) const { return 5 * std::sqrt(variance / static_cast<Real>(v.size())); }
};

TEST(insertion, jitter_is_uniform_up_to_the_number_of_each_component)
{
  const Vec3 most = {0.5, 2, 0};
  const Draws draws(most, false);
  for (int k = 0; k < 3; k++) {
    for (const Vec3 &a : draws.v) ASSERT_LE(std::fabs(a[k]), most[k]);
    const Real second = most[k] * most[k] / 3, fourth = std::pow(most[k], 4) / 5;
    EXPECT_LE(std::fabs(draws.mean([&](const Vec3 &a) { return a[k]; })), draws.error(second));
    EXPECT_LE(std::fabs(draws.mean([&](const Vec3 &a) { return a[k] * a[k]; }) - second),
              draws.error(fourth - second * second));
  }
}

TEST(insertion, gaussian_jitter_has_the_moments_of_the_normal_distribution)
{
  const Vec3 s = {0.5, 2, 1};
  const Draws draws(s, true);
  for (int k = 0; k < 3; k++) {
    // Moments 1 to 4 are 0, 1, 0, 3, and the error of the m-th is that of the 2m-th: 1, 3, 15, 105.
    const Real moments[] = {0, 1, 0, 3}, next[] = {1, 3, 15, 105};
    for (int m = 1; m <= 4; m++)
      EXPECT_LE(std::fabs(draws.mean([&](const Vec3 &a) { return std::pow(a[k] / s[k], m); }) -
                          moments[m - 1]),
                draws.error(next[m - 1] - moments[m - 1] * moments[m - 1]))
          << "moment " << m << " of component " << k;
    // Beyond three deviations.
    const Real far = std::erfc(3 / std::sqrt(Real(2)));
    EXPECT_LE(
        std::fabs(draws.mean([&](const Vec3 &a) { return std::fabs(a[k]) > 3 * s[k]; }) - far),
        draws.error(far * (1 - far)));
    const int l = (k + 1) % 3;
    EXPECT_LE(std::fabs(draws.mean([&](const Vec3 &a) { return a[k] * a[l] / (s[k] * s[l]); })),
              draws.error(1));
  }
}

TEST(insertion, what_finds_no_place_is_owed_and_tried_again)
{
  InsertionPlan plan = at_once(5);
  Feed<> insertion(plan);
  insertion.site.side = 0.5;    // room for one
  EXPECT_EQ(insertion.next_step(), 1);
  EXPECT_EQ(insertion.insert(1), 1U);
  EXPECT_EQ(insertion.late().number, 4);
  EXPECT_NEAR(insertion.late().mass, 4, 1e-12);
  EXPECT_EQ(insertion.refused().grains,
            plan.attempts);    // of one grain; the others are no smaller
  // Twice as long from try to try.
  std::int64_t step = 1;
  for (const int wait : {1, 2, 4, 8, 16, 20, 20}) {
    EXPECT_EQ(insertion.next_step(), step += wait);
    EXPECT_EQ(insertion.insert(step), 0U);
  }
  insertion.site.side = 100;
  EXPECT_EQ(insertion.insert(step + 20), 4U);
  EXPECT_EQ(insertion.inserted(), 5);
}

TEST(insertion, the_wait_for_a_place_goes_on_after_a_restart)
{
  const InsertionPlan plan = at_once(5);
  Feed<> first(plan);
  first.site.side = 0.5;    // room for one
  for (const std::int64_t step : {1, 2, 4, 8}) first.insert(step);
  constexpr std::int64_t kSaved = 10;
  Feed<> second(plan, kSaved);
  const std::vector<Real> saved = first.state(kSaved).numbers();
  second.restore(saved.data(), saved.size(), kSaved);
  second.site.side = 0.5;
  second.there = first.there;
  std::int64_t step = 8;
  for (const int wait : {8, 16, 20, 20}) {
    EXPECT_EQ(second.next_step(), step += wait);
    EXPECT_EQ(second.insert(step), 0U);
  }
}

TEST(insertion, a_grain_without_a_place_does_not_hold_back_those_that_are_due_later)
{
  InsertionPlan plan = plan_of(FeedSettings::by_number, 1);
  Feed<> insertion(plan);    // a grain a step
  insertion.site.side = 0.5;
  insertion.there = {{{0, 0, 0}, 0.5}};
  for (int step = 1; step <= 30; step++) {
    ASSERT_EQ(insertion.next_step(), step);
    insertion.insert(step);
  }
  EXPECT_EQ(insertion.late().number, 30);
  insertion.site.side = 100;    // now there is room: all that is late comes
  EXPECT_EQ(insertion.insert(31), 31U);
  EXPECT_EQ(insertion.late().number, 0);
}

TEST(insertion, where_late_grains_find_places_the_others_are_tried_in_the_next_step)
{
  InsertionPlan plan = at_once(9);
  Feed<> insertion(plan);
  insertion.site.side = 0.5;
  insertion.there = {{{0, 0, 0}, 0.5}};
  for (const int step : {1, 2, 4, 8}) insertion.insert(step);
  EXPECT_EQ(insertion.next_step(), 16);
  insertion.there.clear();
  EXPECT_EQ(insertion.insert(16), 1U);
  EXPECT_EQ(insertion.next_step(), 17);
}

// Grains of 4 to 5 are due all at once, and go down through a chute that takes one or two in ten steps. How many came
// in, by fifths of the range of their diameters.
std::array<int, 5> sizes_through_a_full_chute(int steps, bool is_poly)
{
  InsertionPlan plan = at_once(200 + 2 * steps);
  plan.grains.sizes.clear();
  if (is_poly) plan.grains.sizes = {{4.1, 0.2}, {4.3, 0.2}, {4.5, 0.2}, {4.7, 0.2}, {4.9, 0.2}};
  plan.grains.smallest = 4;
  plan.grains.largest = 5;
  plan.attempts = 30;
  Feed<> insertion(plan);
  insertion.site.side = 15;
  std::array<int, 5> count = {};
  for (int step = 1; step <= steps; step++) {
    for (PackedSphere &grain : insertion.there) grain.at.z -= 0.05;
    insertion.there.erase(std::remove_if(insertion.there.begin(), insertion.there.end(),
                                         [](const PackedSphere &grain) { return grain.at.z < -5; }),
                          insertion.there.end());
    if (step != insertion.next_step()) continue;
    const std::size_t before = insertion.there.size();
    insertion.insert(step);
    for (std::size_t i = before; i < insertion.there.size(); i++)
      count[std::min(4, static_cast<int>(5 * (2 * insertion.there[i].radius - 4)))]++;
  }
  EXPECT_GT(insertion.late().number, 100);    // it was full
  return count;
}

// Of n grains a fifth of the range has n / 5, with the variance 4 n / 25; three deviations.
void expect_a_fifth_each(const std::array<int, 5> &count)
{
  Real n = 0;
  for (const int c : count) n += c;
  for (const int c : count) EXPECT_NEAR(c, n / 5, 3 * std::sqrt(4 * n / 25)) << "of " << n;
  EXPECT_GT(n, 300);
}

TEST(insertion, into_a_full_chute_keeps_the_sizes)
{
  expect_a_fifth_each(sizes_through_a_full_chute(2500, false));
  expect_a_fifth_each(sizes_through_a_full_chute(2500, true));
}

TEST(insertion, into_a_full_chute_keeps_the_sizes_for_100000_steps_LONG)
{
  expect_a_fifth_each(sizes_through_a_full_chute(100000, false));
}

TEST(insertion, a_grain_without_a_place_holds_back_no_burst_of_1500)
{
  InsertionPlan plan = at_once(1500);
  plan.grains.sizes.clear();
  plan.grains.smallest = 0.5;
  Feed<> insertion(plan);
  insertion.draw_due(1);
  Real largest = 0;
  for (const Grain &grain : insertion.owed()) largest = std::max(largest, grain.radius);
  insertion.site.too_large = largest;
  EXPECT_EQ(insertion.insert(1), 1499U);
  EXPECT_EQ(insertion.insert_next(), 0U);
  insertion.site.too_large = 1;
  EXPECT_EQ(insertion.insert_next(), 1U);
  EXPECT_EQ(insertion.next_step(), FeedSchedule::kNever);
}

TEST(insertion, so_many_as_may_be_passed_over_hold_back_all_that_come_after_them)
{
  InsertionPlan plan = plan_of(FeedSettings::by_number, 1);
  plan.grains.sizes = {{1, 0.5}, {2, 0.5}};
  plan.grains.largest = 2;
  Feed<> insertion(plan);
  insertion.site.too_large = 0.7;
  for (int step = 1; step <= 100; step++) insertion.insert(step);
  // Those before the last of them are in, and no other one.
  std::size_t small = 0, large = 0;
  for (std::int64_t k = 0; large <= Insertion::kMostPassedOver; k++)
    (insertion.source().grain(k).radius < 0.7 ? small : large)++;
  EXPECT_EQ(insertion.there.size(), small);
  insertion.site.too_large = 9;
  insertion.insert_next();
  EXPECT_EQ(insertion.late().number, 0);
}

TEST(insertion, where_a_grain_has_no_place_it_asks_whether_there_is_room_for_its_radius)
{
  struct Narrow : Cube {
    void check_has_room(const Grain &grain) override
    {
      throw InputError(grain.radius == 0.5 ? "no room" : "");
    }
  };
  Feed<Narrow> insertion(at_once(10)), late(at_once(10));
  EXPECT_EQ(insertion.insert(1), 10U);
  late.site.too_large = 0.5;
  EXPECT_TRUE(fails_with("no room", [&] { late.insert(1); }));
}

TEST(insertion, a_huge_amount_takes_the_memory_of_a_million_grains)
{
  InsertionPlan plan = at_once(1000000000);
  Feed<> insertion(plan);
  insertion.site.side = 0.5;
  EXPECT_EQ(insertion.insert(1), 1U);
  EXPECT_EQ(insertion.owed().size(), Insertion::kMostDrawn - 1);
  EXPECT_EQ(insertion.late().number, 999999999);
  EXPECT_NEAR(insertion.late().mass, 999999999, 1);    // rounding of 1e6 sums
  const std::vector<Real> saved = insertion.state(1).numbers();
  Feed<> restarted(plan, 1);
  restarted.restore(saved.data(), saved.size(), 1);
  EXPECT_EQ(restarted.late().number, 999999999);
  EXPECT_FALSE(insertion.has_more(1));
  // In vain: what is not drawn is due, too, and brings no try in each step.
  EXPECT_EQ(insertion.next_step(), 2);
  EXPECT_EQ(insertion.insert(2), 0U);
  EXPECT_EQ(insertion.next_step(), 4);
}

TEST(insertion, more_than_a_million_grains_come_in_one_step_where_all_have_places)
{
  InsertionPlan plan = plan_of(FeedSettings::at_once, 0);
  plan.feed.mass = 2.5 * Insertion::kMostDrawn;
  Feed<> insertion(plan);
  std::int64_t n = 0;
  do {
    insertion.draw_due(1);
    std::vector<Insertion::Placed> all;
    for (std::size_t i = 0; i < insertion.owed().size(); i++) all.push_back({i, {0, 0, 0}});
    n += static_cast<std::int64_t>(all.size());
    insertion.accept(1, all, {});
  } while (insertion.has_more(1));
  EXPECT_EQ(n, 2500000);
  EXPECT_EQ(insertion.inserted(), n);
  EXPECT_EQ(insertion.next_step(), FeedSchedule::kNever);
}

void restore(Insertion &insertion, const State &state, std::int64_t step)
{
  const std::vector<Real> numbers = state.numbers();
  insertion.restore(numbers.data(), numbers.size(), step);
}

// Steps in which grains come from here on, told from here.
std::vector<std::int64_t> next_steps(Feed<> &insertion, std::int64_t now, int n)
{
  std::vector<std::int64_t> steps;
  for (int k = 0; k < n; k++) {
    const std::int64_t step = insertion.next_step();
    steps.push_back(step - now);
    insertion.insert(step);
  }
  return steps;
}

TEST(insertion, steps_that_are_counted_anew_change_nothing)
{
  InsertionPlan plan = plan_of(FeedSettings::by_mass, 0.37);
  plan.feed.every = 3;
  plan.grains.sizes.clear();
  plan.grains.smallest = 0.5;
  Feed<> first(plan, 5, 0.1);
  next_steps(first, 5, 20);
  const std::int64_t now = first.next_step() - 1;
  const State state = first.state(now);
  const std::vector<std::int64_t> wanted = next_steps(first, now, 20);
  for (const std::int64_t other : {std::int64_t(0), now, std::int64_t(1000000)}) {
    Feed<> second(plan, other, 0.1);
    restore(second, state, other);
    EXPECT_EQ(next_steps(second, other, 20), wanted) << other;
  }
}

// An insertion that goes on by the new plan where 20 grains of mass 1 are in since step 20, and it is step 50.
Feed<> continued(const InsertionPlan &former, const InsertionPlan &plan)
{
  Feed<> first(former);
  next_steps(first, 0, 20);
  EXPECT_EQ(first.next_step(), FeedSchedule::kNever);
  Feed<> second(plan, 50, 1);
  restore(second, first.state(50), 50);
  EXPECT_EQ(second.inserted(), 20);
  return second;
}

TEST(insertion, with_a_larger_total_after_a_restart_the_rate_goes_on_from_there)
{
  for (const auto kind : {FeedSettings::by_mass, FeedSettings::by_number})
    for (const bool by_mass : {false, true}) {
      InsertionPlan former = plan_of(kind, 1), plan = former;
      former.feed.mass = by_mass ? 20 : 0;
      former.feed.number = by_mass ? 0 : 20;
      plan.feed.mass = by_mass ? 23 : 0;
      plan.feed.number = by_mass ? 0 : 23;
      Feed<> second = continued(former, plan);
      EXPECT_EQ(next_steps(second, 50, 3), (std::vector<std::int64_t>{1, 2, 3}));
      EXPECT_EQ(second.next_step(), FeedSchedule::kNever);
    }
}

TEST(insertion, grains_without_a_place_are_of_the_new_sizes_after_a_restart)
{
  InsertionPlan former = at_once(5);
  Feed<> first(former);
  first.site.side = 0.5;
  EXPECT_EQ(first.insert(1), 1U);
  InsertionPlan plan = former;
  plan.feed.number = 4;
  plan.grains.sizes = {{0.25, 1}};
  plan.grains.smallest = plan.grains.largest = 0.25;
  Feed<> second(plan, 1, 1);
  restore(second, first.state(1), 1);
  EXPECT_EQ(second.insert_next(), 3U);
  EXPECT_EQ(second.there.back().radius, 0.125);
  EXPECT_EQ(second.next_step(), FeedSchedule::kNever);
}

TEST(insertion, the_state_of_another_program_is_refused_and_changes_nothing)
{
  Feed<> insertion(plan_of(FeedSettings::by_mass, 1), 0, 0.1);
  const std::vector<Real> before = insertion.state(0).numbers();
  for (const Real other : {-3.0, 20.0, 1.0}) {
    const Real numbers[] = {other, 0, 0, 0, 0};
    EXPECT_THROW(insertion.restore(numbers, 5, 0), StateError);
  }
  EXPECT_EQ(insertion.state(0).numbers(), before);
}

TEST(insertion, another_rate_after_a_restart_counts_from_there)
{
  Feed<> first(plan_of(FeedSettings::by_mass, 1), 0, 0.1);
  Feed<> second(plan_of(FeedSettings::by_mass, 2), 4, 0.1);
  restore(second, first.state(4), 4);
  EXPECT_EQ(second.next_step(), 7);    // 0.4 is there, 0.6 are three steps
}

TEST(packing, knows_what_brute_force_over_images_finds)
{
  PeriodicBox box;
  box.edge[0] = {3, 0, 0};
  box.edge[1] = {0.8, 2.5, 0};
  box.edge[2] = {0.4, -0.6, 4};
  box.periodic[0] = box.periodic[2] = true;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<Real> part(0, 1);
  const auto anywhere = [&] {
    return part(random) * box.edge[0] + part(random) * box.edge[1] + part(random) * box.edge[2];
  };
  const Box zone = {{-0.5, 0.2, -1}, {3.5, 2, 3}};    // past some faces
  constexpr Real kLargest = 0.2;
  std::vector<PackedSphere> all, there;
  for (int i = 0; i < 60; i++) all.push_back({anywhere(), 0.05 + 0.3 * part(random)});
  for (const PackedSphere &s : all)
    for (const PackedSphere &image : images_in(s, zone, kLargest, box)) there.push_back(image);
  Packing packing(there, zone, kLargest, box);
  int in = 0;
  for (int i = 0; i < 20000; i++) {
    PackedSphere grain = {{0, 0, 0}, kLargest * part(random)};
    for (int k = 0; k < 3; k++) grain.at[k] = zone.lo[k] + part(random) * (zone.hi[k] - zone.lo[k]);
    bool meets = false;
    for (const PackedSphere &s : all)
      for (int a = -2; a <= 2; a++)
        for (int c = -2; c <= 2; c++)
          meets = meets || norm(s.at + Real(a) * box.edge[0] + Real(c) * box.edge[2] - grain.at) <
                               s.radius + grain.radius;
    ASSERT_EQ(packing.overlaps(grain), meets) << i;
    if (meets || i % 10) continue;
    packing.add(grain);
    all.push_back(grain);
    in++;
  }
  EXPECT_GT(in, 50);
}

TriangleSoup rectangle(Real x, Real y)
{
  const Vec3 a = {0, 0, 0}, b = {x, 0, 0}, c = {x, y, 0}, d = {0, y, 0};
  TriangleSoup soup;
  soup.source = "face.stl";
  soup.corners = {a, b, c, a, c, d};
  return soup;
}

TEST(inlet, places_are_uniform_a_radius_off_the_edges_and_within_the_depth)
{
  const InletFace face(weld(rectangle(3, 2), 0), 0.5);
  EXPECT_NEAR(face.area(), 6, 1e-14);
  EXPECT_TRUE(face.normal() == (Vec3{0, 0, 1}));
  RandomStream random({1, 2});
  constexpr int kN = 20000;
  Vec3 sum = {0, 0, 0}, at, lo = {9, 9, 9}, hi = {-9, -9, -9};
  int quarter = 0;
  for (int i = 0; i < kN; i++) {
    ASSERT_TRUE(face.draw(random, 0.4, at));
    sum += at;
    for (int k = 0; k < 3; k++) {
      lo[k] = std::min(lo[k], at[k]);
      hi[k] = std::max(hi[k], at[k]);
    }
    quarter += at.x < 1.5 && at.y < 1;
  }
  const Vec3 from = {0.4, 0.4, 0}, to = {2.6, 1.6, 0.5};
  for (int k = 0; k < 3; k++) {
    const Real width = to[k] - from[k];
    EXPECT_GE(lo[k], from[k] - 1e-12);
    EXPECT_LE(hi[k], to[k] + 1e-12);
    EXPECT_NEAR(sum[k] / kN, (from[k] + to[k]) / 2, 5 * width / std::sqrt(12.0 * kN));
  }
  EXPECT_NEAR(quarter / Real(kN), 0.25, 5 * std::sqrt(0.1875 / kN));
  EXPECT_TRUE(face.has_room(0.9));
  EXPECT_FALSE(face.has_room(1.01));
}

std::string error_of(const TriangleSoup &soup)
{
  return lsdcd::error_of([&] { InletFace(weld(soup, 0), 0); });
}

TEST(inlet, a_face_that_is_not_flat_or_wound_both_ways_is_refused_by_facet)
{
  TriangleSoup bent = rectangle(3, 2);
  bent.corners[5].z = 0.3;
  EXPECT_TRUE(has(error_of(bent), "face.stl: facet 1 has a corner"));
  TriangleSoup mixed = rectangle(3, 2);
  mixed.corners[2].y = 1;    // of another area, so that one side is the larger
  std::swap(mixed.corners[1], mixed.corners[2]);
  EXPECT_TRUE(has(error_of(mixed), "face.stl: facet 1 is wound against"));
  TriangleSoup both = rectangle(3, 2);
  for (const int k : {0, 2, 1}) both.corners.push_back(Vec3(both.corners[k]));
  EXPECT_TRUE(has(error_of(both), "face.stl: 1 of 2 facets are there in both windings"));
}

TEST(insert_settings, grains_that_come_all_at_once_have_more_attempts)
{
  const auto attempts_of = [](std::vector<std::string> words) {
    words.insert(words.end(), {"mesh", "a.stl", "dens", "1", "diam", "one", "1", "number", "9"});
    return parse_insert(words).plan.attempts;
  };
  EXPECT_EQ(attempts_of({}), 1000);
  EXPECT_EQ(attempts_of({"numberrate", "1"}), 100);
  EXPECT_EQ(attempts_of({"attempts", "7"}), 7);
}

TEST(insert_settings, jitter_has_one_number_or_three)
{
  const auto grains = [](const std::vector<std::string> &words) {
    std::vector<std::string> all = {"region", "r", "diam",   "one", "1",
                                    "dens",   "1", "number", "1",   "jitter"};
    all.insert(all.end(), words.begin(), words.end());
    return parse_insert(all).plan.grains;
  };
  EXPECT_EQ(grains({"2"}).jitter, (Vec3{2, 2, 2}));
  EXPECT_EQ(grains({"1", "2", "3"}).jitter, (Vec3{1, 2, 3}));
  EXPECT_FALSE(grains({"1", "2", "3"}).gaussian);
  EXPECT_TRUE(grains({"gaussian", "1", "2", "3"}).gaussian);
  EXPECT_EQ(grains({"gaussian", "2", "seed", "7"}).jitter, (Vec3{2, 2, 2}));
  EXPECT_TRUE(fails_with("jitter", [&] { grains({"1", "2"}); }));
}

TEST(insert_settings, fractions_that_do_not_add_up_are_refused_with_their_sum)
{
  EXPECT_TRUE(fails_with("add up to 0.9, not to 1", [] {
    parse_insert({"mesh", "a.stl", "massrate", "1", "dens", "1", "diam", "mass", "2", "1", "0.5",
                  "2", "0.4"});
  }));
}

}    // namespace
}    // namespace lsdcd::test_insertion
