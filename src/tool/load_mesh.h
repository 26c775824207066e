// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The mesh that the words of a command name.
#pragma once

#include "mesh/io/read_mesh.h"
#include "mesh/measure_mesh.h"
#include "mesh/welded_mesh.h"
#include "tool/placement_options.h"

#include <string>

namespace lsdcd {

// `tolerance` is that of weld(). Throws InputError, or what wrong words of a command throw.
inline WeldedMesh load_mesh(const std::string &file, const PlacementOptions &place,
                            double tolerance)
{
  const Placement placement = placement_of(place);
  TriangleSoup soup = read_mesh(file).soup;
  placement.apply(soup);
  return weld(soup, tolerance);
}

// Throws if it has no face: edges and points alone are no wall.
inline WeldedMesh load_wall(const std::string &file, const PlacementOptions &place,
                            double tolerance)
{
  WeldedMesh mesh = load_mesh(file, place, tolerance);
  check_has_area(mesh);
  return mesh;
}

}    // namespace lsdcd
