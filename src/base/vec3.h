// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Three-vectors: the only linear algebra that contacts need.
#pragma once

#include "base/real.h"

namespace lsdcd {

template <class T>
struct Vec3Of {
  T x, y, z;

  LSDCD_FN T operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }
  LSDCD_FN T &operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }
};
using Vec3 = Vec3Of<Real>;

// A parameter of this type takes no part in deducing T, so that 2 * v compiles.
template <class T>
struct SameAs {
  using Type = T;
};
template <class T>
using ScalarOf = typename SameAs<T>::Type;

template <class To, class From>
LSDCD_FN Vec3Of<To> vec_cast(const Vec3Of<From> &a)
{
  return {static_cast<To>(a.x), static_cast<To>(a.y), static_cast<To>(a.z)};
}

template <class T>
LSDCD_FN Vec3Of<T> operator+(const Vec3Of<T> &a, const Vec3Of<T> &b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
LSDCD_FN Vec3Of<T> operator-(const Vec3Of<T> &a, const Vec3Of<T> &b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
LSDCD_FN Vec3Of<T> operator-(const Vec3Of<T> &a)
{
  return {-a.x, -a.y, -a.z};
}
template <class T>
LSDCD_FN Vec3Of<T> operator*(ScalarOf<T> s, const Vec3Of<T> &a)
{
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
LSDCD_FN Vec3Of<T> operator*(const Vec3Of<T> &a, ScalarOf<T> s)
{
  return s * a;
}
template <class T>
LSDCD_FN Vec3Of<T> &operator+=(Vec3Of<T> &a, const Vec3Of<T> &b)
{
  a.x += b.x;
  a.y += b.y;
  a.z += b.z;
  return a;
}
template <class T>
LSDCD_FN Vec3Of<T> &operator-=(Vec3Of<T> &a, const Vec3Of<T> &b)
{
  a.x -= b.x;
  a.y -= b.y;
  a.z -= b.z;
  return a;
}
template <class T>
LSDCD_FN bool operator==(const Vec3Of<T> &a, const Vec3Of<T> &b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

template <class T>
LSDCD_FN T dot(const Vec3Of<T> &a, const Vec3Of<T> &b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
LSDCD_FN Vec3Of<T> cross(const Vec3Of<T> &a, const Vec3Of<T> &b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
LSDCD_FN T norm_sq(const Vec3Of<T> &a)
{
  return dot(a, a);
}
template <class T>
LSDCD_FN T norm(const Vec3Of<T> &a)
{
  return sqrt(norm_sq(a));
}

// Any unit vector perpendicular to `a` (a need not be unit; a zero `a` gives x).
LSDCD_FN Vec3 any_perpendicular(const Vec3 &a)
{
  const Real ax = fabs(a.x), ay = fabs(a.y), az = fabs(a.z);
  Vec3 p;
  if (ax <= ay && ax <= az)
    p = {0, a.z, -a.y};
  else if (ay <= az)
    p = {-a.z, 0, a.x};
  else
    p = {a.y, -a.x, 0};
  const Real n = norm(p);
  return n > 0 ? (1 / n) * p : Vec3{1, 0, 0};
}

}    // namespace lsdcd
