// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "rigid/mass_properties.h"

#include "base/input_error.h"
#include "base/input_words.h"

#include <algorithm>

namespace lsdcd {

namespace {

std::string place_text(const Vec3 &a)
{
  return "(" + number_text(a.x) + ", " + number_text(a.y) + ", " + number_text(a.z) + ")";
}

[[noreturn]] void fail_open(const WeldedMesh &mesh)
{
  constexpr std::size_t kShown = 3;
  std::string places;
  std::size_t shown = 0;
  for (std::size_t e = 0; e < mesh.edges.size() && shown < kShown; e++) {
    if (mesh.edge_first[e + 1] - mesh.edge_first[e] != 1) continue;
    places += (shown++ ? "; " : "") + place_text(mesh.vertices[mesh.edges[e][0]]) + " to " +
              place_text(mesh.vertices[mesh.edges[e][1]]);
  }
  throw InputError(mesh.source + " does not bound a volume: it has " +
                   counted(mesh.report.open_edges, "open edge") + " (" + places +
                   (mesh.report.open_edges > shown ? "; ..." : "") +
                   "), so a density gives no mass: close it, or give mass, centre and inertia");
}

[[noreturn]] void fail_not_oriented(const WeldedMesh &mesh)
{
  const MeshReport &r = mesh.report;
  const std::string begin = mesh.source + " does not bound a volume: it has ",
                    pairs =
                        counted(r.meeting_pairs, "pair of facets", "pairs of facets") + " that ",
                    other = "give mass, centre and inertia";
  // No repair unites parts that run into each other, such as paddles that begin in their shaft.
  if (r.nonmanifold_edges + r.misoriented_edges + r.inverted_facets + r.two_sided_faces == 0)
    throw InputError(begin + pairs +
                     "cut or touch each other: unite overlapping parts where you make the mesh (a "
                     "Boolean union), or " +
                     other);
  throw InputError(begin + std::to_string(r.nonmanifold_edges) + " non-manifold and " +
                   counted(r.misoriented_edges, "misoriented edge") + ", " +
                   counted(r.inverted_facets, "facet") + " wound against the others, " +
                   counted(r.two_sided_faces, "two-sided one") + ", and " + pairs +
                   "meet: repair it, or " + other);
}

}    // namespace

MassProperties mass_properties(const WeldedMesh &mesh, Real density)
{
  const MeshReport &r = mesh.report;
  if (r.open_edges > 0) fail_open(mesh);
  if (!r.oriented) fail_not_oriented(mesh);
  // From the middle of the box: far from the origin the terms would be large and cancel.
  const Vec3 middle = 0.5 * r.lo + 0.5 * r.hi;
  long double volume = 0, first[3] = {},
              second[6] = {};    // second: of x x, y y, z z, x y, x z, y z
  for (const auto &face : mesh.faces) {
    const Vec3 a = mesh.vertices[face[0]] - middle, b = mesh.vertices[face[1]] - middle,
               c = mesh.vertices[face[2]] - middle, s = a + b + c;
    const long double six = dot(a, cross(b, c));
    volume += six / 6;
    for (int i = 0; i < 3; i++) first[i] += six / 24 * s[i];
    const int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    for (int k = 0; k < 6; k++) {
      const int i = at[k][0], j = at[k][1];
      second[k] += six / 120 *
                   ((long double) (a[i]) * a[j] + (long double) (b[i]) * b[j] +
                    (long double) (c[i]) * c[j] + (long double) (s[i]) * s[j]);
    }
  }
  // Wound inwards all have the other sign.
  const long double sign = volume < 0 ? -1 : 1, scale = sign * density;
  MassProperties p;
  p.mass = static_cast<Real>(scale * volume);
  Vec3 to_centre = {0, 0, 0};
  for (int i = 0; i < 3; i++) to_centre[i] = static_cast<Real>(first[i] / volume);
  p.centre = middle + to_centre;
  const auto about_centre = [&](int k, int i, int j) {
    return static_cast<Real>(scale * (second[k] - first[i] * first[j] / volume));
  };
  const Real x2 = about_centre(0, 0, 0), y2 = about_centre(1, 1, 1), z2 = about_centre(2, 2, 2);
  // From 0, so that it is not -0.
  p.inertia = {y2 + z2,
               x2 + z2,
               x2 + y2,
               0 - about_centre(3, 0, 1),
               0 - about_centre(4, 0, 2),
               0 - about_centre(5, 1, 2)};
  check_mass_properties(p, mesh.source);
  return p;
}

void check_mass_properties(const MassProperties &p, const std::string &of)
{
  // Within these squares of lengths, units and inverses are numbers.
  constexpr Real kHeaviest = 1e100, kLargestMoment = 1e200;
  if (!(p.mass > 0))
    throw InputError(of + ": a mass of " + number_text(p.mass) + " is not above 0");
  if (!(p.mass >= 1 / kHeaviest && p.mass <= kHeaviest))
    throw InputError(of + ": a mass of " + number_text(p.mass) + " is not between " +
                     number_text(1 / kHeaviest) + " and " + number_text(kHeaviest) +
                     ", beyond which steps have no numbers: give another density or mass");
  Real moment[3];
  std::copy_n(principal_axes(p.inertia).value, 3, moment);
  std::sort(moment, moment + 3);
  constexpr Real kRounding = 1e-9;    // of numbers with ten digits in a script
  if (!(moment[0] > 0) || moment[2] > (1 + kRounding) * (moment[0] + moment[1]))
    throw InputError(of + ": no body has the principal moments of inertia " +
                     number_text(moment[0]) + ", " + number_text(moment[1]) + ", " +
                     number_text(moment[2]) +
                     ": each is above 0, and none is larger than the other two together");
  if (!(moment[0] >= 1 / kLargestMoment && moment[2] <= kLargestMoment))
    throw InputError(of + ": the principal moments of inertia " + number_text(moment[0]) + ", " +
                     number_text(moment[1]) + ", " + number_text(moment[2]) + " are not between " +
                     number_text(1 / kLargestMoment) + " and " + number_text(kLargestMoment) +
                     ", beyond which steps have no numbers: give another density or inertia");
}

}    // namespace lsdcd
