// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "shape/are_apart.h"

#include <cmath>

namespace lsdcd {
namespace {

// Returns half the length of the shadow that the box around a grain, with the axes of the grain, has along a direction.
Real half_shadow(const PlacedGrain &grain, const Vec3 &along)
{
  const Vec3 own = grain.to_own(along), &half = grain.shape.half;
  return half.x * std::fabs(own.x) + half.y * std::fabs(own.y) + half.z * std::fabs(own.z);
}

Vec3 axis_of(const PlacedGrain &grain, int k)
{
  return {grain.row[0][k], grain.row[1][k], grain.row[2][k]};
}

// Is one of the 15 directions that can part two boxes such that it parts those around the grains? (Gottschalk, Lin and Manocha 1996.)
bool boxes_are_apart(const PlacedGrain &a, const PlacedGrain &b)
{
  const Vec3 between = b.centre - a.centre;
  const auto parts = [&](const Vec3 &along) {
    return std::fabs(dot(between, along)) > half_shadow(a, along) + half_shadow(b, along);
  };
  for (int k = 0; k < 3; k++)
    if (parts(axis_of(a, k)) || parts(axis_of(b, k))) return true;
  for (int k = 0; k < 3; k++)
    for (int l = 0; l < 3; l++)
      if (parts(cross(axis_of(a, k), axis_of(b, l)))) return true;
  return false;
}

// The points x_b - x_a of all pairs of points of the two grains. The grains have a point in common where the origin is one of them.
class Differences {
 public:
  Differences(const PlacedGrain &a, const PlacedGrain &b) :
      a_(a), b_(b), between_(b.centre - a.centre)
  {
  }

  // Returns the one that is farthest along a direction: a grain is its own mirror image about its centre.
  Vec3 farthest(const Vec3 &along) const
  {
    const Vec3 unit = (1 / norm(along)) * along;
    return between_ + on(a_, unit) + on(b_, unit);
  }

 private:
  static Vec3 on(const PlacedGrain &grain, const Vec3 &unit)
  {
    return grain.turned(support(grain.shape, grain.to_own(unit)).point);
  }

  const PlacedGrain &a_, &b_;
  const Vec3 between_;
};

// Corners of a simplex of differences, the last one the newest, which tells where to look for a corner that brings the simplex
// nearer to the origin (Gilbert, Johnson and Keerthi 1988).
class Simplex {
 public:
  void add(const Vec3 &corner) { corner_[n_++] = corner; }

  // Keeps the corners of the part nearest to the origin. Returns the direction from there to the origin; 0 where the simplex holds it.
  Vec3 reduce()
  {
    if (n_ == 2) return reduce_segment();
    if (n_ == 3) return reduce_triangle();
    return n_ == 4 ? reduce_tetrahedron() : -corner_[0];
  }

 private:
  void keep(const Vec3 &p, const Vec3 &newest)
  {
    corner_[0] = p;
    corner_[1] = newest;
    n_ = 2;
  }
  void keep(const Vec3 &p, const Vec3 &q, const Vec3 &newest)
  {
    corner_[0] = p;
    corner_[1] = q;
    corner_[2] = newest;
    n_ = 3;
  }

  Vec3 reduce_segment()
  {
    const Vec3 newest = corner_[1], side = corner_[0] - newest;
    if (dot(side, newest) < 0) return cross(cross(side, -newest), side);
    corner_[0] = newest;
    n_ = 1;
    return -newest;
  }

  Vec3 reduce_triangle()
  {
    const Vec3 newest = corner_[2], one = corner_[1], two = corner_[0];
    const Vec3 to_one = one - newest, to_two = two - newest, across = cross(to_one, to_two);
    if (dot(cross(across, to_two), newest) < 0) {
      keep(dot(to_two, newest) < 0 ? two : one, newest);
      return reduce_segment();
    }
    if (dot(cross(to_one, across), newest) < 0) {
      keep(one, newest);
      return reduce_segment();
    }
    if (dot(across, newest) < 0) return across;
    keep(one, two, newest);    // wound the other way
    return -across;
  }

  // Each triangle has its outer side away from the fourth corner.
  Vec3 reduce_tetrahedron()
  {
    const Vec3 newest = corner_[3], at[3] = {corner_[2], corner_[1], corner_[0]};
    for (int k = 0; k < 3; k++) {
      const Vec3 one = at[k], two = at[(k + 1) % 3], other = at[(k + 2) % 3];
      Vec3 out = cross(one - newest, two - newest);
      if (dot(out, other - newest) > 0) out = -out;
      if (dot(out, newest) >= 0) continue;
      keep(two, one, newest);
      return reduce_triangle();
    }
    return {0, 0, 0};
  }

  Vec3 corner_[4];
  int n_ = 0;
};

}    // namespace

bool are_apart(const PlacedGrain &a, const PlacedGrain &b)
{
  const Vec3 between = b.centre - a.centre;
  const auto square = [](Real x) { return x * x; };
  const Real distance_sq = norm_sq(between);
  if (distance_sq > square(a.shape.farthest + b.shape.farthest)) return true;
  if (distance_sq <= square(a.shape.nearest + b.shape.nearest)) return false;
  if (boxes_are_apart(a, b)) return true;
  constexpr int kMostSteps = 200;
  const Differences differences(a, b);
  Simplex simplex;
  Vec3 along = -between;
  for (int i = 0; i < kMostSteps; i++) {
    if (!(norm_sq(along) > 0)) return false;
    const Vec3 corner = differences.farthest(along);
    if (dot(corner, along) < 0) return true;    // no difference reaches as far as the origin
    simplex.add(corner);
    along = simplex.reduce();
  }
  return false;
}

}    // namespace lsdcd
