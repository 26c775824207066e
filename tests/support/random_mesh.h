// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Random meshes of all kinds, good and bad, and spheres near them: each from a number.
#pragma once

#include "base/vec3.h"
#include "support/meshes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace lsdcd {

// SplitMix64: the same numbers on host and device.
struct Numbers {
  std::uint64_t state;

  LSDCD_FN explicit Numbers(std::uint64_t seed) : state(seed * 0x9e3779b97f4a7c15ull) {}
  LSDCD_FN std::uint64_t next()
  {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  LSDCD_FN int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
  LSDCD_FN Real in(Real lo, Real hi)
  {
    return lo + (hi - lo) * (static_cast<Real>(next() >> 11) * 0x1p-53);
  }
  LSDCD_FN Real log_in(Real lo, Real hi) { return exp(in(log(lo), log(hi))); }
  LSDCD_FN Vec3 in_box() { return {in(-1, 1), in(-1, 1), in(-1, 1)}; }
  LSDCD_FN Vec3 direction()
  {
    while (true) {
      const Vec3 a = in_box();
      const Real n = norm(a);
      if (n > Real(0.01) && n < 1) return (1 / n) * a;
    }
  }
};

struct RandomMesh {
  TriangleSoup soup;
  const char *kind;
  Real cutoff, length;    // length 0: chosen by the grid
};

namespace random_mesh_detail {

inline void add(TriangleSoup &soup, const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  soup.corners.insert(soup.corners.end(), {a, b, c});
}

// A sheet over [-1, 1]^2, cut in n x n quads, its nodes moved by up to `rough` in
// height and by a third of a side in the plane.
inline TriangleSoup sheet(Numbers &r, int n, Real rough)
{
  std::vector<Vec3> node;
  const Real side = 2. / n;
  for (int j = 0; j <= n; j++)
    for (int i = 0; i <= n; i++)
      node.push_back(
          {-1 + side * (i + r.in(-.3, .3)), -1 + side * (j + r.in(-.3, .3)), rough * r.in(-1, 1)});
  TriangleSoup soup;
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      const Vec3 a = node[j * (n + 1) + i], b = node[j * (n + 1) + i + 1],
                 c = node[(j + 1) * (n + 1) + i + 1], d = node[(j + 1) * (n + 1) + i];
      add(soup, a, b, c);
      add(soup, a, c, d);
    }
  return soup;
}

}    // namespace random_mesh_detail

