// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The material files that come with the project.
#include "base/input_error.h"
#include "input/wall_command.h"
#include "material/material_file.h"

#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <set>

namespace lsdcd::test_potentials {
namespace {

namespace fs = std::filesystem;

std::vector<MaterialFile> shipped()
{
  std::vector<MaterialFile> files;
  for (const auto &entry : fs::directory_iterator(LSDCD_TEST_DIR "/../potentials"))
    if (entry.path().extension() == ".lsdcd")
      files.push_back(read_materials(entry.path().string()));
  return files;
}

TEST(potentials, have_the_materials_that_the_manual_names)
{
  std::set<std::string> names;
  for (const MaterialFile &file : shipped())
    for (const MaterialSection &m : file.materials) names.insert(m.first);
  EXPECT_EQ(names, (std::set<std::string>{"alumina", "aluminium", "glass", "hdpe", "quartz",
                                          "silica", "steel", "tungsten"}));
}

TEST(potentials, are_greater_than_zero_and_have_a_source)
{
  for (const MaterialFile &file : shipped())
    for (const auto *sections : {&file.materials, &file.pairs})
      for (const MaterialSection &section : *sections)
        for (const Stated &s : section.stated) {
          EXPECT_GT(s.value, 0) << s.place;
          EXPECT_GT(s.source.size(), 7u) << s.place;
        }
}

// Solids lie between hard rubber and diamond, and between foam and osmium.
TEST(potentials, have_elasticity_and_density_of_solids)
{
  for (const MaterialFile &file : shipped())
    for (const MaterialSection &m : file.materials) {
      for (const char *key : {"youngs_modulus", "poissons_ratio", "density"})
        ASSERT_TRUE(m.find(key)) << m.place << " " << key;
      EXPECT_GT(m.find("youngs_modulus")->value, 1e7) << m.place;
      EXPECT_LT(m.find("youngs_modulus")->value, 1.2e12) << m.place;
      EXPECT_GT(m.find("density")->value, 500) << m.place;
      EXPECT_LT(m.find("density")->value, 22600) << m.place;
    }
}

TEST(potentials, are_found_by_name_from_where_the_program_is)
{
  EXPECT_EQ(read_materials(find_material_file("glass.lsdcd")).material("glass").first, "glass");
}

TEST(potentials, fill_the_styles_that_the_manual_shows)
{
  for (const std::vector<std::string> &words : std::vector<std::vector<std::string>>{
           {"granular", "material", "glass.lsdcd", "glass", "mesh", "a"},
           {"granular", "material", "glass.lsdcd", "glass", "on", "aluminium", "mesh", "a"},
           {"granular", "material", "alumina.lsdcd", "alumina", "on", "glass", "mesh", "a"},
           {"granular", "material", "tungsten.lsdcd", "tungsten", "on", "steel", "with",
            "restitution", "0.7", "sliding_friction", "0.3", "mesh", "a"},
           {"granular", "jkr", "material", "silica_powder.lsdcd", "silica", "with",
            "sliding_friction", "0.4", "rolling", "sds", "1", "0", "NULL", "mesh", "a"}})
    for (const std::string units : {"si", "cgs", "micro", "nano"}) {
      MaterialsRead read;
      const auto laws = [&](const WallMaterials &materials,
                            const std::vector<MaterialPair> &pairs) {
        return read_laws(materials, pairs, units, read);
      };
      EXPECT_GT(parse_wall(words, laws).wall.law().k_normal, 0);
      EXPECT_NE(read.report, "");
    }
}

}    // namespace
}    // namespace lsdcd::test_potentials
