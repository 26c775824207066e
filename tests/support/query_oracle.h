// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Nearest triangles by another method, on host and device: coarse bins of the soup and the
// regions of a triangle's plane. It shares only vectors with the core.
#pragma once

#include "base/vec3.h"
#include "mesh/triangle_soup.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace lsdcd {

// Squared distance from p to the triangle a b c, which must not be degenerate: the corner,
// the side or the inside in whose region p lies (Ericson 2005, section 5.1.5).
LSDCD_FN double region_distance_sq(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &p)
{
  const Vec3 u = b - a, v = c - a, from_a = p - a, from_b = p - b, from_c = p - c;
  const double ua = dot(u, from_a), va = dot(v, from_a), ub = dot(u, from_b), vb = dot(v, from_b),
               uc = dot(u, from_c), vc = dot(v, from_c);
  if (ua <= 0 && va <= 0) return norm_sq(from_a);
  if (ub >= 0 && vb <= ub) return norm_sq(from_b);
  if (vc >= 0 && uc <= vc) return norm_sq(from_c);
  // Areas of p's closest point with two of the corners, by the third's name.
  const double area_c = ua * vb - ub * va, area_b = uc * va - ua * vc, area_a = ub * vc - uc * vb;
  if (area_c <= 0 && ua >= 0 && ub <= 0) return norm_sq(from_a - (ua / (ua - ub)) * u);
  if (area_b <= 0 && va >= 0 && vc <= 0) return norm_sq(from_a - (va / (va - vc)) * v);
  if (area_a <= 0 && vb - ub >= 0 && uc - vc >= 0)
    return norm_sq(from_b - ((vb - ub) / ((vb - ub) + (uc - vc))) * (c - b));
  const Vec3 n = cross(u, v);
  const double height = dot(n, from_a);
  return height * height / norm_sq(n);
}

// Bins of cubes; each lists the triangles whose box, grown by the cutoff, meets it.
struct BinsView {
  const Vec3 *corners;    // three for each triangle
  std::uint32_t n_triangles;
  Vec3 origin;
  double side;
  int n[3];
  const std::uint32_t *first, *triangle;    // of bin b: triangle[first[b] .. first[b + 1])
};

struct Bins {
  std::vector<Vec3> corners;
  Vec3 origin;
  double side;
  int n[3];
  std::vector<std::uint32_t> first, triangle;
};

inline Bins make_bins(const TriangleSoup &soup, double cutoff)
{
  Bins bins;
  bins.corners = soup.corners;
  Vec3 lo = soup.corners[0], hi = lo;
  for (const Vec3 &p : soup.corners)
    for (int k = 0; k < 3; k++) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  bins.side = cutoff;
  for (int k = 0; k < 3; k++) bins.side = std::max(bins.side, (hi[k] - lo[k]) / 200);
  bins.origin = lo - 1.5 * cutoff * Vec3{1, 1, 1};
  for (int k = 0; k < 3; k++)
    bins.n[k] = static_cast<int>((hi[k] - lo[k] + 3 * cutoff) / bins.side) + 1;
  bins.first.assign(std::size_t(bins.n[0]) * bins.n[1] * bins.n[2] + 1, 0);

  const auto each_bin = [&](std::size_t t, auto visit) {
    int from[3], to[3];
    for (int k = 0; k < 3; k++) {
      const double *c[3];
      double least = HUGE_VAL, most = -HUGE_VAL;
      for (int j = 0; j < 3; j++) {
        c[j] = &bins.corners[3 * t + j].x;
        least = std::min(least, c[j][k]);
        most = std::max(most, c[j][k]);
      }
      const double grown = cutoff * 1.001;
      from[k] = std::max(0, static_cast<int>((least - grown - bins.origin[k]) / bins.side));
      to[k] =
          std::min(bins.n[k] - 1, static_cast<int>((most + grown - bins.origin[k]) / bins.side));
    }
    for (int z = from[2]; z <= to[2]; z++)
      for (int y = from[1]; y <= to[1]; y++)
        for (int x = from[0]; x <= to[0]; x++)
          visit((std::size_t(z) * bins.n[1] + y) * bins.n[0] + x);
  };
  const std::size_t n_triangles = soup.n_triangles();
  for (std::size_t t = 0; t < n_triangles; t++)
    each_bin(t, [&](std::size_t b) { bins.first[b + 1]++; });
  for (std::size_t b = 1; b < bins.first.size(); b++) bins.first[b] += bins.first[b - 1];
  bins.triangle.resize(bins.first.back());
  std::vector<std::uint32_t> at(bins.first.begin(), bins.first.end() - 1);
  for (std::size_t t = 0; t < n_triangles; t++)
    each_bin(t, [&](std::size_t b) { bins.triangle[at[b]++] = static_cast<std::uint32_t>(t); });
  return bins;
}

// Exact where it is within the cutoff that the bins were made for; otherwise larger than it.
LSDCD_FN double bin_distance(const BinsView &bins, const Vec3 &p)
{
  double least = 1e300;
  std::size_t bin = 0;
  for (int k = 2; k >= 0; k--) {
    const double u = (p[k] - bins.origin[k]) / bins.side;
    if (!(u >= 0 && u < bins.n[k])) return least;
    bin = bin * bins.n[k] + static_cast<std::size_t>(u);
  }
  for (std::uint32_t i = bins.first[bin]; i < bins.first[bin + 1]; i++) {
    const Vec3 *t = bins.corners + 3 * std::size_t(bins.triangle[i]);
    least = fmin(least, region_distance_sq(t[0], t[1], t[2], p));
  }
  return least < 1e300 ? sqrt(least) : least;
}

LSDCD_FN double brute_distance(const BinsView &bins, const Vec3 &p)
{
  double least = 1e300;
  for (std::uint32_t i = 0; i < bins.n_triangles; i++) {
    const Vec3 *t = bins.corners + 3 * std::size_t(i);
    least = fmin(least, region_distance_sq(t[0], t[1], t[2], p));
  }
  return sqrt(least);
}

}    // namespace lsdcd
