// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The least signed distance from a grain to a plane, a line, a segment and a triangle, in the grain's frame.
//
// A normal n across a plane or line gives n.y - h(n) as a lower bound of the signed distance on all of it. The largest such
// bound is the minimum where a point has that signed distance: the foot, its height below the point of the surface with the
// normal n. It has where the overlap is less than rho, and outside; else nearest_on_surface() tells.
#pragma once

#include "shape/nearest_on_surface.h"

namespace lsdcd {

// The part of a triangle on which its minimum is: its inside, edge k from corner k to the next one, or corner k.
enum class TrianglePart { face, edge, corner };

struct ShapeMinimum {
  Real distance;    // signed; HUGE_VAL: none is below the limit
  Vec3 normal;      // unit, out of the grain
  Vec3
      gradient;    // one of the signed distance that lets nothing fall on its plane, line or point: the normal, or a mean of two
  Vec3 foot;       // the point of the plane, line or triangle
  TrianglePart part;
  int k;
  // The overlap is less than rho, so that the signed distance has one gradient there; or it is of a tangent of a contact.
  bool is_smooth;
  bool is_sure;    // of nearest_on_surface()
};

LSDCD_FN ShapeMinimum no_minimum()
{
  return {HUGE_VAL, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, TrianglePart::face, 0, true, true};
}

// The highest tangent plane of one direction or more, a lower bound of the minimum.
struct TangentMinimum {
  Real distance;
  Vec3 normal, foot;
  bool is_highest;    // else the search for it has ended elsewhere
};

// Is the bound the minimum? To be asked where the overlap is not less than rho.
LSDCD_FN bool is_minimum(const Superellipsoid &s, const TangentMinimum &t)
{
  if (!t.is_highest) return false;
  const SurfacePoint there = nearest_on_surface(s, t.foot);
  return there.is_sure && fabs(there.distance - t.distance) <= 4 * on_surface(s);
}

// Is a point in the grain less deep than rho? Then the signed distance has one gradient there, and that of a deeper tangent over it is
// another one.
LSDCD_FN bool is_shallow(const Superellipsoid &s, const Vec3 &y)
{
  // The inscribed sphere around the centre holds one around y.
  if (!((1 - gauge_value(s, y)) * s.nearest < s.rho)) return false;
  const SurfacePoint p = nearest_on_surface(s, y);
  return p.is_sure && -p.distance < s.rho;
}

// Is it that of a contact: by the highest bound, at a foot in the grain, and there not less deep than rho? To be asked where the overlap
// is not less than rho; else it is.
LSDCD_FN bool is_contact(const Superellipsoid &s, const TangentMinimum &t)
{
  return t.is_highest && gauge_value(s, t.foot) < 1 && !is_shallow(s, t.foot);
}

// Returns the tangent plane over the plane through y with the unit normal n.
LSDCD_FN TangentMinimum tangent_over_plane(const Superellipsoid &s, const Vec3 &y, const Vec3 &n)
{
  TangentMinimum t;
  const Real height = dot(n, y);
  t.normal = height < 0 ? -n : n;
  const SupportPlane plane = support(s, t.normal);
  t.distance = fabs(height) - plane.height;
  t.foot = plane.point + t.distance * t.normal;
  t.is_highest = true;
  return t;
}

// The highest tangent of a grain that is parallel to a line, by the angle of its normal about the line.
class TangentAboutLine {
 public:
  // y: a point of the line; along: its unit direction.
  LSDCD_FN TangentAboutLine(const Superellipsoid &s, const Vec3 &y, const Vec3 &along) :
      s_(s), along_(along), y_(y - dot(y, along) * along), one_(any_perpendicular(along)),
      two_(cross(along, one_))
  {
  }

  LSDCD_FN TangentMinimum find()
  {
    if (s_.is_ellipsoid()) {
      if (follow_shadow() && polish() && is_only()) return tangent(true);
      start_at_shadow();
      if (polish()) return tangent(true);
    } else {
      if (follow_gauge() && is_only()) return tangent(true);
      start_at_gauge();
    }
    return tangent(refine());
  }

