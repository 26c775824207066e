// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The table of sub-models: what is said of each is said everywhere.
#include "law/sub_models.h"

#include "effects/effects.h"
#include "support/table_laws.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace lsdcd::test_sub_models {
namespace {

std::string name_of(const SubModel &row)
{
  return std::string(family_word(row.family)) + " " + row.name;
}

bool is_off(const SubModel &row)
{
  return row.name == std::string("none");
}

TEST(sub_models, have_names_and_numbers_of_their_own)
{
  std::set<std::string> seen;
  for (const SubModel &row : sub_models()) {
    const char *const style = row.family == Family::style ? "classic " : "granular ";
    EXPECT_TRUE(seen.insert(style + name_of(row)).second) << name_of(row);
    EXPECT_LE(row.parameters.size(), row.set ? 7u : std::size_t(kMaxNumbers)) << name_of(row);
    EXPECT_TRUE(row.help && *row.help) << name_of(row);
    for (const Parameter &p : row.parameters) EXPECT_TRUE(p.unit && *p.unit) << name_of(row);
  }
}

// Equal words are the same numbers to a restart file: only springs along the wall share theirs, and forms of one normal model that yields.
TEST(sub_models, say_what_they_keep)
{
  for (const SubModel &row : sub_models()) {
    if (row.stored.beside_shear > 0) {
      EXPECT_TRUE(row.stored.what) << name_of(row);
    }
    const bool shear = row.family == Family::style || row.family == Family::tangential;
    for (const SubModel &other : sub_models())
      if (&row != &other && row.stored.what && other.stored.what &&
          row.stored.what == std::string(other.stored.what)) {
        const bool yields = row.family == Family::normal && other.family == Family::normal;
        EXPECT_TRUE((shear || yields) && row.stored.beside_shear == other.stored.beside_shear)
            << name_of(row);
      }
  }
}

// `lsdcd effects` and ./run bench effects have each.
TEST(sub_models, have_a_case_in_the_table_of_effects)
{
  std::set<const SubModel *> seen;
  for (const EffectCase &c : effect_cases())
    for (const SubModel *row : rows_of(c.settings.law())) seen.insert(row);
  for (const SubModel &row : sub_models()) {
    // Where two rows have one formula, the first stands for both.
    const auto first =
        std::find_if(sub_models().begin(), sub_models().end(), [&](const SubModel &r) {
          return r.family == row.family && r.model == row.model;
        });
    if (is_off(row)) continue;
    EXPECT_TRUE(seen.count(&*first)) << name_of(row);
  }
}

// With the formulas of LAMMPS and LIGGGHTS such a dashpot is the right one only where force is mass times acceleration.
TEST(sub_models, that_are_a_part_of_the_critical_dashpot_are_refused_in_other_units)
{
  const auto is_refused = [](const ContactLaw &law, Real acceleration) {
    try {
      check_dashpots(law, acceleration);
    } catch (const LawError &) {
      return true;
    }
    return false;
  };
  std::set<std::string> refused;
  each_law_of_table([&](const ContactLaw &law, const LawRows &rows) {
    EXPECT_FALSE(is_refused(law, 1)) << name_of(rows);
    if (!is_refused(law, 9648.5)) return;
    bool has_one = false;
    for (const SubModel *row : rows)
      for (const char *name : {"tsuji", "coeff_restitution", "epsd", "epsd3"})
        if (row && row->name == std::string(name)) {
          refused.insert(name);
          has_one = true;
        }
    EXPECT_TRUE(has_one) << name_of(rows);
  });
  EXPECT_EQ(refused, (std::set<std::string>{"tsuji", "coeff_restitution", "epsd", "epsd3"}));
  // Without a dashpot there is none of another part.
  ContactLaw law = granular_law(NormalModel::hooke);
  law.damping = DampingModel::stiffness;
  law.eta = restitution_damping(law.normal, 1);
  EXPECT_FALSE(is_refused(law, 9648.5));
  law.rolling = {RollingModel::epsd, {0.3, 0}};
  EXPECT_FALSE(is_refused(law, 9648.5));
}

// ---- the page ------------------------------------------------------------------------------

std::string csv_row(const SubModel &row)
{
  std::string numbers;
  for (const Parameter &p : row.parameters)
    if (p.unit != std::string("1") && p.unit != std::string("0 or 1"))
      numbers += (numbers.empty() ? "" : ", ") + std::string(p.name) + ": " + p.unit;
  const std::string word = row.family == Family::normal ? "granular" : family_word(row.family);
  return "   \"" + word + (word.empty() ? "" : " ") + syntax_of(row) + "\", \"" + numbers +
         "\", \"" + (row.stored.what ? row.stored.what : "") + "\", \"" + row.help + "\"\n";
}

std::string page_table()
{
  std::string table;
  for (const SubModel &row : sub_models())
    if (!is_off(row)) table += csv_row(row);
  return table;
}

TEST(sub_models, are_listed_in_the_page_of_the_fix)
{
  const std::string page = content(LSDCD_TEST_DIR "/../doc/contact_laws.rst");
  ASSERT_FALSE(page.empty());
  EXPECT_NE(page.find(page_table()), std::string::npos)
      << "the table of sub-models in doc/contact_laws.rst should be\n"
      << page_table();
}

// "L kn", "gamman/L^2"; empty: the number stays.
std::string becomes(const std::string &name, Real real_power)
{
  if (real_power == kPowerByExponent) return "L^(2-n) " + name;
  const int power = static_cast<int>(real_power);
  const std::string factor = std::abs(power) == 1 ? "L" : "L^" + std::to_string(std::abs(power));
  if (power == 0) return "";
  return power > 0 ? factor + " " + name : name + "/" + factor;
}

std::string coarse_row(const SubModel &row)
{
  std::vector<std::string> numbers;
  for (const Parameter &p : row.parameters)
    if (p.power != kPowerOfDamping) numbers.push_back(becomes(p.name, p.power));
  if (row.family == Family::damping) numbers.push_back(becomes("eta", row.second));
  std::string text;
  for (const std::string &number : numbers)
    if (!number.empty()) text += (text.empty() ? "" : ", ") + number;
  if (text.empty()) return "";
  const std::string word = row.family == Family::normal ? "granular" : family_word(row.family);
  return "   \"" + word + (word.empty() ? "" : " ") + syntax_of(row) + "\", \"" + text + "\"\n";
}

TEST(sub_models, have_their_powers_of_coarse_graining_in_the_page_of_the_fix)
{
  std::string table;
  for (const SubModel &row : sub_models()) table += coarse_row(row);
  const std::string page = content(LSDCD_TEST_DIR "/../doc/contact_laws.rst");
  EXPECT_NE(page.find("\n\n" + table + "\n"), std::string::npos)
      << "the table of coarse graining in doc/contact_laws.rst should be\n"
      << table;
}

}    // namespace
}    // namespace lsdcd::test_sub_models
