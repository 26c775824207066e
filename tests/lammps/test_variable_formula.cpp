// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Which formulas of LAMMPS read atoms, by its documentation of variables of style equal.
#include "variable_formula.h"

#include <gtest/gtest.h>

namespace lsdcd {
namespace {

bool reads(const std::string &formula)
{
  return formula_reads_atoms(
      formula, [](const std::string &name) { return name == "high"; },
      [](const std::string &name) { return name == "plain"; });
}

TEST(variable_formula, numbers_time_and_functions_do_not)
{
  for (const char *formula :
       {"1", "-1.5e-3*2E+5", "0.1*sin(2*PI*step*dt/1e3)", "ramp(0,5.0)", "ternary(time<0.5,1,0)",
        "swiggle(0,1.5,0.2)^2", "(xhi-xlo)/2 + vol", "v_low*3", "f_wall[3]/f_wall[1][2]", ""})
    EXPECT_FALSE(reads(formula)) << formula;
}

TEST(variable_formula, group_functions_keywords_and_atom_values_do)
{
  for (const char *formula : {"xcm(all,z)", "1+ke", "0.5*count(all,box)", "x[12]-1", "mass(some)",
                              "press", "bound(all,zmax)", "gmask(all)", "sum(c_of[1])"})
    EXPECT_TRUE(reads(formula)) << formula;
}

TEST(variable_formula, other_variables_and_computes_are_asked)
{
  EXPECT_TRUE(reads("2*v_high"));
  EXPECT_TRUE(reads("2*c_plain[1]"));
  EXPECT_FALSE(reads("2*c_of_kokkos[1]"));
}

}    // namespace
}    // namespace lsdcd
