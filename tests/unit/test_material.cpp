// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Material files: what is read, what is refused and how, and units.
#include "base/input_error.h"
#include "material/contact_moduli.h"
#include "material/material_file.h"
#include "material/material_units.h"
#include "support/says.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace lsdcd::test_material {
namespace {

const char *const kGood = "# beads\n"
                          "units si\n"
                          "\n"
                          "material glass\n"
                          "  youngs_modulus 69e9 Pa  # a book, table 2\n"
                          "  poissons_ratio 0.23 1\n"
                          "material steel  # the wall\n"
                          "  youngs_modulus 207e9 Pa # another\n"
                          "pair glass steel\n"
                          "  restitution 0.9 1 # measured\r\n";

struct MaterialFiles : ::testing::Test {
  TempDir folder;

  std::string write(const std::string &name, const std::string &text)
  {
    return folder.write(name, text);
  }
  MaterialFile read(const std::string &text) { return read_materials(write("m.lsdcd", text)); }
  std::string error_of(const std::string &text)
  {
    return lsdcd::error_of([&] { read(text); });
  }
  // The error of a file that is good up to one more line, the third.
  std::string error_with(const std::string &line)
  {
    return error_of("units si\nmaterial glass\n" + line + "\n");
  }
};

using material_file = MaterialFiles;

TEST_F(material_file, values_keep_their_source_and_line)
{
  const MaterialFile file = read(kGood);
  const Stated *e = file.material("glass").find("youngs_modulus");
  ASSERT_TRUE(e);
  EXPECT_EQ(e->value, 69e9);
  EXPECT_EQ(e->source, "a book, table 2");
  EXPECT_TRUE(says(e->place, {"m.lsdcd line 5"}));
  EXPECT_EQ(file.material("glass").find("poissons_ratio")->source, "");
  EXPECT_EQ(file.material("glass").find("density"), nullptr);
}

TEST_F(material_file, may_begin_with_a_byte_order_mark)
{
  EXPECT_EQ(read("\xEF\xBB\xBFunits si\nmaterial glass\n").materials.size(), 1u);
}

TEST_F(material_file, a_pair_is_found_in_either_order)
{
  const MaterialFile file = read(kGood);
  EXPECT_EQ(file.pair("steel", "glass"), file.pair("glass", "steel"));
  ASSERT_TRUE(file.pair("steel", "glass"));
  EXPECT_EQ(file.pair("steel", "glass")->find("restitution")->value, 0.9);
  EXPECT_EQ(file.pair("steel", "glass")->find("restitution")->source, "measured");
  EXPECT_EQ(file.pair("glass", "glass"), nullptr);
}

TEST_F(material_file, an_included_file_lies_beside_the_one_that_names_it)
{
  write("steel.lsdcd", "units si\nmaterial steel\nyoungs_modulus 2e11 Pa\n");
  const MaterialFile file =
      read("units si\ninclude steel.lsdcd\nmaterial glass\npair steel glass\nrestitution 1 1\n");
  EXPECT_EQ(file.material("steel").find("youngs_modulus")->value, 2e11);
  EXPECT_TRUE(file.pair("glass", "steel"));
}

TEST_F(material_file, files_may_include_one_another)
{
  write("other.lsdcd", "units si\ninclude m.lsdcd\nmaterial steel\n");
  EXPECT_EQ(read("units si\ninclude other.lsdcd\nmaterial glass\n").materials.size(), 2u);
}

TEST_F(material_file, what_is_wrong_is_named_with_its_file_and_line)
{
  write("steel.lsdcd", "units si\nmaterial steel\n");
  write("bad.lsdcd", "units si\nmaterial steel\nyoungs_modulus big Pa\n");
  const struct {
    const char *text;
    std::vector<std::string> told;
  } rows[] = {
      {"units si\ninclude stele.lsdcd\n", {"m.lsdcd line 2", "stele.lsdcd"}},
      {"units si\ninclude bad.lsdcd\n", {"bad.lsdcd line 3", "'big'"}},
      {"units si\nmaterial glass\ninclude steel.lsdcd\ndensity 1 kg/m3\n",
       {"line 4", "no material"}},
      {"material glass\n", {"line 1", "'material'", "units si"}},
      {"# text\nunits cgs\n", {"line 2", "'units cgs'", "units si"}},
      {"# nothing\n", {"m.lsdcd", "units si"}},
      {"units si\ndensity 1 kg/m3\n", {"line 2", "material NAME"}},
      {"units si\nmaterial a\nmaterial b\npair a b\npair b a\n", {"line 5", "line 4"}},
  };
  for (const auto &row : rows) EXPECT_TRUE(says(error_of(row.text), row.told)) << row.text;
}

TEST_F(material_file, a_wrong_line_is_named_with_the_remedy)
{
  const struct {
    const char *line;
    std::vector<std::string> told;
  } rows[] = {
      {"density heavy kg/m3", {"m.lsdcd line 3", "'heavy'", "density VALUE kg/m3"}},
      {"density 2,5 kg/m3", {"line 3", "'2,5'"}},
      {"density nan kg/m3", {"line 3", "'nan'"}},
      {"density inf kg/m3", {"line 3", "'inf'"}},
      {"youngs_modulus 69 GPa", {"line 3", "'GPa'", "VALUE Pa"}},
      {"youngs_modulus 69e9", {"line 3", "unit", "VALUE Pa"}},
      {"youngs_modulus 69e9 Pa more", {"line 3", "VALUE Pa"}},
      {"young_modulus 69e9 Pa", {"line 3", "'youngs_modulus'"}},
      {"youngs_modulus 0 Pa", {"line 3", "out of range"}},
      {"youngs_modulus -1 Pa", {"line 3", "out of range"}},
      {"poissons_ratio 0.51 1", {"line 3", "out of range"}},
      {"poissons_ratio -1 1", {"line 3", "out of range"}},
      {"density -2500 kg/m3", {"line 3", "out of range"}},
      {"surface_energy 0 J/m2", {"line 3", "out of range"}},
      {"restitution 0.9 1", {"line 3", "pair glass glass"}},
      {"density 1 kg/m3\ndensity 2 kg/m3", {"line 4", "line 3"}},
      {"material glass", {"line 3", "line 2"}},
      {"pair glass steel", {"line 3", "'steel'"}},
      {"material", {"line 3", "material NAME"}},
      {"pair glass", {"line 3", "pair NAME NAME"}},
      {"pair glass glass\nrestitution 1.01 1", {"line 4", "out of range"}},
      {"pair glass glass\nrestitution 0 1", {"line 4", "out of range"}},
      {"pair glass glass\nsliding_friction -0.1 1", {"line 4", "out of range"}},
      {"pair glass glass\ndensity 1 kg/m3", {"line 4", "material glass"}},
  };
  for (const auto &row : rows) EXPECT_TRUE(says(error_with(row.line), row.told)) << row.line;
}

TEST_F(material_file, an_unknown_material_names_the_nearest)
{
  EXPECT_TRUE(says(lsdcd::error_of([&] { read(kGood).material("galss"); }),
                   {"'galss'", "m.lsdcd", "'glass'"}));
}

TEST_F(material_file, a_cut_file_is_read_or_refused)
{
  const std::string text = kGood;
  for (std::size_t n = 0; n <= text.size(); n++) error_of(text.substr(0, n));
}

TEST_F(material_file, that_is_nowhere_tells_where_it_was_looked_for)
{
  setenv("LSDCD_POTENTIALS", "/nowhere", 1);
  EXPECT_TRUE(says(lsdcd::error_of([] { find_material_file("glas.lsdcd"); }),
                   {"glas.lsdcd", "LSDCD_POTENTIALS", "share/lsdcd/potentials", "glass.lsdcd"}));
  unsetenv("LSDCD_POTENTIALS");
}

Real convert(Real si, const char *property, const char *units)
{
  return in_units(si, *find_property(property), units);
}

// By hand: 1 Pa = 10 dyn/cm2 = 1e-3 pg/(um us2) = 1e-6 ag/(nm ns2), 1000 kg/m3 = 1 g/cm3 = 1 pg/um3 = 1e-3 ag/nm3,
// 1 J/m2 = 1000 erg/cm2 = 1000 pg/us2 = 1000 ag/ns2, 1 W/(m K) = 1e5 erg/(s cm K) = 1e3 pg um/(us3 K) = 1e3 ag nm/(ns3 K).
TEST(material_units, are_those_of_the_script)
{
  const struct {
    const char *property;
    Real si, cgs, micro, nano;
  } rows[] = {{"youngs_modulus", 69e9, 69e10, 69e6, 69e3},
              {"density", 2500, 2.5, 2.5, 2.5e-3},
              {"surface_energy", 0.025, 25, 25, 25},
              {"thermal_conductivity", 1.7, 1.7e5, 1.7e3, 1.7e3},
              {"poissons_ratio", 0.23, 0.23, 0.23, 0.23}};
  for (const auto &row : rows) {
    EXPECT_EQ(convert(row.si, row.property, "si"), row.si) << row.property;
    EXPECT_EQ(convert(row.si, row.property, "cgs"), row.cgs) << row.property;
    EXPECT_EQ(convert(row.si, row.property, "micro"), row.micro) << row.property;
    EXPECT_EQ(convert(row.si, row.property, "nano"), row.nano) << row.property;
  }
}

TEST(material_units, without_a_scale_are_refused)
{
  for (const std::string units : {"lj", "real", "metal", "electron", "parsec"})
    EXPECT_TRUE(says(error_of([&] { convert(1, "density", units.c_str()); }),
                     {"units " + units, "'cgs'", "'nano'"}));
}

// The modulus of fix wall/gran granular for one E and nu of a wall.
Real wall_youngs(const Elastic &m)
{
  return m.youngs_modulus / (2 * (1 - m.poissons_ratio * m.poissons_ratio));
}

Real wall_shear(const Elastic &m)
{
  return m.youngs_modulus / (4 * (2 - m.poissons_ratio) * (1 + m.poissons_ratio));
}

const Elastic kGlass = {69e9, 0.23}, kSteel = {207e9, 0.30};

// By hand: (1 - 0.0529)/69e9 + (1 - 0.09)/207e9 = 1.8122222e-11, and
// 2 1.77 1.23/69e9 + 2 1.7 1.3/207e9 = 8.4457005e-11.
TEST(contact_moduli, of_glass_on_steel)
{
  const ContactModuli m = contact_moduli(kGlass, kSteel);
  EXPECT_NEAR(m.youngs, 5.51808706e10, 1e3);
  EXPECT_NEAR(m.shear, 1.18403441e10, 1e3);
}

// Four operations on numbers near 1 that are each good to 1e-16, and a division by
// quotient - 2 > 2: 1e-15.
TEST(contact_moduli, of_one_material_that_stands_for_two_are_theirs)
{
  const Elastic soft = {1.08e9, 0.42}, odd = {5e9, -0.3};
  for (const auto &pair :
       {std::make_pair(kGlass, kSteel), std::make_pair(kSteel, soft), std::make_pair(kGlass, odd),
        std::make_pair(soft, odd), std::make_pair(kSteel, kSteel)}) {
    const ContactModuli two = contact_moduli(pair.first, pair.second);
    const Elastic one = as_one(pair.first, pair.second);
    EXPECT_NEAR(wall_youngs(one) / two.youngs, 1, 2e-15);
    EXPECT_NEAR(wall_shear(one) / two.shear, 1, 2e-15);
  }
}

}    // namespace
}    // namespace lsdcd::test_material
