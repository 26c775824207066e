// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Which compiled law a scene gets: one that computes what is asked for, as the law with all sub-models does, and no more.
#include "pair/booked_law.h"

#include "law/contact_slope.h"
#include "law/contact_time.h"
#include "support/random.h"
#include "support/table_laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

namespace lsdcd::test_smallest_model {
namespace {

using All = GranularModel<TouchingNormal, true, GranularSet::all>;

ContactLaw law_with(NormalModel normal, TangentialModel tangential)
{
  ContactLaw law = granular_law(normal);
  law.k_normal = 1e4;
  law.modulus = 0.75e4;
  law.surface_energy = 3;
  law.damping = law.is_adhesive() ? DampingModel::viscoelastic : DampingModel::stiffness;
  law.eta = 0.4;
  law.tangential = tangential;
  law.k_tangent = 3e3;
  law.xgammat = 0.5;
  law.mu = 0.4;
  return law;
}

// Every law of normal force and friction alone.
std::vector<ContactLaw> laws_of_few(bool booked)
{
  std::vector<ContactLaw> laws;
  for (const SubModel *normal : sub_models(Family::normal))
    for (const SubModel *tangential : sub_models(Family::tangential)) {
      const ContactLaw law = law_with(static_cast<NormalModel>(normal->model),
                                      static_cast<TangentialModel>(tangential->model));
      if (law.rescales() || law.reach().acts() || law.yields()) continue;
      laws.push_back(law);
      laws.back().keeps_forces = booked;
    }
  return laws;
}
// These, with books of energy and without.
std::vector<ContactLaw> laws_of_few()
{
  std::vector<ContactLaw> laws = laws_of_few(false), booked = laws_of_few(true);
  laws.insert(laws.end(), booked.begin(), booked.end());
  return laws;
}

// Calls act(law) with the compiled law of a wall or of pairs; with_booked_granular() with one that books energy.
template <class Act>
void with_booked_granular(const ContactLaw &p, const Act &act)
{
  with_energy_law(p, [&](const auto &law) {
    if constexpr (!std::decay_t<decltype(law)>::kWholeArms) act(law);    // none of a classic style
  });
}
template <class Act>
void with_law(const ContactLaw &p, const Act &act)
{
  if (p.keeps_forces)
    with_booked_granular(p, act);
  else if (p.is_extended())
    with_granular_added_law(p, act);
  else
    with_granular_law(p, act);
}

std::string name_of(const ContactLaw &p)
{
  return "normal " + std::to_string(static_cast<int>(p.normal)) + ", tangential " +
         std::to_string(static_cast<int>(p.tangential)) + (p.keeps_forces ? ", booked" : "");
}

TEST(smallest_model, has_no_sub_model_that_few_scenes_use)
{
  for (const ContactLaw &p : laws_of_few())
    with_law(p, [&](const auto &law) {
      using Law = std::decay_t<decltype(law)>;
      EXPECT_EQ(Law::kHistory, p.has_history()) << name_of(p);
      EXPECT_EQ(Law::kExtra, 0) << name_of(p);
      EXPECT_FALSE(Law::kContactTorque) << name_of(p);
      EXPECT_FALSE(Law::kHeat) << name_of(p);
    });
}

TEST(smallest_model, has_the_sub_models_of_its_law)
{
  for (const ContactLaw &few : laws_of_few()) {
    ContactLaw p = few;
    p.heat = HeatModel::area;
    with_law(p, [&](const auto &law) { EXPECT_TRUE(law.kHeat && law.has_heat()) << name_of(p); });
    p = few;
    p.twisting = TwistingModel::sds;
    with_law(p, [&](const auto &law) { EXPECT_EQ(n_extra(law), 1) << name_of(p); });
    for (const RollingModel model : {RollingModel::sds, RollingModel::epsd2}) {
      p = few;
      p.rolling = model;
      with_law(p, [&](const auto &law) { EXPECT_EQ(n_extra(law), 3) << name_of(p); });
    }
    p = few;
    p.cohesion = CohesionModel::sjkr;
    p.cohesion.numbers[0] = 200;
    with_law(p, [&](const auto &law) {
      using Law = std::decay_t<decltype(law)>;
      EXPECT_TRUE((std::is_same_v<typename Law::Rolls, AnyRolling>) ) << name_of(p);
    });
  }
}

// A contact of spheres or of a sphere with a wall, on its way: it slides, and its normal turns.
template <class C>
C contact_on_its_way(Random &random)
{
  C c = {};
  c.normal = random_unit(random);
  c.radius = 0.3;
  c.mass = 2;
  c.overlap = uniform(random, 0.001, 0.03);
  c.v_normal = uniform(random, -1, 1);
  c.v_tangent = in_plane(uniform(random, {-9, -9, -9}, {9, 9, 9}), c.normal);
  c.dt = 1e-3;
  c.update = true;
  if constexpr (C::kPair) {
    c.radius_i = 0.5;
    c.radius_j = 0.75;
    c.mass_i = 3;
    c.mass_j = 6;
  }
  return c;
}

template <class C>
void expect_forces_of_all()
{
  Random random(5);
  for (const ContactLaw &p : laws_of_few())
    with_law(p, [&](const auto &law) {
      using Law = std::decay_t<decltype(law)>;
      const All all = granular_model<true, GranularSet::all>(p, touching_normal(p));
      ContactMemory<Law::kExtra> memory = {};
      ContactMemory<All::kExtra> memory_of_all = {};
      for (int step = 0; step < 200; step++) {
        C c = contact_on_its_way<C>(random);
        c.update = step % 20 != 19;
        const ContactForce found = law.evaluate(c, memory),
                           expected = all.evaluate(c, memory_of_all);
        ASSERT_EQ(found.normal, expected.normal) << name_of(p);
        ASSERT_EQ(found.tangential, expected.tangential) << name_of(p);
        ASSERT_EQ(found.energy, expected.energy) << name_of(p);
        ASSERT_EQ(memory.shear, memory_of_all.shear) << name_of(p);
      }
    });
}

void expect_same_spring(const SpringPart &found, const SpringPart &expected, const ContactLaw &p)
{
  ASSERT_EQ(found.begins, expected.begins) << name_of(p);
  ASSERT_EQ(found.ends, expected.ends) << name_of(p);
  ASSERT_EQ(found.k, expected.k) << name_of(p);
  ASSERT_EQ(found.projected, expected.projected) << name_of(p);
}

// Two laws say the same of a contact. All, of which `law` has less.
template <class C, class Law, class All>
void expect_same_parts(const Law &law, const All &all, const ContactLaw &p)
{
  Random random(7);
  for (int step = 0; step < 200; step++) {
    const C c = contact_on_its_way<C>(random);
    ContactMemory<Law::kExtra> begun = {}, memory;
    begun.shear = in_plane(uniform(random, {-1e-3, -1e-3, -1e-3}, {1e-3, 1e-3, 1e-3}), c.normal);
    memory = begun;
    ContactMemory<All::kExtra> begun_of_all = {}, memory_of_all;
    begun_of_all.shear = begun.shear;
    memory_of_all = begun_of_all;
    const FullForce force = law.evaluate(c, memory), of_all = all.evaluate(c, memory_of_all);
    ASSERT_EQ(force.normal, of_all.normal) << name_of(p);
    ASSERT_EQ(force.energy, of_all.energy) << name_of(p);
    const ForceParts found = law.parts(c, begun, memory, force),
                     expected = all.parts(c, begun_of_all, memory_of_all, of_all);
    ASSERT_EQ(found.elastic, expected.elastic) << name_of(p);
    ASSERT_EQ(found.slides, expected.slides) << name_of(p);
    expect_same_spring(found.friction, expected.friction, p);
    expect_same_spring(found.rolling, expected.rolling, p);
    expect_same_spring(found.twisting, expected.twisting, p);
    ASSERT_EQ(law.normal_energy(c, 0.01), all.normal_energy(c, 0.01)) << name_of(p);
  }
}

TEST(smallest_model, says_what_its_force_is_made_of_as_the_law_with_all)
{
  for (const ContactLaw &p : laws_of_few(true))
    with_booked_granular(p, [&](const auto &law) {
      const All all = granular_model<true, GranularSet::all>(p, touching_normal(p));
      expect_same_parts<Contact>(law, all, p);
      expect_same_parts<PairContact>(law, all, p);
    });
}
TEST(smallest_model, of_booked_pairs_is_a_classic_style_alone)
{
  for (ContactLaw p :
       {classic_law(NormalModel::hooke, false), classic_law(NormalModel::hooke, true),
        classic_law(NormalModel::hertz, true)}) {
    p.k_normal = 1e4;
    p.eta = 20;
    p.k_tangent = 3e3;
    p.gamma_tangent = 5;
    p.mu = 0.4;
    p.keeps_forces = true;
    with_booked_law(p, [&](const auto &law) {
      using Law = std::decay_t<decltype(law)>;
      if constexpr (Law::kWholeArms && !Law::kContactTorque)
        with_classic_law(p, [&](const auto &base) {
          using Base = std::decay_t<decltype(base)>;
          if constexpr (std::is_base_of_v<Base, Law>)
            expect_same_parts<PairContact>(
                law, AddedModel<Base, true>{base, {RollingModel::none, {}}, {0}, p.k_tangent}, p);
          else
            ADD_FAILURE() << "another style: " << name_of(p);
        });
      else
        ADD_FAILURE() << "no law of its own: " << name_of(p);
    });
    p.rolling = RollingModel::epsd2;
    with_booked_law(p, [&](const auto &law) { EXPECT_TRUE(law.kContactTorque) << name_of(p); });
  }
}
// secant(), tangent(), and what takes them, beside differences of the force, without adhesion.
TEST(smallest_model, has_the_stiffnesses_of_its_normal_force)
{
  const Real overlap = 0.003, radius = 0.3,
             mass = 2;    // contact_time() looks at 1 % of the radius
  for (const SubModel *row : sub_models(Family::normal)) {
    ContactLaw p =
        law_with(static_cast<NormalModel>(row->model), TangentialModel::linear_nohistory);
    if (p.yields()) continue;    // test_plastic
    p.surface_energy = 0;
    p.damping = DampingModel::none;
    const auto at = [&](Real depth) {
      Contact c = {};
      c.overlap = depth;
      c.radius = radius;
      c.mass = mass;
      return c;
    };
    const auto force = [&](Real depth) {
      Real f = 0;
      with_granular_law(p, [&](const auto &law) {
        ContactMemory<std::decay_t<decltype(law)>::kExtra> memory = {};
        f = law.evaluate(at(depth), memory).normal;
      });
      return f;
    };
    // Differences over h are wrong by h^2/24 of the overlap's, and round to 1e-16 of the force over h.
    const Real h = 1e-4 * overlap, slope = (force(overlap + h / 2) - force(overlap - h / 2)) / h;
    const Real secant = force(overlap) / overlap;
    with_normal(p, [&](const auto &normal) {
      const Contact c = at(overlap);
      const Real a = std::sqrt(radius * overlap);
      EXPECT_NEAR(normal.secant(c, a), secant, 1e-12 * slope) << row->name;
      EXPECT_NEAR(normal.tangent(c, a), slope, 1e-8 * slope) << row->name;
    });
    EXPECT_NEAR(contact_slopes(p, overlap, radius, mass).normal.stiffness, slope, 1e-8 * slope)
        << row->name;
    const Real time = kPi / std::sqrt(slope / mass);
    EXPECT_NEAR(contact_time(p, mass, radius, 1), time, 1e-8 * time) << row->name;
    EXPECT_EQ(stiffens(p), slope > 1.0001 * secant) << row->name;
    p.rolling = {RollingModel::epsd, {2, 0}};
    const Real rolling = 2.25 * secant * 2 * 2 * radius * radius;
    EXPECT_NEAR(rolling_stiffness(p, overlap, radius), rolling, 1e-12 * rolling) << row->name;
  }
}

TEST(smallest_model, gives_the_forces_of_the_law_with_all_at_a_wall)
{
  expect_forces_of_all<Contact>();
}
TEST(smallest_model, gives_the_forces_of_the_law_with_all_between_spheres)
{
  expect_forces_of_all<PairContact>();
}

}    // namespace
}    // namespace lsdcd::test_smallest_model