 private:
  LSDCD_FN TangentMinimum tangent(bool is_highest) const
  {
    // The foot is on the line: along it it is under the point of the surface.
    return {-depth_, normal_, y_ + dot(along_, point_) * along_, is_highest};
  }
  // The shadow of an ellipsoid along the line is an ellipse.
  LSDCD_FN void start_at_shadow()
  {
    Real p = 0, q = 0, r = 0, product = 0;
    for (int k = 0; k < 3; k++) {
      const Real square = s_.half[k] * s_.half[k];
      p += square * one_[k] * one_[k];
      q += square * one_[k] * two_[k];
      r += square * two_[k] * two_[k];
      const Real others = s_.half[k == 0 ? 1 : 0] * s_.half[k == 2 ? 1 : 2] * along_[k];
      product += others * others;    // of the squares of its half-axes
    }
    const Real spread = hypot_of(Real(0.5) * (p - r), q), square = (p + r) / 2 + spread;
    const Real large = sqrt(square), small = sqrt(product) / large;
    // The direction of the larger one: of two forms the one without cancellation.
    const Real u = p >= r ? Real(0.5) * (p - r) + spread : q,
               v = p >= r ? q : Real(0.5) * (r - p) + spread;
    turn_axes(u, v);
    if (!(small > 0)) return;
    const Vec3 n =
        nearest_on_ellipsoid({large, small, large}, {dot(one_, y_), dot(two_, y_), 0}).normal;
    turn_axes(n.x, n.y);
  }
  // Is the tangent that was found the highest because its overlap is less than rho? A shadow has no smaller radii of curvature
  // than its body, so that there is one such tangent, as there is one nearest point of that depth.
  LSDCD_FN bool is_only() const { return depth_ < s_.rho; }

  // Takes Newton's steps where they are as short as the rounding of a start, the last one without another plane; returns false
  // where they are longer.
  LSDCD_FN bool polish()
  {
    constexpr int kMostSteps = 4;
    constexpr Real kLongest = 1e-6, kLast = 1e-9;
    for (int i = 0; i < kMostSteps; i++) {
      normal_ = one_;
      turn_ = two_;
      const SupportPlane plane = support(s_, normal_);
      point_ = plane.point;
      depth_ = plane.height - dot(normal_, y_);
      slope_ = dot(turn_, point_ - y_);
      const Vec3 u = scaled(turn_);
      const Real along = dot(turn_, point_), over = 1 / plane.height;
      bend_ = (norm_sq(u) - along * along) * over - depth_;
      const Real step = -slope_ / bend_;
      if (!(bend_ > 0) || !(fabs(step) <= kLongest)) return false;
      if (fabs(step) <= kLast * (s_.nearest / s_.farthest)) {
        const Vec3 way = scaled(u);
        normal_ += step * turn_;
        point_ += (step * over) * (way - along * point_);
        return true;
      }
      turn_axes(1, step);
    }
    return true;
  }
  // Follows the angle downhill on the shadow of an ellipsoid, an ellipse with the matrix (p, q; q, r), from its normal under
  // the line; returns false where that is not found soon.
  LSDCD_FN bool follow_shadow()
  {
    constexpr int kMostSteps = 6;
    constexpr Real kShort = 1e-4;    // the square of the next step is below its rounding
    Real p = 0, q = 0, r = 0, det = 0;
    for (int k = 0; k < 3; k++) {
      const Real u = s_.half[k] * one_[k], v = s_.half[k] * two_[k];
      p += u * u;
      q += u * v;
      r += v * v;
      const Real others = s_.half[k == 0 ? 1 : 0] * s_.half[k == 2 ? 1 : 2] * along_[k];
      det += others * others;
    }
    const Real y = dot(one_, y_), z = dot(two_, y_);
    // Over p + r, whose square is in the range of Real.
    const Real less = 1 / (p + r);
    Real c = less * r * y - less * q * z, s = less * p * z - less * q * y;
    const Real size = hypot_of(c, s);
    if (!(size > 0)) return false;
    const Real scale = 1 / size;
    c *= scale;
    s *= scale;
    for (int i = 0; i < kMostSteps; i++) {
      const Real a = p * c + q * s, b = q * c + r * s, square = c * a + s * b;
      const Real over = 1 / sqrt(square);
      const Real slope = (c * b - s * a) * over - (c * z - s * y),
                 depth = square * over - (c * y + s * z);
      const Real bend = det * (over * over * over) - depth, step = -slope / bend;
      if (!(bend > 0) || !(fabs(step) <= kLongestTurn)) return false;
      const Turn by(step);
      const Real turned = c * by.cosine - s * by.sine;
      s = s * by.cosine + c * by.sine;
      c = turned;
      if (fabs(step) <= kShort) {
        turn_axes(c, s);
        return true;
      }
    }
    return false;
  }

