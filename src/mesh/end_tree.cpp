// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/end_tree.h"

#include <cmath>
#include <initializer_list>

namespace lsdcd {

Vec3 direction(const Vec3 &from, const Vec3 &to)
{
  const Real length = norm(to - from);
  return length > 0 ? (1 / length) * (to - from) : Vec3{0, 0, 0};
}

namespace {

Vec3 middle(const Box &box)
{
  return Real(0.5) * box.lo + Real(0.5) * box.hi;
}

// Is the thing so long that directions along its axis part it from others better than those of boxes?
bool is_long(const Ends &a)
{
  constexpr Real kLong = 4;    // times the larger end
  const Real size = std::max(norm(a.end[0].hi - a.end[0].lo), norm(a.end[1].hi - a.end[1].lo));
  return norm(middle(a.end[1]) - middle(a.end[0])) > kLong * size;
}

struct Interval {
  Real lo, hi;
};

Interval along(const Vec3 &d, const Ends &a)
{
  Interval all = {HUGE_VAL, -HUGE_VAL};
  for (const Box &box : a.end) {
    Real lo = 0, hi = 0;
    for (int k = 0; k < 3; k++) {
      lo += std::min(d[k] * box.lo[k], d[k] * box.hi[k]);
      hi += std::max(d[k] * box.lo[k], d[k] * box.hi[k]);
    }
    all = {std::min(all.lo, lo), std::max(all.hi, hi)};
  }
  return all;
}

// Is there a gap between them along one of these directions? `size`: the largest coordinate. Each end of an interval is a sum of three
// products, which 4 u of their sizes bound, u = 2^-53.
bool are_parted(const Ends &a, const Ends &b, Real size, std::initializer_list<Vec3> directions)
{
  constexpr Real kRounding = 1e-14;
  return std::any_of(directions.begin(), directions.end(), [&](const Vec3 &d) {
    const Interval of_a = along(d, a), of_b = along(d, b);
    const Real gap = kRounding * size * (std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z));
    return of_a.lo - of_b.hi > gap || of_b.lo - of_a.hi > gap;
  });
}

Real largest(const Box &box)
{
  Real most = 0;
  for (int k = 0; k < 3; k++) most = std::max({most, std::fabs(box.lo[k]), std::fabs(box.hi[k])});
  return most;
}

}    // namespace

bool may_meet(const Ends &a, const Ends &b)
{
  const Box all_a = a.bounds(), all_b = b.bounds();
  if (!overlap(all_a, all_b)) return false;
  const bool long_a = is_long(a), long_b = is_long(b);
  if (!long_a && !long_b) return true;
  const Real size = std::max(largest(all_a), largest(all_b));
  const Vec3 way = direction(middle(all_a), middle(all_b));
  const auto off = [&](const Vec3 &axis) { return cross(axis, cross(way, axis)); };
  const Vec3 u = direction(middle(a.end[0]), middle(a.end[1])),
             v = direction(middle(b.end[0]), middle(b.end[1]));
  if (long_a && long_b) {
    const Vec3 across = cross(u, v);
    return !are_parted(a, b, size, {across, cross(across, u), cross(across, v), off(u), off(v)});
  }
  const Vec3 axis = long_a ? u : v;
  return !are_parted(a, b, size,
                     {{0, axis.z, -axis.y}, {axis.z, 0, -axis.x}, {axis.y, -axis.x, 0}, off(axis)});
}

EndTree::EndTree(const std::vector<Ends> &things) :
    things_(things), number_(things.size()), around_(4 * things.size() / kLeaf + 4)
{
  std::iota(number_.begin(), number_.end(), 0);
  if (!things.empty()) build({1, 0, things.size()});
  for (std::size_t i = 0; i < things.size(); i++) things_[i] = things[number_[i]];
}

// Splits a range in two along the coordinate of an end in which its things differ most.
void EndTree::build(const Node &node)
{
  Ends all = things_[number_[node.first]];
  Box middles[2] = {{middle(all.end[0]), middle(all.end[0])},
                    {middle(all.end[1]), middle(all.end[1])}};
  for (std::size_t i = node.first; i < node.last; i++)
    for (const int side : {0, 1}) {
      const Box &end = things_[number_[i]].end[side];
      extend(all.end[side], end.lo);
      extend(all.end[side], end.hi);
      extend(middles[side], middle(end));
    }
  if (node.number >= around_.size()) around_.resize(2 * node.number);
  around_[node.number] = all;
  if (node.size() <= kLeaf) return;
  int side = 0, axis = 0;
  const auto spread = [&](int s, int k) { return middles[s].hi[k] - middles[s].lo[k]; };
  for (const int s : {0, 1})
    for (int k = 0; k < 3; k++)
      if (spread(s, k) > spread(side, axis)) side = s, axis = k;
  const auto at = [&](int i) { return middle(things_[i].end[side])[axis]; };
  std::nth_element(number_.begin() + static_cast<std::ptrdiff_t>(node.first),
                   number_.begin() + static_cast<std::ptrdiff_t>(node.half(1).first),
                   number_.begin() + static_cast<std::ptrdiff_t>(node.last),
                   [&](int i, int j) { return at(i) < at(j); });
  build(node.half(0));
  build(node.half(1));
}

}    // namespace lsdcd