inline RandomMesh random_mesh(std::uint64_t seed)
{
  using namespace random_mesh_detail;
  Numbers r(seed);
  RandomMesh m;
  TriangleSoup &soup = m.soup;
  switch (r.below(10)) {
    case 0:
      m.kind = "loose facets";
      for (int i = 1 + r.below(40); i > 0; i--) {
        const Vec3 at = r.in_box();
        const Real size = r.log_in(1e-3, 1);
        add(soup, at + size * r.direction(), at + size * r.direction(), at + size * r.direction());
      }
      break;
    case 1: {
      m.kind = "facets between few nodes";
      std::vector<Vec3> node;
      for (int i = 4 + r.below(12); i > 0; i--) node.push_back(r.in_box());
      const int n = static_cast<int>(node.size());
      for (int i = 2 + r.below(40); i > 0; i--)
        add(soup, node[r.below(n)], node[r.below(n)], node[r.below(n)]);
      break;
    }
    case 2:
      m.kind = "a rough sheet";
      soup = sheet(r, 1 + r.below(5), r.log_in(1e-9, 0.3));
      break;
    case 3:
      m.kind = "a flat sheet";
      soup = sheet(r, 1 + r.below(5), 0);
      break;
    case 4:
      m.kind = "a cylinder";
      soup = cylinder_mesh(3 + r.below(12), 1 + r.below(2), r.in(0.3, 1), r.in(0.2, 1.5));
      break;
    case 5:
      m.kind = "a hinge";
      soup = hinge_mesh((r.below(2) ? 1 : -1) * r.log_in(1e-6, 179), 1);
      break;
    case 6: {
      m.kind = "a fan";
      const int n = 3 + r.below(40);
      const Real height = r.below(3) ? r.log_in(1e-6, 3) : 0, bumps = r.below(2) ? r.in(0, 2) : 0;
      std::vector<Vec3> rim;
      for (int i = 0; i < n; i++) {
        const Real a = 2 * kPi * (i + r.in(-.4, .4)) / n;
        rim.push_back({std::cos(a), std::sin(a), -height * (1 + bumps * r.in(0, 1))});
      }
      for (int i = 0; i < n - r.below(2); i++) add(soup, {0, 0, 0}, rim[i], rim[(i + 1) % n]);
      break;
    }
    case 7:
      m.kind = "needles";
      for (int i = 1 + r.below(30); i > 0; i--) {
        const Vec3 a = r.in_box(), b = a + r.in(0.1, 1) * r.direction();
        add(soup, a, b, a + r.in(-0.2, 1.2) * (b - a) + r.log_in(1e-9, 1) * r.direction());
      }
      break;
    case 8: {
      m.kind = "T-junctions and doubled facets";
      soup = sheet(r, 1 + r.below(3), r.below(2) ? r.log_in(1e-9, 0.1) : 0);
      const TriangleSoup other = sheet(r, 1 + r.below(3), 0);
      append(soup, other);
      const std::size_t n = soup.corners.size();
      for (std::size_t t = 0; t < n; t += 3) {
        const Vec3 a = soup.corners[t], b = soup.corners[t + 1], c = soup.corners[t + 2];
        if (r.below(3) == 0) add(soup, b, a, c);
        if (r.below(3) == 0) {    // a neighbour that has only half of the side
          add(soup, a, 0.5 * (a + b), a + 0.3 * r.direction());
        }
      }
      break;
    }
    default: {
      m.kind = "boxes with facets without an area";
      const Vec3 lo = r.in_box();
      soup = box_mesh(lo, lo + Vec3{r.log_in(1e-3, 1), r.log_in(0.1, 1), r.log_in(0.1, 1)});
      const std::size_t n = soup.corners.size();
      for (int i = r.below(10); i > 0; i--) {
        const Vec3 a = soup.corners[r.next() % n], b = soup.corners[r.next() % n], c = r.in_box();
        switch (r.below(4)) {
          case 0:
            add(soup, a, b, b);
            break;
          case 1:
            add(soup, c, c, c);
            break;
          case 2:
            add(soup, a, c, 0.5 * (a + c));
            break;
          default:
            add(soup, a, b, a + r.in(0, 1) * (b - a));
        }
      }
    }
  }
  m.soup.source = m.kind;
  m.cutoff = r.log_in(0.03, 2);
  // Turned, scaled by 1e-6 .. 1e6 and, every third, moved by up to 1e6 radii.
  if (r.below(2)) {
    const Vec3 u = r.direction(), a = any_perpendicular(u), b = cross(u, a);
    for (Vec3 &p : soup.corners) p = p.x * a + p.y * b + p.z * u;
  }
  const Real scale = r.below(2) ? r.log_in(1e-6, 1e6) : 1;
  m.cutoff *= scale;
  const Vec3 at = r.below(3) ? Vec3{0, 0, 0} : r.log_in(1, 1e6) * m.cutoff * r.direction();
  for (Vec3 &p : soup.corners) p = scale * p + at;
  m.length = r.below(2) ? 0 : m.cutoff * r.log_in(0.25, 4);
  return m;
}

// A sphere's centre: anywhere in reach of the box, or from exactly on a facet, its
// edges or corners to a cutoff away from them.
LSDCD_FN Vec3 random_centre(Numbers &r, const Vec3 *corners, int n_triangles, const Vec3 &lo,
                            const Vec3 &hi, Real cutoff)
{
  if (r.below(4) == 0)
    return {r.in(lo.x - cutoff, hi.x + cutoff), r.in(lo.y - cutoff, hi.y + cutoff),
            r.in(lo.z - cutoff, hi.z + cutoff)};
  const Vec3 *p = corners + 3 * r.below(n_triangles);
  const int k = r.below(3);
  const Real u = r.in(0, 1), v = r.in(0, 1 - u);
  Vec3 q = p[k];
  if (r.below(3)) q += u * (p[(k + 1) % 3] - p[k]);
  if (r.below(3) == 0) q += v * (p[(k + 2) % 3] - p[k]);
  if (r.below(16) == 0) return q;
  Vec3 d = r.direction();
  const Real away = cutoff * (r.below(2) ? r.in(0, 1) : r.log_in(1e-12, 1));
  // Every fourth along a normal: over the very edge, as far as rounding lets it.
  if (r.below(4) == 0) {
    const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    const Real size = norm(n);
    if (size > 0) d = (1 / size) * n;
  }
  return q + away * d;
}

}    // namespace lsdcd