  // A turn by an angle up to kLongestTurn; its lengths are right to 2e-9.
  struct Turn {
    Real cosine, sine;
    LSDCD_FN explicit Turn(Real angle)
    {
      const Real square = angle * angle;
      cosine = 1 - square / 2 * (1 - square / 12 * (1 - square / 30));
      sine = angle * (1 - square / 6 * (1 - square / 20 * (1 - square / 42)));
    }
  };
  static constexpr Real kLongestTurn = 0.3;

  // Returns (1 + x)^a for 0 < a <= 1.
  LSDCD_FN static Real power_near_one(Real x, Real a)
  {
    // The series lacks its ninth power times a factor below 0.014, which is a rounding.
    constexpr Real kSmall = 0.03;
    if (!(fabs(x) < kSmall)) return pow(1 + x, a);
    Real sum = 1;
    for (int k = 7; k > 0; k--) sum = 1 + (a - k) * (Real(1) / (k + 1)) * x * sum;
    return 1 + a * x * sum;
  }

  // Follows the angle downhill from the normal that the gauge has where it is least on the line. There the point of the surface
  // with that normal is known. A turn changes the numbers whose roots are its coordinates by little, so that the
  // roots follow without powers. Returns false where they do not, as beside a flat side.
  LSDCD_FN bool follow_gauge()
  {
    constexpr int kMostTurns = 12;
    constexpr Real kLast = 1e-8;    // a change of numbers, of which the square is below rounding
    const Real root1 = 1 / (s_.n1 - 1), root2 = 1 / (s_.n2 - 1);
    Vec3 x, u;    // the point over the half-axes; the normal times them, of any length
    if (!least_gauge(x, u)) return false;
    one_ = {u.x / s_.half.x, u.y / s_.half.y, u.z / s_.half.z};
    const Real size = norm(one_);
    u = (1 / size) * u;
    one_ = (1 / size) * one_;
    one_ -= dot(one_, along_) * along_;
    one_ = (1 / norm(one_)) * one_;
    two_ = cross(along_, one_);
    Vec3 inverse = {1 / u.x, 1 / u.y, 1 / u.z};
    for (int i = 0; i < kMostTurns; i++) {
      const Vec3 now = scaled(one_);
      const Vec3 change = {change_of(now.x, u.x, inverse.x), change_of(now.y, u.y, inverse.y),
                           change_of(now.z, u.z, inverse.z)};
      constexpr Real kMostChange = 0.9;
      if (!(fabs(change.x) < kMostChange && fabs(change.y) < kMostChange &&
            fabs(change.z) < kMostChange))
        return false;
      const bool is_last =
          i > 0 && fabs(change.x) < kLast && fabs(change.y) < kLast && fabs(change.z) < kLast;
      const Real before = dot(u, x);
      const Vec3 root = {power_near_one(change.x, root2), power_near_one(change.y, root2),
                         power_near_one(change.z, root1)};
      if (s_.n1 == s_.n2) {
        x = {root.x * x.x, root.y * x.y, root.z * x.z};
      } else {
        const Real plane_before = u.x * x.x + u.y * x.y;
        x.x *= root.x;
        x.y *= root.y;
        const Real grown = (now.x * x.x + now.y * x.y) / plane_before - 1,
                   less = 1 / power_near_one(grown, 1 / s_.n2),
                   scale = less * power_near_one((grown + 1) * less - 1, root1);
        x = {scale * x.x, scale * x.y, root.z * x.z};
      }
      x = (1 / power_near_one(dot(now, x) / before - 1, 1 / s_.n1)) * x;
      u = now;
      normal_ = one_;
      point_ = scaled(x);
      const Real height = dot(u, x);
      depth_ = height - dot(normal_, y_);
      if (is_last) {
        const Real length = norm(normal_);
        normal_ = (1 / length) * normal_;
        depth_ /= length;
        return true;
      }
      inverse = {1 / u.x, 1 / u.y, 1 / u.z};
      turn_ = two_;
      slope_ = dot(turn_, point_ - y_);
      const Vec3 turn = scaled(turn_);
      const Real plane = u.x * x.x + u.y * x.y, in_plane = turn.x * x.x + turn.y * x.y,
                 all = in_plane + turn.z * x.z;
      const Real share = plane > 0 ? in_plane * in_plane / plane : 0;
      bend_ = root1 * (share + bend_of(turn.z, x.z, inverse.z) - all * all / height) +
              root2 * (bend_of(turn.x, x.x, inverse.x) + bend_of(turn.y, x.y, inverse.y) - share) -
              depth_;
      const Real step = -slope_ / bend_;
      if (!(bend_ > 0 && fabs(step) <= kLongestTurn)) return false;
      const Turn by(step);
      one_ = by.cosine * normal_ + by.sine * turn_;
      two_ = by.cosine * turn_ - by.sine * normal_;
    }
    return false;
  }
  // Returns by what share a number changes; one that is 0 may not.
  LSDCD_FN static Real change_of(Real now, Real before, Real inverse)
  {
    return now == before ? 0 : (now - before) * inverse;
  }
  LSDCD_FN static Real bend_of(Real turn, Real x, Real inverse)
  {
    return x == 0 ? 0 : turn * turn * (x * inverse);
  }
  LSDCD_FN Vec3 scaled(const Vec3 &v) const
  {
    return {s_.half.x * v.x, s_.half.y * v.y, s_.half.z * v.z};
  }

