// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// `material` in a script's words gives the laws of the numbers that could have stood there.
#include "base/input_error.h"
#include "input/wall_command.h"
#include "support/says.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lsdcd::test_material_words {
namespace {

const char *const kFile = "units si\n"
                          "material glass\n"
                          "  youngs_modulus 69e9 Pa # book one\n"
                          "  poissons_ratio 0.23 1\n"
                          "  surface_energy 0.02 J/m2\n"
                          "  thermal_conductivity 1.7 W/m/K\n"
                          "material steel\n"
                          "  youngs_modulus 207e9 Pa # book two\n"
                          "  poissons_ratio 0.3 1\n"
                          "  surface_energy 0.08 J/m2\n"
                          "  thermal_conductivity 51 W/m/K\n"
                          "  yield_strength 250e6 Pa\n"
                          "  yield_pressure 1.6e9 Pa\n"
                          "  contact_angle 70 deg\n"
                          "material sand\n"
                          "  youngs_modulus 69e9 Pa\n"
                          "  poissons_ratio 0.23 1\n"
                          "  yield_strength 40e6 Pa\n"
                          "  yield_pressure 5e9 Pa\n"
                          "  contact_angle 0 deg\n"
                          "material bare\n"
                          "pair glass glass\n"
                          "  restitution 0.97 1 # measured\n"
                          "  sliding_friction 0.092 1\n"
                          "  rolling_friction 0.01 1\n"
                          "  rolling_damping 0.3 1\n"
                          "  cohesion_energy_density 5e4 J/m3\n"
                          "pair glass steel\n"
                          "  restitution 0.9 1\n"
                          "  sliding_friction 0.2 1\n"
                          "pair sand steel\n"
                          "  restitution 0.4 1\n"
                          "  sliding_friction 0.5 1\n"
                          "  surface_tension 0.072 N/m\n"
                          "  bridge_volume 1e-12 m3\n"
                          "  bridge_volume_share 0.001 1\n"
                          "  adhesive_force 2e-3 N\n"
                          "  adhesive_force_fraction 0.4 1\n"
                          "  adhesive_stiffness 20 N/m\n"
                          "  adhesive_distance 1e-4 m\n";

struct MaterialWordsTest : ::testing::Test {
  TempDir folder;
  std::string file = folder.write("m.lsdcd", kFile);
  MaterialsRead read;

