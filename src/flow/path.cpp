// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "flow/path.h"

#include "geometry/expansion.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

constexpr Real kEpsilon = 1.2e-16;    // a little above half of the last bit of 1

struct ExactVec {
  Expansion x[3];
};

ExactVec exact(const Vec3 &a)
{
  return {{Expansion(a.x), Expansion(a.y), Expansion(a.z)}};
}

ExactVec exact(const WrappedPoint &p, const PeriodicBox &box)
{
  ExactVec out = exact(p.at);
  for (int k = 0; k < 3; k++)
    for (int d = 0; d < 3; d++)
      if (p.cells[k] != 0) out.x[d].add_product(p.cells[k], box.edge[k][d]);
  return out;
}

ExactVec operator-(const ExactVec &a, const ExactVec &b)
{
  return {{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]}};
}

ExactVec cross(const ExactVec &a, const ExactVec &b)
{
  return {{a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2],
           a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}

int sign_of_dot(const ExactVec &a, const ExactVec &b)
{
  return (a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2]).sign();
}

// The sign of the product with (e, e^2, e^3): the first component that is not 0 decides.
int sign_along_shift(const ExactVec &a)
{
  for (const Expansion &x : a.x)
    if (x.sign() != 0) return x.sign();
  return 0;
}

Real size(const Vec3 &a)
{
  return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
}

}    // namespace

Path::Path(const WrappedPoint &from, const WrappedPoint &to, const PeriodicBox &box) :
    end_{from, to}, box_(box), largest_(0)
{
  for (int i = 0; i < 2; i++) {
    unwrapped_[i] = end_[i].at;
    largest_ = std::max(largest_, size(unwrapped_[i]));
    for (int k = 0; k < 3; k++) {
      if (end_[i].cells[k] == 0) continue;
      const Vec3 shift = end_[i].cells[k] * box.edge[k];
      unwrapped_[i] += shift;
      largest_ = std::max(largest_, size(shift));
    }
  }
}

// Four sums round by at most 4 kEpsilon of what may add up to 4 largest_.
Box Path::bounds() const
{
  const Real room = 16 * kEpsilon * largest_;
  Box box;
  for (int d = 0; d < 3; d++) {
    box.lo[d] = std::min(unwrapped_[0][d], unwrapped_[1][d]) - room;
    box.hi[d] = std::max(unwrapped_[0][d], unwrapped_[1][d]) + room;
  }
  return box;
}

// In front of the triangle's plane (1) or behind it (-1). The determinant is a sum of 6 products
// of a component each of u, v and w. Components of u and v are off by kEpsilon of their sizes, those
// of w by 16 kEpsilon largest_ and kEpsilon of its size; products and sums add 5 kEpsilon of
// each product. All that is less than 6 |u| |v| (16 largest_ + 8 |w|) kEpsilon.
int Path::side(int end, const Vec3 &a, const Vec3 &b, const Vec3 &c) const
{
  const Vec3 u = b - a, v = c - a, w = unwrapped_[end] - a;
  const Real volume = dot(cross(u, v), w);
  const Real off = 100 * kEpsilon * size(u) * size(v) * (largest_ + size(w));
  return std::fabs(volume) > off ? (volume > 0 ? 1 : -1) : exact_side(end, a, b, c);
}

int Path::exact_side(int end, const Vec3 &a, const Vec3 &b, const Vec3 &c) const
{
  const ExactVec origin = exact(a);
  const ExactVec normal = cross(exact(b) - origin, exact(c) - origin);
  const int sign = sign_of_dot(normal, exact(end_[end], box_) - origin);
  return sign != 0 ? sign : sign_along_shift(normal);
}

// How the path's line passes the edge from a to b: 1 with the edge turning left about it. Off by
// at most 6 kEpsilon times |u| |v| (32 largest_ + |d|) + |d| |v| (16 largest_ + |u|) + |d| |u| (16
// largest_ + |v|), and 5 kEpsilon of each of 6 products.
int Path::turn(const Vec3 &a, const Vec3 &b) const
{
  const Vec3 d = unwrapped_[1] - unwrapped_[0], u = a - unwrapped_[0], v = b - unwrapped_[0];
  const Real volume = dot(d, cross(u, v));
  const Real uv = size(u) * size(v), du = size(d) * size(u), dv = size(d) * size(v);
  const Real off = 200 * kEpsilon * (uv * (largest_ + size(d)) + (du + dv) * largest_);
  return std::fabs(volume) > off ? (volume > 0 ? 1 : -1) : exact_turn(a, b);
}

// 0 only if the edge is parallel to the path, and so are its triangles.
int Path::exact_turn(const Vec3 &a, const Vec3 &b) const
{
  const ExactVec from = exact(end_[0], box_), d = exact(end_[1], box_) - from;
  const ExactVec u = exact(a) - from, v = exact(b) - from;
  const int sign = sign_of_dot(d, cross(u, v));
  return sign != 0 ? sign : -sign_along_shift(cross(v - u, d));
}

int Path::crosses(const Vec3 &a, const Vec3 &b, const Vec3 &c) const
{
  const int to = side(1, a, b, c);
  if (side(0, a, b, c) == to) return 0;
  const int first = turn(a, b);
  return turn(b, c) == first && turn(c, a) == first ? to : 0;
}

}    // namespace lsdcd
