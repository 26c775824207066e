// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Facts that must hold for every pair of a sphere and a random mesh.
#pragma once

#include "contact/corner.h"
#include "contact/find_contacts.h"
#include "support/brute_force_long.h"
#include "support/random_mesh.h"

namespace lsdcd {

// The mesh as a checker sees it, on the host or on a device.
template <class T>
struct PairMesh {
  GridView grid;
  const LongTriangle<T> *triangle;
  const Vec3 *corners;
  int n_triangles;
  Vec3 lo, hi;
  Real cutoff;
  Real tolerance;    // of a distance, length
  std::uint64_t seed;
};

struct PairResult {
  bool touches, missed, not_there, wrong, bad;
  Real error;    // of the distance, over the tolerance
};

struct Sphere {
  Vec3 x;
  Real radius;
};

// The i-th sphere of a mesh.
template <class T>
LSDCD_FN Sphere sphere_of(const PairMesh<T> &mesh, std::uint64_t i)
{
  Numbers r(mesh.seed + 0x100000001b3ull * (i + 1));
  const Vec3 x = random_centre(r, mesh.corners, mesh.n_triangles, mesh.lo, mesh.hi, mesh.cutoff);
  return {x, mesh.cutoff * (r.below(2) ? 1 : r.log_in(1e-3, 1))};
}

// No contact missed, none that is not there, the nearest at the right distance; unit
// normals, weights in [0, 1], a finite force. `kSolved`: the corner rule is tried
// where there are no more contacts.
template <int kMost, int kSolved, class T>
LSDCD_FN PairResult check_pair(const PairMesh<T> &mesh, std::uint64_t i)
{
  const Sphere s = sphere_of(mesh, i);
  ContactSet<kMost> set;
  find_contacts(mesh.grid, s.x, s.radius, set);
  const Real d = long_distance(mesh.triangle, mesh.n_triangles, s.x);

  PairResult out = {};
  out.touches = set.n > 0;
  out.missed = set.n == 0 && d < s.radius - mesh.tolerance;
  out.not_there = set.n > 0 && d > s.radius + mesh.tolerance;
  out.bad = set.overflow;
  Real nearest = Real(1e300);
  for (int k = 0; k < set.n; k++) {
    const Real off = fabs(norm(set.normal[k]) - 1);
    out.bad = out.bad || !(off < Real(1e-14)) || !(set.distance[k] >= 0);
    if (!(set.distance[k] >= nearest)) nearest = set.distance[k];
  }
  if (set.n > 0) {
    out.error = fabs(nearest - d) / mesh.tolerance;
    out.wrong = !(out.error <= 1);
  }
  if (set.n > 1 && set.n <= kSolved) {
    ContactSet<kSolved> few;
    for (int k = 0; k < set.n; k++) few.add(set.feature[k], set.normal[k], set.distance[k]);
    Real weight[kSolved];
    CornerRule<kSolved> rule;
    rule.solve(few, s.radius, weight, mesh.grid.tolerance);
    Vec3 f = {0, 0, 0};
    for (int k = 0; k < set.n; k++) {
      out.bad = out.bad || !(weight[k] >= 0 && weight[k] <= 1);
      f += (weight[k] * (s.radius - set.distance[k])) * set.normal[k];
    }
    // As many overlaps at most as there are contacts.
    out.bad = out.bad || !(norm(f) <= set.n * s.radius * (1 + Real(1e-12)));
  }
  return out;
}

// A face reaches sqrt(2) tolerances past its sides and corners, so that a closest point may be that
// much nearer than the wall; dot products round by 8 eps of the lengths in them. A
// facet too thin to be a face has its middle half its height from its edges.
inline Real pair_tolerance(const MeshReport &report, const TriangleGrid &grid)
{
  Real t = Real(1.5) * grid.tolerance + 8 * kRoundoff * (norm(report.hi - report.lo) + grid.cutoff);
  if (report.degenerate_facets > 0) {
    Real largest = 0;
    for (int k = 0; k < 3; k++)
      largest = std::max({largest, std::fabs(report.lo[k]), std::fabs(report.hi[k])});
    t += std::fmax(4 * kRoundoff * largest, Real(5e-15) * report.largest_edge);
  }
  return t;
}

}    // namespace lsdcd
