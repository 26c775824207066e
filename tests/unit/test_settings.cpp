// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/input_error.h"
#include "input/granular_words.h"
#include "input/motion_words.h"
#include "input/wall_command.h"
#include "support/says.h"
#include "wall/spec/run_files.h"
#include "wall/spec/spec_text.h"

#include <gtest/gtest.h>

#include <iterator>
#include <numeric>

namespace lsdcd::test_settings {
namespace {

WallSpec parse(const std::string &line)
{
  return parse_wall(words(line)).wall;
}

// A valid command with more words at its end.
WallSpec with(const std::string &more)
{
  return parse("hooke 1e5 NULL 50 NULL 0.5 1 mesh a.stl " + more);
}

PictureSpec picture(const std::string &more)
{
  return parse_wall(words("hooke 1e5 NULL 50 NULL 0.5 1 mesh a.stl " + more)).picture;
}

std::string error_of(const std::string &line)
{
  return lsdcd::error_of([&] { parse(line); });
}

std::string error_with(const std::string &more)
{
  return error_of("hooke 1e5 NULL 50 NULL 0.5 1 mesh a.stl " + more);
}

TEST(settings, classic_styles_have_the_defaults_of_lammps)
{
  EXPECT_EQ(parse("hooke 7e4 NULL 50 NULL 0.5 1 mesh a.stl").law().k_tangent, 2e4);    // 2/7 kn
  EXPECT_EQ(with("").law().gamma_tangent, 25);                                         // gamman / 2
  EXPECT_EQ(parse("hooke 1e5 NULL 50 20 0.5 0 mesh a.stl").law().gamma_tangent, 0);
  EXPECT_TRUE(parse("hooke 1 1 1 1 0.5 1 limit_damping mesh a.stl").law().limit_damping);
  for (const std::string style : {"hooke", "hooke/history", "hertz/history"})
    EXPECT_EQ(parse(style + " 1 1 1 1 0.5 1 mesh a.stl").law().has_history(), style != "hooke");
}

// Angles are right-handed, and an axis may have any length.
TEST(settings, placements_act_in_the_order_given)
{
  const struct {
    const char *words;
    Vec3 from, to;
  } rows[] = {{"scale 2 contacts", {1, 1, 1}, {2, 2, 2}},
              {"scale 2 3 4 contacts", {1, 1, 1}, {2, 3, 4}},
              {"scale 2 move 1 0 0", {1, 0, 0}, {3, 0, 0}},
              {"move 1 0 0 scale 2", {1, 0, 0}, {4, 0, 0}},
              {"move 1 0 0 move 1 0 0", {0, 0, 0}, {2, 0, 0}},
              {"rotate 0 0 1 90", {1, 0, 0}, {0, 1, 0}},
              {"rotate 1e200 0 1e200 180", {1, 0, 0}, {0, 0, 1}},
              {"rotate 1e-200 0 1e-200 180", {1, 0, 0}, {0, 0, 1}}};
  for (const auto &row : rows)
    for (int k = 0; k < 3;
         k++)    // a few roundings of numbers up to 1, and of small whole ones none
      EXPECT_NEAR(with(row.words).meshes[0].placement.apply(row.from)[k], row.to[k], 1e-15)
          << row.words;
}

TEST(settings, choices_and_values_are_read)
{
  EXPECT_EQ(with("grid auto").grid_length, 0);    // chosen by the grid
  EXPECT_EQ(with("grid 0.5").grid_length, 0.5);
  EXPECT_EQ(with("rmax auto").rmax, 0);
  EXPECT_EQ(with("rmax 0.75").rmax, 0.75);
  EXPECT_EQ(with("nearest all").nearest, 0);
  EXPECT_EQ(with("nearest 3").nearest, 3);
  EXPECT_EQ(with("average 7").average_every, 7);
  EXPECT_EQ(with("impacts 0.01").impact_speed, 0.01);
  EXPECT_TRUE(!with("").each_contact && with("each_contact").each_contact);
  EXPECT_TRUE(!with("").energy && with("energy").energy);
  EXPECT_EQ(parse("granular hertz 1e5 3 tangential linear_nohistory 1 0.5 heat area 7 mesh a.stl "
                  "temperature 300 energy friction_heat 0.25")
                .friction_heat,
            0.25);
  EXPECT_EQ(with("").memory_budget, StepGridSettings().memory_budget);
  EXPECT_EQ(with("memory 2").memory_budget, std::size_t(2) * 1024 * 1024);
  EXPECT_TRUE(!with("").contacts && with("contacts").contacts);
  EXPECT_TRUE(!with("").periodic && with("periodic").periodic);
  EXPECT_EQ(with("").corner, Corner::blend);
  EXPECT_EQ(with("corner sum").corner, Corner::sum);
  EXPECT_EQ(with("").side, Side::both);
  EXPECT_EQ(with("side in").side, Side::in);
  EXPECT_EQ(with("side out").side, Side::out);
  EXPECT_EQ(with("").device, Device::automatic);
  EXPECT_EQ(with("device cpu").device, Device::cpu);
  EXPECT_EQ(with("device cuda").device, Device::cuda);
  EXPECT_FALSE(with("log full").brief);
  EXPECT_TRUE(with("log brief").brief);
  EXPECT_EQ(with("cache none").meshes[0].cache_file, "");
  EXPECT_EQ(with("cache vessel.grid").meshes[0].cache_file, "vessel.grid");
  EXPECT_EQ(with("surface_angvel 0 0 3").meshes[0].surface.centre, (Vec3{0, 0, 0}));
  EXPECT_EQ(picture("draw faces").draw, Draw::faces);
  EXPECT_EQ(picture("draw contours").draw, Draw::contours);
  EXPECT_EQ(picture("draw edges 2 contacts").type, 2);    // of atoms, whose colour it is
  EXPECT_FALSE(picture("").cut);
  const PictureSpec cut = picture("cut 0 1 0 0.5");
  EXPECT_TRUE(cut.cut);
  EXPECT_EQ(cut.cut_normal.y, 1);
  EXPECT_EQ(cut.cut_offset, 0.5);
}

TEST(settings, the_placement_is_shown_step_by_step)
{
  EXPECT_EQ(placement_text(with("scale 0.001 move 0 0 1 rotate 0 0 2 90").meshes[0].placement),
            "scale 0.001, move 0 0 1, rotate 0 0 2 90");
}

TEST(settings, an_unknown_keyword_names_the_nearest)
{
  EXPECT_TRUE(has(error_with("sclae 2"), "'scale s | sx sy sz'"));
  EXPECT_TRUE(has(error_with("rmxa 2"), "'rmax"));
}

TEST(settings, a_word_like_no_keyword_is_told_all_of_them)
{
  const std::string error = error_with("colour red");
  EXPECT_FALSE(has(error, "the nearest"));
  for (const char *keyword : {"mesh", "grid", "surface_angvel", "log"})
    EXPECT_TRUE(has(error, keyword));
}

TEST(settings, words_of_other_walls_are_answered)
{
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"vibrate 1 0 0", "motion wiggle"},
      {"move/mesh linear 1 0 0", "motion linear"},
      {"zplane 0 NULL", "mesh FILE"},
      {"zcylinder 3", "mesh FILE"},
      {"velocity 1 0 0", "surface_vel vx vy vz"},
      {"curvature 1e-5", "not needed"},
      {"stress on", "mesh_fields"},
      {"type 1", "before mesh"},
      {"file a.stl", "mesh FILE"},
      {"damping tsuji", "style granular"},
      {"limit_damping", "before mesh"}};
  for (const auto &c : cases) {
    EXPECT_TRUE(has(error_with(c.first), c.second));
    EXPECT_FALSE(has(error_with(c.first), "nearest"));
  }
}

