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

constexpr Real kMaxTriangles = 2e7;

void check_triangles(Real n, Real edge)
{
  if (n > kMaxTriangles)
    throw InputError("--edge " + number_text(edge) +
                     " would make more than 20 million triangles; give a larger one");
}

namespace {

// Lengths that are equal but for rounding.
constexpr Real kSame = 1e-9;

// How many equal pieces a length has, none of which is longer than `piece`.
int pieces_of(Real length, Real piece)
{
  const Real n = std::ceil((1 - kSame) * length / piece);
  check_triangles(n, piece);
  return std::max(1, static_cast<int>(n));
}

// Point i of those that cut a to b into n equal pieces; the same bits from either end.
Vec3 on_line(const Vec3 &a, const Vec3 &b, int i, int n)
{
  if (i == 0) return a;
  return i == n ? b : (1 / Real(n)) * (Real(n - i) * a + Real(i) * b);
}

Line in_pieces(const Vec3 &a, const Vec3 &b, int n)
{
  Line line;
  for (int i = 0; i <= n; i++) line.push_back(on_line(a, b, i, n));
  return line;
}

}    // namespace

Rows rows_between(Real width, Real length, Real edge)
{
  if (edge == 0) return {1, false};
  const Real height = std::sqrt(std::max(edge * edge - width * width, Real(0.1) * edge * edge));
  const int even = pieces_of(length, height),
            shifted = pieces_of(length, std::min(edge, 2 * height));
  return even <= shifted ? Rows{even, false} : Rows{shifted, true};
}

Line column(const Vec3 &a, const Vec3 &b, const Rows &rows, bool odd)
{
  if (!odd || !rows.shifted) return in_pieces(a, b, rows.n);
  Line line = {a};
  for (int i = 0; i < rows.n; i++) line.push_back(on_line(a, b, 2 * i + 1, 2 * rows.n));
  line.push_back(b);
  return line;
}

void add_strip(Triangles &to, const Line &left, const Line &right)
{
  const std::size_t n = left.size(), m = right.size();
  const bool begins_in_tip = left[0] == right[0], ends_in_tip = left[n - 1] == right[m - 1];
  std::size_t i = 0, j = 0;
  const auto goes_right = [&] {
    if (i + 1 == n || j + 1 == m) return i + 1 == n;
    // At a tip both lines take turns: two edges of one line make no triangle.
    if (begins_in_tip && (i == 0) != (j == 0)) return j == 0;
    if (ends_in_tip && (i + 2 == n) != (j + 2 == m)) return i + 2 == n;
    return norm_sq(right[j + 1] - left[i]) <= norm_sq(left[i + 1] - right[j]);
  };
  while (i + 1 < n || j + 1 < m) {
    const bool on_right = goes_right();
    const Vec3 &a = left[i], &b = right[j], &c = on_right ? right[j + 1] : left[i + 1];
    if (!(a == b) && !(b == c) && !(c == a)) to.push_back({a, b, c});
    (on_right ? j : i)++;
  }
}

namespace {

// A disc in rings. The first has the corners of the rim; the next ones have half as many where that is enough, else they
// are turned by half a corner.
void add_disc(Triangles &to, const Line &rim, const Vec3 &centre, bool outward, Real edge)
{
  constexpr std::size_t kLeast = 6;
  const Real radius = norm(rim[0] - centre);
  const int rings = pieces_of(radius, kAcross * edge);
  check_triangles(Real(rings) * Real(rim.size()), edge);
  std::size_t corners = rim.size() - 1;
  Real start = 0;
  Line outer = rim;
  for (int i = rings - 1; i >= 0; i--) {
    const Real r = radius * i / rings;
    if (corners % 2 == 0 && corners / 2 >= kLeast &&
        4 * r * std::sin(kPi / Real(corners)) <= kAcross * edge)
      corners /= 2;
    else
      start += kPi / Real(corners);
    Line inner;
    for (std::size_t j = 0; j < corners; j++) {
      const Real turn = start + 2 * kPi * Real(j) / Real(corners);
      inner.push_back(centre + r * Vec3{std::cos(turn), std::sin(turn), 0});
    }
    inner.push_back(inner[0]);
    if (outward)
      add_strip(to, outer, inner);
    else
      add_strip(to, inner, outer);
    outer = inner;
  }
}

// A trapezoid that is wider than an edge, from a to b below and from d to c above, in rows for its length from a to d. Each
// line of a row is cut by its own length, as that of the neighbour is that shares it.
void add_wide(Triangles &to, const Line &corners, Real length, Real edge)
{
  const Vec3 &a = corners[0], &b = corners[1], &c = corners[2], &d = corners[3];
  const Real across = std::sqrt(Real(0.5)) * edge;
  const auto line = [&](const Vec3 &from, const Vec3 &end) {
    return in_pieces(from, end, pieces_of(norm(end - from), across));
  };
  const int rows = pieces_of(length, across);
  check_triangles(Real(to.size()) + Real(rows) * (norm(b - a) + norm(c - d)) / across, edge);
  for (int i = 0; i < rows; i++)
    add_strip(to, line(on_line(a, d, i + 1, rows), on_line(b, c, i + 1, rows)),
              line(on_line(a, d, i, rows), on_line(b, c, i, rows)));
}

}    // namespace

