// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Coarse graining: with lengths and times L times as large, and gravity 1/L of what it is, larger grains go the way of the real ones.
// The numbers of the real ones are given with the keyword.
#include "law/coarse_grain.h"

#include "base/input_error.h"
#include "input/pair_words.h"
#include "input/wall_command.h"
#include "support/pair_grains.h"
#include "support/says.h"
#include "support/table_laws.h"
#include "support/temp_dir.h"
#include "support/wall_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lsdcd::test_coarse_grain {
namespace {

// Its square root and its cube root are powers of two, so that the two ways differ by few roundings.
constexpr Real kScale = 64;
// A thousand steps round by about 1e-16 each, and springs and dashpots forget what is before.
constexpr Real kRounding = 1e-12;

using Law = std::vector<GivenSubModel>;

// ---- the table --------------------------------------------------------------------------------

TEST(coarse_grain, has_a_power_for_every_number_of_the_table)
{
  for (const SubModel &row : sub_models()) {
    for (const Parameter &p : row.parameters)
      EXPECT_NE(p.power, kNoPower) << p.name << " of " << name_of({&row}) << "has no to_power()";
    if (row.family == Family::damping) {
      EXPECT_NE(row.second, kNoPower) << name_of({&row}) << "has no power of its second number";
    }
  }
}

// The power of L of a unit, "torque time/angle": that of each word, with a minus behind the stroke.
int power_of_unit(const std::string &unit)
{
  const std::map<std::string, int> of_word = {
      {"1", 0},        {"0", 0},      {"1.5", 0},    {"0.5", 0},   {"multiple", 0}, {"of", 0},
      {"or", 0},       {"length", 1}, {"time", 1},   {"mass", 3},  {"force", 2},    {"energy", 3},
      {"pressure", 0}, {"torque", 3}, {"volume", 3}, {"angle", 0}, {"degrees", 0}};
  int power = 0, sign = 1;
  std::string word;
  for (const char c : unit + " ") {
    if (std::string(" /()").find(c) == std::string::npos) {
      word += c;
      continue;
    }
    if (!word.empty()) {
      const std::size_t at = word.find('^');
      power += sign * of_word.at(word.substr(0, at)) *
               (at == std::string::npos ? 1 : word[at + 1] - '0');
    }
    word.clear();
    if (c == '/') sign = -1;
  }
  return power;
}

// Heat is another matter: the bulk's conductivity stays.
TEST(coarse_grain, has_the_powers_of_the_units)
{
  for (const SubModel &row : sub_models())
    for (const Parameter &p : row.parameters)
      if (p.power == kPowerByExponent) {
        EXPECT_STREQ(p.unit, "force/length^n");
      } else if (row.family != Family::heat && p.power != kPowerOfDamping) {
        EXPECT_EQ(p.power, power_of_unit(p.unit)) << p.name << " of " << name_of({&row});
      }
  const std::map<std::string, std::string> unit_of_second = {{"none", "1"},
                                                             {"velocity", "mass/time"},
                                                             {"mass_velocity", "1/time"},
                                                             {"viscoelastic", "1/(time length)"},
                                                             {"tsuji", "1"},
                                                             {"coeff_restitution", "1"}};
  for (const SubModel *row : sub_models(Family::damping)) {
    const auto unit = unit_of_second.find(row->name);
    ASSERT_NE(unit, unit_of_second.end())
        << "name the unit of the second number with " << row->name;
    EXPECT_EQ(row->second, power_of_unit(unit->second)) << row->name;
  }
}

// A layer of grains has 1/L^2 contacts per area and conducts over L: what a contact conducts must grow by L.
TEST(coarse_grain, keeps_the_conductivity_of_the_bulk)
{
  const Real a = 0.3;    // of the contact
  for (const SubModel *row : sub_models(Family::heat)) {
    if (row->parameters.empty()) continue;
    const auto conducts = [&](Real scale) {
      const Law law = coarse_grained({{row, {7}}}, scale);
      const Conduction heat = {static_cast<HeatModel>(row->model), law.front().numbers.front()};
      Contact c = {};
      c.temperature_difference = 1;
      return heat.flow(c, scale * a);
    };
    EXPECT_NEAR(conducts(kScale), kScale * conducts(1), 1e-13 * kScale * conducts(1)) << row->name;
  }
}

// ---- laws to try ------------------------------------------------------------------------------

const SubModel &row_of(Family family, const std::string &name)
{
  for (const SubModel *row : sub_models(family))
    if (row->name == name) return *row;
  throw std::logic_error("there is no sub-model " + name);
}

Law sub_models_of(const LawRows &rows, bool derives)
{
  Law law;
  LawDraft draft = {granular_law(NormalModel::hooke)};
  for (const SubModel *row : rows) {
    GivenSubModel given = {row, {}};
    for (const Parameter &p : row->parameters)
      given.numbers.push_back(number_of(p, derives && can_derive(*row, draft)));
    add_sub_model(*row, given.numbers, draft);
    law.push_back(given);
  }
  return law;
}

// Laws that have each row of the table, and each normal sub-model with each damping that goes with it.
std::vector<Law> laws_to_try(bool derives)
{
  std::vector<Law> laws;
  const SubModel &hertz = row_of(Family::normal, "hertz/material"),
                 &viscous = row_of(Family::damping, "velocity"),
                 &mindlin = row_of(Family::tangential, "mindlin");
  const auto add = [&](const LawRows &rows) {
    const Law law = sub_models_of(rows, derives);
    try {
      make_law(law, false);
    } catch (const LawError &) {
      return;
    }
    laws.push_back(law);
  };
  for (const SubModel *style : sub_models(Family::style)) {
    add({style});
    for (const Family family : {Family::rolling, Family::cohesion})
      for (const SubModel *row : sub_models(family))
        if (!row->parameters.empty()) add({style, row});
  }
  for (const SubModel *normal : sub_models(Family::normal))
    for (const SubModel *damping : sub_models(Family::damping)) add({normal, damping, &mindlin});
  for (const SubModel *tangential : sub_models(Family::tangential))
    add({&hertz, &viscous, tangential});
  for (const Family family : {Family::rolling, Family::twisting, Family::cohesion})
    for (const SubModel *row : sub_models(family)) add({&hertz, &viscous, &mindlin, row});
  return laws;
}

// ---- ways of grains ---------------------------------------------------------------------------

// Places over the scale, velocities, and spins times the scale.
using Way = std::vector<Real>;

Real difference(const Way &a, const Way &b)
{
  Real most = 0;
  for (std::size_t k = 0; k < a.size(); k++) most = std::max(most, std::fabs(a[k] - b[k]));
  return most;
}

// A sphere that falls on a floor, slides and spins, bounces, and comes to roll.
Way way_at_wall(const Law &law, Real scale)
{
  const TempDir dir;
  const std::string floor =
      dir.write("floor.stl", "solid floor\n"
                             "facet normal 0 0 1\nouter loop\n"
                             "vertex -8 -8 0\nvertex 8 -8 0\nvertex 8 8 0\nendloop\nendfacet\n"
                             "facet normal 0 0 1\nouter loop\n"
                             "vertex -8 -8 0\nvertex 8 8 0\nvertex -8 8 0\nendloop\nendfacet\n"
                             "endsolid floor\n");
  const bool classic = law.front().row->family == Family::style;
  const std::string of_style = text_of(Law{law.front()}),
                    beside = text_of(Law(law.begin() + 1, law.end()));
  const std::string rest = " mesh " + floor + " scale " + exact_text(scale) + " coarse_grain " +
                           exact_text(scale) + " device cpu ";
  const WallSpec spec = parse_wall(words(classic ? of_style + rest + beside
                                                 : "granular " + of_style + " " + beside + rest))
                            .wall;
  auto host = std::make_unique<FakeHost>();
  host->simulation = wide_box();
  for (int k = 0; k < 3; k++) {
    host->simulation.corner[k] *= scale;
    host->simulation.edge[k][k] *= scale;
  }
  host->simulation.margin *= scale;
  WallScene scene(std::move(host), spec, WallUnits(), scale * 1e-3, WallBackend());
  scene.add(scale * Vec3{0.3, -0.4, 0.52}, scale * 0.5);
  scene.mass[0] = 2 * scale * scale * scale;
  scene.v[0] = {0.4, 0.3, -0.5};
  scene.omega[0] = (1 / scale) * Vec3{3, -2, 4};
  const Real gravity[] = {1, 0.5, -9};
  for (int k = 0; k < 3; k++) scene.gravity[k] = gravity[k] / scale;
  scene.set_up();
  Way way;
  for (int step = 0; step < 1000; step++) {
    scene.move_spheres();
    if (step % 50) continue;
    for (int k = 0; k < 3; k++)
      for (const Real number : {scene.x[0][k] / scale, scene.v[0][k], scene.omega[0][k] * scale})
        way.push_back(number);
  }
  return way;
}

// Two grains of other sizes that are pushed together, slide, spin, bounce, and come to roll on each other.
Way way_of_pair(const Law &law, Real scale)
{
  PairCoeff coeff;
  coeff.sub_models = law;
  PairGrains g(2);
  g.set_law(law_of(coeff, scale));
  g.set_list();
  g.dt = scale * 1e-3;
  g.radius = {0.5 * scale, 0.4 * scale};
  const Real cube = scale * scale * scale;
  g.mass = {2 * cube, 1.1 * cube};
  g.x = {0, 0, 0, 0.905 * scale, 0.05 * scale, 0};
  g.v = {0.3, 0.2, 0, -0.4, -0.2, 0.3};
  g.omega = {3 / scale, -2 / scale, 4 / scale, -1 / scale, 2 / scale, 1 / scale};
  const Real push[] = {5, 0, 0.2, -9, 0.3, 0};
  Way way;
  const auto kick = [&] {
    for (int k = 0; k < 6; k++) {
      const int i = k / 3;
      g.v[k] += 0.5 * g.dt * (g.force[k] / g.mass[i] + push[k] / scale);
      g.omega[k] += 0.5 * g.dt / (0.4 * g.mass[i] * g.radius[i] * g.radius[i]) * g.torque[k];
    }
  };
  g.step(false);
  for (int step = 0; step < 600; step++) {
    kick();
    for (int k = 0; k < 6; k++) g.x[k] += g.dt * g.v[k];
    g.step();
    kick();
    if (step % 30) continue;
    for (int k = 0; k < 6; k++)
      for (const Real number : {g.x[k] / scale, g.v[k], g.omega[k] * scale}) way.push_back(number);
  }
  return way;
}

using WayOf = Way (*)(const Law &law, Real scale);

void expect_the_way_of_real_grains(WayOf way_of, bool derives)
{
  for (const Law &law : laws_to_try(derives))
    EXPECT_LE(difference(way_of(law, 1), way_of(law, kScale)), kRounding) << text_of(law);
}

TEST(coarse_grain, keeps_the_way_at_a_wall)
{
  expect_the_way_of_real_grains(way_at_wall, false);
}

TEST(coarse_grain, keeps_the_way_of_two_grains)
{
  expect_the_way_of_real_grains(way_of_pair, false);
}

TEST(coarse_grain, keeps_the_way_where_numbers_are_derived)
{
  expect_the_way_of_real_grains(way_of_pair, true);
}

// Else the ways above would be the same with any power.
void expect_that_each_number_is_felt(WayOf way_of)
{
  std::map<std::pair<const SubModel *, std::size_t>, Real> felt;
  for (const Law &law : laws_to_try(false)) {
    const Way way = way_of(law, 1);
    for (std::size_t i = 0; i < law.size(); i++)
      for (std::size_t k = 0; k < law[i].numbers.size(); k++) {
        Real &most = felt[{law[i].row, k}];
        const Parameter &p = law[i].row->parameters[k];
        if (p.is_flag || p.mixing == Mixing::equal || most > 1e-9)
          continue;    // no flag, no exponent
        Law other = law;
        other[i].numbers[k] *= 0.75;
        most = std::max(most, difference(way, way_of(other, 1)));
      }
  }
  for (const SubModel &row : sub_models())
    for (std::size_t k = 0; k < row.parameters.size(); k++)
      if (row.family != Family::heat && !row.parameters[k].is_flag &&
          row.parameters[k].mixing != Mixing::equal) {
        EXPECT_GT((felt[{&row, k}]), 1e-9) << row.parameters[k].name << " of " << name_of({&row});
      }
}

TEST(coarse_grain, ways_at_a_wall_feel_each_number)
{
  expect_that_each_number_is_felt(way_at_wall);
}

TEST(coarse_grain, ways_of_two_grains_feel_each_number)
{
  expect_that_each_number_is_felt(way_of_pair);
}

// ---- where it is applied ----------------------------------------------------------------------

TEST(coarse_grain, refuses_a_number_without_a_power_by_its_name)
{
  SubModel row = row_of(Family::rolling, "sds");
  row.name = "sticky";
  row.parameters[1].power = kNoPower;
  const Law law = {{&row, {1, 2, 3}}};
  EXPECT_TRUE(says(error_of([&] { coarse_grained(law, 2); }), {"gamma", "rolling sticky"}));
  EXPECT_NO_THROW(coarse_grained(law, 1));
}

TEST(coarse_grain, tells_what_becomes_of_numbers)
{
  const Law law = {{&row_of(Family::normal, "hooke"), {1000, 3}},
                   {&row_of(Family::damping, "mass_velocity"), {}},
                   {&row_of(Family::rolling, "sds"), {0, 5, 0.2}}};
  EXPECT_EQ(coarse_grain_text(law, 2),
            "kn 1000 becomes 2000, eta 3 becomes 1.5, rolling sds gamma 5 becomes 20");
}

TEST(coarse_grain, is_told_of_each_law_once)
{
  EXPECT_EQ(coarse_grain_line(2, {{"wall", "kn 1 becomes 2"}, {"mesh 1", "kn 1 becomes 2"}}),
            "coarse_grain 2: kn 1 becomes 2; other numbers stay");
  EXPECT_EQ(coarse_grain_line(2, {{"wall", "kn 1 becomes 2"}, {"mesh 2", "kn 3 becomes 6"}}),
            "coarse_grain 2: wall: kn 1 becomes 2; mesh 2: kn 3 becomes 6; other numbers stay");
  EXPECT_EQ(coarse_grain_line(2, {{"wall", ""}}), "coarse_grain 2: all numbers stay");
}

PairCoeff coeff_of(const std::string &text)
{
  return read_pair_coeff(words(text));
}

TEST(coarse_grain, is_applied_once_to_mixed_types)
{
  const PairCoeff a = coeff_of("jkr 1e7 0 0.3 2 tangential mindlin NULL 1 0.5 damping none"),
                  b = coeff_of("jkr 1e7 0 0.3 8 tangential mindlin NULL 1 0.5 damping none");
  const PairCoeff both = mixed(a, b, "1 and 2");
  EXPECT_DOUBLE_EQ(law_of(both, 3).surface_energy, 3 * 4);
}

TEST(coarse_grain, leaves_the_words_of_a_law_as_they_are)
{
  const PairCoeff coeff =
      coeff_of("hooke 1000 3 tangential linear_history 300 1 0.5 damping velocity");
  const std::string before = text_of(coeff);
  law_of(coeff, 3);
  EXPECT_EQ(text_of(coeff), before);
  EXPECT_TRUE(are_equal(coeff_of("law " + before), coeff));
}

WallSpec wall_of(const std::string &text)
{
  return parse_wall(words(text)).wall;
}

TEST(coarse_grain, stands_anywhere_behind_the_numbers)
{
  const std::string law = "hooke 1000 NULL 20 NULL 0.5 1 mesh a.stl";
  for (const std::string &text :
       {law + " coarse_grain 4", law + " coarse_grain 4 rolling sds 5 0 0.1",
        law + " rolling sds 5 0 0.1 coarse_grain 4"}) {
    const WallSpec wall = wall_of(text);
    EXPECT_EQ(wall.law().k_normal, 4000) << text;
    EXPECT_EQ(wall.law().eta, 5) << text;
    EXPECT_EQ(wall.law().rolling.numbers[0], wall.law().rolling.is_on() ? 20 : 0) << text;
  }
}

TEST(coarse_grain, is_for_laws_of_meshes_and_types_too)
{
  const WallSpec wall =
      wall_of("hooke 1000 NULL 20 NULL 0.5 1 mesh a.stl rolling sds 5 0 0.1 "
              "law types 2 hooke 500 NULL 20 NULL 0.5 1 "
              "mesh b.stl law hooke 300 NULL 20 NULL 0.5 1 rolling sds 7 0 0.1 coarse_grain 4");
  const ContactLaw &of_types = wall.meshes[0].laws[0].law, &of_mesh = wall.meshes[1].laws[0].law;
  EXPECT_EQ(of_types.k_normal, 2000);
  EXPECT_EQ(of_types.rolling.numbers[0], 20);    // that of the wall
  EXPECT_EQ(of_mesh.k_normal, 1200);
  EXPECT_EQ(of_mesh.rolling.numbers[0], 28);
}

TEST(coarse_grain, keeps_limit_damping)
{
  EXPECT_TRUE(wall_of("hooke 1000 NULL 20 NULL 0.5 1 limit_damping mesh a.stl coarse_grain 4")
                  .law()
                  .limit_damping);
}

TEST(coarse_grain, is_a_number_above_0)
{
  for (const char *wrong : {"coarse_grain 0", "coarse_grain -2", "coarse_grain"})
    EXPECT_TRUE(has(error_of([&] {
                      wall_of(std::string("hooke 1000 NULL 20 NULL 0.5 1 mesh a.stl ") + wrong);
                    }),
                    "coarse_grain"));
}

}    // namespace
}    // namespace lsdcd::test_coarse_grain