  // Finds about where the gauge is least on the line, and gives the point of the surface over it and the slope there, both over
  // the half-axes and the slope of any length; returns false where that is not found soon.
  LSDCD_FN bool least_gauge(Vec3 &x, Vec3 &slope) const
  {
    constexpr int kMostSteps = 12;
    constexpr Real kClose = 1e-2;
    const Real n1 = s_.n1, n2 = s_.n2, ratio = n1 / n2;
    const Vec3 inverse = {1 / s_.half.x, 1 / s_.half.y, 1 / s_.half.z};
    const Vec3 y = {inverse.x * y_.x, inverse.y * y_.y, inverse.z * y_.z},
               d = {inverse.x * along_.x, inverse.y * along_.y, inverse.z * along_.z};
    const Vec3 square = {d.x * d.x, d.y * d.y, d.z * d.z};
    Real t = -dot(y, d) / norm_sq(d);
    for (int i = 0; i < kMostSteps; i++) {
      x = y + t * d;
      const Vec3 p = {power_of(fabs(x.x), n2 - 2), power_of(fabs(x.y), n2 - 2),
                      power_of(fabs(x.z), n1 - 2)};
      slope = {p.x * x.x, p.y * x.y, p.z * x.z};
      const Real across = slope.x * x.x + slope.y * x.y;
      Real fall = d.x * slope.x + d.y * slope.y, bend = square.x * p.x + square.y * p.y;
      // The gauge to the power n1, and its derivatives over n1.
      Real power = across;
      if (n1 == n2) {
        bend *= n1 - 1;
      } else {
        const Real scale = power_of(across, ratio - 1);
        bend = scale * ((n1 - n2) * (fall * fall) / across + (n2 - 1) * bend);
        fall *= scale;
        power *= scale;
        slope.x *= scale;
        slope.y *= scale;
      }
      power += slope.z * x.z;
      fall += d.z * slope.z;
      bend += (n1 - 1) * (square.z * p.z);
      const Real step = -fall / bend;
      if (!(fabs(step) <= s_.farthest)) return false;
      if (fabs(step) <= kClose * s_.nearest) {
        x = (1 / power_near_one(power - 1, 1 / n1)) * x;
        return true;
      }
      t += step;
    }
    return false;
  }
  // The normal of the gauge at the point of the line that is nearest in the metric of the half-axes.
  LSDCD_FN void start_at_gauge()
  {
    one_ = any_perpendicular(along_);
    two_ = cross(along_, one_);
    Real across = 0, size = 0;
    for (int k = 0; k < 3; k++) {
      across += along_[k] / s_.half[k] * (y_[k] / s_.half[k]);
      size += along_[k] / s_.half[k] * (along_[k] / s_.half[k]);
    }
    const Vec3 n = gauge(s_, y_ - (across / size) * along_).slope;
    const Real u = dot(one_, n), v = dot(two_, n);
    if (u - u == 0 && v - v == 0) turn_axes(u, v);
  }
  // Turns the axes so that (u, v) is along the first.
  LSDCD_FN void turn_axes(Real u, Real v)
  {
    const Real size = hypot_of(u, v);
    if (!(size > 0)) return;
    const Real c = u / size, s = v / size;
    const Vec3 turned = c * one_ + s * two_;
    two_ = c * two_ - s * one_;
    one_ = turned;
  }
  LSDCD_FN static Real hypot_of(Real u, Real v) { return sqrt(u * u + v * v); }
  LSDCD_FN void evaluate(Real angle)
  {
    normal_ = cos(angle) * one_ + sin(angle) * two_;
    turn_ = cos(angle) * two_ - sin(angle) * one_;
    const Vec3 u = scaled(normal_);
    const NestedNorm h = nested_norm(u, s_.n1 / (s_.n1 - 1), s_.n2 / (s_.n2 - 1));
    point_ = scaled(h.slope);
    depth_ = h.value - dot(normal_, y_);
    slope_ = dot(turn_, point_ - y_);
    const Vec3 turned = scaled(turn_);
    bend_ = -depth_;
    for (int k = 0; k < 2; k++) {
      const Real part = dot(h.along[k], turned);
      bend_ += h.bend[k] * part * part;
    }
  }
  // Takes Newton's steps for slope = 0 from the angle 0, and within a bracket, once there is one, halves that where they do
  // not. On a flat side the bend is infinite, and just beside it Newton's steps are too long.
  LSDCD_FN bool refine()
  {
    constexpr int kMostSteps = 200;
    constexpr Real kLongest = 0.3, kSmallest = 2 * kRoundoff;
    Real low = -4, high = 4, angle = 0, width = HUGE_VAL;
    for (int i = 0; i < kMostSteps; i++) {
      evaluate(angle);
      if (slope_ == 0) return true;
      (slope_ < 0 ? low : high) = angle;
      end_[slope_ > 0] = {slope_, point_};
      const Real newton = -slope_ / bend_;
      const bool is_newton = bend_ > 0 && fabs(newton) <= kLongest;
      Real next = angle + (is_newton ? newton : (slope_ < 0 ? kLongest : -kLongest));
      if (low > -4 && high < 4) {
        // Every third step halves the bracket if the others have not.
        const bool is_slow = i % 3 == 0 && high - low > 0.5 * width;
        if (i % 3 == 0) width = high - low;
        if (is_slow || !(next > low && next < high)) next = low + 0.5 * (high - low);
        if (next == low || next == high || high - low <= kSmallest) {
          // The point runs over a flat side between the two ends.
          const Real share = end_[0].slope / (end_[0].slope - end_[1].slope);
          point_ = end_[0].point + share * (end_[1].point - end_[0].point);
          return true;
        }
      }
      if (is_newton && fabs(newton) <= kSmallest && fabs(slope_) <= on_surface(s_)) return true;
      if (next == angle) next += slope_ < 0 ? kSmallest : -kSmallest;
      if (!(fabs(next) <= kPi)) return false;
      angle = next;
    }
    return false;
  }

