// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The mesh that the words of a command name.
#pragma once

#include "mesh/io/read_mesh.h"
#include "mesh/measure_mesh.h"
#include "mesh/placement.h"
#include "mesh/welded_mesh.h"

#include <string>
#include <vector>

namespace lsdcd {

// `scale` holds no factor, one, or three. Throws InputError, or what wrong words of a command throw.
inline void apply_scale(TriangleSoup &soup, const std::vector<double> &scale,
                        const char *option = "--scale")
{
  if (scale.size() == 2) throw_usage_error(option, "takes one factor or three (x y z)");
  Placement placement;
  if (scale.size() == 1) placement.scale({scale[0], scale[0], scale[0]});
  if (scale.size() == 3) placement.scale({scale[0], scale[1], scale[2]});
  placement.apply(soup);
}

// `tolerance` is that of weld(). Throws InputError.
inline WeldedMesh load_mesh(const std::string &file, const std::vector<double> &scale,
                            double tolerance, const char *option = "--scale")
{
  TriangleSoup soup = read_mesh(file).soup;
  apply_scale(soup, scale, option);
  return weld(soup, tolerance);
}

// Throws if it has no face: edges and points alone are no wall.
inline WeldedMesh load_wall(const std::string &file, const std::vector<double> &scale,
                            double tolerance)
{
  WeldedMesh mesh = load_mesh(file, scale, tolerance);
  check_has_area(mesh);
  return mesh;
}

}    // namespace lsdcd
