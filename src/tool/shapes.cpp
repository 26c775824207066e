// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/shapes.h"

#include "base/input_error.h"
#include "base/input_words.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

Triangles fan(const Line &corners)
{
  Triangles out;
  for (std::size_t i = 1; i + 1 < corners.size(); i++)
    out.push_back({corners[0], corners[i], corners[i + 1]});
  return out;
}

// Advances along the line that is behind, by its share of the way.
Triangles between(const Line &left, const Line &right)
{
  Triangles out;
  std::size_t i = 0, j = 0;
  while (i + 1 < left.size() || j + 1 < right.size()) {
    const bool on_right =
        i + 1 == left.size() ||
        (j + 1 < right.size() && (j + 1) * (left.size() - 1) <= (i + 1) * (right.size() - 1));
    if (on_right) {
      out.push_back({left[i], right[j], right[j + 1]});
      j++;
    } else {
      out.push_back({left[i], right[j], left[i + 1]});
      i++;
    }
  }
  return out;
}

Triangles turned(const Profile &profile, int segments)
{
  const auto point = [&](const RadiusHeight &p, int j) -> Vec3 {
    const Real turn = 2 * M_PI * (j % segments) / segments;
    return {p.r * std::cos(turn), p.r * std::sin(turn), p.z};
  };
  Triangles out;
  for (std::size_t i = 0; i + 1 < profile.size(); i++)
    for (int j = 0; j < segments; j++) {
      const RadiusHeight &low = profile[i], &high = profile[i + 1];
      const Vec3 a = point(low, j), b = point(low, j + 1);
      const Vec3 c = point(high, j + 1), d = point(high, j);
      if (low.r > 0) out.push_back({a, b, c});
      if (high.r > 0) out.push_back({a, c, d});
    }
  return out;
}

Profile rounded_corner(const RadiusHeight &before, const RadiusHeight &at,
                       const RadiusHeight &after, Real round, int steps)
{
  const auto towards = [&](const RadiusHeight &p, Real &length) -> RadiusHeight {
    length = std::hypot(p.r - at.r, p.z - at.z);
    return {(p.r - at.r) / length, (p.z - at.z) / length};
  };
  Real first = 0, last = 0;
  const RadiusHeight u = towards(before, first), w = towards(after, last);
  const Real half = std::acos(std::clamp<Real>(u.r * w.r + u.z * w.z, -1, 1)) / 2;
  const Real used = round / std::tan(half);
  if (used <= 1e-9 * first) return {at};    // straight on, or no rounding
  if (used > first / 2 || used > last / 2)
    throw InputError(
        "--knuckle " + number_text(round) +
        " is too large to round the wall between cylinder, cone and tube; the largest is " +
        number_text(std::min(first, last) / 2 * std::tan(half)));
  const Real length = std::hypot(u.r + w.r, u.z + w.z);
  const RadiusHeight centre = {at.r + (u.r + w.r) / length * round / std::sin(half),
                               at.z + (u.z + w.z) / length * round / std::sin(half)};
  const auto turn_of = [&](const RadiusHeight &d) {
    return std::atan2(at.z + used * d.z - centre.z, at.r + used * d.r - centre.r);
  };
  const Real start = turn_of(u), sweep = std::remainder(turn_of(w) - start, 2 * M_PI);
  Profile arc;
  for (int i = 0; i <= steps; i++) {
    const Real turn = start + sweep * i / steps;
    arc.push_back({centre.r + round * std::cos(turn), centre.z + round * std::sin(turn)});
  }
  return arc;
}

Triangles plane_shape(Real width, Real depth)
{
  const Real x = width / 2, y = depth / 2;
  return fan({{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}});
}

Triangles box_shape(const Vec3 &size)
{
  const auto corner = [&](int i) -> Vec3 {
    return {i & 1 ? size.x : 0, i & 2 ? size.y : 0, i & 4 ? size.z : 0};
  };
  constexpr int kSides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  Triangles out;
  for (const auto &side : kSides)
    for (const auto &t : fan({corner(side[0]), corner(side[1]), corner(side[2]), corner(side[3])}))
      out.push_back(t);
  return out;
}

namespace {

Real length_of(const Vec3 &a, const Vec3 &b)
{
  return norm(b - a);
}

// The same bits from either end.
Vec3 middle(const Vec3 &a, const Vec3 &b)
{
  return 0.5 * (a + b);
}

// Splits the edges that are too long and keeps the winding.
void split(const std::array<Vec3, 3> &t, Real edge, Triangles &out)
{
  bool cut[3];
  for (int k = 0; k < 3; k++) cut[k] = length_of(t[k], t[(k + 1) % 3]) > edge;
  const int n = cut[0] + cut[1] + cut[2];
  if (n == 0) {
    out.push_back(t);
    return;
  }
  // Rotated so that edge 0 is cut, and edge 1 if two are.
  int first = 0;
  while (!cut[first] || (n == 2 && !cut[(first + 1) % 3])) first++;
  const Vec3 &a = t[first], &b = t[(first + 1) % 3], &c = t[(first + 2) % 3];
  const Vec3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
  if (n == 1) {
    out.insert(out.end(), {{a, ab, c}, {ab, b, c}});
  } else if (n == 2) {
    out.push_back({ab, b, bc});
    if (length_of(a, bc) <= length_of(ab, c))
      out.insert(out.end(), {{a, ab, bc}, {a, bc, c}});
    else
      out.insert(out.end(), {{a, ab, c}, {ab, bc, c}});
  } else {
    out.insert(out.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
}

}    // namespace

constexpr std::size_t kMaxTriangles = 20000000;

[[noreturn]] void refuse_edge(Real edge)
{
  throw InputError("--edge " + number_text(edge) +
                   " would make more than 20 million triangles; give a larger one");
}

// A new edge is shorter than sqrt(3)/2 of the longest edge before, so that this ends.
Triangles refined(Triangles coarse, Real edge)
{
  // No triangle with edges so short has a larger area, so that too many are refused before the work.
  const Real largest = std::sqrt(Real(3)) / 4 * edge * edge;
  Real area = 0;
  for (const auto &[a, b, c] : coarse) area += norm(cross(b - a, c - a)) / 2;
  if (area > largest * kMaxTriangles) refuse_edge(edge);
  for (std::size_t before = 0; before != coarse.size();) {
    before = coarse.size();
    Triangles finer;
    for (const auto &t : coarse) split(t, edge, finer);
    if (finer.size() > kMaxTriangles) refuse_edge(edge);
    coarse = std::move(finer);
  }
  return coarse;
}

}    // namespace lsdcd