TEST(settings, out_of_range_gives_the_range)
{
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"grid 0", "L = 0 is out of range: it must be above 0."},
      {"weld -1", "the tolerance = -1 is out of range: it must be 0 or more."},
      {"memory 0.5", "it must be from 1 to 1e+09."},
      {"nearest 33", "it must be from 1 to 32."},
      {"draw edges 0", "it must be from 1 to 1e+06."},
      {"wear archard 1 0", "H = 0 is out of range: it must be above 0."}};
  for (const auto &c : cases) EXPECT_TRUE(has(error_with(c.first), c.second));
  EXPECT_TRUE(has(error_of("hooke 1 NULL 50 NULL 10001 1 mesh a.stl"), "from 0 to 10000."));
  EXPECT_TRUE(has(error_of("granular hertz/material 1 1 -1 tangential linear_nohistory 0 0 mesh a"),
                  "nu = -1 is out of range: it must be above -1 to 0.5."));
}

TEST(settings, wrong_words_are_named_with_what_is_right)
{
  const std::string law = "hooke 1e5 NULL 50 NULL 0.5 1 mesh a.stl ";
  const struct {
    const char *what;
    std::string line, told;
  } cases[] = {
      {"no style", "", "contact style is missing"},
      {"an unknown style", "hertz 1 1 1 1 0.5 1 mesh a.stl", "hooke|hooke/history|hertz/history"},
      {"no mesh", "hooke 1 1 1 1 0.5 1 contacts", "mesh FILE is missing"},
      {"a word for a number", "hooke 1e5 NULL fifty NULL 0.5 1 mesh a.stl", "'fifty'"},
      {"too few numbers", "hooke 1e5 NULL 50 NULL 0.5 mesh a.stl",
       "dampflag must be a number, not 'mesh'"},
      {"too few numbers: the syntax", "hooke 1e5 NULL 50 NULL 0.5 mesh a.stl", "Syntax: hooke|"},
      {"a negative stiffness", "hooke -1 NULL 50 NULL 0.5 1 mesh a.stl", "out of range"},
      {"a dampflag between 0 and 1", "hooke 1 NULL 50 NULL 1 0.5 mesh a.stl", "0 or 1"},
      {"a value missing at the end", law + "move 1 2", "the value of z is missing"},
      {"a number with a tail", law + "weld 1e-6m", "'1e-6m'"},
      {"an infinite number", law + "grid inf", "'inf'"},
      {"no number", law + "grid nan", "'nan'"},
      {"a wrong choice", law + "corner round", "blend | sum"},
      {"a wrong choice of logs", law + "log none", "log full | brief"},
      {"a cache without a name", law + "cache", "the file name is missing"},
      {"a keyword twice", law + "rmax 1 rmax 2", "twice"},
      {"one of all meshes twice", law + "corner sum mesh b.stl corner sum", "is given twice"},
      {"two factors", law + "scale 2 3 contacts", "one factor or three"},
      {"a zero axis", law + "rotate 0 0 0 90", "axis"},
      {"a cut without a normal", law + "cut 0 0 0 1", "the normal must not be 0 0 0"},
  };
  for (const auto &c : cases) EXPECT_TRUE(has(error_of(c.line), c.told)) << c.what;
}

