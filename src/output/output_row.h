// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The numbers that styles give to scripts and programs: their names, units and meanings.
#pragma once

#include <string>
#include <vector>

namespace lsdcd {

// Numbers that stand one behind the other in an array of LAMMPS and have one meaning: those of a vector, or of several causes.
struct OutputRow {
  int n;    // numbers
  const char
      *name;    // of all of them; of one alone with an underscore and its component behind it
  const char *components;    // n words apart by blanks; empty: the row is one number
  const char *text;          // what they are, as the manual has it
  const char *unit;          // the kind of unit; empty: none
};

// A number of a style, and where it stands.
struct NamedElement {
  std::string name;
  int column;    // from 0
  static constexpr int kScalar = -1;
};

// The components of energy that contacts dissipate, and of that which is lost: BookedEnergy's kCauses and kOtherLosses.
inline constexpr char kCauseNames[] = "damping slider rolling twisting adhesion";
inline constexpr char kOtherLossNames[] = "lever_arms stiffness turned_springs inserted";

// Returns the name of number d of a row, counted from 0: "force_x".
std::string output_name(const OutputRow &row, int d);
// Returns the numbers of some rows, which stand one behind the other. `with_scalar`: the last row is the scalar of the style.
std::vector<NamedElement> named_elements(const std::vector<OutputRow> &rows, bool with_scalar);
// Returns how many numbers an array has that these rows describe.
int n_elements(const std::vector<OutputRow> &rows);

// The rows of the arrays of other styles than fix wall/lsdcd, in the order of their elements.
const std::vector<OutputRow> &massflow_outputs();            // the vector of fix massflow/lsdcd
const std::vector<OutputRow> &massflow_outputs_by_type();    // a row of its array
const std::vector<OutputRow> &insertion_outputs();           // the vector of fix insert/lsdcd
const std::vector<OutputRow> &
energy_outputs();    // the vector of compute lsdcd/energy, then its scalar
const std::vector<OutputRow> &impact_outputs();             // the vector of compute lsdcd/impacts
const std::vector<OutputRow> &impact_outputs_by_types();    // a row of its array
const std::vector<OutputRow> &
collide_outputs();    // the vector of compute lsdcd/collide, then its scalar
const std::vector<OutputRow> &collide_outputs_by_body();    // a row of its array
// A row of the per-atom array of fix wall/lsdcd, and one of its local array: with the columns of *heat* and *energy*, or without.
std::vector<OutputRow> contact_outputs(bool heat);
std::vector<OutputRow> each_contact_outputs(bool energy);

}    // namespace lsdcd
