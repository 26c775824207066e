// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Superellipsoids in long double, by their two defining formulas alone: what tests of grains that are no spheres compare with.
#pragma once

#include "base/vec3.h"
#include "shape/superellipsoid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lsdcd {

using Long = long double;
using LongVec = Vec3Of<Long>;

inline constexpr Long kQuarter = 1.57079632679489661923L;
inline constexpr int kCloud = 48;    // steps of a quarter turn

inline Long length(const LongVec &a)
{
  return std::sqrt(dot(a, a));
}

// The shape by its support function and its surface in two angles, in long double.
class ShapeOracle {
 public:
  explicit ShapeOracle(const Superellipsoid &s) :
      a_(s.half.x), b_(s.half.y), c_(s.half.z), n1_(s.n1), n2_(s.n2)
  {
    for (int i = 0; i <= kCloud; i++)
      for (int j = 0; j <= kCloud; j++)
        cloud_[i * (kCloud + 1) + j] = surface(Real(i * kStep), Real(j * kStep));
  }

  Long support(const LongVec &n) const
  {
    const Long q1 = n1_ / (n1_ - 1), q2 = n2_ / (n2_ - 1);
    const auto power = [](Long x, Long p) { return std::pow(std::fabs(x), p); };
    const Long plane = std::pow(power(a_ * n.x, q2) + power(b_ * n.y, q2), q1 / q2);
    return std::pow(plane + power(c_ * n.z, q1), 1 / q1);
  }
  // The point of the surface with the unit normal n: the slope of the support function.
  LongVec point(const LongVec &n) const
  {
    const Long q1 = n1_ / (n1_ - 1), q2 = n2_ / (n2_ - 1);
    const auto power = [](Long x, Long p) {
      return x == 0 ? 0 : std::copysign(std::pow(std::fabs(x), p), x);
    };
    const Long plane =
        std::pow(std::pow(std::fabs(a_ * n.x), q2) + std::pow(std::fabs(b_ * n.y), q2), 1 / q2);
    const Long h = support(n), over = power(plane / h, q1 - 1);
    if (plane == 0) return {0, 0, c_ * power(c_ * n.z / h, q1 - 1)};
    return {a_ * over * power(a_ * n.x / plane, q2 - 1),
            b_ * over * power(b_ * n.y / plane, q2 - 1), c_ * power(c_ * n.z / h, q1 - 1)};
  }
  template <class T>
  T gauge(const Vec3Of<T> &x) const
  {
    const auto power = [](T y, Long p) { return std::pow(std::fabs(y), T(p)); };
    return std::pow(std::pow(power(x.x / T(a_), n2_) + power(x.y / T(b_), n2_), T(n1_ / n2_)) +
                        power(x.z / T(c_), n1_),
                    T(1 / n1_));
  }
  // A point of the surface in the first octant, on a ray by its angles.
  template <class T>
  Vec3Of<T> surface(T up, T round) const
  {
    // The cosine of a quarter is 0 here.
    const auto cosine = [](T x) { return x > T(kQuarter - 1e-15L) ? 0 : std::cos(x); };
    const Vec3Of<T> x = {T(a_) * cosine(up) * cosine(round), T(b_) * cosine(up) * std::sin(round),
                         T(c_) * std::sin(up)};
    return (1 / gauge(x)) * x;
  }
  // How far a point is from the surface: from all points of a cloud, and from there downhill.
  Long distance(const Vec3 &y) const
  {
    const Vec3 at = {std::fabs(y.x), std::fabs(y.y), std::fabs(y.z)};
    int best = 0;
    for (int i = 1; i < int(cloud_.size()); i++)
      if (norm_sq(cloud_[i] - at) < norm_sq(cloud_[best] - at)) best = i;
    return downhill(best, vec_cast<Long>(at));
  }
  Real distance_from_cloud(const Vec3 &y) const
  {
    const Vec3 at = {std::fabs(y.x), std::fabs(y.y), std::fabs(y.z)};
    Real least = HUGE_VAL;
    for (const Vec3 &x : cloud_) least = std::fmin(least, norm_sq(x - at));
    return std::sqrt(least);
  }
  // The signed distance, also where several points of the surface are nearly the nearest; to rounding of Real.
  Real signed_distance(const Vec3 &y) const
  {
    const Vec3 at = {std::fabs(y.x), std::fabs(y.y), std::fabs(y.z)};
    Real least = HUGE_VAL;
    for (int i = 0; i <= kCloud; i++)
      for (int j = 0; j <= kCloud; j++) {
        const auto here = [&](int k, int l) {
          k = std::clamp(k, 0, kCloud), l = std::clamp(l, 0, kCloud);
          return norm(cloud_[k * (kCloud + 1) + l] - at);
        };
        const Real middle = here(i, j);
        if (middle <= std::min({here(i - 1, j), here(i + 1, j), here(i, j - 1), here(i, j + 1)}))
          least = std::min(least, downhill(i * (kCloud + 1) + j, at));
      }
    return gauge(at) < 1 ? -least : least;
  }

 private:
  static constexpr Long kStep = kQuarter / kCloud;

  template <class T>
  T downhill(int from, const Vec3Of<T> &at) const
  {
    const auto f = [&](T up, T round) { return std::sqrt(norm_sq(surface(up, round) - at)); };
    constexpr T kEnd = T(kQuarter);
    T up = from / (kCloud + 1) * T(kStep), round = from % (kCloud + 1) * T(kStep),
      best = f(up, round);
    for (T by = T(kStep); by > T(1e-8);) {
      bool better = false;
      constexpr int kWays[8][2] = {{1, 0}, {-1, 0}, {0, 1},  {0, -1},
                                   {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
      for (const auto &way : kWays) {
        const T u = std::clamp<T>(up + way[0] * by, 0, kEnd),
                r = std::clamp<T>(round + way[1] * by, 0, kEnd);
        const T here = f(u, r);
        if (!(here < best * (1 - T(1e-16)))) continue;
        best = here, up = u, round = r, better = true;
        break;
      }
      if (!better) by /= 2;
    }
    // Narrow valleys: Newton's steps by differences.
    for (int i = 0; i < 6; i++) {
      const T h = sizeof(T) > sizeof(Real) ? T(1e-5L) : T(1e-4L), h2 = h * h;
      const T o = f(up, round), e = f(up + h, round), w = f(up - h, round), n = f(up, round + h),
              s = f(up, round - h);
      const T fu = (e - w) / (2 * h), fr = (n - s) / (2 * h), fuu = (e - 2 * o + w) / h2,
              frr = (n - 2 * o + s) / h2,
              fur = (f(up + h, round + h) - f(up + h, round - h) - f(up - h, round + h) +
                     f(up - h, round - h)) /
                    (4 * h2);
      const T det = fuu * frr - fur * fur;
      const T u = up - (frr * fu - fur * fr) / det, r = round - (fuu * fr - fur * fu) / det;
      if (!(u > 0 && r > 0 && u < kEnd && r < kEnd && f(u, r) < best)) break;
      best = f(u, r), up = u, round = r;
    }
    return best;
  }

  const Long a_, b_, c_, n1_, n2_;
  std::array<Vec3, (kCloud + 1) * (kCloud + 1)> cloud_;
};

}    // namespace lsdcd