TEST(settings, keywords_of_a_mesh_are_of_the_one_before_them)
{
  const WallSpec s = with("move 1 0 0 weld 0 corner sum mesh b.stl motion linear 1 2 3 contacts "
                          "mesh c.stl surface_vel 1 0 0 weld 1e-3");
  ASSERT_EQ(s.meshes.size(), 3u);
  EXPECT_EQ(s.meshes[1].file, "b.stl");
  EXPECT_EQ(s.meshes[0].placement.apply({0, 0, 0}).x, 1);
  EXPECT_EQ(s.meshes[1].placement.apply({0, 0, 0}).x, 0);
  EXPECT_EQ(s.meshes[0].weld, 0);
  EXPECT_LT(s.meshes[1].weld, 0);
  EXPECT_EQ(s.meshes[2].weld, 1e-3);
  EXPECT_TRUE(!s.meshes[0].motion.any() && s.meshes[1].motion.any() && !s.meshes[2].motion.any());
  EXPECT_EQ(s.meshes[2].surface.velocity, (Vec3{1, 0, 0}));
  EXPECT_TRUE(s.corner == Corner::sum && s.contacts);
}

TEST(settings, before_the_only_mesh_its_keywords_may_stand)
{
  const WallSpec s = parse("hooke 1e5 NULL 50 NULL 0.5 1 move 1 0 0 contacts mesh a.stl");
  EXPECT_EQ(s.meshes[0].placement.apply({0, 0, 0}).x, 1);
}

TEST(settings, of_several_meshes_errors_name_the_one)
{
  const std::string law = "hooke 1e5 NULL 50 NULL 0.5 1 ";
  EXPECT_TRUE(has(error_of(law + "weld 0 mesh a.stl mesh b.stl"), "'weld' comes before the first"));
  EXPECT_TRUE(has(error_with("mesh a.stl"), "of mesh 2 'a.stl': it is that of mesh 1 'a.stl' at"));
  EXPECT_EQ(with("mesh a.stl move 0 0 1").meshes.size(), 2u);
  EXPECT_EQ(with("mesh a.stl motion linear 0 0 1").meshes.size(), 2u);
  EXPECT_TRUE(has(error_with("move 1 0 0 rmax 1 mesh b.stl move 1 0 0 rmax 1"), "twice"));
}

TEST(settings, laws_are_of_a_mesh_and_of_types_with_it)
{
  const WallSpec s =
      with("law types 2* hooke 3e5 NULL 50 NULL 0.5 1 law hooke 2e5 NULL 50 NULL 0.5 1 "
           "mesh b.stl law types 3 hooke 4e5 NULL 50 NULL 0.5 1 limit_damping corner sum");
  const LawTable laws = law_table(s);
  ASSERT_EQ(laws.kinds, 3);
  EXPECT_EQ(laws.kind_of_type, (std::vector<int>{0, 0, 1, 2, 1}));    // 0 is no type
  const Real stiffness[2][3] = {{2e5, 3e5, 3e5}, {1e5, 1e5, 4e5}};
  for (int mesh = 0; mesh < 2; mesh++)
    for (int kind = 0; kind < 3; kind++)
      EXPECT_EQ(law_of(laws, mesh, kind).k_normal, stiffness[mesh][kind]);
  EXPECT_TRUE(law_of(laws, 1, 2).limit_damping);
  EXPECT_EQ(s.corner, Corner::sum);
  EXPECT_EQ(law_table(with("")).laws.size(), 1u);
}

TEST(settings, of_laws_of_the_same_types_the_last_counts)
{
  const WallSpec s = with("law types 1*3 hooke 2e5 NULL 50 NULL 0.5 1 "
                          "law types *2 hooke 3e5 NULL 50 NULL 0.5 1");
  const LawTable laws = law_table(s);
  const int kinds[] = {laws.kind_of_type.at(1), laws.kind_of_type.at(3), laws.kind_of_type.at(4)};
  const Real stiffness[] = {3e5, 2e5, 1e5};
  for (int k = 0; k < 3; k++) EXPECT_EQ(law_of(laws, 0, kinds[k]).k_normal, stiffness[k]);
}

TEST(settings, laws_take_limit_damping_of_the_wall)
{
  const char *const numbers[] = {"hooke 2e5 NULL 50 NULL 0.5 1 ",
                                 "hertz/history 2e5 NULL 50 NULL 0.5 1 ",
                                 "granular hooke 2e5 50 tangential linear_nohistory 1 0.5 "};
  for (const std::string law : numbers)
    for (const bool of_wall : {true, false}) {
      const std::string limit = of_wall ? "limit_damping " : "";
      const WallSpec s = parse(law + limit + "mesh a.stl mesh b.stl law " + law +
                               "mesh c.stl law " + law + "limit_damping law types 2 " + law);
      EXPECT_EQ(law_of(law_table(s), 0, 0).limit_damping, of_wall) << law;
      EXPECT_EQ(law_of(law_table(s), 1, 0).limit_damping, of_wall) << law;
      EXPECT_TRUE(law_of(law_table(s), 2, 0).limit_damping) << law;
      EXPECT_EQ(law_of(law_table(s), 2, 1).limit_damping, of_wall) << law;
    }
}

TEST(settings, the_log_names_limit_damping_that_a_granular_law_takes_of_the_wall)
{
  const std::string law = "granular hooke 2e5 50 tangential linear_nohistory 1 0.5 ";
  const WallSpec s = parse(law + "limit_damping mesh a.stl law " + law);
  EXPECT_EQ(s.meshes[0].laws[0].name, s.laws[0].name);
}

TEST(settings, laws_take_rolling_and_cohesion_of_the_wall)
{
  const WallSpec s = with("law hooke 2e5 NULL 50 NULL 0.5 1 cohesion sjkr 5 mesh b.stl rolling "
                          "cdt 0.1 cohesion sjkr 0");
  EXPECT_EQ(law_of(law_table(s), 0, 0).rolling.numbers[0], 0.1);
  EXPECT_EQ(law_of(law_table(s), 0, 0).cohesion.numbers[0], 5);
  EXPECT_EQ(law_of(law_table(s), 1, 0).cohesion.numbers[0], 0);
  EXPECT_TRUE(law_of(law_table(s), 1, 0).cohesion.is_on());
  EXPECT_FALSE(with("cohesion sjkr 0").law().cohesion.is_on());
}

