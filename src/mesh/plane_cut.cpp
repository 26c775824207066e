// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/plane_cut.h"

#include "mesh/face_plane.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

// Corners in float lean less than this; it takes 5e-7 of a force.
constexpr Real kUpright = 1e-3;

PlaneCut plane_cut(const WeldedMesh &mesh)
{
  PlaneCut cut;
  for (const auto &face : mesh.faces) {
    const Vec3 &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]],
               &c = mesh.vertices[face[2]];
    if (std::min({a.z, b.z, c.z}) > 0 || std::max({a.z, b.z, c.z}) < 0) continue;
    const Real lean = std::fabs(face_plane(a, b, c).normal.z);
    if (lean <= kUpright) continue;
    cut.leaning++;
    cut.lean = std::max(cut.lean, std::asin(std::min(lean, Real(1))) * 180 / kPi);
  }
  return cut;
}

}    // namespace lsdcd
