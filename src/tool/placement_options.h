// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Options that place a mesh: by its scale, and then by a matrix.
#pragma once

#include "base/input_error.h"
#include "mesh/placement.h"
#include "tool/command.h"
#include "tool/number_options.h"

#include <string>
#include <vector>

namespace lsdcd {

struct PlacementOptions {
  std::string prefix = "--";
  std::vector<double> scale;     // no factor, one, or three
  std::vector<double> matrix;    // no number, or 12
};

// Adds --scale and --matrix, or --body-scale and --body-matrix for the prefix --body-. Returns the first. `mesh`: its name in the help.
inline Option add_placement_options(Command &command, PlacementOptions &o, const std::string &mesh)
{
  command
      .option(o.prefix + "matrix", o.matrix,
              "placement of the " + mesh +
                  ", behind its scale: three rows of M, each with its shift t behind it; a corner "
                  "x goes to M x + t")
      .words(12, 12)
      .shows_words("12 NUMBERS");
  return command
      .option(o.prefix + "scale", o.scale,
              "scale of the " + mesh + ": one factor, or three (x y z)")
      .words(1, 3)
      .check(not_zero);
}

// Throws InputError, or what wrong words of a command throw.
inline Placement placement_of(const PlacementOptions &o)
{
  const std::vector<double> &s = o.scale, &m = o.matrix;
  if (s.size() == 2) throw_usage_error(o.prefix + "scale", "takes one factor or three (x y z)");
  Placement placement;
  if (s.size() == 1) placement.scale({s[0], s[0], s[0]});
  if (s.size() == 3) placement.scale({s[0], s[1], s[2]});
  if (m.empty()) return placement;
  try {
    placement.matrix({{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}},
                     {m[3], m[7], m[11]});
  } catch (const InputError &e) {
    throw_usage_error(o.prefix + "matrix", e.what());
  }
  return placement;
}

}    // namespace lsdcd