  const Superellipsoid &s_;
  const Vec3 along_, y_;
  Vec3 one_, two_, normal_, turn_, point_;
  Real depth_, slope_, bend_;
  struct End {
    Real slope;
    Vec3 point;
  } end_[2];    // of the bracket
};

// The least signed distance of a triangle.
class TriangleMinimum {
 public:
  // normal: of length 1, either way.
  LSDCD_FN TriangleMinimum(const Superellipsoid &s, const Vec3 (&corner)[3], const Vec3 &normal) :
      s_(s), normal_(normal)
  {
    for (int k = 0; k < 3; k++) {
      corner_[k] = corner[k];
      const Vec3 side = corner[k == 2 ? 0 : k + 1] - corner[k];
      inward_[k] = cross(normal, (1 / norm(side)) * side);
    }
    if (dot(inward_[0], corner[2] - corner[0]) < 0)
      for (Vec3 &inward : inward_) inward = -inward;
  }

  // Returns the minimum if it is less than `below`.
  LSDCD_FN ShapeMinimum find(Real below) const
  {
    const TangentMinimum plane = tangent_over_plane(s_, corner_[0], normal_);
    if (!(plane.distance < below)) return no_minimum();
    if (!is_less_deep(plane.distance)) return find_deep(plane, below);
    return find_by_tangent(plane, below);
  }
  // Returns the minimum as a contact has it, if it is less than 0: at any depth that of the tangent over the plane if its foot is
  // here, or in another triangle of the plane (`is_owned`), and is_contact(), and likewise that over a side. It counts as smooth.
  // Elsewhere, where the overlap is not less than rho, its normal is that of the gradient.
  LSDCD_FN ShapeMinimum find_contact(bool is_owned)
  {
    takes_tangents_ = true;
    const TangentMinimum plane = tangent_over_plane(s_, corner_[0], normal_);
    if (!(plane.distance < 0)) return no_minimum();
    if (is_less_deep(plane.distance) || is_owned ||
        (is_inside(plane.foot) && is_contact(s_, plane)))
      return find_by_tangent(plane, 0);
    ShapeMinimum least = find_deep(plane, 0);
    if (!least.is_smooth && least.distance < 0)
      least.normal = (1 / norm(least.gradient)) * least.gradient;
    return least;
  }