  // FILE stands for the file above. A line without a mesh gets one.
  WallSpec wall(const std::string &line, const std::string &units = "si")
  {
    std::vector<std::string> tokens = words(line);
    std::replace(tokens.begin(), tokens.end(), std::string("FILE"), file);
    read = {};
    return parse_wall(tokens,
                      [&](const WallMaterials &materials, const std::vector<MaterialPair> &pairs) {
                        return read_laws(materials, pairs, units, read);
                      })
        .wall;
  }
  // The words of the wall's law, with numbers.
  std::string filled(const std::string &line, const std::string &units = "si")
  {
    const bool has_mesh = line.find(" mesh ") != line.npos;
    return wall(line + (has_mesh ? "" : " mesh a.stl"), units).laws.front().name;
  }
  std::vector<std::string> fill(const std::string &line, const std::string &units = "si")
  {
    return words(filled(line, units));
  }
  std::string error_of(const std::string &line, const std::string &units = "si")
  {
    return lsdcd::error_of([&] { wall(line, units); });
  }
};

using material_words = MaterialWordsTest;

TEST_F(material_words, are_a_whole_granular_style)
{
  const std::string glass = "granular hertz/material 6.9e+10 0.97 0.23 ",
                    restitution = "damping coeff_restitution ",
                    mindlin = "tangential mindlin NULL 1 ";
  const std::pair<const char *, std::string> rows[] = {
      {"glass mesh a.stl scale 2", glass + restitution + mindlin + "0.092"},
      {"glass damping tsuji mesh a.stl", glass + mindlin + "0.092 damping tsuji"},
      {"glass tangential linear_history 1e5 0.5 0.3 mesh a",
       glass + restitution + "tangential linear_history 1e+05 0.5 0.3"},
      {"bare with youngs_modulus 1 poissons_ratio 0.1 restitution 1 sliding_friction 2 mesh a",
       "granular hertz/material 1 1 0.1 " + restitution + mindlin + "2"}};
  for (const auto &[words, style] : rows)
    EXPECT_EQ(filled(std::string("granular material FILE ") + words), style);
  EXPECT_EQ(fill("granular material FILE glass damping none mesh a.stl")[3], "0");
}

// The law of each pair alone, and that of numbers in its place.
TEST_F(material_words, of_meshes_and_types_become_laws)
{
  const auto law = [&](const std::string &pair) {
    return filled("granular material FILE " + pair + " mesh a.stl");
  };
  const auto rows = [](const WallSpec &wall, std::size_t mesh) {
    std::vector<std::string> all;
    for (const LawOfTypes &row : wall.meshes[mesh].laws)
      all.push_back(std::to_string(row.first_type) + " " + row.name);
    return all;
  };
  using Rows = std::vector<std::string>;
  const std::string steel = law("glass on steel"), glass = law("glass"),
                    more = " with sliding_friction 0.7";
  const WallSpec meshes =
      wall("granular material FILE glass mesh a.stl scale 2 material steel mesh b.stl corner sum");
  EXPECT_EQ(meshes.laws.front().name, glass);
  EXPECT_EQ(rows(meshes, 0), Rows({"0 " + steel}));
  EXPECT_EQ(rows(meshes, 1), Rows());
  const WallSpec types =
      wall("granular material FILE glass types 2* steel mesh a.stl material glass" + more +
           " torque_about mesh law types 3 " + glass + " mesh b.stl law " + glass);
  EXPECT_EQ(rows(types, 0),
            Rows({"0 " + law("glass" + more), "2 " + law("steel on glass" + more), "3 " + glass}));
  EXPECT_EQ(rows(types, 1), Rows({"0 " + glass, "2 " + law("steel on glass")}));
  const WallSpec by_numbers = wall(glass + " mesh a.stl");
  EXPECT_EQ(by_numbers.law().k_normal, meshes.law().k_normal);
  EXPECT_EQ(by_numbers.law().eta, meshes.law().eta);
  EXPECT_EQ(by_numbers.law().k_tangent, meshes.law().k_tangent);
  EXPECT_EQ(by_numbers.law().mu, meshes.law().mu);
}

// What is given of a wall is given of the pairs that have it, and a mesh may have it otherwise.
TEST_F(material_words, with_numbers_of_a_wall_hold_where_they_mean_something)
{
  const auto law = [&](const std::string &pair) {
    return filled("granular material FILE " + pair + " mesh a.stl");
  };
  const std::string stiff = "glass on steel with steel youngs_modulus 1e9 restitution 0.5",
                    two = "granular material FILE " + stiff + " mesh a.stl mesh b.stl material ";
  const WallSpec some = wall(two + "glass"), other = wall(two + "steel with restitution 0.6");
  EXPECT_EQ(some.laws.front().name, law(stiff));
  EXPECT_EQ(some.meshes[1].laws.front().name, law("glass with restitution 0.5"));
  EXPECT_EQ(other.laws.front().name, law(stiff));
  EXPECT_EQ(other.meshes[1].laws.front().name,
            law("glass on steel with steel youngs_modulus 1e9 restitution 0.6"));
  EXPECT_TRUE(says(error_of(two + "glass with steel youngs_modulus 2e9"),
                   {"'with steel youngs_modulus' changes nothing"}));
}

// Steel on steel is not in the file.
TEST_F(material_words, ask_for_no_pair_that_does_not_meet)
{
  EXPECT_EQ(error_of("granular material FILE steel mesh a.stl material glass"), "");
}

TEST_F(material_words, may_name_the_normal_model)
{
  EXPECT_EQ(filled("granular hertz/material material FILE glass mesh a.stl"),
            filled("granular material FILE glass mesh a.stl"));
}

TEST_F(material_words, are_in_the_units_of_the_script)
{
  const std::vector<std::string> tokens = fill("granular jkr material FILE glass mesh a", "cgs");
  EXPECT_EQ(std::stod(tokens[2]), 69e10);
  EXPECT_EQ(tokens[4], "0.23");
  EXPECT_EQ(std::stod(tokens[5]), 20);
  EXPECT_EQ(std::stod(fill("granular material FILE glass mesh a", "micro")[2]), 69e6);
}

TEST_F(material_words, of_units_without_a_scale_are_refused)
{
  EXPECT_TRUE(says(error_of("granular material FILE glass mesh a", "lj"), {"units lj", "cgs"}));
  EXPECT_TRUE(says(error_of("granular material FILE glass mesh a", "metal"), {"units metal"}));
}

// LAMMPS takes E/(2(1-nu^2)) for a wall: of two materials it must come out as
// 1/((1-0.0529)/69e9 + (1-0.09)/207e9) = 5.51808706e10.
TEST_F(material_words, of_two_materials_give_their_effective_modulus)
{
  const std::vector<std::string> tokens = fill("granular material FILE glass on steel mesh a");
  const double e = std::stod(tokens[2]), nu = std::stod(tokens[4]);
  EXPECT_NEAR(e / (2 * (1 - nu * nu)), 5.51808706e10, 1e3);
  EXPECT_EQ(tokens[3], "0.9");
  EXPECT_TRUE(says(filled("granular material FILE glass on steel mesh a"), {"NULL 1 0.2"}));
}

TEST_F(material_words, give_the_geometric_mean_of_surface_energies)
{
  const std::vector<std::string> tokens = fill("granular dmt material FILE glass on steel mesh a");
  EXPECT_NEAR(std::stod(tokens[5]), 0.04, 1e-16);
}

TEST_F(material_words, of_adhesive_models_have_no_damping_by_default)
{
  EXPECT_EQ(filled("granular jkr material FILE glass mesh a.stl"),
            "granular jkr 6.9e+10 0 0.23 0.02 damping none tangential mindlin NULL 1 0.092");
  EXPECT_TRUE(says(read.report, {"no damping"}));
}

TEST_F(material_words, with_a_damping_of_another_kind_need_its_number)
{
  EXPECT_TRUE(says(error_of("granular jkr material FILE glass damping tsuji mesh a"),
                   {"'damping tsuji' with jkr", "with eta VALUE"}));
  EXPECT_EQ(fill("granular jkr material FILE glass with eta 3 damping velocity mesh a")[3], "3");
}

TEST_F(material_words, fill_the_nulls_that_are_of_the_materials)
{
  EXPECT_TRUE(says(filled("granular material FILE glass tangential linear_nohistory 1 NULL mesh a"),
                   {"linear_nohistory 1 0.092"}));
  EXPECT_TRUE(
      says(filled("granular material FILE glass limit_damping rolling sds 1e3 2 NULL "
                  "tangential mindlin/force NULL 1 NULL mesh a"),
           {"rolling sds 1000 2 0.01 tangential mindlin/force NULL 1 0.092 limit_damping"}));
}

// 5e4 J/m3 are 5e5 erg/cm3.
TEST_F(material_words, fill_the_sub_models_of_liggghts)
{
  const std::string law =
      "granular material FILE glass tangential mindlin_liggghts NULL NULL NULL ";
  EXPECT_TRUE(says(filled(law + "rolling epsd NULL NULL cohesion sjkr NULL mesh a", "cgs"),
                   {"tangential mindlin_liggghts NULL NULL 0.092 rolling epsd 0.01 0.3",
                    "cohesion sjkr 5e+05"}));
  EXPECT_TRUE(says(filled(law + "rolling cdt NULL mesh a"), {"rolling cdt 0.01"}));
}

// 2/(1/1.7 + 1/51) = 3.29032258
TEST_F(material_words, give_the_harmonic_mean_of_conductivities)
{
  const auto tokens =
      fill("granular material FILE glass on steel heat radius NULL mesh a temperature 1", "cgs");
  const auto heat = std::find(tokens.begin(), tokens.end(), "heat");
  ASSERT_NE(heat, tokens.end());
  EXPECT_NEAR(std::stod(heat[2]), 3.29032258e5, 1e-2);
}

// The softer material yields. Without E in the normal sub-model the stiffness of friction is 8 G*.
TEST_F(material_words, give_the_numbers_of_contacts_that_yield)
{
  const Real shear = 1 / (2 * (2 - 0.23) * 1.23 / 69e9 + 2 * (2 - 0.3) * 1.3 / 207e9);
  const std::vector<std::string> edem =
      fill("granular hysteretic/edem material FILE sand on steel");
  EXPECT_EQ(std::vector<std::string>(edem.begin(), edem.begin() + 8),
            words("granular hysteretic/edem 4e+07 0.4 damping none tangential mindlin"));
  EXPECT_NEAR(std::stod(edem.at(8)), 8 * shear, 1e-12 * shear);
  EXPECT_EQ(edem.at(9), "0");
  const std::vector<std::string> thornton = fill("granular thornton material FILE sand on steel");
  EXPECT_EQ(thornton.at(1), "thornton");
  EXPECT_EQ(thornton.at(5), "1.6e+09");
  EXPECT_EQ(std::vector<std::string>(thornton.begin() + 6, thornton.end()),
            words("damping none tangential mindlin NULL 1 0.5"));
  EXPECT_TRUE(
      says(error_of("granular eepa material FILE sand"),
           {"'eepa' does not take material constants", "calibrated for grains of one size"}));
}

// NULL for the angle of the wall is that of the particle where the script gives this one.
TEST_F(material_words, fill_the_numbers_of_cohesion_across_a_gap)
{
  const auto cohesion = [&](const std::string &numbers, const std::string &units = "si") {
    const std::string name =
        filled("granular material FILE sand on steel cohesion " + numbers, units);
    return name.substr(name.find("cohesion"));
  };
  EXPECT_EQ(cohesion("capillary NULL NULL NULL NULL"), "cohesion capillary 0.072 0 70 1e-12");
  EXPECT_EQ(cohesion("capillary 0.05 20 NULL 2e-12"), "cohesion capillary 0.05 20 NULL 2e-12");
  EXPECT_EQ(cohesion("capillary/share NULL NULL 30 NULL"),
            "cohesion capillary/share 0.072 0 30 0.001");
  EXPECT_EQ(cohesion("constant NULL NULL"), "cohesion constant 0.002 1e-04");
  EXPECT_EQ(cohesion("constant/weight NULL 9.81 NULL"), "cohesion constant/weight 0.4 9.81 1e-04");
  EXPECT_EQ(cohesion("linear NULL NULL"), "cohesion linear 20 1e-04");
  // dyn/cm, cm3
  EXPECT_EQ(cohesion("capillary NULL NULL NULL NULL", "cgs"), "cohesion capillary 72 0 70 1e-06");
}

TEST_F(material_words, leave_the_words_of_the_fix_alone)
{
  const MeshSpec mesh = wall("granular material FILE glass mesh rolling cache sds").meshes[0];
  EXPECT_EQ(mesh.file, "rolling");
  EXPECT_EQ(mesh.cache_file, "sds");
  EXPECT_EQ(wall("granular material FILE glass mesh material cache material").meshes[0].cache_file,
            "material");
}

TEST_F(material_words, with_overrides_take_the_numbers_of_the_script_as_they_are)
{
  EXPECT_EQ(filled("granular material FILE glass with youngs_modulus 5e7 restitution 0.5 "
                   "sliding_friction 0.1 mesh a",
                   "cgs"),
            "granular hertz/material 5e+07 0.5 0.23 damping coeff_restitution "
            "tangential mindlin NULL 1 0.1");
  EXPECT_TRUE(says(read.report, {"youngs_modulus 5e+07, as the input script says"}));
}

TEST_F(material_words, with_a_misspelt_property_name_it_and_the_nearest)
{
  const std::vector<std::string> said = {"'restituion' is not a property", "'restitution'"};
  EXPECT_TRUE(says(error_of("granular material FILE glass with restituion 1 mesh a"), said));
  EXPECT_TRUE(says(error_of("granular material FILE glass with eta 1 restituion 1 mesh a"), said));
  EXPECT_TRUE(says(error_of("granular material FILE glass on steel with steel youngs_modulu 1"),
                   {"'youngs_modulu' is not a property", "'youngs_modulus'"}));
}

TEST_F(material_words, with_a_misspelt_keyword_leave_it_to_the_keywords)
{
  for (const char *with : {"", "with restitution 1 "})
    EXPECT_TRUE(
        says(error_of("granular material FILE glass " + std::string(with) + "rmaxx 1 mesh a"),
             {"'rmaxx' is not a keyword", "'rmax R"}));
}

TEST_F(material_words, are_called_what_the_caller_calls_them)
{
  MaterialPair pair;
  pair.file = file;
  pair.particle = pair.wall = "steel";
  EXPECT_TRUE(fails_with("'--with restitution VALUE'", [&] {
    law_of_materials(pair, "si", {"--on", "--with", "TOOL", "as given"});
  }));
}

// The wall's numbers given, where the file has none: as with a file that has them.
TEST_F(material_words, with_overrides_give_the_partner_what_the_file_does_not_know)
{
  const std::string contact = " restitution 0.9 sliding_friction 0.2 mesh a",
                    by_file = filled("granular material FILE glass on steel mesh a", "cgs");
  EXPECT_EQ(filled("granular material FILE glass on bare with youngs_modulus 207e10 "
                   "poissons_ratio 0.3" +
                       contact,
                   "cgs"),
            by_file);
  EXPECT_EQ(filled("granular material FILE bare on glass with bare youngs_modulus 207e10 bare "
                   "poissons_ratio 0.3" +
                       contact,
                   "cgs"),
            by_file);
}

TEST_F(material_words, with_overrides_may_name_whose_number_they_replace)
{
  const std::vector<std::string> tokens =
      fill("granular jkr material FILE glass on steel with steel surface_energy 0.32 mesh a");
  EXPECT_NEAR(std::stod(tokens[5]), 0.08, 1e-17);    // sqrt(0.02 0.32)
  EXPECT_TRUE(says(read.report,
                   {"steel: surface_energy 0.32, as the input script says", "glass: surface_energy "
                                                                            "0.02 (0.02 J/m2"}));
}

TEST_F(material_words, of_29sep2021_have_the_damping_that_it_knows)
{
  MaterialPair pair;
  pair.file = file;
  pair.particle = pair.wall = "glass";
  const auto text = [&] {
    return text_of(sub_models_of_29sep2021(law_of_materials(pair, "si", kScriptWords).sub_models));
  };
  EXPECT_EQ(text(),
            "hertz/material 6.9e+10 0.95676 0.23 damping tsuji tangential mindlin NULL 1 0.092");
  pair.normal = "jkr";
  EXPECT_EQ(text(), "jkr 6.9e+10 0 0.23 0.02 damping velocity tangential mindlin NULL 1 0.092");
}

TEST_F(material_words, that_are_missing_are_asked_for)
{
  EXPECT_TRUE(says(error_of("granular material"), {"file name", "Syntax: granular"}));
  EXPECT_TRUE(says(error_of("granular material FILE"), {"material's name", "Syntax: granular"}));
  for (const std::string before :
       {"", "glass types 2 ", "glass on ", "glass types 2 steel 3 ", "glass mesh a.stl material "})
    for (const std::string word : {"mesh b.stl", "types 1 glass mesh b.stl", "on steel mesh b.stl"})
      EXPECT_TRUE(
          says(error_of("granular material FILE " + before + word),
               {"is missing: the word '" + word.substr(0, word.find(' ')) + "' was found instead"}))
          << before << word;
}

TEST_F(material_words, in_another_order_are_told_the_right_one)
{
  for (const std::string words :
       {"on steel types 2 steel", "with restitution 1 types 2 steel", "with restitution 1 on steel",
        "damping tsuji with restitution 1"}) {
    const std::string late = words.find("types") != words.npos      ? "types"
                             : words.find("on steel") != words.npos ? "on"
                                                                    : "with";
    EXPECT_TRUE(says(error_of("granular material FILE glass " + words + " mesh a.stl"),
                     {"'" + late + "' must come earlier: the order is PARTICLE, types, on, with"}))
        << words;
  }
}

TEST_F(material_words, of_a_law_are_refused)
{
  const std::string wall = "granular material FILE glass mesh a.stl ";
  for (const char *law :
       {"law material FILE steel", "law granular material FILE steel",
        "law hooke material FILE steel", "law granular jkr material FILE steel",
        "law types 2 material FILE steel", "law types 2 granular material FILE steel",
        "law types 2 granular jkr material FILE steel"})
    EXPECT_TRUE(says(error_of(wall + law),
                     {"in 'law' of mesh 'a.stl', numbers are expected, not a material"}))
        << law;
}

TEST_F(material_words, and_a_law_of_one_mesh_are_refused)
{
  const std::string
      law = " law granular hertz/material 1 1 0.3 tangential mindlin NULL 1 0.5 damping tsuji",
      types = " law types 2 granular hertz/material 1 1 0.3 tangential mindlin NULL 1 0.5 damping "
              "tsuji";
  const std::string wall = "granular material FILE glass mesh a.stl";
  for (const std::string &words : {" material steel" + law, law + " material steel"})
    EXPECT_TRUE(says(error_of(wall + words), {"'a.stl' has 'material steel' and 'law'"})) << words;
  EXPECT_EQ(error_of(wall + " material steel mesh b.stl" + law), "");
  EXPECT_EQ(error_of(wall + " material steel" + types), "");
}

TEST_F(material_words, wrong_ones_are_told_what_is_right)
{
  const struct {
    const char *words;
    std::vector<std::string> told;
  } rows[] = {
      {"glass material steel mesh a.stl", {"after its mesh FILE"}},
      {"glass mesh a.stl material steel material glass", {"two materials"}},
      {"glass types steel mesh a.stl", {"2 coal"}},
      {"glass damping velocity mesh a", {"'damping velocity'", "with eta VALUE", "tsuji"}},
      {"glass with eta 3 mesh a", {"name it"}},
      {"glass with eta 0.3 damping tsuji mesh a", {"write 'with restitution VALUE'"}},
      {"glass with eta 0.3 damping none mesh a", {"'with eta' changes nothing"}},
      {"glass with rolling_friction 0.3 mesh a", {"'with rolling_friction' changes nothing"}},
      {"glass with surface_energy 0.5 mesh a", {"'with surface_energy' changes nothing"}},
      {"glass with sliding_friction 0.5 tangential mindlin NULL 1 0.1 mesh a",
       {"'with sliding_friction' changes nothing"}},
      {"glass with density 2 mesh a", {"density"}},
      {"glass with mesh a", {"'with' needs"}},
      {"glass with restitution 1.1 mesh a", {"restitution = 1.1", "out of range"}},
      {"glass with restitution high mesh a", {"restitution", "'high'"}},
      {"glass with eta 1 eta 2 damping tsuji mesh a", {"twice"}},
      {"glass on steel with youngs_modulus 1 mesh a",
       {"'youngs_modulus' of both", "with steel youngs_modulus VALUE"}},
      {"glass on steel with steel restitution 1 mesh a",
       {"'restitution' is not a property of steel alone"}},
      {"glass on steel with steel mesh a", {"after 'with steel' write a property"}},
      {"glass on bare mesh a", {"'bare' has no youngs_modulus", "with bare youngs_modulus VALUE"}},
      {"glass on", {"wall's material"}},
      {"glass on mesh floor.stl",
       {"after 'on' the wall's material is missing", "the word 'mesh' was found instead"}},
      {"gloss mesh a", {"'gloss'", "'glass'"}},
      {"glass on steal mesh a", {"'steal'", "'steel'"}},
      {"glass on copper mesh a", {"'copper'", "those are glass, steel, sand, bare"}},
      {"glass steel mesh a", {"'on steel'"}},
      {"steel mesh a",
       {"restitution of steel on steel", "with restitution VALUE", "pair steel steel"}},
      {"bare mesh a", {"line 21", "'bare' has no youngs_modulus", "with youngs_modulus VALUE"}},
      {"steel mesh a.stl material glass mesh b.stl", {"has no restitution of steel on steel"}},
      {"glass types 2 steel mesh a.stl material steel", {"has no restitution of steel on steel"}},
  };
  for (const auto &row : rows)
    EXPECT_TRUE(says(error_of(std::string("granular material FILE ") + row.words), row.told))
        << row.words;
  EXPECT_TRUE(says(error_of("granular jkr material FILE glass with restitution 0.5 mesh a"),
                   {"'with restitution' changes nothing"}));
}

// kn = 4/3 E*, kt = 8 G*: with E = 69e9, nu = 0.23, 4.856932e10 and 6.338707e10.
TEST_F(material_words, of_classic_styles_are_refused_with_what_can_be_said)
{
  const std::string error = error_of("hertz/history material FILE glass mesh a");
  EXPECT_TRUE(says(error, {"hertz/history", "granular material", "kn 4856931", "kt 6338707"}));
  EXPECT_TRUE(says(error_of("hooke material FILE glass mesh a"), {"hooke", "granular material"}));
  EXPECT_TRUE(says(error_of("granular hooke material FILE glass mesh a"), {"'hooke'", "jkr"}));
}

TEST_F(material_words, are_reported_with_unit_source_and_line)
{
  fill("granular material FILE glass on steel mesh a", "cgs");
  EXPECT_TRUE(
      says(read.report,
           {"units cgs", "glass: youngs_modulus 6.9e+11 (6.9e+10 Pa, m.lsdcd line 3): book one",
            "m.lsdcd line 8): book two", "glass: poissons_ratio 0.23 (m.lsdcd line 4)",
            "glass on steel: restitution 0.9", "no source"}));
}

}    // namespace
}    // namespace lsdcd::test_material_words