TEST(settings, laws_of_other_sub_models_are_refused)
{
  const std::string law = "law hooke 2e5 NULL 50 NULL 0.5 1 ";
  EXPECT_TRUE(has(error_with("law hooke/history 1 NULL 1 NULL 1 1"),
                  "sub-models hooke/history, and the wall has hooke: only the numbers may differ"));
  EXPECT_TRUE(
      has(error_with(law + "rolling cdt 0.1"), "hooke, rolling cdt, and the wall has hooke"));
  EXPECT_TRUE(has(error_with(law + law), "the mesh already has a law for all atom types"));
  for (const char *types : {"0", "3*2", "a", "1.5", "2-3"})
    EXPECT_TRUE(has(error_with("law types " + std::string(types) + " hooke 1 NULL 1 NULL 1 1"),
                    "not a range of atom types"));
  EXPECT_TRUE(has(error_with("material steel"), "granular material FILE"));
}

TEST(settings, nodes_are_atoms_of_a_group_that_a_pressure_pushes)
{
  const WallSpec s = with("nodes rubber pressure -2.5");
  EXPECT_TRUE(s.meshes[0].has_nodes);
  EXPECT_EQ(s.meshes[0].node_group, "rubber");
  EXPECT_EQ(s.meshes[0].pressure, -2.5);
  EXPECT_EQ(with("nodes rubber pressure v_p").inputs, (InputNames{"p"}));
  EXPECT_FALSE(with("").meshes[0].has_nodes);
  EXPECT_TRUE(has(error_with("nodes"), "the group of the nodes is missing"));
}

TEST(settings, motions_are_kept_in_the_order_given)
{
  const WallSpec s = with("motion wiggle 1 2 3 0.5 wiggle z 0.1 2 scale 2 motion transrot 4 5 6 "
                          "7 8 9 0 0 -2 0.25 motion rotate 1 1 1 3 0 0 4 motion linear 1 0 -1");
  EXPECT_EQ(motion_text(s.meshes[0].motion.terms(), s.inputs),
            "wiggle 1 2 3 0.5, wiggle z 0.1 2, transrot 4 5 6 7 8 9 0 0 -2 0.25, "
            "rotate 1 1 1 3 0 0 4, linear 1 0 -1");
  EXPECT_FALSE(with("").meshes[0].motion.any());
}

TEST(settings, motions_of_variables)
{
  const WallSpec s = with("motion variable v_a NULL v_b NULL NULL v_c");
  const MotionTerm &m = s.meshes[0].motion.terms()[0];
  EXPECT_EQ(s.inputs, (InputNames{"a", "b", "c"}));
  const int inputs[] = {0, kNoInput, 1, kNoInput, kNoInput, 2};
  for (int k = 0; k < 6; k++) EXPECT_EQ(m.input[k], inputs[k]);
  EXPECT_EQ(motion_text({m}, s.inputs), "variable v_a NULL v_b NULL NULL v_c");
  EXPECT_FALSE(s.meshes[0].surface_varies());
  const WallSpec belt = with("surface_vel v_u 1 2 surface_angvel 0 0 v_w");
  EXPECT_EQ(belt.inputs, (InputNames{"u", "w"}));
  EXPECT_EQ(belt.meshes[0].surface_input[0], 0);
  EXPECT_EQ(belt.meshes[0].surface_input[5], 1);
  EXPECT_EQ(belt.meshes[0].surface.velocity, (Vec3{0, 1, 2}));
  EXPECT_TRUE(belt.meshes[0].surface_varies());
  EXPECT_EQ(with("shear y v_u").meshes[0].surface_input[1], 0);
  EXPECT_EQ(with("shear y 3").meshes[0].surface.velocity, (Vec3{0, 3, 0}));
}

TEST(settings, turns_by_variables_and_to_and_fro)
{
  const WallSpec s = with("motion rotate 1 2 3 0 0 2 variable v_a v_w motion rotate 0 0 0 1 0 0 "
                          "variable NULL v_w motion riggle 1 2 3 0 1 0 90 0.5");
  const std::vector<MotionTerm> &m = s.meshes[0].motion.terms();
  ASSERT_EQ(m.size(), 3u);
  EXPECT_EQ(m[0].kind, MotionKind::variable_turn);
  EXPECT_EQ(m[0].input[0], 0);
  EXPECT_EQ(m[0].input[3], 1);
  EXPECT_EQ(m[1].input[0], kNoInput);
  EXPECT_TRUE(m[1].adds_up(0));
  EXPECT_EQ(m[2].angle, kPi / 2);
  EXPECT_EQ(motion_text(m, s.inputs),
            "rotate 1 2 3 0 0 2 variable v_a v_w, rotate 0 0 0 1 0 0 variable NULL v_w, "
            "riggle 1 2 3 0 1 0 90 0.5");
}

TEST(settings, tables_of_motions_with_their_words_in_any_order)
{
  const WallSpec s = with("motion table a.txt linear axis 1 2 3 0 0 2 degrees repeat motion table "
                          "b.txt about 1 0 0 periodic");
  const std::vector<MotionTerm> &m = s.meshes[0].motion.terms();
  ASSERT_EQ(m.size(), 2u);
  EXPECT_EQ(m[0].table_file, "a.txt");
  EXPECT_EQ(m[0].axis, (Vec3{0, 0, 2}));
  const TableOptions &o = m[0].table_options;
  EXPECT_TRUE(o.has_axis && o.linear && o.degrees && o.repeats);
  EXPECT_EQ(m[1].point, (Vec3{1, 0, 0}));
  EXPECT_TRUE(m[1].table_options == TableOptions());
  EXPECT_TRUE(s.periodic);
  EXPECT_EQ(motion_text(m, s.inputs),
            "table a.txt axis 1 2 3 0 0 2 linear repeat degrees, table b.txt about 1 0 0");
}

