// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The distance to a soup by trying every triangle, in more digits than the core has
// and by another way: barycentric coordinates from a dual basis, and segments.
#pragma once

#include "base/quad.h"
#include "base/vec3.h"
#include "mesh/triangle_soup.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lsdcd {

// A double and its rounding error, 106 bits: what a GPU has in the place of long
// double. (Dekker 1971; Knuth's two-sum; a product's error by a fused multiply-add.)
struct DoubleDouble {
  double hi, lo;
  LSDCD_FN DoubleDouble() : hi(0), lo(0) {}
  LSDCD_FN DoubleDouble(double a) : hi(a), lo(0) {}
  LSDCD_FN DoubleDouble(double a, double b) : hi(a), lo(b) {}
  LSDCD_FN explicit operator double() const { return hi + lo; }
};
LSDCD_FN DoubleDouble two_sum(double a, double b)
{
  const double s = a + b, v = s - a;
  return {s, (a - (s - v)) + (b - v)};
}
LSDCD_FN DoubleDouble operator+(const DoubleDouble &a, const DoubleDouble &b)
{
  DoubleDouble s = two_sum(a.hi, b.hi);
  const DoubleDouble t = two_sum(a.lo, b.lo);
  s = two_sum(s.hi, s.lo + t.hi);
  return two_sum(s.hi, s.lo + t.lo);
}
LSDCD_FN DoubleDouble operator-(const DoubleDouble &a, const DoubleDouble &b)
{
  return a + DoubleDouble(-b.hi, -b.lo);
}
LSDCD_FN DoubleDouble operator*(const DoubleDouble &a, const DoubleDouble &b)
{
  const double p = a.hi * b.hi;
  const double e = fma(a.hi, b.hi, -p) + (a.hi * b.lo + a.lo * b.hi);
  return two_sum(p, e);
}
LSDCD_FN bool operator<(const DoubleDouble &a, const DoubleDouble &b)
{
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

// T is long double, or DoubleDouble where there is none.
template <class T>
struct LongVec3 {
  T x, y, z;
};
template <class T>
LSDCD_FN T dot(const LongVec3<T> &a, const LongVec3<T> &b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
LSDCD_FN LongVec3<T> from_to(const Vec3 &a, const Vec3 &b)
{
  return {T(b.x) - T(a.x), T(b.y) - T(a.y), T(b.z) - T(a.z)};
}

// A triangle with what a distance takes. A point at w from corner 0 has the closest point
// s e0 + t e1 on the plane, s = w . dual[0], t = w . dual[1], and height w . normal.
template <class T>
struct LongTriangle {
  Vec3 corner[3];
  LongVec3<T> edge[3];    // from corner k to the next
  T inv_length_sq[3];     // 0 for an edge without a length
  LongVec3<T> dual[2], normal;
  bool flat;    // no area to speak of: only edges
  Vec3 centre;
  Real size;    // all corners lie within it of the centre
};

namespace long_detail {

// Made in quad precision: a needle of 1e8 : 1 loses 16 digits in its duals.
inline void put(long double &to, Quad a)
{
  to = static_cast<long double>(a);
}
inline void put(DoubleDouble &to, Quad a)
{
  to.hi = static_cast<double>(a);
  to.lo = static_cast<double>(a - to.hi);
}
template <class T>
void put(LongVec3<T> &to, const LongVec3<Quad> &a)
{
  put(to.x, a.x);
  put(to.y, a.y);
  put(to.z, a.z);
}
inline LongVec3<Quad> times(Quad s, const LongVec3<Quad> &a)
{
  return {s * a.x, s * a.y, s * a.z};
}
inline LongVec3<Quad> cross(const LongVec3<Quad> &a, const LongVec3<Quad> &b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}    // namespace long_detail

template <class T>
std::vector<LongTriangle<T>> long_triangles(const TriangleSoup &soup)
{
  using namespace long_detail;
  std::vector<LongTriangle<T>> out;
  for (std::size_t i = 0; i < soup.corners.size(); i += 3) {
    LongTriangle<T> t = {};
    LongVec3<Quad> e[3];
    for (int k = 0; k < 3; k++) t.corner[k] = soup.corners[i + k];
    for (int k = 0; k < 3; k++) {
      e[k] = from_to<Quad>(t.corner[k], t.corner[(k + 1) % 3]);
      const Quad length_sq = dot(e[k], e[k]);
      put(t.edge[k], e[k]);
      put(t.inv_length_sq[k], length_sq > 0 ? 1 / length_sq : 0);
    }
    // Duals of u = e0 and v = corner 2 - corner 0 = -e2.
    const LongVec3<Quad> u = e[0], v = times(-1, e[2]), n = cross(u, v);
    const Quad n_sq = dot(n, n);
    // A needle less high than 2^-49 of its length is its edges: no point of it is farther from them
    // than half of that, and 64 bits do not tell where past its tip a point in its line is.
    Quad longest_sq = 0;
    for (const LongVec3<Quad> &side : e) longest_sq = std::max(longest_sq, dot(side, side));
    t.flat = !(n_sq > Quad(0x1p-98) * longest_sq * longest_sq);
    if (!t.flat) {
      put(t.dual[0], times(1 / n_sq, cross(v, n)));
      put(t.dual[1], times(1 / n_sq, cross(n, u)));
      Quad root = std::sqrt(static_cast<long double>(n_sq));
      root = (root + n_sq / root) / 2;
      put(t.normal, times(1 / root, n));
    }
    t.centre = (1. / 3) * (t.corner[0] + t.corner[1] + t.corner[2]);
    for (const Vec3 &p : t.corner) t.size = std::fmax(t.size, norm(p - t.centre) * (1 + 1e-9));
    out.push_back(t);
  }
  return out;
}

template <class T>
LSDCD_FN T distance_sq(const LongTriangle<T> &t, const Vec3 &q)
{
  const LongVec3<T> w = from_to<T>(t.corner[0], q);
  if (!t.flat) {
    const T a = dot(w, t.dual[0]), b = dot(w, t.dual[1]);
    if (!(a < T(0)) && !(b < T(0)) && !(T(1) < a + b)) {
      const T h = dot(w, t.normal);
      return h * h;
    }
  }
  T least = T(1e300);
  for (int k = 0; k < 3; k++) {
    const LongVec3<T> from = from_to<T>(t.corner[k], q);
    T s = dot(from, t.edge[k]) * t.inv_length_sq[k];
    if (s < T(0)) s = T(0);
    if (T(1) < s) s = T(1);
    const LongVec3<T> r = {from.x - s * t.edge[k].x, from.y - s * t.edge[k].y,
                           from.z - s * t.edge[k].z};
    const T d = dot(r, r);
    if (d < least) least = d;
  }
  return least;
}

// The distance from q to n triangles. A triangle whose ball lies farther than the
// best so far, with a margin for rounding, is passed over.
template <class T>
LSDCD_FN Real long_distance(const LongTriangle<T> *triangle, int n, const Vec3 &q)
{
  T least = T(1e300);
  Real best = 1e150;
  for (int i = 0; i < n; i++) {
    const Real away = norm(q - triangle[i].centre);
    if (away - triangle[i].size > best + 1e-9 * (away + best)) continue;
    const T d = distance_sq(triangle[i], q);
    if (!(d < least)) continue;
    least = d;
    best = sqrt(static_cast<Real>(least));
  }
  return best;
}

// ---- local minima, on the host ----------------------------------------------------------

using LongReal = long double;

// The closest point of a triangle to the point at w, both from its corner 0. Sides are
// compared from the closest point on the plane: from far above it their offsets are lost.
inline LongVec3<LongReal> foot_of(const LongTriangle<LongReal> &t, const LongVec3<LongReal> &w)
{
  LongVec3<LongReal> level = w;
  if (!t.flat) {
    const LongReal a = dot(w, t.dual[0]), b = dot(w, t.dual[1]), h = dot(w, t.normal);
    level = {w.x - h * t.normal.x, w.y - h * t.normal.y, w.z - h * t.normal.z};
    if (a >= 0 && b >= 0 && a + b <= 1) return level;
  }
  LongVec3<LongReal> best = {0, 0, 0};
  LongReal least = HUGE_VALL;
  for (int k = 0; k < 3; k++) {
    const LongVec3<LongReal> start = from_to<LongReal>(t.corner[0], t.corner[k]);
    const LongVec3<LongReal> from = {level.x - start.x, level.y - start.y, level.z - start.z};
    LongReal s = dot(from, t.edge[k]) * t.inv_length_sq[k];
    s = s < 0 ? 0 : (s > 1 ? 1 : s);
    const LongVec3<LongReal> r = {from.x - s * t.edge[k].x, from.y - s * t.edge[k].y,
                                  from.z - s * t.edge[k].z};
    if (dot(r, r) < least) {
      least = dot(r, r);
      best = {level.x - r.x, level.y - r.y, level.z - r.z};
    }
  }
  return best;
}

}    // namespace lsdcd
