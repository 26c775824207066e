// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The table of sub-models. A row is all that the program knows of one beside its formula: what a script
// writes, what a contact stores, which number a material has, how the log calls it.
#pragma once

#include "law/contact_law.h"

#include <string>
#include <vector>

namespace lsdcd {

enum class Family { style, normal, damping, tangential, rolling, twisting, heat, cohesion };

// How the number of two types that have no law together follows from those of each.
enum class Mixing {
  geometric,    // sqrt(a b)
  series,       // 2 a b/(a + b): two springs one behind the other
  least,
  equal,    // two that differ cannot be mixed
  first,    // that of the first type
  second    // the number before it, of the second type
};

// Powers of a length. In coarse graining grains are L times as large, and a number of theirs is multiplied by L to its power.
constexpr Real kNoPower = 1e9;           // nothing is known of it
constexpr Real kPowerOfDamping = 2e9;    // that of the damping sub-model (SubModel::second)
constexpr Real kPowerByExponent =
    3e9;    // 2 - n, with the number n of the same row: a force is it times a length^n

// A number that a script gives.
struct Parameter {
  const char *name;
  const char *unit;    // "1": none
  Real least = 0, most = 1.7976931348623157e308;
  bool may_be_null = false;          // NULL: derived from the numbers before it
  const char *property = nullptr;    // its name in a material file, if it is there
  bool is_flag = false;              // 0 or 1
  Mixing mixing = Mixing::geometric;
  Real power = kNoPower;    // of L, see coarse_grain.h

  // Return the same number with a power of L, and mixed in another way.
  constexpr Parameter to_power(Real of_length) const
  {
    Parameter made = *this;
    made.power = of_length;
    return made;
  }
  constexpr Parameter mixed_by(Mixing way) const
  {
    Parameter made = *this;
    made.mixing = way;
    return made;
  }
};

// Numbers that a contact stores from step to step.
struct Stored {
  // Null: nothing. Equal words mean the same numbers in a restart file.
  const char *what = nullptr;
  int beside_shear = 0;            // numbers beside the shear displacement
  const char *effect = nullptr;    // the log's name of what they are for; null: the row's
  // Do these numbers change sign where the two spheres of a pair change places? The shear displacement does.
  bool flips = false;
};

// A law while a script is read.
struct LawDraft {
  ContactLaw law;
  const char *normal_name = "", *damping_name = "viscoelastic";
  // For normal sub-models with material constants; young 0: there are none.
  Real young = 0, poisson = 0;
  Real second = 0;    // eta or e, the second number of the normal sub-model
};

struct SubModel {
  Family family;
  const char *name;
  int model;    // of the family's enum
  std::vector<Parameter> parameters;
  // `given`: a number for each parameter, NaN for NULL. Null: the numbers are copied to the Chosen of
  // the family.
  void (*set)(const Real *given, LawDraft &draft);
  Stored stored;
  const char *effect;    // name in the log; empty: none
  const char *help;      // one line, with the source of the formula
  // Of a damping sub-model: the power of L of the second number of the normal one, whose meaning it says.
  Real second = kNoPower;
};

// A sub-model and its numbers; NaN: one that is derived, or of the materials.
struct GivenSubModel {
  const SubModel *row;
  std::vector<Real> numbers;
};

const std::vector<SubModel> &sub_models();
std::vector<const SubModel *> sub_models(Family family);

// Returns the names of a family's sub-models: "none|sds".
std::string names_text(Family family);

// Returns whether sub-models of this family may also stand beside a classic style. All families but `style` are of `granular`.
bool is_beside_style(Family family);

// Returns the words of a family in scripts: "tangential"; empty for style and normal.
const char *family_word(Family family);

// Returns the rows of a law, in the order of families. If two rows have the same formula, it is the first.
std::vector<const SubModel *> rows_of(const ContactLaw &law);

// Returns the sub-models of a law as text: "hooke/history, rolling cdt".
std::string sub_models_text(const ContactLaw &law);

// Return the parameters of a row as text, without and with its name: "k gamma mu" and "sds k gamma mu".
std::string parameters_text(const SubModel &row);
std::string syntax_of(const SubModel &row);

}    // namespace lsdcd
