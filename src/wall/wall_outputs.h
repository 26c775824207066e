// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The output numbers of a wall and of each of its meshes in a step, in the order of their columns.
#pragma once

#include "output/output_row.h"
#include "wall/wall.h"

#include <string>
#include <vector>

namespace lsdcd {

// What a wall must have so that a row of outputs can be different from 0.
enum class OutputPart {
  every_wall,
  servo,
  body,
  wear,
  nodes,
  means,
  motion,
  energy,
  impacts,
  wear_energy,
  plastic,
  scalar    // the fix's scalar, which is no column
};

// Returns the keyword that gives a wall a part, as the manual writes it; empty: every wall has it.
const char *keyword_of(OutputPart part);

struct WallOutput {
  // Its name is that of the member of the library's lsdcd_wall_totals; of a body, with "body_" before it, of lsdcd_body_state.
  OutputRow row;
  bool adds_up;    // is it extensive: does it grow with the size of a system?
  OutputPart part;
  Real (*of_mesh)(Wall &wall, int mesh, int d);    // column d of n; collective
  // The value for all meshes together. Null: that of the only mesh that has a servo, body or motion; for other parts the sum over
  // meshes.
  Real (*of_all)(Wall &wall, int d);
};

// Returns the rows of outputs. Their columns follow each other from 0; that of the scalar comes last.
const std::vector<WallOutput> &wall_outputs();
// Returns how many columns this wall has: up to the last one of a part that it has.
int n_outputs(const WallSpec &wall);

// Return a number of a mesh, counted from 0, or with -1 of all together: number d of a row, and that of a column. 0 where it is of a part
// that the wall does not have. Collective.
Real output_value(Wall &wall, int mesh, const WallOutput &output, int d);
Real output_of(Wall &wall, int mesh, int column);
// Returns the row in which a name stands, and in d the number's place there. Null: the wall has no number of this name (why_no_output()).
const WallOutput *find_output(const WallSpec &wall, const std::string &name, int &d);
// Returns the numbers that this wall has, in the order of their columns, with the scalar as column -1.
std::vector<NamedElement> named_outputs(const WallSpec &wall);
// Returns why a wall has no number of this name: the keyword that it needs, or that there is none, with the nearest name.
std::string why_no_output(const WallSpec &wall, const std::string &name);

}    // namespace lsdcd
