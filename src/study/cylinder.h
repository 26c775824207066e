// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The paper's wall: a cylinder about z from 0 to its height, as a formula and in triangles.
#pragma once

#include "base/vec3.h"
#include "mesh/triangle_soup.h"

namespace lsdcd {

// Distance from q to the surface of a solid cylinder: the paper's function (3).
LSDCD_FN Real cylinder_distance(const Vec3 &q, Real radius, Real height)
{
  const Real rho = sqrt(q.x * q.x + q.y * q.y);
  const Real above = q.z - height;
  if (q.z <= 0) {
    if (rho < radius) return -q.z;
    return sqrt((rho - radius) * (rho - radius) + q.z * q.z);
  }
  if (above >= 0) {
    if (rho < radius) return above;
    return sqrt((rho - radius) * (rho - radius) + above * above);
  }
  if (rho < radius) return fmin(fmin(radius - rho, q.z), -above);
  return rho - radius;
}

// How the flat ends are cut: from their centre, or from one corner of the rim. The second
// has obtuse triangles.
enum class Caps { centre, rim };

struct CylinderMesh {
  Real radius = 50, height = 100;
  int segments = 39;    // flat sides; corners lie on the circle
  int along = 1;        // rows of triangles along the axis
  // Rows by which the diagonals of the sides climb more than they need to. The surface
  // stays; from 1 on its triangles are obtuse where a row is lower than a side is wide.
  int slant = 0;
  Caps caps = Caps::centre;
};

TriangleSoup make_cylinder(const CylinderMesh &shape);

}    // namespace lsdcd
