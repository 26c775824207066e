// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "clump/surface_gap.h"

#include "mesh/surface_points.h"

#include <cmath>
#include <limits>

namespace lsdcd {

SurfaceGap surface_gap(const InsideMesh &inside, const std::vector<Ball> &balls)
{
  constexpr Real kPoints = 20000;
  const WeldedMesh &mesh = inside.mesh();
  const Real apart = std::sqrt(4 * mesh.report.area / kPoints);
  SurfaceGap gap;
  gap.apart = apart / std::sqrt(Real(3));
  for (const Vec3 &p : surface_points(mesh, apart, std::numeric_limits<std::size_t>::max())) {
    Real nearest = HUGE_VAL;
    for (const Ball &b : balls) nearest = std::fmin(nearest, norm(p - b.centre) - b.radius);
    gap.uncovered = std::fmax(gap.uncovered, nearest);
  }
  for (const Ball &b : balls)
    gap.stick_out = std::fmax(gap.stick_out, b.radius - inside.depth(b.centre));
  // A sphere that touches the mesh from inside is off by rounding.
  if (gap.stick_out < 1e-12 * norm(mesh.report.hi - mesh.report.lo)) gap.stick_out = 0;
  return gap;
}

}    // namespace lsdcd