 private:
  LSDCD_FN bool is_inside(const Vec3 &foot) const
  {
    bool is = true;
    for (int k = 0; k < 3; k++) is &= dot(inward_[k], foot - corner_[k]) >= 0;
    return is;
  }
  LSDCD_FN ShapeMinimum find_by_tangent(const TangentMinimum &plane, Real below) const
  {
    // The distance falls towards the foot, so that the minimum is on a side that the foot is past.
    ShapeMinimum least = no_minimum();
    bool is_inside = true;
    for (int k = 0; k < 3; k++) {
      if (dot(inward_[k], plane.foot - corner_[k]) >= 0) continue;
      is_inside = false;
      keep_nearer(least, on_side(k, below));
    }
    if (!is_inside) return least;
    return on_face(plane);
  }

 public:
  // Returns the minimum of side k if it is less than `below`.
  LSDCD_FN ShapeMinimum on_side(int k, Real below) const
  {
    const int next = k == 2 ? 0 : k + 1;
    const Vec3 side = corner_[next] - corner_[k];
    const Real length = norm(side);
    const Vec3 along = (1 / length) * side;
    const TangentMinimum line = TangentAboutLine(s_, corner_[k], along).find();
    if (!(line.distance < below)) return no_minimum();
    const Real at = dot(line.foot - corner_[k], along);
    if (!(line.is_highest && is_less_deep(line.distance))) {
      if (!(takes_tangents_ && at > 0 && at < length && is_contact(s_, line)))
        return on_deep_side(k, line, along, length);
    }
    if (at <= 0) return on_corner(k);
    if (at >= length) return on_corner(next);
    return on_line(line, k);
  }

