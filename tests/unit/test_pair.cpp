// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Grains under the wall's laws, beside closed forms.
#include "base/input_error.h"
#include "input/pair_words.h"
#include "pair/compile_pair.h"
#include "pair/pair_lanes.h"
#include "pair/partners.h"
#include "support/pair_grains.h"
#include "support/random.h"
#include "support/table_laws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace lsdcd::test_pair {

std::vector<std::string> words_of(const std::string &text)
{
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

ContactLaw law_of_words(const std::string &text)
{
  return law_of(read_pair_coeff(words_of(text)));
}

// A law of each compiled kind, with every sub-model that changes what a pair keeps.
const std::vector<std::string> kLaws = {
    "hooke 1000 30 tangential linear_nohistory 1 0.4 damping velocity",
    "hertz 4e4 0.4 tangential linear_history 500 0.5 0.4 damping tsuji",
    "hertz/material 1e5 0.4 0.3 tangential mindlin NULL 0.5 0.4 damping coeff_restitution",
    "hertz/material 1e5 20 0.3 tangential mindlin/force NULL 0.5 0.4",
    "hertz/material 1e5 20 0.3 tangential mindlin_slip NULL 0.5 0.4 damping mass_velocity",
    "hertz/material 1e5 20 0.3 tangential mindlin_rescale NULL 0.5 0.4 rolling sds 300 2 0.3 "
    "twisting marshall",
    "dmt 1e5 20 0.3 5 tangential mindlin_rescale/force NULL 0.5 0.4 twisting sds 30 2 0.3",
    "jkr 1e5 20 0.3 50 tangential mindlin NULL 0.5 0.4 rolling sds 300 2 0.3 twisting marshall",
    "law hooke 1000 NULL 20 NULL 0.4 1",
    "law hooke/history 1000 NULL 20 NULL 0.4 1 limit_damping",
    "law hertz/history 4e4 NULL 20 NULL 0.4 1",
    "law hertz/history 4e4 NULL 20 NULL 0.4 1 rolling epsd2 0.3 cohesion sjkr 200",
    "law hooke 1000 NULL 20 NULL 0.4 1 rolling cdt 0.3",
    "hooke 1000 30 tangential linear_history_slip 500 0.5 0.4 damping viscoelastic limit_damping",
    "hertz/material 1e5 0.4 0.3 tangential mindlin NULL 0.5 0.4 rolling sds 300 2 0.3 damping "
    "tsuji",
    "hertz/material 1e5 0.4 0.3 tangential mindlin_liggghts NULL NULL 0.4 damping "
    "coeff_restitution "
    "rolling epsd 0.3 0.2 cohesion sjkr 200",
    "hertz/material 1e5 20 0.3 tangential mindlin_liggghts NULL 0 0.4 rolling cdt 0.3 "
    "limit_damping",
    "law hertz/history 4e4 NULL 20 NULL 0.4 1 rolling epsd3 0.3 0.1 2",
    "hertz/material 1e5 0.4 0.3 tangential mindlin_liggghts NULL NULL 0.4 damping "
    "coeff_restitution",
    "dmt 1e5 20 0.3 5 tangential linear_history_liggghts 500 0.5 0.4",
    "hooke 1000 30 tangential linear_nohistory_liggghts 1 0.4 damping velocity"};

bool has_whole_arms(const std::string &words)
{
  return words.compare(0, 4, "law ") == 0;
}

using Grains = PairGrains;

// n grains of radii 1 to 20 that overlap by some per cent, with velocities and spins.
Grains random_grains(int n, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<Real> unit(-1, 1);
  Grains g(n);
  for (int i = 0; i < n; i++) {
    g.radius[i] = 10.5 + 9.5 * unit(random);
    g.mass[i] = g.radius[i] * g.radius[i] * g.radius[i];
    for (int k = 0; k < 3; k++) {
      g.x[3 * i + k] = 6.0 * std::cbrt(n) * unit(random);
      g.v[3 * i + k] = unit(random);
      g.omega[3 * i + k] = 0.1 * unit(random);
    }
  }
  return g;
}

Real largest(const std::vector<Real> &a)
{
  Real most = 0;
  for (const Real each : a) most = std::max(most, std::fabs(each));
  return most;
}

// ---- one pair in closed form ------------------------------------------------------------------

// hooke: F = k d - gamma v_n; friction gamma_t v_t up to mu |F|; torques -(R - d/2) n x F_t.
TEST(pair, of_hooke_is_its_formula)
{
  Grains g(2);
  g.radius = {1.0, 0.5};
  g.mass = {2.0, 1.0};
  g.x = {1.4, 0, 0, 0, 0, 0};    // overlap 0.1, normal (1, 0, 0)
  g.v = {0.2, 0.3, 0, 0, 0, 0};
  g.omega = {0, 0, 0.5, 0, 0, 0.25};
  g.set_law(
      law_of_words("hooke 1000 30 tangential linear_nohistory 0.5 0.4 damping mass_velocity"));
  g.set_list();
  g.step();
  const Real reduced = 2.0 / 3, damping = 30 * reduced;
  const Real push = 1000 * 0.1 - damping * 0.2;
  // The surface of 1 at the contact moves by v + w x (-R n): slip 0.3 - (1.0 0.5 + 0.5 0.25) along y.
  const Real slip = 0.3 - 0.625, drag = std::min(0.5 * damping * std::fabs(slip), 0.4 * push);
  const Real friction = slip < 0 ? drag : -drag;
  EXPECT_NEAR(g.force[0], push, 1e-12);
  EXPECT_NEAR(g.force[1], friction, 1e-13);
  EXPECT_NEAR(g.force[3], -push, 1e-12);
  EXPECT_NEAR(g.torque[2], -(1.0 - 0.05) * friction, 1e-13);
  EXPECT_NEAR(g.torque[5], -(0.5 - 0.05) * friction, 1e-13);
}

// hertz of two materials: E* and G* of both; kt 8 G* a.
TEST(pair, of_two_materials_has_the_moduli_of_both)
{
  const Real e1 = 1e7, e2 = 3e6, nu1 = 0.2, nu2 = 0.4;
  const PairCoeff a = read_pair_coeff(words_of(
                      "hertz/material 1e7 0.4 0.2 tangential mindlin NULL 0.5 0.4 damping tsuji")),
                  b = read_pair_coeff(words_of(
                      "hertz/material 3e6 0.9 0.4 tangential mindlin NULL 0.2 0.9 damping tsuji"));
  const ContactLaw law = law_of(mixed(a, b, "1 and 2"));
  const Real e = 1 / ((1 - nu1 * nu1) / e1 + (1 - nu2 * nu2) / e2);
  const Real g = 1 / (2 * (2 - nu1) * (1 + nu1) / e1 + 2 * (2 - nu2) * (1 + nu2) / e2);
  EXPECT_NEAR(law.k_normal, 4 * e / 3, 1e-13 * e);
  EXPECT_NEAR(law.k_tangent, 8 * g, 1e-13 * 8 * g);
  EXPECT_DOUBLE_EQ(law.eta, tsuji_damping(std::sqrt(0.4 * 0.9)));
  EXPECT_DOUBLE_EQ(law.xgammat, std::sqrt(0.5 * 0.2));
  EXPECT_DOUBLE_EQ(law.mu, std::sqrt(0.4 * 0.9));
}

TEST(pair_coeff, is_equal_with_the_same_words)
{
  const std::string words = "hertz/material 1e5 0.4 0.3 tangential mindlin NULL 0.5 0.4";
  const PairCoeff a = read_pair_coeff(words_of(words));
  EXPECT_TRUE(are_equal(a, read_pair_coeff(words_of(words))));
  EXPECT_TRUE(are_equal(a, mixed(a, a, "1 and 2")));
  for (const char *other :
       {"hertz/material 1e5 0.4 0.3 tangential mindlin 1 0.5 0.4",
        "hertz/material 1e5 0.4 0.3 tangential mindlin NULL 0.5 0.4000000001",
        "hertz/material 1e5 0.4 0.3 tangential mindlin NULL 0.5 0.4 damping tsuji",
        "hertz/material 1e5 0.4 0.3 tangential mindlin NULL 0.5 0.4 limit_damping",
        "hertz/material 1e5 0.4 0.3 tangential mindlin NULL 0.5 0.4 cutoff 2",
        "hertz/material 1e5 0.4 0.3 tangential mindlin_slip NULL 0.5 0.4"})
    EXPECT_FALSE(are_equal(a, read_pair_coeff(words_of(other)))) << other;
}

TEST(pair, of_laws_with_other_sub_models_is_not_mixed)
{
  const PairCoeff a = read_pair_coeff(words_of("hooke 1 0 tangential linear_nohistory 0 0")),
                  b = read_pair_coeff(words_of("hertz 1 0 tangential linear_nohistory 0 0"));
  EXPECT_THROW(mixed(a, b, "1 and 2"), InputError);
  EXPECT_NO_THROW(mixed(a, a, "1 and 2"));
}

TEST(pair_coeff, keeps_limit_damping_and_the_larger_cutoff_where_it_is_mixed)
{
  const std::string words = "hooke 1000 30 tangential linear_nohistory 1 0.4 damping velocity";
  const PairCoeff plain = read_pair_coeff(words_of(words)),
                  limited = read_pair_coeff(words_of(words + " limit_damping cutoff 2"));
  for (const PairCoeff &both :
       {mixed(plain, limited, "1 and 2"), mixed(limited, plain, "1 and 2")}) {
    EXPECT_TRUE(law_of(both).limit_damping);
    EXPECT_EQ(both.cutoff, 2);
  }
  EXPECT_FALSE(law_of(mixed(plain, plain, "1 and 2")).limit_damping);
}

// Adhesion holds what has touched, up to 3 pi gamma R: overlap -(3 pi^2 gamma^2 R/(16 E^2))^(1/3).
TEST(pair, under_jkr_parts_beyond_touch)
{
  const Real e = 1e5 / (2 * (1 - 0.09)), gamma = 50, radius = 0.5;
  const Real reach = std::cbrt(3 * kPi * kPi * gamma * gamma * radius / (16 * e * e));
  Grains g(2);
  g.set_law(law_of_words("jkr 1e5 0 0.3 50 tangential linear_nohistory 0 0 damping none"));
  g.set_list();
  const auto force_at = [&](Real overlap) {
    g.x[3] = 2 - overlap;
    g.step();
    return g.force[3];
  };
  EXPECT_EQ(force_at(-0.5 * reach), 0);    // has not touched
  EXPECT_NE(force_at(0.01), 0);
  EXPECT_NEAR(force_at(-reach * (1 - 1e-12)), -3 * kPi * gamma * radius, 1e-3 * gamma);
  EXPECT_EQ(force_at(-reach * (1 + 1e-9)), 0);
  EXPECT_EQ(force_at(-0.5 * reach), 0);    // let go
}

// In and out again: what the pull takes beyond touch is lost. With a = s y^2, s^3 = 4 pi gamma R^2/E, the overlap is (s^2/R)(y^4 - y), the
// force (4 E s^3/3 R)(y^6 - 3/2 y^3), and the work of the force (4 E s^5/3 R^2)(2/5 y^10 - y^7 + 3/8 y^4), from y = 1 at touch to
// y^3 = 3/4, where the pull is greatest.
TEST(pair, under_jkr_loses_the_work_of_the_pull_beyond_touch)
{
  const Real e = 1e5 / (2 * (1 - 0.09)), gamma = 50, radius = 0.5;
  const Real s = std::cbrt(4 * kPi * gamma * radius * radius / e), y = std::cbrt(0.75);
  const auto work = [&](Real at) {
    return 4 * e * std::pow(s, 5) / (3 * radius * radius) *
           (0.4 * std::pow(at, 10) - std::pow(at, 7) + 0.375 * std::pow(at, 4));
  };
  const Real parting = s * s / radius * (std::pow(y, 4) - y), deepest = 0.1;
  Grains g(2);
  g.set_law(law_of_words("jkr 1e5 0 0.3 50 tangential linear_nohistory 0 0 damping none"));
  g.set_list();
  // The rule of the middle over n steps; `done`: by the grains, while the overlap goes from one to the other.
  Real done = 0;
  const auto go = [&](Real from, Real to) {
    constexpr int n = 20000;
    for (int k = 0; k < n; k++) {
      g.x[3] = 2 - (from + (k + 0.5) / n * (to - from));
      g.step();
      done -= g.force[3] * (to - from) / n;
    }
  };
  go(0, deepest);
  go(deepest, 0);
  EXPECT_NEAR(done, 0, 1e-12 * work(2));
  go(0, parting);
  EXPECT_NEAR(done, work(1) - work(y), 1e-7 * std::fabs(work(1) - work(y)));
}

// Two grains that turn as one body keep the length of their spring, which turns with them: after a whole turn it is as it was.
TEST(pair, that_turns_as_one_body_keeps_its_spring)
{
  Grains g(2);
  g.set_law(law_of_words("hooke 1000 0 tangential linear_history 800 0 10 damping none"));
  g.set_list();
  const auto place = [&](Real angle) {
    const Real c = 0.95 * std::cos(angle), s = 0.95 * std::sin(angle);
    g.x = {c, s, 0, -c, -s, 0};
  };
  place(0);
  g.v = {0, 1, 0, 0, -1, 0};    // shears along y by 2 dt
  g.step();
  const Real first = 800 * 2 * g.dt;
  EXPECT_NEAR(g.force[1], -first, 1e-12);
  const int steps = 1000;
  g.dt = 1e-30;
  for (int k = 1; k <= steps; k++) {
    place(2 * kPi * k / steps);
    g.v = {0, 0, 0, 0, 0, 0};
    g.omega = {0, 0, 0, 0, 0, 0};
    g.step();
  }
  EXPECT_NEAR(g.force[1], -first, 1e-11);
  EXPECT_NEAR(g.force[0], 100, 1e-10);
}

// A pair that slips faster than its limit allows has the friction mu F, and its spring is that of the sub-model: cut to the limit
// alone (`_liggghts`, `_slip`), or to what makes up for the dashpot.
TEST(pair, beyond_the_limit_of_friction_has_the_spring_of_its_sub_model)
{
  const Real kn = 1000, overlap = 0.1, kt = 500, dashpot = 0.5 * 30, speed = 2000;
  const Real limit = 0.4 * kn * overlap;
  const struct {
    const char *model;
    Real spring;    // force
  } rows[] = {{"linear_history_liggghts", limit},
              {"linear_history_slip", limit},
              {"linear_history", dashpot * speed - limit}};
  for (const auto &row : rows) {
    Grains g(2);
    g.x = {1.9, 0, 0, 0, 0, 0};
    g.v = {0, speed, 0, 0, 0, 0};    // slips by 0.2 in the step
    g.set_law(law_of_words("hooke 1000 30 tangential " + std::string(row.model) +
                           " 500 0.5 0.4 damping velocity"));
    g.set_list();
    std::vector<RecordedPair> record;
    g.record = &record;
    g.step();
    EXPECT_NEAR(g.force[1], -limit, 1e-12 * limit) << row.model;
    const Real held = kn * overlap * overlap / 2 + row.spring * row.spring / (2 * kt);
    ASSERT_EQ(record.size(), 1u);
    EXPECT_NEAR(record[0].energy, held, 1e-12 * held) << row.model;
  }
}

// heat area: h pi a^2 dT flows from the warm grain into the cold one, with one law and with several, whichever comes first.
TEST(pair, loses_as_much_heat_as_it_gains)
{
  const ContactLaw law =
      law_of_words("hooke 1000 30 tangential linear_nohistory 1 0.4 damping velocity heat area 7");
  for (const bool several : {false, true})
    for (const bool swapped : {false, true}) {
      Grains g(2);
      g.radius = {1.0, 0.5};
      g.x = {1.4, 0, 0, 0, 0, 0};    // overlap 0.1
      g.set_law(law);
      if (several) g.laws.push_back(pair_law(law_of_words(kLaws[0])));
      g.set_list(swapped);
      const std::vector<Real> temperature = {300, 320};
      std::vector<Real> heat(2);
      PairJob job = g.job(true);
      job.temperature = temperature.data();
      job.heat = heat.data();
      run_pairs(job);
      // a^2 = R d with R = 1/3; products of six factors round to 6e-16 of themselves.
      const Real flow = 7 * kPi * (1.0 / 3 * 0.1) * 20;
      EXPECT_NEAR(heat[0], flow, 1e-14 * flow) << several << swapped;
      EXPECT_NEAR(heat[1], -flow, 1e-14 * flow) << several << swapped;
    }
}

TEST(pair, with_a_grain_that_does_not_move_has_the_mass_of_the_other)
{
  PairJob job = {};
  const int mask[2] = {1, 5};
  EXPECT_EQ(reduced_mass(job, 0, 1, 2, 3), 1.2);
  job.mask = mask;
  job.frozen = 4;
  EXPECT_EQ(reduced_mass(job, 0, 1, 2, 3), 2);
  EXPECT_EQ(reduced_mass(job, 1, 0, 3, 2), 2);
  job.frozen = 8;
  EXPECT_EQ(reduced_mass(job, 0, 1, 2, 3), 1.2);
}

// ---- all laws -----------------------------------------------------------------------------------

// What an oblique step adds to springs is in the next one's force.
TEST(pairs, keep_momentum_and_with_arms_to_the_contact_angular_momentum)
{
  for (const std::string &words : kLaws) {
    Grains g = random_grains(200, 1);
    g.set_law(law_of_words(words));
    g.set_list();
    g.step();
    g.step();
    Vec3 force = {0, 0, 0}, torque = {0, 0, 0};
    for (int i = 0; i < g.n; i++) {
      force += vec_of(g.force.data(), i);
      torque +=
          cross(vec_of(g.x.data(), i), vec_of(g.force.data(), i)) + vec_of(g.torque.data(), i);
    }
    const Real most = largest(g.force);
    ASSERT_GT(most, 0) << words;
    // Sums of some 1000 terms, each rounded to 1e-16 of itself.
    EXPECT_LT(norm(force), 1e-13 * most * 100) << words;
    if (!has_whole_arms(words)) {
      EXPECT_LT(norm(torque), 1e-12 * most * 40 * 100) << words;
    }
  }
}

// What partners are told of grains that have one law and one image.
struct Known {
  unsigned of_law;

  Partners::Name name(int i) const { return 1000 + i; }
  unsigned flips(int, int) const { return of_law; }
  int kind(int, int) const { return 0; }
  Vec3 offset(int, int) const { return {}; }
};

// A pair that is listed the other way round, with what it keeps as the other grain sees it, has the same forces.
TEST(pairs, do_not_depend_on_which_grain_comes_first)
{
  for (const std::string &words : kLaws) {
    const ContactLaw law = law_of_words(words);
    Grains a = random_grains(100, 2), b = random_grains(100, 2);
    for (Grains *g : {&a, &b}) g->set_law(law);
    a.set_list();
    b.set_list();
    for (int k = 0; k < 3; k++) {
      a.step();
      b.step();
    }
    const PartnerForm form = {a.history[0].width()};
    const Known known = {law.flips()};
    Partners partners(form);
    partners.grow(b.n);
    if (partners.width() > 0) partners.collect(b.list(), b.history[b.now], b.n, form, known);
    b.set_list(true);
    if (partners.width() > 0) partners.hand_out(b.list(), b.history[b.now], 0, 3, known);
    a.step();
    b.step();
    const Real most = largest(a.force), turning = largest(a.torque);
    for (int k = 0; k < 3 * a.n; k++) {
      ASSERT_NEAR(a.force[k], b.force[k], 1e-13 * most) << words;
      ASSERT_NEAR(a.torque[k], b.torque[k], 1e-13 * turning) << words;
    }
  }
}

// What touching pairs keep: of each its number in the list, then its numbers.
std::vector<Real> kept(const Grains &g)
{
  const PairHistory &h = g.history[g.now];
  std::vector<Real> all;
  for (std::size_t pair = 0; pair < h.size(); pair++) {
    all.push_back(static_cast<Real>(h.key(pair)));
    for (int k = 0; k < h.width(); k++) all.push_back(h.column(k)[pair]);
  }
  return all;
}

// Springs act in a setup, and do not move, though velocities are of another time than those of the step before.
void check_setup(Grains &g, const std::string &what)
{
  for (int step = 0; step < 5; step++) {
    for (int k = 0; k < 3 * g.n; k++) g.x[k] += 0.02 * g.v[k];
    g.step();
  }
  const std::vector<Real> before = kept(g);
  for (int k = 0; k < 3 * g.n; k++) {
    g.v[k] *= 0.8;
    g.omega[k] *= -0.8;
  }
  g.step(false);
  const std::vector<Real> force = g.force;
  ASSERT_EQ(kept(g), before) << what;
  g.step(false);
  ASSERT_EQ(g.force, force) << what;
}
TEST(pairs, keep_what_they_have_in_a_setup)
{
  for (const std::string &words : kLaws) {
    Grains g = random_grains(60, 3);
    g.set_law(law_of_words(words));
    g.set_list();
    check_setup(g, words);
  }
}
TEST(pairs, of_several_laws_keep_what_they_have_in_a_setup)
{
  Grains g = random_grains(60, 3);
  g.set_list();
  int width = 0;
  for (const int law : {4, 5, 11}) {
    g.laws.push_back(pair_law(law_of_words(kLaws[law])));
    width = std::max(width, 3 + law_of_words(kLaws[law]).n_extra());
  }
  g.n_types = 2;
  g.law_of = {0, 0, 0, 0, 0, 1, 0, 1, 2};
  for (int i = 0; i < g.n; i++) g.type[i] = 1 + i % 2;
  for (PairHistory &h : g.history) h.begin(width);
  check_setup(g, "three laws");
}

// Loops whose vectors hold several pairs give the bits of one pair after the other. 2000 pairs fill many lanes, and some of a last
// vector; pairs come and go.
TEST(pairs, have_the_same_bits_side_by_side)
{
  for (const std::string &words : kLaws) {
    Grains wide = random_grains(100, 6), narrow = random_grains(100, 6);
    for (Grains *g : {&wide, &narrow}) {
      g->set_law(law_of_words(words));
      g->set_list();
    }
    if (!wide.laws[0].evaluate_wide) continue;    // jkr, or a processor without such vectors
    narrow.laws[0].evaluate_wide = nullptr;
    std::vector<RecordedPair> of_wide, of_narrow;
    wide.record = &of_wide;
    narrow.record = &of_narrow;
    for (int step = 0; step < 5; step++) {
      for (Grains *g : {&wide, &narrow}) {
        for (int k = 0; k < 3 * g->n; k++) g->x[k] += 0.1 * g->v[k];
        g->step();
      }
      ASSERT_EQ(wide.force, narrow.force) << words;
      ASSERT_EQ(wide.torque, narrow.torque) << words;
      ASSERT_EQ(of_wide.size(), of_narrow.size()) << words;
      for (std::size_t k = 0; k < of_wide.size(); k++)
        ASSERT_EQ(of_wide[k].energy, of_narrow[k].energy) << words;
    }
  }
}

// ---- every law of the table of sub-models --------------------------------------------------------

// Lanes full of pairs that touch, slip, roll, spin and have kept something: from hardly at all to far beyond any limit.
struct FullLanes : PairLanes {
  explicit FullLanes(unsigned seed) : PairLanes()
  {
    Random random(seed);
    const auto any_size = [&] { return log_uniform(random, 1e-7, 10) * (random() % 2 ? 1 : -1); };
    for (int k = 0; k < kLanes; k++) {
      radius_i[k] = uniform(random, 0.5, 1);
      radius_j[k] = uniform(random, 0.5, 1);
      mass_i[k] = uniform(random, 1, 2);
      mass_j[k] = uniform(random, 1, 2);
      mass[k] = mass_i[k] * mass_j[k] / (mass_i[k] + mass_j[k]);
      temperature_difference[k] = any_size();
      const Real distance = radius_i[k] + radius_j[k] - log_uniform(random, 1e-9, 0.1);
      set_lane(offset, k, distance * random_unit(random));
      set_lane(velocity, k, {any_size(), any_size(), any_size()});
      set_lane(omega_i, k, {any_size(), any_size(), any_size()});
      set_lane(omega_j, k, {any_size(), any_size(), any_size()});
      for (Lane &number : memory) number[k] = any_size();
      constexpr int kRadius = 3 + 3;    // of the contact, of `mindlin_rescale`
      memory[kRadius][k] = std::fabs(memory[kRadius][k]);
    }
    look_at_own();
  }
  FullLanes(const FullLanes &other) : PairLanes(other) { look_at_own(); }

  // All that a law has put into them.
  std::vector<Real> results(const PairLaw &law) const
  {
    std::vector<const Real *> lanes = {energy};
    for (const Lane *const vector : {force, torque_i, torque_j})
      lanes.insert(lanes.end(), {vector[0], vector[1], vector[2]});
    if (law.has_heat) lanes.push_back(heat);
    for (int m = 0; m < kLaneNumbers; m++)
      if (law.stored >> m & 1) lanes.push_back(memory[m]);
    std::vector<Real> all;
    for (const Real *const lane : lanes) all.insert(all.end(), lane, lane + kLanes);
    return all;
  }

 private:
  void look_at_own()
  {
    for (int m = 0; m < kLaneNumbers; m++) before[m] = after[m] = memory[m];
  }
};

std::vector<Real> results_one_by_one(const PairLaw &law, const FullLanes &lanes)
{
  FullLanes computed = lanes;
  law.evaluate_lanes(law.law, computed, kLanes, 1e-3, true);
  return computed.results(law);
}

// The choices of a law that a loop over vectors was compiled for are its own.
TEST(pairs, of_every_law_that_can_be_made_have_the_same_bits_side_by_side)
{
  const FullLanes lanes(9);
  int n = 0;
  each_law_of_table([&](const ContactLaw &of, const LawRows &rows) {
    const PairLaw law = pair_law(of);
    if (!law.evaluate_wide || ::testing::Test::HasFailure()) return;
    FullLanes computed = lanes;
    law.prepare(law.law, computed);
    law.evaluate_wide(law.law, computed, kLanes, 1e-3);
    ASSERT_EQ(computed.results(law), results_one_by_one(law, lanes))
        << name_of(rows) << (of.limit_damping ? "limit_damping" : "");
    n++;
  });
  if (pair_law(law_of_words(kLaws[0])).evaluate_wide) {
    EXPECT_GT(n, 10000);
  }
}

// A row whose model has no branch in the formulas of its family would act as another one.
TEST(pairs, of_each_sub_model_of_the_table_have_forces_of_their_own)
{
  const auto row_of = [](Family family, const std::string &name) {
    for (const SubModel *row : sub_models(family))
      if (row->name == name) return row;
    return static_cast<const SubModel *>(nullptr);
  };
  const LawRows usual = {row_of(Family::normal, "hertz/material"),
                         row_of(Family::damping, "velocity"),
                         row_of(Family::tangential, "mindlin"),
                         row_of(Family::rolling, "sds"),
                         row_of(Family::twisting, "sds"),
                         row_of(Family::heat, "radius"),
                         nullptr};
  const FullLanes lanes(10);
  const auto results = [&](const LawRows &rows) {
    std::optional<ContactLaw> law = law_of_rows(rows);
    EXPECT_TRUE(law) << name_of(rows);
    law->k_normal = law->k_tangent = 1e4;    // by formulas alone they differ
    std::vector<Real> all = results_one_by_one(pair_law(*law), lanes);
    for (const Real each : all) EXPECT_TRUE(std::isfinite(each)) << name_of(rows);
    return all;
  };
  const Family families[] = {Family::normal,   Family::damping, Family::tangential, Family::rolling,
                             Family::twisting, Family::heat,    Family::cohesion};
  for (std::size_t k = 0; k < usual.size(); k++) {
    const LawRows choices = choices_of(families[k]);
    for (const SubModel *a : choices)
      for (const SubModel *b : choices) {
        if (a == b || (a && b && a->model == b->model)) continue;
        LawRows of_a = usual, of_b = usual;
        of_a[k] = a;
        of_b[k] = b;
        if (families[k] == Family::normal)    // some have no number for a damping
          of_a[1] = of_b[1] = row_of(Family::damping, "none");
        EXPECT_NE(results(of_a), results(of_b)) << name_of({a, b});
      }
  }
}

#if defined(__GLIBC__)
// A host may have asked for a signal where a result is no number. Grains that lie side by side without velocities have zeros in all roots.
TEST(pairs, raise_no_signal)
{
  for (const std::string &words : kLaws) {
    Grains g = random_grains(100, 8);
    for (int k = 0; k < 150; k++) g.v[k] = g.omega[k] = 0;
    g.set_law(law_of_words(words));
    g.set_list();
    feenableexcept(FE_INVALID | FE_DIVBYZERO);
    for (int step = 0; step < 3; step++) g.step();
    fedisableexcept(FE_ALL_EXCEPT);
    EXPECT_GT(largest(g.force), 0) << words;
  }
}
#endif

// The sum over pairs that the law of each is asked for alone. Grains move, so that pairs touch and part; some pairs have half of
// the force or none; the last grains are copies of others; two types have three laws, of which
// one may hold beyond contact.
void check_sum(const std::vector<std::string> &words)
{
  Grains g = random_grains(100, 7);
  g.set_list();
  g.n_own = 90;
  g.n_types = 2;
  g.law_of = {0, 0, 0, 0, 0, 1, 0, 1, 2};
  g.factor[1] = 0.5;
  g.factor[2] = 0;
  int width = 0;
  for (const std::string &law : words) {
    g.laws.push_back(pair_law(law_of_words(law)));
    width = std::max(width, 3 + law_of_words(law).n_extra());
  }
  for (PairHistory &h : g.history) h.begin(width);
  for (int i = 0; i < g.n; i++) {
    g.type[i] = 1 + i % 2;
    for (std::size_t k = 0; k < g.neighbours[i].size(); k++) g.neighbours[i][k] |= (k % 3) << 30;
  }
  std::map<std::pair<int, int>, std::vector<Real>> kept;
  for (int step = 0; step < 20; step++) {
    for (int k = 0; k < 3 * g.n; k++) g.x[k] += 0.1 * g.v[k];
    g.step();
    std::vector<Real> force(3 * g.n), torque(3 * g.n);
    const PairJob job = g.job(true);
    for (int i = 0; i < g.n; i++)
      for (const int neighbour : g.neighbours[i]) {
        const int j = neighbour & g.list().mask;
        const Real factor = g.factor[neighbour >> 30 & 3];
        if (factor == 0) continue;
        const PairLaw &law = g.laws[g.law_of[3 * g.type[i] + g.type[j]]];
        const auto old = kept.find({i, j});
        std::vector<Real> now(width);
        PairForce f;
        const bool touched = old != kept.end();
        if (!law.evaluate(law.law, grain_pair(job, i, j, true), touched,
                          touched ? old->second.data() : nullptr, now.data(), f)) {
          kept.erase({i, j});
          continue;
        }
        kept[{i, j}] = now;
        for (int k = 0; k < 3; k++) {
          force[3 * i + k] += factor * f.force()[k];
          torque[3 * i + k] += factor * f.torque_i()[k];
          if (j >= g.n_own) continue;
          force[3 * j + k] -= factor * f.force()[k];
          torque[3 * j + k] += factor * f.torque_j()[k];
        }
      }
    // Sums of some 40 forces in another order.
    for (int k = 0; k < 3 * g.n; k++) {
      ASSERT_NEAR(g.force[k], force[k], 1e-14 * largest(force)) << step;
      ASSERT_NEAR(g.torque[k], torque[k], 1e-14 * largest(torque)) << step;
    }
    ASSERT_EQ(g.history[g.now].size(), kept.size());
  }
}
TEST(pairs, of_a_step_are_the_sum_of_each_alone)
{
  check_sum({kLaws[4], kLaws[7], kLaws[11]});
  check_sum({kLaws[4], kLaws[5], kLaws[11]});
}

// Laws of types that differ in their sub-models take another path to the same numbers.
TEST(pairs, of_several_laws_have_each_its_own)
{
  const ContactLaw soft = law_of_words(kLaws[1]), hard = law_of_words(kLaws[5]);
  Grains one = random_grains(100, 4), both = random_grains(100, 4);
  one.set_law(hard);
  one.set_list();
  both.set_list();
  both.laws = {pair_law(soft), pair_law(hard)};
  both.n_types = 2;
  both.law_of.assign(9, 1);
  both.law_of[4] = 0;    // types 1 and 1
  for (int i = 0; i < both.n; i++) both.type[i] = 2;
  for (PairHistory &h : both.history) h.begin(3 + hard.n_extra());
  for (int k = 0; k < 3; k++) {
    one.step();
    both.step();
  }
  EXPECT_EQ(one.force, both.force);
  EXPECT_EQ(one.torque, both.torque);
}

// Pairs of many types wait for others with their law, in lanes that are shared by all, and have the bits of a law of all types. There
// are 300 laws here, and more pairs than wait at once.
TEST(pairs, of_many_types_have_the_bits_of_one)
{
  constexpr int kTypes = 24, kGrains = 500;
  const ContactLaw law = law_of_words(kLaws[5]);
  Grains one = random_grains(kGrains, 9), many = random_grains(kGrains, 9);
  one.set_law(law);
  many.n_types = kTypes;
  many.law_of.assign((kTypes + 1) * (kTypes + 1), 0);
  for (int i = 1; i <= kTypes; i++)
    for (int j = i; j <= kTypes; j++) {
      many.law_of[i * (kTypes + 1) + j] = many.law_of[j * (kTypes + 1) + i] =
          static_cast<int>(many.laws.size());
      many.laws.push_back(pair_law(law));
    }
  for (PairHistory &h : many.history) h.begin(3 + law.n_extra());
  std::mt19937 random(1);
  for (int &type : many.type) type = 1 + static_cast<int>(random() % kTypes);
  std::vector<RecordedPair> of_one, of_many;
  one.record = &of_one;
  many.record = &of_many;
  for (Grains *g : {&one, &many}) {
    for (Real &x : g->x) x *= 0.5;    // each touches many
    g->set_list();
    for (int step = 0; step < 4; step++) {
      for (int k = 0; k < 3 * g->n; k++) g->x[k] += 0.1 * g->v[k];
      g->step();
    }
  }
  EXPECT_GT(kept(one).size() / (1 + one.history[0].width()), 20000u);
  EXPECT_EQ(one.force, many.force);
  EXPECT_EQ(one.torque, many.torque);
  EXPECT_EQ(kept(one), kept(many));
  ASSERT_EQ(of_one.size(), of_many.size());
  for (std::size_t k = 0; k < of_one.size(); k++) {
    ASSERT_EQ(of_one[k].offset, of_many[k].offset);
    ASSERT_EQ(of_one[k].force, of_many[k].force);
    ASSERT_EQ(of_one[k].energy, of_many[k].energy);
  }
}

// What a file gets of a pair does not hang on what was in its memory before.
TEST(pairs, keep_zeros_where_their_law_keeps_fewer_numbers_than_another)
{
  const ContactLaw few = law_of_words(kLaws[4]), more = law_of_words(kLaws[5]);
  const int width = 3 + more.n_extra();
  Grains g = random_grains(100, 4);
  g.set_list();
  g.laws = {pair_law(few), pair_law(more)};
  g.n_types = 2;
  g.law_of.assign(9, 0);
  for (PairHistory &h : g.history) h.begin(width);
  // The memory of all columns is full of other numbers.
  std::vector<std::size_t> keys(5000);
  for (std::size_t k = 0; k < keys.size(); k++) keys[k] = k;
  for (PairHistory &h : g.history) {
    h.append(keys.data(), static_cast<int>(keys.size()));
    for (int k = 0; k < width; k++) std::fill_n(h.column(k), keys.size(), 7);
    h.begin(width);
  }
  g.step();
  const PairHistory &now = g.history[g.now];
  ASSERT_GT(now.size(), 100u);
  for (int k = 3; k < width; k++)
    for (std::size_t pair = 0; pair < now.size(); pair++) ASSERT_EQ(now.of(pair)[k], 0);
}

TEST(partners, go_in_a_message_as_they_are)
{
  Partners a({4}), b({4});
  a.grow(2);
  b.grow(2);
  const Real numbers[] = {2, 7, 1, 2, 3, 4, 9, 5, 6, 7, 8};
  EXPECT_TRUE(a.is_sound(numbers, 11));
  EXPECT_FALSE(a.is_sound(numbers, 10));
  const Real part_of_a_name[] = {1, 7.5, 1, 2, 3, 4}, no_name[] = {1, 1e300, 1, 2, 3, 4};
  EXPECT_FALSE(a.is_sound(part_of_a_name, 6));
  EXPECT_FALSE(a.is_sound(no_name, 6));
  EXPECT_EQ(a.unpack(1, numbers), 11);
  std::vector<Real> buffer(a.packed_size(1));
  EXPECT_EQ(a.pack(1, buffer.data()), 11);
  EXPECT_EQ(buffer, std::vector<Real>(numbers, numbers + 11));
  b.unpack(0, buffer.data());
  b.unpack_more(0, buffer.data());
  EXPECT_EQ(b.count(0), 4);
  EXPECT_EQ(b.name(0, 3), 9);
  EXPECT_EQ(b.numbers(0, 3)[3], 8);
}

// Grain 0 has a row with two others.
struct OneRow {
  int grain[3] = {0, 1, 2}, length[3] = {2, 0, 0}, row[2] = {1, 2};
  const int *rows[3] = {row, row, row};
  PairHistory history;

  PairList list() const { return {3, grain, length, rows, 0x3fffffff, 30}; }
  // Both pairs touch, and keep these numbers.
  void keep(const std::vector<Real> &first, const std::vector<Real> &second)
  {
    const std::size_t keys[] = {0, 1};
    history.begin(static_cast<int>(first.size()));
    history.append(keys, 2);
    for (std::size_t k = 0; k < first.size(); k++) {
      history.column(static_cast<int>(k))[0] = first[k];
      history.column(static_cast<int>(k))[1] = second[k];
    }
  }
  std::vector<Real> kept(std::size_t pair) const
  {
    std::vector<Real> numbers;
    for (int k = 0; k < history.width(); k++) numbers.push_back(history.column(k)[pair]);
    return numbers;
  }
};

// Grains 1 and 2 are images of one grain, at these places on an axis; grain 0 is at 0.
struct Images {
  Real place[3];

  Partners::Name name(int i) const { return i == 0 ? 1 : 7; }
  unsigned flips(int, int) const { return 7; }
  int kind(int, int) const { return 0; }
  Vec3 offset(int i, int j) const { return {0, place[i] - place[j], 0}; }
};

TEST(partners, tell_images_of_one_grain_apart)
{
  OneRow pairs;
  pairs.keep({1, 2, 3}, {4, 5, 6});
  Partners partners;
  partners.grow(3);
  partners.collect(pairs.list(), pairs.history, 1, {3, false, true}, Images{{0, 0.95, -0.95}});
  std::vector<Real> message(static_cast<std::size_t>(partners.packed_size(0)));
  EXPECT_EQ(partners.pack(0, message.data()), 1 + 2 * 7);
  partners.unpack(0, message.data());
  partners.hand_out(pairs.list(), pairs.history, 0.95, 3, Images{{0.1, -0.84, 1.04}});
  EXPECT_EQ(pairs.kept(0), (std::vector<Real>{4, 5, 6}));
  EXPECT_EQ(pairs.kept(1), (std::vector<Real>{1, 2, 3}));
  // There is one of them only, and it is not in contact.
  pairs.length[0] = 1;
  partners.hand_out(pairs.list(), pairs.history, 0.95, 3, Images{{0, 1.9, 0}});
  EXPECT_EQ(pairs.history.size(), 0u);
}

// Books of energy, which a later run has, need more numbers of each pair: images are told apart as before.
TEST(partners, tell_images_apart_where_they_are_given_more_numbers)
{
  OneRow pairs;
  pairs.keep({1, 2, 3}, {4, 5, 6});
  Partners partners;
  partners.grow(3);
  const Images there = {{0, 0.95, -0.95}};
  partners.collect(pairs.list(), pairs.history, 1, {3, false, true}, there);
  for (const PartnerForm form : {PartnerForm{5, false, true}, {4, true, true}, {3, false, true}}) {
    partners.set_form(form);
    partners.hand_out(pairs.list(), pairs.history, 0.95, 3, Images{{0, -0.95, 0.95}});
    std::vector<Real> first = {4, 5, 6}, second = {1, 2, 3};
    first.resize(static_cast<std::size_t>(form.width));
    second.resize(static_cast<std::size_t>(form.width));
    ASSERT_EQ(pairs.history.size(), 2u);
    EXPECT_EQ(pairs.kept(0), first);
    EXPECT_EQ(pairs.kept(1), second);
  }
}

// The laws of grain 0 with 1 and 2 are of these kinds.
struct Kinds {
  int of[3];

  Partners::Name name(int i) const { return i; }
  unsigned flips(int, int) const { return 0; }
  int kind(int, int j) const { return of[j]; }
  Vec3 offset(int, int) const { return {}; }
};

TEST(partners, give_no_numbers_to_a_law_of_another_kind)
{
  OneRow pairs;
  pairs.keep({1, 2, 3, 8}, {4, 5, 6, 9});
  Partners partners;
  partners.grow(3);
  partners.collect(pairs.list(), pairs.history, 1, {4, true}, Kinds{{0, 10, 20}});
  EXPECT_FALSE(partners.hand_out(pairs.list(), pairs.history, 0, 3, Kinds{{0, 10, 20}}));
  EXPECT_EQ(pairs.kept(0), (std::vector<Real>{1, 2, 3, 8}));
  EXPECT_TRUE(partners.hand_out(pairs.list(), pairs.history, 0, 3, Kinds{{0, 10, 10}}));
  EXPECT_EQ(pairs.kept(0), (std::vector<Real>{1, 2, 3, 8}));
  EXPECT_EQ(pairs.kept(1), (std::vector<Real>{0, 0, 0, 9}));    // it touches as before
}

TEST(partners, go_to_any_law_and_image_where_a_file_does_not_say_of_which_they_are)
{
  OneRow pairs;
  Partners partners({3});
  partners.grow(3);
  const Real numbers[] = {1, 7, 1, 2, 3};
  partners.unpack(0, numbers);
  partners.set_form({3, true, true});
  EXPECT_FALSE(partners.hand_out(pairs.list(), pairs.history, 0.95, 3, Images{{0, 0.95, -0.95}}));
  ASSERT_GE(pairs.history.size(), 1u);
  EXPECT_EQ(pairs.kept(0), (std::vector<Real>{1, 2, 3}));
}

TEST(pair_coeff, refuses_what_is_not_served_with_a_reason)
{
  const auto error = [](const std::string &text) {
    try {
      read_pair_coeff(words_of(text));
    } catch (const InputError &e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(error("mdr 1 1 1 1 1 1").find("suffix off"), std::string::npos);
  EXPECT_NE(
      error("hooke 1 1 tangential linear_history 1 1 1 synchronized_verlet").find("suffix off"),
      std::string::npos);
  EXPECT_NE(error("hooke 1 1 tangential linear_history 1 1 1 cutof 2").find("cutof"),
            std::string::npos);
  EXPECT_EQ(read_pair_coeff(words_of("hooke 1 1 cutoff 2 tangential linear_history 1 1 1")).cutoff,
            2);
}

}    // namespace lsdcd::test_pair
