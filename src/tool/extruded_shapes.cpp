// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Drum and screw.
#include "tool/shapes.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

void append(Triangles &to, const Triangles &more)
{
  to.insert(to.end(), more.begin(), more.end());
}

void append_reversed(Triangles &to, const Triangles &more)
{
  for (const auto &t : more) to.push_back({t[0], t[2], t[1]});
}

Line at_y(Line line, Real y)
{
  for (Vec3 &p : line) p.y = y;
  return line;
}

// The drum's outline at y = 0, from one lifter to the next, in pieces: the lifter, then the gap
// after it, each from its first to its last point.
struct DrumOutline {
  std::vector<Line> lifters, gaps;
};

DrumOutline drum_outline(const DrumShape &d)
{
  DrumOutline outline;
  const int n = std::max(1, d.lifters);
  const Real half = d.lifters > 0 ? std::asin(d.width / 2 / d.radius) : 0;
  const Real foot = d.radius * std::cos(half), tip = d.radius - d.height;
  const auto lifter_point = [&](int k, Real r, Real t) -> Vec3 {
    const Real turn = 2 * kPi * (k % n) / n;
    return {r * std::cos(turn) - t * std::sin(turn), 0, r * std::sin(turn) + t * std::cos(turn)};
  };
  const int pieces =
      std::max(d.lifters > 0 ? 2 : 3,
               static_cast<int>(std::lround(d.segments * (2 * kPi / n - 2 * half) / (2 * kPi))));
  for (int k = 0; k < n; k++) {
    const Real w = d.width / 2;
    if (d.lifters > 0)
      outline.lifters.push_back({lifter_point(k, foot, -w), lifter_point(k, tip, -w),
                                 lifter_point(k, tip, w), lifter_point(k, foot, w)});
    Line gap;
    for (int i = 0; i <= pieces; i++) {
      const Real turn = 2 * kPi * k / n + half + (2 * kPi / n - 2 * half) * i / pieces;
      gap.push_back({d.radius * std::cos(turn), 0, d.radius * std::sin(turn)});
    }
    gap.front() = d.lifters > 0 ? lifter_point(k, foot, w) : Vec3{d.radius, 0, 0};
    gap.back() = d.lifters > 0 ? lifter_point(k + 1, foot, -w) : gap.front();
    outline.gaps.push_back(gap);
  }
  return outline;
}

// Columns along y between points of the outline, which is cut as refined() cuts it in the ends.
void add_wall(Triangles &to, const DrumShape &d, const DrumOutline &outline)
{
  Line round;
  for (std::size_t k = 0; k < outline.gaps.size(); k++)
    for (const auto *lines : {&outline.lifters, &outline.gaps}) {
      if (lines->empty()) continue;
      const Line line = cut((*lines)[k], d.edge);
      round.insert(round.end(), line.begin(), line.end() - 1);    // the last begins the next line
    }
  const int n = static_cast<int>(round.size());
  Real width = 0;
  for (int j = 0; j < n; j++) width = std::max(width, norm(round[(j + 1) % n] - round[j]));
  // In wider columns refined() splits the edges across.
  const Rows rows = rows_between(std::min(width, kAcross * d.edge), d.length, d.edge);
  check_triangles(Real(rows.n) * n, d.edge);
  const auto line = [&](int j) {
    const Vec3 &a = round[j % n];
    return column(a, {a.x, d.length, a.z}, rows, j % n % 2 != 0);
  };
  for (int j = 0; j < n; j++) add_strip(to, line(j + 1), line(j));
}

// The end at y = 0, in triangles of three kinds: inside the lifters' tips all round the axis; and
// from the middle of each gap to its arc, the sides of its lifters and the line between their tips.
Triangles drum_end(const DrumOutline &outline)
{
  Line inner;
  Triangles out;
  const std::size_t n = outline.gaps.size();
  for (std::size_t k = 0; k < n; k++) {
    const Line &gap = outline.gaps[k];
    if (outline.lifters.empty()) {
      inner = gap;
      break;
    }
    const Line &before = outline.lifters[k], &after = outline.lifters[(k + 1) % n];
    inner.insert(inner.end(), {before[1], before[2]});
    // Convex, from the middle of the arc onwards.
    const std::size_t middle = gap.size() / 2;
    Line round(gap.begin() + static_cast<std::ptrdiff_t>(middle), gap.end());
    round.insert(round.end(), {after[1], before[2]});
    round.insert(round.end(), gap.begin(), gap.begin() + static_cast<std::ptrdiff_t>(middle));
    append(out, fan(round));
  }
  if (!outline.lifters.empty()) inner.push_back(inner.front());
  for (std::size_t i = 0; i + 1 < inner.size(); i++)
    out.push_back({Vec3{0, 0, 0}, inner[i], inner[i + 1]});
  return out;
}

