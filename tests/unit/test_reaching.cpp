// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Cohesion that acts across a gap: its reach, its energy, and what contacts keep, beside closed forms.
#include "law/contact_law.h"
#include "law/law_table.h"
#include "law/make_law.h"
#include "law/smallest_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace lsdcd::test_reaching {
namespace {

constexpr Real kRadius = 1e-3;

TEST(reaching, arc_tangent_is_that_of_the_library)
{
  for (Real x = 1e-9; x < 1e9; x *= 1.07)
    EXPECT_NEAR(arc_tangent(x), std::atan(x), 8 * 1.2e-16 * std::atan(x)) << x;
  EXPECT_EQ(arc_tangent(0), 0);
}

const SubModel &row_of(Family family, const std::string &name)
{
  for (const SubModel *row : sub_models(family))
    if (row->name == name) return *row;
  throw std::logic_error("there is no sub-model " + name);
}

ContactLaw law_of(const char *cohesion, const std::vector<Real> &numbers,
                  const char *normal = "hooke", const std::vector<Real> &of_normal = {1e3, 0})
{
  return make_law({{&row_of(Family::normal, normal), of_normal},
                   {&row_of(Family::damping, "none"), {}},
                   {&row_of(Family::tangential, "linear_nohistory"), {0, 0}},
                   {&row_of(Family::cohesion, cohesion), numbers}},
                  false);
}

std::vector<ContactLaw> laws_of_each_row()
{
  return {law_of("capillary", {0.072, 20, 70, 1e-13}),
          law_of("capillary/share", {0.072, 20, NAN, 1e-4}), law_of("constant", {1e-3, 2e-5}),
          law_of("constant/weight", {0.5, 9.8, 2e-5}), law_of("linear", {10, 2e-5})};
}

PairContact two_spheres(Real radius_i, Real radius_j, Real overlap)
{
  PairContact c = {};
  c.radius_i = radius_i;
  c.radius_j = radius_j;
  c.radius = radius_i * radius_j / (radius_i + radius_j);
  c.mass_i = 2e-6;
  c.mass_j = 3e-6;
  c.overlap = overlap;
  return c;
}

// The work to rupture of two equal spheres with V/R^3 and an angle (rad): integrals that were made apart from this program.
struct Work {
  Real volume, angle, work;
};
constexpr Work kWorks[] = {{1e-4, 0, 3.36847677e-9},
                           {1e-3, 0, 1.01562990e-8},
                           {1e-2, 0, 3.00216388e-8},
                           {1e-4, 0.3491, 3.21459576e-9}};

TEST(reaching, a_bridge_holds_less_by_its_work_from_touch_to_rupture)
{
  for (const Work &w : kWorks) {
    const ReachingCohesion bridge =
        reaching_cohesion(law_of("capillary", {0.072, w.angle * 180 / kPi, NAN, w.volume * 1e-9}));
    EXPECT_NEAR(bridge.energy(two_spheres(kRadius, kRadius, 0)), -w.work, 1e-8 * w.work);
  }
}

TEST(reaching, energy_falls_by_the_pull)
{
  for (const ContactLaw &law : laws_of_each_row()) {
    const ReachingCohesion cohesion = reaching_cohesion(law);
    const Real end = cohesion.gap(two_spheres(kRadius, 0.6 * kRadius, 0)), apart = 1e-4 * end;
    for (Real overlap = -0.999 * end; overlap < 0.5 * end; overlap += 0.0313 * end) {
      const auto energy_at = [&](Real d) {
        return cohesion.energy(two_spheres(kRadius, 0.6 * kRadius, d));
      };
      const Real slope = (energy_at(overlap + apart) - energy_at(overlap - apart)) / (2 * apart);
      const Real pull = cohesion.pull(two_spheres(kRadius, 0.6 * kRadius, overlap));
      EXPECT_NEAR(-slope, pull, 2e-5 * pull + 1e-12) << sub_models_text(law) << " at " << overlap;
    }
    EXPECT_NEAR(cohesion.energy(two_spheres(kRadius, 0.6 * kRadius, -end)), 0,
                1e-12 * -cohesion.energy(two_spheres(kRadius, 0.6 * kRadius, 0)));
  }
}

// Lists of neighbours are made for the largest radii.
TEST(reaching, most_is_no_less_than_the_reach_of_smaller_spheres)
{
  std::vector<ContactLaw> laws = laws_of_each_row();
  laws.push_back(law_of("capillary", {0.072, 0, NAN, 1e-10}));    // beyond the cap of the stretch
  LawReach all;
  for (const ContactLaw &law : laws) all = longest(all, law.reach());
  for (const ContactLaw &law : laws)
    for (Real a = 0.01; a <= 1; a *= 1.3)
      for (Real b = 0.01; b <= 1; b *= 1.3) {
        const PairContact small = two_spheres(a * kRadius, b * kRadius, 0),
                          large = two_spheres(kRadius, kRadius, 0);
        const LawReach reach = law.reach();
        const Real size = size_of_both(small.radius_i, small.radius_j);
        EXPECT_LE(reach.at(small.radius, size),
                  reach.most(large.radius, size_of_both(kRadius, kRadius)));
        EXPECT_LE(reach.at(small.radius, size), all.at(small.radius, size));
      }
}

TEST(reaching, laws_that_reach_keep_their_contacts)
{
  for (const ContactLaw &law : laws_of_each_row()) {
    EXPECT_TRUE(law.has_history()) << sub_models_text(law);
    EXPECT_EQ(law.n_extra(), 0) << sub_models_text(law);
    EXPECT_GT(cutoff_of(law, kRadius), kRadius) << sub_models_text(law);
  }
}

// What a contact keeps of yielding after it has opened to a gap in which a bridge holds it.
Real kept_across_a_gap(const char *normal, const std::vector<Real> &numbers)
{
  Real kept = 0;
  with_reaching_law(law_of("capillary", {0.072, 20, NAN, 1e-13}, normal, numbers),
                    [&](const auto &law) {
                      using Law = std::decay_t<decltype(law)>;
                      ContactMemory<Law::kExtra> memory = {};
                      Contact c = {};
                      c.radius = kRadius;
                      c.mass = 1e-6;
                      c.update = true;
                      for (const Real overlap : {1e-5, -1e-6}) {
                        c.overlap = overlap;
                        law.evaluate(c, memory);
                      }
                      kept = memory.extra[Law::kYielded];
                    });
  return kept;
}

TEST(reaching, what_yielded_heals_across_a_gap_but_for_thornton)
{
  EXPECT_EQ(kept_across_a_gap("hysteretic", {1e3, 0.5}), 0);
  EXPECT_EQ(kept_across_a_gap("eepa", {1e5, 1, 0.5, 0.1, 1.5, 2, 0}), 0);
  EXPECT_EQ(kept_across_a_gap("lepa", {1e3, 0, 4e3, 1e2, 0.1}), 0);
  EXPECT_EQ(kept_across_a_gap("thornton", {1e7, 0, 0.3, 1e5}), 1e-5);
}

// Where it is stiff, a pull counts in the times of contacts.
TEST(reaching, slope_is_that_of_the_pull_at_touch)
{
  for (const ContactLaw &law : laws_of_each_row()) {
    const ReachingCohesion cohesion = reaching_cohesion(law);
    const Real apart = 1e-10;
    const Real slope = (cohesion.pull(two_spheres(kRadius, kRadius, 0)) -
                        cohesion.pull(two_spheres(kRadius, kRadius, -apart))) /
                       apart;
    EXPECT_NEAR(cohesion.slope(two_spheres(kRadius, kRadius, 0)), slope, 1e-4 * slope + 1e-9)
        << sub_models_text(law);
  }
}

}    // namespace
}    // namespace lsdcd::test_reaching