TEST(settings, wrong_motions_are_refused)
{
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"motion", "its value is missing"},
      {"motion slide 1 0 0", "'slide' is not one of its values"},
      {"motion linear 1 0", "the value of Vz is missing"},
      {"motion linear 1 0 0 4", "one more than expected"},
      {"motion wiggle 1 0 0 -2", "the period = -2 is below 0: give a period above 0"},
      {"motion rotate 0 0 0 0 0 1 0", "the period = 0 is out of range"},
      {"motion rotate 0 0 0 0 0 0 1", "the axis Rx Ry Rz must not be 0 0 0"},
      {"motion rotate 0 0 0 0 0 1 2 1 1 1", "there is one centre P, one axis R and one period"},
      {"motion linear v_u 0 0", "Use motion variable"},
      {"motion rotate 0 0 0 0 0 1 v_p", "Use motion variable"},
      {"motion variable v_a v_b v_c NULL NULL", "the variable v_vz is missing"},
      {"motion variable v_a 1 NULL NULL NULL NULL", "v_dy must be a variable, v_NAME, or NULL"},
      {"motion variable NULL NULL NULL NULL NULL NULL", "nothing would move"},
      {"motion rotate 0 0 0 0 0 1 variable v_a", "the variable v_speed is missing"},
      {"motion rotate 0 0 0 0 0 1 variable NULL NULL", "nothing would move"},
      {"motion riggle 0 0 0 0 0 1 5", "the value of the period is missing"},
      {"motion table", "the file name is missing after table"},
      {"motion table a.txt linear cubic", "'cubic' is given twice, or together with"},
      {"motion table a.txt axis 0 0 0 0 0 0", "the axis Rx Ry Rz must not be 0 0 0"},
      {"motion variable v_ NULL NULL NULL NULL NULL", "name is missing after v_"},
      {"wiggle w 1 1", "'w' is not one of its values"},
      {"wiggle z 1 -1", "the period = -1 is below 0"},
      {"wiggle z v_a 1", "Use motion variable"},
      {"wiggle z 1 1 wiggle z 1 1", "given twice"},
      {"shear x", "the value of the speed is missing"},
      {"shear x 1 surface_vel 0 1 0", "give one of them"}};
  for (const auto &c : cases) EXPECT_TRUE(has(error_with(c.first), c.second)) << c.first;
}

TEST(settings, wrong_servos_are_refused)
{
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"servo press z 100 vmax 1", "'press' is not one of its values"},
      {"servo force z", "the target (number or v_NAME) is missing"},
      {"servo force z vmax 1", "the target (number or v_NAME)"},
      {"servo force z 100", "vmax is missing"},
      {"servo force z 100 speed 1",
       "vmax is missing, the speed at which the mesh moves up to the spheres; "
       "'speed' is not a keyword of a servo"},
      {"servo force z 100 vmax 0", "vmax = 0 is out of range"},
      {"servo force axis 0 0 0 100 vmax 1", "the axis ax ay az must not be 0 0 0"},
      {"servo force z 100 vmax 1 limits 0.1 0.2", "the limits 0.1 0.2 do not contain 0"},
      {"servo force z 100 vmax 1 limits 0.1 -0.1", "the limits 0.1 -0.1 are reversed"},
      {"servo torque y through 0 0 1 100 vmax 1 gain -1", "the gain = -1 is out of range"},
      {"servo force z 100 vmax 1 servo torque z 1 vmax 1", "the keyword is given twice"}};
  for (const auto &c : cases) EXPECT_TRUE(has(error_with(c.first), c.second)) << c.first;
}

TEST(settings, fix_modify_reads_motions_or_none)
{
  InputNames inputs;
  const std::vector<std::string> of_two =
      words("motion linear 1 0 0 motion wiggle 0 0 1 2 energy yes");
  Tokens two(of_two);
  EXPECT_EQ(motion_text(read_modified_motion(two, inputs).terms(), inputs),
            "linear 1 0 0, wiggle 0 0 1 2");
  EXPECT_EQ(two.at(), 11u);
  const std::vector<std::string> of_none = words("motion none energy yes");
  Tokens none(of_none);
  EXPECT_FALSE(read_modified_motion(none, inputs).moves());
  EXPECT_EQ(none.at(), 2u);
  for (const char *const wrong : {"motion none motion linear 1 0 0", "motion linear 1 0"}) {
    const std::vector<std::string> read = words(wrong);
    Tokens tokens(read);
    EXPECT_THROW(read_modified_motion(tokens, inputs), InputError) << wrong;
  }
}

