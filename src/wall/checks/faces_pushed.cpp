// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/checks/faces_pushed.h"

#include "mesh/face_plane.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

// Share of the largest speed: a smaller component comes from rounded input such as 0.87 0 0.5.
constexpr Real kRounded = 0.01;

Vec3 velocity_at(const SurfaceMotion &m, const Vec3 &p)
{
  return m.velocity + cross(m.angular, p - m.centre);
}

}    // namespace

PushReport faces_pushed(const WeldedMesh &mesh, const SurfaceMotion &motion)
{
  PushReport report;
  if (!motion.moves()) return report;
  Real fastest = 0, area = 0, pushed = 0;
  for (const Vec3 &p : mesh.vertices) fastest = std::max(fastest, norm(velocity_at(motion, p)));
  for (const auto &f : mesh.faces) {
    const Vec3 a = mesh.vertices[f[0]], b = mesh.vertices[f[1]], c = mesh.vertices[f[2]];
    const FacePlane plane = face_plane(a, b, c);
    area += plane.area;
    // The component is linear over the face: with one sign at all corners it is nowhere 0.
    const auto [least, most] = std::minmax({dot(velocity_at(motion, a), plane.normal),
                                            dot(velocity_at(motion, b), plane.normal),
                                            dot(velocity_at(motion, c), plane.normal)});
    if (std::max(least, -most) <= kRounded * fastest) continue;
    pushed += plane.area;
    report.faces++;
    const Vec3 centre = velocity_at(motion, (Real(1) / 3) * (a + b + c));
    const Real component = std::fabs(dot(centre, plane.normal));
    if (component <= report.component) continue;
    report.component = component;
    report.share = component / norm(centre);
  }
  report.area = pushed / area;
  return report;
}

}    // namespace lsdcd