  LSDCD_FN ShapeMinimum on_corner(int k) const
  {
    return at_point(corner_[k], TrianglePart::corner, k);
  }

 private:
  LSDCD_FN bool is_less_deep(Real distance) const { return -distance < s_.rho; }
  LSDCD_FN static void keep_nearer(ShapeMinimum &least, const ShapeMinimum &other)
  {
    if (other.distance < least.distance) least = other;
  }
  LSDCD_FN ShapeMinimum at_point(const Vec3 &y, TrianglePart part, int k) const
  {
    const SurfacePoint p = nearest_on_surface(s_, y);
    return {p.distance, p.normal, p.normal, y, part, k, is_less_deep(p.distance), p.is_sure};
  }

  LSDCD_FN ShapeMinimum on_face(const TangentMinimum &plane) const
  {
    return {plane.distance,
            plane.normal,
            plane.normal,
            plane.foot,
            TrianglePart::face,
            0,
            takes_tangents_ || is_less_deep(plane.distance),
            true};
  }
  LSDCD_FN ShapeMinimum on_line(const TangentMinimum &line, int k) const
  {
    return {line.distance,
            line.normal,
            line.normal,
            line.foot,
            TrianglePart::edge,
            k,
            takes_tangents_ || is_less_deep(line.distance),
            true};
  }

  // The minimum on a side whose tangent need not be it: at an end that nothing falls from; or at the tangent if that is it; or
  // where the tangents at both ends of a bracket meet, or in its middle.
  LSDCD_FN ShapeMinimum on_deep_side(int k, const TangentMinimum &line, const Vec3 &along,
                                     Real length) const
  {
    constexpr int kMostSteps = 120;
    ShapeMinimum low = on_corner(k), high = on_corner(k == 2 ? 0 : k + 1);
    if (dot(low.normal, along) >= 0) return low;
    if (dot(high.normal, along) <= 0) return high;
    const Real tangent_at = dot(line.foot - corner_[k], along);
    if (tangent_at > 0 && tangent_at < length && is_minimum(s_, line)) return on_line(line, k);
    ShapeMinimum least = low;
    keep_nearer(least, high);
    Real from = 0, to = length;
    for (int i = 0; i < kMostSteps; i++) {
      const Real fall = dot(low.normal, along), rise = dot(high.normal, along);
      Real at = (low.distance - high.distance + rise * to - fall * from) / (rise - fall);
      const Real bound = low.distance + fall * (at - from);
      if (!(least.distance - bound > on_surface(s_)) || !(to - from > on_surface(s_))) break;
      if (i % 2 == 1 || !(at > from && at < to)) at = from + 0.5 * (to - from);
      const ShapeMinimum here = at_point(corner_[k] + at * along, TrianglePart::edge, k);
      keep_nearer(least, here);
      if (dot(here.normal, along) < 0)
        low = here, from = at;
      else
        high = here, to = at;
    }
    const Real fall = dot(low.normal, along), rise = dot(high.normal, along);
    least.gradient = low.normal + (fall / (fall - rise)) * (high.normal - low.normal);
    return least;
  }