TEST(settings, wear_is_volume_per_work)
{
  const WallSpec archard = with("wear archard 0.003 1.5e9");
  EXPECT_EQ(archard.wear_deform.every, 0);
  const WallSpec recedes = with("wear finnie 1e-9 deform every 40 factor 2.5");
  EXPECT_EQ(recedes.wear_deform.every, 40);
  EXPECT_EQ(recedes.wear_deform.factor, 2.5);
  EXPECT_EQ(archard.wear.model, WearModel::archard);
  EXPECT_DOUBLE_EQ(archard.wear.per_work, 2e-12);
  const WallSpec finnie = with("wear finnie 4e-11");
  EXPECT_EQ(finnie.wear.model, WearModel::finnie);
  EXPECT_EQ(finnie.wear.per_work, 4e-11);
  EXPECT_FALSE(with("").has_loads());
  EXPECT_TRUE(has(error_with("wear archard 0.003"), "H"));
  EXPECT_TRUE(has(error_with("wear archard 0.003 0"), "H"));
  EXPECT_TRUE(has(error_with("wear archard -1 5"), "K"));
  EXPECT_TRUE(has(error_with("wear rubbing 1"), "archard"));
  const Wear oka = with("wear oka 6e-11 1.18 0.727 2.05 2.31 0.19 104 3.26e-4 0.5").wear;
  EXPECT_EQ(oka.model, WearModel::oka);
  EXPECT_EQ(oka.per_work, 6e-11);
  EXPECT_EQ((std::array<Real, 8>{oka.oka.hardness, oka.oka.n1, oka.oka.n2, oka.oka.k2, oka.oka.k3,
                                 oka.oka.speed, oka.oka.diameter, oka.oka.least_speed}),
            (std::array<Real, 8>{1.18, 0.727, 2.05, 2.31, 0.19, 104, 3.26e-4, 0.5}));
  EXPECT_TRUE(has(error_with("wear oka 6e-11 1.18 0.727 2.05 2.31 0.19 104 3.26e-4"), "least"));
  EXPECT_TRUE(has(error_with("wear finnie nan"), "K"));
}

TEST(settings, a_mesh_wears_by_a_factor_of_its_own)
{
  const WallSpec s = with("wear_factor 0.25 mesh b.stl wear_factor 0 mesh c.stl wear finnie 1");
  EXPECT_EQ(s.meshes[0].wear_factor, 0.25);
  EXPECT_EQ(s.meshes[1].wear_factor, 0);
  EXPECT_EQ(s.meshes[2].wear_factor, 1);
  EXPECT_TRUE(has(error_with("wear_factor -1 wear finnie 1"), "F = -1"));
  EXPECT_TRUE(
      has(error_with("wear_factor 2"), "in 'wear_factor', a factor is given, but nothing wears"));
}

TEST(settings, mesh_fields_need_a_vtp_file_and_a_number_of_steps)
{
  const WallSpec s = with("mesh_fields wall_*.vtp every 500");
  EXPECT_EQ(s.meshes[0].fields.name, "wall_*.vtp");
  EXPECT_EQ(s.meshes[0].fields.every, 500);
  EXPECT_TRUE(s.has_loads());
  EXPECT_TRUE(has(error_with("mesh_fields wall.vtk every 500"), ".vtp"));
  EXPECT_TRUE(has(error_with("mesh_fields wall.vtp 500"), "every"));
  EXPECT_TRUE(has(error_with("mesh_fields wall.vtp every 0"), "N"));
  EXPECT_TRUE(has(error_with("mesh_fields wall.vtp every 1.5"), "whole"));
  EXPECT_TRUE(has(error_with("mesh_fields"), "file name"));
  EXPECT_TRUE(has(error_with("mesh_fields a_*/wall.vtp every 5"), "folder"));
  EXPECT_TRUE(has(error_with("mesh_fields a_*_*.vtp every 5"), "only one is the step"));
}

TEST(run_files, are_one_however_the_folder_is_spelled)
{
  EXPECT_TRUE(are_one_file({"mesh", "a.stl"}, {"mesh_stl", "./no/../a.stl", 5, true}, 0));
  EXPECT_FALSE(are_one_file({"mesh", "a.stl"}, {"mesh_stl", "no/a.stl", 5, true}, 0));
}

// A run that goes on from step 100 with the mesh of that step does not write it again.
TEST(run_files, a_series_is_a_file_that_it_will_write)
{
  const RunFile series = {"mesh_stl", "a_*.stl", 50, true};
  EXPECT_TRUE(are_one_file(series, {"mesh", "a_100.stl"}, 0));
  EXPECT_TRUE(are_one_file({"mesh", "a_100.stl"}, series, 99));
  EXPECT_FALSE(are_one_file(series, {"mesh", "a_100.stl"}, 100));
  EXPECT_FALSE(are_one_file(series, {"mesh", "a_101.stl"}, 0));
  EXPECT_FALSE(are_one_file(series, {"mesh", "a_0100.stl"}, 0));
  EXPECT_FALSE(are_one_file(series, {"mesh", "a_.stl"}, 0));
  EXPECT_FALSE(are_one_file(series, {"mesh", "a.stl"}, 0));
}

TEST(settings, mesh_stl_needs_an_stl_file_and_a_number_of_steps)
{
  const WallSpec s = with("mesh_stl wall_*.stl every 500");
  EXPECT_EQ(s.meshes[0].stl.name, "wall_*.stl");
  EXPECT_EQ(s.meshes[0].stl.every, 500);
  EXPECT_FALSE(s.has_loads());
  EXPECT_TRUE(has(error_with("mesh_stl wall.vtp every 500"), ".stl"));
  EXPECT_TRUE(has(error_with("mesh_stl wall.stl every 0"), "N"));
}

TEST(settings, torque_is_about_a_point_of_the_box_or_of_the_mesh)
{
  EXPECT_EQ(with("").meshes[0].torque_about, (Vec3{0, 0, 0}));
  const WallSpec box = with("torque_about 1 2 3");
  EXPECT_FALSE(box.meshes[0].torque_about_mesh);
  EXPECT_EQ(box.meshes[0].torque_about, (Vec3{1, 2, 3}));
  const WallSpec mesh = with("torque_about mesh contacts");
  EXPECT_TRUE(mesh.meshes[0].torque_about_mesh && mesh.contacts);
  EXPECT_EQ(mesh.meshes[0].torque_about, (Vec3{0, 0, 0}));
  EXPECT_EQ(with("torque_about mesh 4 5 6").meshes[0].torque_about, (Vec3{4, 5, 6}));
  EXPECT_TRUE(has(error_with("torque_about"), "x"));
  EXPECT_TRUE(has(error_with("torque_about 1 2"), "z"));
  EXPECT_TRUE(has(error_with("torque_about axis"), "axis"));
}