// A screw: the blade's bands cross each column of the shaft, between two lines along the axis,
// `turns` times, so that a column is a pile of shaft and blade.
class Screw {
 public:
  explicit Screw(const ScrewShape &shape) : s_(shape) {}

  Triangles all() const
  {
    Triangles out;
    for (int j = 0; j < s_.segments; j++) {
      for (int k = 0; k <= s_.turns; k++) append(out, shaft(j, k));
      for (int k = 0; k < s_.turns; k++) append(out, blade(j, k));
    }
    append(out, blade_end(0));
    append_reversed(out, blade_end(s_.turns * s_.segments));
    Line low, high;
    for (int j = 0; j < s_.segments; j++) {
      low.push_back(on_shaft(j, 0));
      high.push_back(on_shaft(j, length()));
    }
    append_reversed(out, disc(low, {0, 0, 0}));
    append(out, disc(high, {0, length(), 0}));
    return out;
  }

 private:
  Real length() const { return 2 * s_.stub + s_.pitch * s_.turns + s_.thickness; }

  // Right-handed about y, from z on.
  Vec3 point(Real r, int j, Real y) const
  {
    const Real turn = 2 * kPi * (j % s_.segments) / s_.segments;
    return {r * std::sin(turn), y, r * std::cos(turn)};
  }
  Vec3 on_shaft(int j, Real y) const { return point(s_.shaft, j, y); }

  // The blade's lower face at station j, from 0 to turns * segments, and its upper one.
  Real low(int j) const { return s_.stub + s_.pitch * j / s_.segments; }
  Real high(int j) const { return low(j) + s_.thickness; }

  // Column j of the shaft below winding k of the blade; k = turns: above all.
  Triangles shaft(int j, int k) const
  {
    return joined(shaft_line(j, j, k, false), shaft_line(j + 1, j, k, true));
  }
  // Its boundary at line i, upwards. Where the blade begins and ends, its foot is in between.
  Line shaft_line(int i, int j, int k, bool right) const
  {
    const int on = i + k * s_.segments;    // station of the winding above
    Line line;
    if (k == 0) line.push_back(on_shaft(i, 0));
    if (k == 0 && right && j + 1 == s_.segments) {
      line.push_back(on_shaft(i, low(0)));
      line.push_back(on_shaft(i, high(0)));
    }
    if (k > 0) line.push_back(on_shaft(i, high(on - s_.segments)));
    if (k < s_.turns) line.push_back(on_shaft(i, low(on)));
    if (k == s_.turns && !right && j == 0) {
      line.push_back(on_shaft(i, low(on)));
      line.push_back(on_shaft(i, high(on)));
    }
    if (k == s_.turns) line.push_back(on_shaft(i, length()));
    return line;
  }

  // Lower face, tip and upper face.
  Triangles blade(int j, int k) const
  {
    const int on = j + k * s_.segments;
    const Line left = rim(on), right = rim(on + 1);
    if (s_.edge == 0) return between(left, right);
    Triangles out;
    for (std::size_t i = 0; i + 1 < left.size(); i++)
      append(out, joined({left[i], left[i + 1]}, {right[i], right[i + 1]}));
    return out;
  }
  // Between straight lines.
  Triangles joined(const Line &left, const Line &right) const
  {
    if (s_.edge == 0) return between(left, right);
    Triangles out;
    add_strip(out, cut(left, s_.edge), cut(right, s_.edge));
    return out;
  }
  Line rim(int on) const
  {
    return {on_shaft(on, low(on)), point(s_.radius, on, low(on)), point(s_.radius, on, high(on)),
            on_shaft(on, high(on))};
  }
  Triangles blade_end(int on) const { return fan(rim(on)); }

  static Triangles disc(const Line &ring, const Vec3 &centre)
  {
    Triangles out;
    for (std::size_t i = 0; i < ring.size(); i++)
      out.push_back({centre, ring[i], ring[(i + 1) % ring.size()]});
    return out;
  }

  ScrewShape s_;
};

}    // namespace

Triangles drum_shape(const DrumShape &drum)
{
  const DrumOutline outline = drum_outline(drum);
  Triangles out;
  if (drum.edge > 0)
    add_wall(out, drum, outline);
  else
    for (const auto *lines : {&outline.gaps, &outline.lifters})
      for (const Line &line : *lines) append(out, between(line, at_y(line, drum.length)));
  if (!drum.closed) return out;
  Triangles end = drum_end(outline);
  append(out, end);
  for (auto &t : end)
    for (Vec3 &p : t) p.y = drum.length;
  append_reversed(out, end);
  return out;
}

Triangles screw_shape(const ScrewShape &screw)
{
  return Screw(screw).all();
}

}    // namespace lsdcd
