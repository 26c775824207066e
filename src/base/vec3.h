// Three-vectors of Real: the only linear algebra that contacts need.
#pragma once

#include "base/real.h"

#include <cmath>

namespace lsdcd {

struct Vec3 {
  Real x, y, z;

  LSDCD_FN Real operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }
  LSDCD_FN Real &operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }
};

LSDCD_FN Vec3 operator+(const Vec3 &a, const Vec3 &b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
LSDCD_FN Vec3 operator-(const Vec3 &a, const Vec3 &b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
LSDCD_FN Vec3 operator-(const Vec3 &a)
{
  return {-a.x, -a.y, -a.z};
}
LSDCD_FN Vec3 operator*(Real s, const Vec3 &a)
{
  return {s * a.x, s * a.y, s * a.z};
}
LSDCD_FN Vec3 operator*(const Vec3 &a, Real s)
{
  return s * a;
}
LSDCD_FN Vec3 &operator+=(Vec3 &a, const Vec3 &b)
{
  a.x += b.x;
  a.y += b.y;
  a.z += b.z;
  return a;
}
LSDCD_FN Vec3 &operator-=(Vec3 &a, const Vec3 &b)
{
  a.x -= b.x;
  a.y -= b.y;
  a.z -= b.z;
  return a;
}
LSDCD_FN bool operator==(const Vec3 &a, const Vec3 &b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

LSDCD_FN Real dot(const Vec3 &a, const Vec3 &b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
LSDCD_FN Vec3 cross(const Vec3 &a, const Vec3 &b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
LSDCD_FN Real norm_sq(const Vec3 &a)
{
  return dot(a, a);
}
LSDCD_FN Real norm(const Vec3 &a)
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