TEST(settings, rolling_and_cohesion_go_with_classic_styles)
{
  const WallSpec s = with("rolling epsd2 0.05 cohesion sjkr 3e5");
  EXPECT_EQ(s.law().rolling.model, RollingModel::epsd2);
  EXPECT_EQ(s.law().rolling.numbers[0], 0.05);
  EXPECT_EQ(s.law().cohesion.numbers[0], 3e5);
  EXPECT_EQ(with("rolling cdt 0.1").law().rolling.model, RollingModel::cdt);
  EXPECT_FALSE(with("").law().is_extended());
  EXPECT_FALSE(with("cohesion sjkr 0").law().is_extended());
  EXPECT_EQ(with("rolling sds 1 2 3").law().rolling.model, RollingModel::sds);
  EXPECT_EQ(with("rolling epsd3 1 2 3").law().rolling.numbers[2], 3);
  EXPECT_TRUE(has(error_with("rolling none"), "epsd2"));
  EXPECT_TRUE(has(error_with("rolling cdt"), "MU"));
  EXPECT_TRUE(has(error_with("rolling cdt -0.1"), "MU"));
  EXPECT_TRUE(has(error_with("cohesion sjkr -1"), "K"));
  EXPECT_TRUE(has(error_with("cohesion jkr 1"), "sjkr"));
}

// ---- granular ------------------------------------------------------------------------

template <class Model>
Real sum(const Chosen<Model> &chosen)
{
  return std::accumulate(std::begin(chosen.numbers), std::end(chosen.numbers), Real(0));
}

ContactLaw law_of(const std::string &tokens)
{
  return parse("granular " + tokens + " mesh a.stl").law();
}

std::string granular_error(const std::string &tokens)
{
  return error_of("granular " + tokens + " mesh a.stl");
}

const std::string kSlip = " tangential linear_nohistory 0 0";

TEST(settings, granular_reads_every_normal_sub_model)
{
  EXPECT_EQ(law_of("hooke 7e4 3" + kSlip).normal, NormalModel::hooke);
  EXPECT_EQ(law_of("hooke 7e4 3" + kSlip).k_normal, 7e4);
  EXPECT_EQ(law_of("hertz 7e4 3" + kSlip).normal, NormalModel::hertz);
  EXPECT_EQ(law_of("hertz 7e4 3" + kSlip).damping, DampingModel::viscoelastic);
  EXPECT_EQ(law_of("hertz 7e4 3" + kSlip + " damping none").damping, DampingModel::none);
  EXPECT_EQ(law_of("dmt 7e4 3 0.3 2" + kSlip).normal, NormalModel::dmt);
  EXPECT_EQ(law_of("jkr 7e4 3 0.3 2" + kSlip).normal, NormalModel::jkr);
  EXPECT_EQ(law_of("jkr 7e4 3 0.3 2" + kSlip).surface_energy, 2);
}

TEST(settings, rolling_and_cohesion_of_liggghts_go_with_granular)
{
  const ContactLaw g =
      law_of("hertz 7e4 3 tangential mindlin 1 1 1 rolling epsd 0.1 0.2 cohesion sjkr 5");
  EXPECT_EQ(g.rolling.model, RollingModel::epsd);
  EXPECT_EQ(g.rolling.numbers[1], 0.2);
  EXPECT_EQ(g.cohesion.numbers[0], 5);
  EXPECT_TRUE(g.is_extended());
  EXPECT_FALSE(law_of("hertz 7e4 3" + kSlip + " rolling cdt 0.1").has_history());
  EXPECT_FALSE(law_of("hertz 7e4 3" + kSlip + " cohesion sjkr 0").cohesion.is_on());
  EXPECT_FALSE(law_of("hertz 7e4 3" + kSlip + " rolling sds 1 2 3").is_extended());
}

// The dashpots of LIGGGHTS damp by the root of their stiffnesses, 2 E* along the normal and 8 G* across it.
TEST(settings, granular_xgammat_null_is_that_of_liggghts)
{
  const ContactLaw g =
      law_of("hertz/material 1e5 0.5 0.25 damping tsuji tangential mindlin_liggghts NULL NULL 0.5");
  const Real normal = 1e5 / (2 * (1 - 0.25 * 0.25)), shear = 1e5 / (4 * 1.75 * 1.25);
  EXPECT_NEAR(g.xgammat, std::sqrt(8 * shear / (2 * normal)), 1e-14);
  EXPECT_NEAR(g.k_tangent, 8 * shear, 1e-9);
}

TEST(settings, granular_none_turns_nothing_on)
{
  const ContactLaw g = law_of("hooke 1e5 3" + kSlip + " rolling none twisting none heat none");
  EXPECT_FALSE(g.rolling.is_on() || g.twisting.is_on() || g.has_heat() || g.has_history());
}

TEST(settings, granular_takes_the_modulus_of_a_sphere_and_a_wall_of_one_material)
{
  // LAMMPS's manual: 960/(2 (1 - 0.2^2)) = 500.
  const ContactLaw g = law_of("hertz/material 960 3 0.2" + kSlip);
  EXPECT_NEAR(g.modulus, 500, 1e-12);
  EXPECT_NEAR(g.k_normal, 2000.0 / 3, 1e-12);
}