Triangles turned(const Profile &profile, int segments, Real edge)
{
  constexpr int kRound = 24;    // rings of so many corners stay inside of one another
  constexpr Real kNarrow = 0.95;
  Real radius = 0;
  for (const RadiusHeight &p : profile) radius = std::max(radius, p.r);
  const auto width = [&](Real r) { return 2 * r * std::sin(kPi / segments); };
  const auto point = [&](const RadiusHeight &p, int j) -> Vec3 {
    const Real turn = 2 * kPi * (j % segments) / segments;
    return {p.r * std::cos(turn), p.r * std::sin(turn), p.z};
  };
  const bool is_wide = edge > 0 && width(radius) > kNarrow * edge;
  Triangles out;
  for (std::size_t i = 0; i + 1 < profile.size(); i++) {
    const RadiusHeight &low = profile[i], &high = profile[i + 1];
    const Real length = std::hypot(high.r - low.r, high.z - low.z);
    if (is_wide) {
      for (int j = 0; j < segments; j++)
        add_wide(out, {point(low, j), point(low, j + 1), point(high, j + 1), point(high, j)},
                 length, edge);
      continue;
    }
    if (edge > 0 && segments >= kRound && low.z == high.z && low.r * high.r == 0) {
      const RadiusHeight &of_rim = low.r > 0 ? low : high;
      Line rim;
      for (int j = 0; j <= segments; j++) rim.push_back(point(of_rim, j));
      add_disc(out, rim, {0, 0, of_rim.z}, high.r > 0, edge);
      continue;
    }
    const Rows rows = rows_between(width(std::max(low.r, high.r)), length, edge);
    check_triangles(Real(rows.n) * segments, edge);
    const auto line = [&](int j) {
      return column(point(low, j), point(high, j), rows, j % segments % 2 != 0);
    };
    for (int j = 0; j < segments; j++) {
      if (edge > 0) {
        add_strip(out, line(j), line(j + 1));
        continue;
      }
      const Vec3 a = point(low, j), c = point(high, j + 1);
      if (low.r > 0) out.push_back({a, point(low, j + 1), c});
      if (high.r > 0) out.push_back({a, c, point(high, j)});
    }
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
  const Real start = turn_of(u), sweep = std::remainder(turn_of(w) - start, 2 * kPi);
  Profile arc;
  for (int i = 0; i <= steps; i++) {
    const Real turn = start + sweep * i / steps;
    arc.push_back({centre.r + round * std::cos(turn), centre.z + round * std::sin(turn)});
  }
  return arc;
}

namespace {

// A rectangle, its corners in counter-clockwise order viewed from its front: columns from the first side to the third.
Triangles in_columns(const Line &corners, int columns, Real edge)
{
  const Vec3 &a = corners[0], &b = corners[1], &c = corners[2], &d = corners[3];
  const Rows rows = rows_between(norm(b - a) / columns, norm(c - b), edge);
  check_triangles(Real(rows.n) * columns, edge);
  const auto line = [&](int j) {
    return column(on_line(a, b, j, columns), on_line(d, c, j, columns), rows, j % 2 != 0);
  };
  Triangles out;
  for (int j = 0; j < columns; j++) add_strip(out, line(j), line(j + 1));
  return out;
}

// A rectangle whose sides are cut by their lengths alone, as those of its neighbours are.
Triangles in_grid(const Line &corners, Real edge)
{
  Triangles out;
  add_wide(out, corners, norm(corners[3] - corners[0]), edge);
  return out;
}

}    // namespace

Triangles plane_shape(Real width, Real depth, Real edge)
{
  const Real x = width / 2, y = depth / 2;
  const Line corners = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
  return edge > 0 ? in_columns(corners, pieces_of(width, kAcross * edge), edge) : fan(corners);
}

Triangles box_shape(const Vec3 &size, Real edge)
{
  const auto corner = [&](int i) -> Vec3 {
    return {i & 1 ? size.x : 0, i & 2 ? size.y : 0, i & 4 ? size.z : 0};
  };
  constexpr int kSides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  Triangles out;
  for (const auto &side : kSides) {
    const Line corners = {corner(side[0]), corner(side[1]), corner(side[2]), corner(side[3])};
    for (const auto &t : edge > 0 ? in_grid(corners, edge) : fan(corners)) out.push_back(t);
  }
  return out;
}

namespace {

Real length_of(const Vec3 &a, const Vec3 &b)
{
  return norm(b - a);
}

bool is_longer(const Vec3 &a, const Vec3 &b, Real edge)
{
  return length_of(a, b) > (1 + kSame) * edge;
}

// Returns the middle of an edge, with the same bits from either end.
Vec3 middle(const Vec3 &a, const Vec3 &b)
{
  return 0.5 * (a + b);
}

// Splits the edges that are too long. The winding stays.
void split(const std::array<Vec3, 3> &t, Real edge, Triangles &out)
{
  bool cut[3];
  for (int k = 0; k < 3; k++) cut[k] = is_longer(t[k], t[(k + 1) % 3], edge);
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

void add_cut(Line &to, const Vec3 &a, const Vec3 &b, Real edge)
{
  if (!is_longer(a, b, edge)) return to.push_back(b);
  check_triangles(Real(to.size()), edge);
  const Vec3 m = middle(a, b);
  add_cut(to, a, m, edge);
  add_cut(to, m, b, edge);
}

// A thin triangle in strips between its long edges, whose pieces are as long as it is wide at its end, or as the limit.
void add_thin(Triangles &to, const std::array<Vec3, 3> &t, Real edge)
{
  int tip = 0;    // across from the shortest edge
  for (int k = 1; k < 3; k++)
    if (length_of(t[(k + 1) % 3], t[(k + 2) % 3]) < length_of(t[(tip + 1) % 3], t[(tip + 2) % 3]))
      tip = k;
  const Vec3 &a = t[tip], &b = t[(tip + 1) % 3], &c = t[(tip + 2) % 3];
  const Real piece = std::max(edge, length_of(b, c));
  add_strip(to, cut({a, c}, piece), cut({a, b}, piece));
}

}    // namespace

Line cut(const Line &line, Real edge)
{
  Line out = {line[0]};
  for (std::size_t i = 0; i + 1 < line.size(); i++) add_cut(out, line[i], line[i + 1], edge);
  return out;
}

// A new edge is shorter than sqrt(3)/2 of the longest edge before, so that this ends.
Triangles refined(Triangles coarse, Real edge)
{
  // No triangle with edges so short has a larger area, so that too many are refused before the work.
  const Real largest = std::sqrt(Real(3)) / 4 * edge * edge;
  Real area = 0;
  for (const auto &[a, b, c] : coarse) area += norm(cross(b - a, c - a)) / 2;
  check_triangles(area / largest, edge);
  Triangles strips;
  for (const auto &t : coarse) add_thin(strips, t, edge);
  coarse = std::move(strips);
  for (std::size_t before = 0; before != coarse.size();) {
    before = coarse.size();
    Triangles finer;
    for (const auto &t : coarse) split(t, edge, finer);
    check_triangles(Real(finer.size()), edge);
    coarse = std::move(finer);
  }
  return coarse;
}

}    // namespace lsdcd