  // Where the tangent plane need not be the minimum, that is on the sides if a gradient there shows that nothing falls
  // inwards. Else it is inside: the tangent if that is it.
  LSDCD_FN ShapeMinimum find_deep(const TangentMinimum &plane, Real below) const
  {
    ShapeMinimum least = no_minimum();
    for (int k = 0; k < 3; k++) keep_nearer(least, on_side(k, HUGE_VAL));
    if (!rises_inwards(least)) {
      if (is_inside(plane.foot) && is_minimum(s_, plane)) return on_face(plane);
      keep_nearer(least,
                  search_inside(plane.normal, fmin(below, least.distance - 4 * on_surface(s_))));
    }
    return least.distance < below ? least : no_minimum();
  }
  LSDCD_FN bool rises_inwards(const ShapeMinimum &at) const
  {
    constexpr Real kTilt = 64 * kRoundoff;
    if (at.part == TrianglePart::edge) return dot(at.gradient, inward_[at.k]) >= -kTilt;
    for (int k = 1; k < 3; k++) {
      const Vec3 side = corner_[(at.k + k) % 3] - corner_[at.k];
      if (!(dot(at.gradient, side) >= -kTilt * norm(side))) return false;
    }
    return true;
  }

  // Cuts off what a gradient shows to be farther than the least found, through the centroid of what is left: each cut takes
  // more than a third of the area. There the gradient is along the normal of the triangle; as the tangent's it is the one `away` from the centre.
  LSDCD_FN ShapeMinimum search_inside(const Vec3 &away, Real below) const
  {
    constexpr int kMostCuts = 160;
    struct Point {
      Real u, v;
    };
    const Vec3 along = cross(inward_[0], normal_);
    Point polygon[kMostCuts + 4], rest[kMostCuts + 4];
    int n = 3;
    for (int k = 0; k < 3; k++) {
      const Vec3 to = corner_[k] - corner_[0];
      polygon[k] = {dot(along, to), dot(inward_[0], to)};
    }
    ShapeMinimum least = no_minimum();
    least.distance = below;
    bool found = false;
    for (int cut = 0; cut < kMostCuts && n > 2; cut++) {
      Real area = 0, u = 0, v = 0;
      for (int i = 1; i + 1 < n; i++) {
        const Point &o = polygon[0], &a = polygon[i], &b = polygon[i + 1];
        const Real part = fabs((a.u - o.u) * (b.v - o.v) - (a.v - o.v) * (b.u - o.u));
        area += part;
        u += part * (o.u + a.u + b.u) / 3;
        v += part * (o.v + a.v + b.v) / 3;
      }
      if (!(area > 0)) break;
      const Point centre = {u / area, v / area};
      const ShapeMinimum here =
          at_point(corner_[0] + centre.u * along + centre.v * inward_[0], TrianglePart::face, 0);
      if (here.distance < least.distance) least = here, found = true;
      const Real gu = dot(here.normal, along), gv = dot(here.normal, inward_[0]);
      // What the gradient allows to be nearer than the least.
      const auto past = [&](const Point &p) {
        return here.distance - least.distance + gu * (p.u - centre.u) + gv * (p.v - centre.v);
      };
      int left = 0;
      Real nearest = 0;
      for (int i = 0; i < n; i++) {
        const Point &p = polygon[i], &q = polygon[i + 1 < n ? i + 1 : 0];
        const Real at_p = past(p), at_q = past(q);
        nearest = fmin(nearest, at_p);
        if (at_p <= 0) rest[left++] = p;
        if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
          const Real share = at_p / (at_p - at_q);
          rest[left++] = {p.u + share * (q.u - p.u), p.v + share * (q.v - p.v)};
        }
      }
      if (nearest >= -0.25 * on_surface(s_)) break;
      n = left;
      for (int i = 0; i < n; i++) polygon[i] = rest[i];
    }
    if (!found) return no_minimum();
    least.gradient = away;
    return least;
  }

  const Superellipsoid &s_;
  bool takes_tangents_ = false;
  Vec3 corner_[3], inward_[3];
  const Vec3 normal_;
};

}    // namespace lsdcd
