// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The numbers that a wall and each of its meshes have in a step, in the order of their columns.
#pragma once

#include "wall/wall.h"

#include <vector>

namespace lsdcd {

// What a wall must have for a row of outputs to be more than 0.
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
  wear_energy
};

struct WallOutput {
  int n;    // columns
  // The member of the library's lsdcd_wall_totals; of a body, of lsdcd_body_state; of a motion, what lsdcd_wall_get_pose() tells.
  const char *name;
  const char *text;    // what they are, for the manual (doc/wall_output.rst)
  const char *unit;    // the kind of unit; empty: none
  bool adds_up;        // with the size of a system
  OutputPart part;
  Real (*of_mesh)(Wall &wall, int mesh, int d);    // column d of n; collective
  // Of all meshes together. Null: that of the only mesh that has a servo, body or motion, and of other parts the sum over
  // meshes.
  Real (*of_all)(Wall &wall, int d);
};

// The rows. Their columns follow each other from 0.
const std::vector<WallOutput> &wall_outputs();
// Returns how many columns this wall has: up to the last one of a part that it has.
int n_outputs(const WallSpec &wall);

// Return a column of one mesh, and of all together. Collective.
Real output_of_mesh(Wall &wall, int mesh, int column);
Real output_of_wall(Wall &wall, int column);

}    // namespace lsdcd