TEST(settings, granular_kt_null_is_eight_times_the_shear_modulus_of_the_contact)
{
  const ContactLaw g = law_of("hertz/material 1e5 3 0.25 tangential mindlin NULL 1 0.5");
  EXPECT_NEAR(g.k_tangent, 8e5 / (4 * 1.75 * 1.25), 1e-9);
  EXPECT_TRUE(has(granular_error("hertz 1e5 3 tangential mindlin NULL 1 0.5"), "E and nu"));
}

TEST(settings, granular_takes_a_restitution_for_tsuji_and_coeff_restitution)
{
  for (const char *model : {"tsuji", "coeff_restitution"}) {
    const std::string damping = std::string(" damping ") + model;
    EXPECT_GT(law_of("hertz 1e5 0.5" + kSlip + damping).eta, 0);
    EXPECT_TRUE(has(granular_error("hertz 1e5 1.2" + kSlip + damping), "e = 1.2 is out of range"));
    EXPECT_TRUE(has(granular_error("hertz 1e5 1.2" + kSlip + damping), "0 < e <= 1"));
    EXPECT_TRUE(has(granular_error("jkr 1e5 0.5 0.3 2" + kSlip + damping), "adhesive"));
  }
  EXPECT_TRUE(has(granular_error("hertz 1e5 0" + kSlip + " damping coeff_restitution"), "e = 0"));
}

TEST(settings, granular_words_come_in_any_order_and_end_at_the_first_keyword)
{
  const WallSpec s =
      parse("granular hertz 1e5 3 limit_damping twisting sds 1 2 3 rolling sds 4 5 6 heat area 7 "
            "tangential mindlin_rescale/force 8 9 10 damping velocity temperature 300 mesh a.stl");
  const ContactLaw &g = s.law();
  EXPECT_TRUE(s.law().limit_damping);
  EXPECT_EQ(sum(g.twisting), 6);
  EXPECT_EQ(sum(g.rolling), 15);
  EXPECT_EQ(sum(g.heat), 7);
  EXPECT_EQ(g.k_tangent + g.xgammat + g.mu, 27);
  EXPECT_EQ(s.meshes[0].temperature, 300);
  EXPECT_EQ(s.law().n_extra(), 5);
  EXPECT_TRUE(has(s.laws[0].name, "granular hertz 1e5 3 limit_damping twisting"));
  EXPECT_FALSE(has(s.laws[0].name, "temperature"));
}

TEST(settings, granular_errors_name_the_word_and_show_the_syntax)
{
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "sub-model"},
      {"hook 1e5 3" + kSlip, "'hook' is not a sub-model"},
      {"hook 1e5 3" + kSlip, "hooke|hertz|hertz/material|dmt|jkr"},
      {"hertz -1e5 3" + kSlip, "kn = -1e5 is out of range"},
      {"hertz nan 3" + kSlip, "kn must be a number, not 'nan'"},
      {"hertz 1e5 -3" + kSlip, "eta|e = -3 is out of range"},
      {"hertz 1e5" + kSlip, "eta|e must be a number, not 'tangential'"},
      {"hertz/material 0 3 0.3" + kSlip, "E = 0 is out of range"},
      {"hertz/material 1e5 3 0.6" + kSlip, "nu = 0.6 is out of range"},
      {"hertz/material 1e5 3 -1" + kSlip, "nu = -1 is out of range"},
      {"jkr 1e5 3 0.3 -2" + kSlip, "gamma = -2 is out of range"},
      {"hertz 1e5 3", "the tangential sub-model is missing"},
      {"hertz 1e5 3 tangential", "'mesh' is not a sub-model"},
      {"hertz 1e5 3 tangential mindlinn 1 1 1", "mindlin_rescale/force"},
      {"hertz 1e5 3 tangential linear_history 1 1", "mu must be a number, not 'mesh'"},
      {"hertz 1e5 3 tangential linear_history 1 1", "tangential linear_history kt xgammat mu"},
      {"hertz 1e5 3 tangential linear_history NULL 1 1", "kt must be a number"},
      {"hertz 1e5 3" + kSlip + kSlip, "given twice"},
      {"hertz 1e5 3" + kSlip + " rolling sds 1 2", "rolling sds k gamma mu"},
      {"hertz 1e5 3" + kSlip + " rolling sds 1 -2 3", "gamma = -2 is out of range"},
      {"hertz 1e5 3" + kSlip + " twisting sds 1 2 inf", "mu must be a number"},
      {"hertz 1e5 3" + kSlip + " damping mdr 1", "none|velocity|mass_velocity|viscoelastic"},
      {"hertz 1e5 3" + kSlip + " heat area -1 temperature 3", "h = -1 is out of range"},
      {"hertz 1e5 3" + kSlip + " heat area 1", "in 'temperature', the temperature is missing"},
      {"hertz 1e5 3" + kSlip + " temperature 1", "no sub-model heat uses it"},
      {"hertz 1e5 3" + kSlip + " heat area 1 temperature v_", "the variable's name is missing"},
      {"hertz 1e5 3" + kSlip + " heat area 1 temperature hot", "T must be a number, not 'hot'"},
      {"dmt 1e5 3 0.3 2 limit_damping" + kSlip, "must be able to pull"},
      {"hertz 1e5 3" + kSlip + " rolling epsd2 0.1",
       "in 'granular rolling', epsd2 has the stiffness"},
      {"hertz 1e5 3" + kSlip + " rolling epsd 0.1", "rolling epsd MU damping"},
      {"hertz 1e5 3" + kSlip + " mesh a.stl rolling cdt 0.1", "it comes before mesh"},
      {"hertz 1e5 3" + kSlip + " roling sds 1 2 3", "the nearest is 'rolling'"},
  };
  for (const auto &[tokens, told] : cases)
    EXPECT_TRUE(has(granular_error(tokens), told)) << tokens << ": " << granular_error(tokens);
}

}    // namespace
}    // namespace lsdcd::test_settings
