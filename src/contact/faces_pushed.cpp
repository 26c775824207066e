// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "contact/faces_pushed.h"

#include "mesh/face_plane.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

// Share of the largest speed: a smaller component comes from rounded input such as 0.87 0 0.5.
constexpr Real kRoundedWords = 0.01;
// Share of the mesh's diagonal: the rounding of coordinates in STL files, float or six digits.
constexpr Real kRoundedCorners = 1e-6;
// Share of the speed: the sine of half the angle of a facet of a roll with six of them.
constexpr Real kCoarsestRoll = 0.5;

Vec3 velocity_at(const SurfaceMotion &m, const Vec3 &p)
{
  return m.velocity + cross(m.angular, p - m.centre);
}

struct Push {
  Real component = 0, speed = 0;    // at the centre; 0 where nothing is pushed
};

// How far a circle rises above its chord at the share x of the chord, if it turns by an angle over it:
// a - b, where a^2 - b^2 = x (1 - x) chord^2. The quotient keeps its digits for small angles.
Real rise_of_arc(Real chord, Real angle, Real x)
{
  const Real radius = chord / (2 * std::sin(angle / 2)), from_middle = chord * (x - Real(0.5));
  const Real a = std::sqrt(radius * radius - from_middle * from_middle);
  const Real b = radius * std::cos(angle / 2);
  return x * (1 - x) * chord * chord / (a + b);
}

// The sine of the angle by which the plane of three corners on a roll leans, because the corner
// between the two others lies above the chord of their arc: its rise over its distance to their edge.
// It is 0 if the corner in the middle has the place of another one along the path, as in a box.
Real lean_of_middle(const Vec3 corner[3], const Real along[3], Real angle, Real area)
{
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int i, int j) { return along[i] < along[j]; });
  const Real chord = along[order[2]] - along[order[0]];
  if (!(angle > 0) || !(chord > 0)) return 0;
  const Real x = (along[order[1]] - along[order[0]]) / chord;
  const Real distance = 2 * area / norm(corner[order[2]] - corner[order[0]]);
  return rise_of_arc(chord, angle, x) / distance;
}

// A flat face can be part of a smooth surface that moves along itself if the velocity lies in its
// plane at some point of it, as along the middle of a roll's facet. For a sliver more is allowed: what
// the path bends away from its chord over the sliver's height.
Push push_on(const Vec3 corner[3], const SurfaceMotion &motion, Real fastest, Real rounding)
{
  const FacePlane plane = face_plane(corner[0], corner[1], corner[2]);
  const Vec3 centre = (Real(1) / 3) * (corner[0] + corner[1] + corner[2]);
  const Vec3 u = velocity_at(motion, centre);
  const Real speed = norm(u), component = std::fabs(dot(u, plane.normal));
  if (component <= kRoundedWords * fastest) return {};

  Real lowest = 1, highest = -1, turned = 0, along[3];
  Vec3 direction[3];
  int n = 0;
  for (int k = 0; k < 3; k++) {
    along[k] = dot(u, corner[k] - centre) / speed;
    const Vec3 v = velocity_at(motion, corner[k]);
    if (!(norm(v) > Real(1e-9) * speed)) continue;    // on the axis it has no direction
    direction[n] = (1 / norm(v)) * v;
    lowest = std::min(lowest, dot(direction[n], plane.normal));
    highest = std::max(highest, dot(direction[n], plane.normal));
    for (int i = 0; i < n; i++)
      turned = std::max(turned, std::atan2(norm(cross(direction[i], direction[n])),
                                           dot(direction[i], direction[n])));
    n++;
  }
  // An arc that turns by an angle rises over its chord by a quarter of the tangent of a quarter.
  const Real length = *std::max_element(along, along + 3) - *std::min_element(along, along + 3);
  const Real bend = Real(0.5) * length * std::tan(turned / 4);
  const Real lean = rounding / plane.height;
  const Real one_way = std::max(lowest, -highest), most = std::max(highest, -lowest);
  if (one_way > lean + bend / plane.height ||
      most >
          kCoarsestRoll + kRoundedWords + lean + lean_of_middle(corner, along, turned, plane.area))
    return {component, speed};
  return {};
}

}    // namespace

PushReport faces_pushed(const WeldedMesh &mesh, const SurfaceMotion &motion)
{
  PushReport report;
  if (!motion.moves()) return report;
  const Real rounding = kRoundedCorners * norm(mesh.report.hi - mesh.report.lo);
  Real fastest = 0;
  for (const Vec3 &p : mesh.vertices) fastest = std::max(fastest, norm(velocity_at(motion, p)));
  for (const auto &f : mesh.faces) {
    const Vec3 corner[3] = {mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]};
    const Push push = push_on(corner, motion, fastest, rounding);
    if (!(push.component > 0)) continue;
    report.faces++;
    if (push.component <= report.component) continue;
    report.component = push.component;
    report.share = push.component / push.speed;
  }
  return report;
}

}    // namespace lsdcd
