// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "clump/sphere_union.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lsdcd {

namespace {

constexpr int kDegree = 3;    // highest power of the normal

// Integrals of x^a y^b z^c, for a + b + c up to 3, over a part of the unit sphere.
struct NormalMoments {
  std::array<std::array<std::array<Real, kDegree + 1>, kDegree + 1>, kDegree + 1> of = {};

  void add(Real times, const NormalMoments &m)
  {
    for (int a = 0; a <= kDegree; a++)
      for (int b = 0; a + b <= kDegree; b++)
        for (int c = 0; a + b + c <= kDegree; c++) of[a][b][c] += times * m.of[a][b][c];
  }
  // The integral of the product of components with these numbers, 0 to 2.
  template <class... Component>
  Real at(Component... component) const
  {
    int power[3] = {0, 0, 0};
    (power[component]++, ...);
    return of[power[0]][power[1]][power[2]];
  }
};

Real largest_difference(const NormalMoments &one, const NormalMoments &other)
{
  Real largest = 0;
  for (int a = 0; a <= kDegree; a++)
    for (int b = 0; a + b <= kDegree; b++)
      for (int c = 0; a + b + c <= kDegree; c++)
        largest = std::fmax(largest, std::fabs(one.of[a][b][c] - other.of[a][b][c]));
  return largest;
}

// Points and weights for an integral over 0 to 1 (Press et al., Numerical Recipes, section 4.6).
template <int N>
struct GaussLegendre {
  Real at[N], weight[N];

  GaussLegendre()
  {
    for (int i = 0; i < N; i++) {
      Real x = std::cos(kPi * (i + 0.75) / (N + 0.5)), slope = 1;
      for (int step = 0; step < 20; step++) {
        Real before = 0, value = 1;
        for (int k = 0; k < N; k++) {
          const Real next = ((2 * k + 1) * x * value - k * before) / (k + 1);
          before = value;
          value = next;
        }
        slope = N * (x * value - before) / (x * x - 1);
        x -= value / slope;
      }
      at[i] = 0.5 * (1 - x);
      weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};

// The part of a unit sphere that another one covers: normals whose component along the axis is at least `height`.
struct Cap {
  Vec3 axis;    // of length 1
  Real height;

  Real tilt() const { return std::hypot(axis.x, axis.y); }    // sine of the angle to z
};

// Integrates polynomials of the normal over what caps leave free of a unit sphere.
class ExposedPart {
 public:
  explicit ExposedPart(std::vector<Cap> caps) : caps_(std::move(caps)) {}

  NormalMoments integrate(Real &error)
  {
    find_heights();
    NormalMoments all;
    for (std::size_t i = 0; i + 1 < heights_.size(); i++)
      add_between(heights_[i], heights_[i + 1], 0, all, error);
    return all;
  }

 private:
  static constexpr Real kSame = 1e-13;         // heights that are one
  static constexpr Real kTolerance = 1e-10;    // between the two rules
  static constexpr int kMostHalvings = 40;

  // The heights at which arcs begin, end or meet: the highest and lowest points of each cap's rim, and the points in which two
  // rims meet that no third cap covers. Between them the integrand is smooth.
  void find_heights()
  {
    heights_ = {-1, 1};
    for (const Cap &cap : caps_) {
      const Real along = std::acos(std::clamp(cap.axis.z, Real(-1), Real(1))),
                 wide = std::acos(std::clamp(cap.height, Real(-1), Real(1)));
      heights_.push_back(std::cos(along - wide));
      heights_.push_back(std::cos(along + wide));
    }
    for (std::size_t i = 0; i < caps_.size(); i++)
      for (std::size_t j = i + 1; j < caps_.size(); j++) add_meeting(i, j);
    std::sort(heights_.begin(), heights_.end());
    const auto same = [](Real a, Real b) { return b - a < kSame; };
    heights_.erase(std::unique(heights_.begin(), heights_.end(), same), heights_.end());
    heights_.back() = 1;
  }
  void add_meeting(std::size_t i, std::size_t j)
  {
    const Cap &one = caps_[i], &other = caps_[j];
    const Vec3 across = cross(one.axis, other.axis);
    const Real sine_sq = norm_sq(across), cosine = dot(one.axis, other.axis);
    if (!(sine_sq > kSame)) return;
    const Real a = (one.height - cosine * other.height) / sine_sq,
               b = (other.height - cosine * one.height) / sine_sq,
               rest = 1 - a * one.height - b * other.height;
    if (!(rest > 0)) return;
    const Vec3 middle = a * one.axis + b * other.axis, away = std::sqrt(rest / sine_sq) * across;
    for (const Vec3 &point : {middle + away, middle - away})
      if (!is_covered(point, i, j)) heights_.push_back(point.z);
  }
  bool is_covered(const Vec3 &point, std::size_t i, std::size_t j) const
  {
    for (std::size_t k = 0; k < caps_.size(); k++)
      if (k != i && k != j && dot(point, caps_[k].axis) > caps_[k].height + kSame) return true;
    return false;
  }

  void add_between(Real from, Real to, int halvings, NormalMoments &all, Real &error)
  {
    const NormalMoments few = by_rule(few_, from, to), many = by_rule(many_, from, to);
    const Real difference = largest_difference(few, many);
    if (difference > kTolerance && halvings < kMostHalvings && to - from > kSame) {
      const Real middle = 0.5 * (from + to);
      add_between(from, middle, halvings + 1, all, error);
      add_between(middle, to, halvings + 1, all, error);
      return;
    }
    all.add(1, many);
    error += difference;
  }
  // An arc begins as the square root of the height from there: steps in the cosine make that smooth.
  template <int N>
  NormalMoments by_rule(const GaussLegendre<N> &rule, Real from, Real to)
  {
    NormalMoments sum;
    const Real half = 0.5 * (to - from);
    for (int i = 0; i < N; i++) {
      // 1 - cos and 1 + cos, without the cancellation near the ends.
      const Real sine = std::sin(0.5 * kPi * rule.at[i]), cosine = std::cos(0.5 * kPi * rule.at[i]);
      const Real height =
          rule.at[i] < 0.5 ? from + 2 * half * sine * sine : to - 2 * half * cosine * cosine;
      sum.add(rule.weight[i] * half * kPi * 2 * sine * cosine, at_height(height));
    }
    return sum;
  }

  // Integrates over the exposed arcs of the circle at one height.
  NormalMoments at_height(Real z)
  {
    const Real radius = std::sqrt(std::fmax(0, (1 - z) * (1 + z)));
    Real arc[kDegree + 1][kDegree + 1] = {};    // of cos^a sin^b
    if (!find_covered(z, radius)) return {};
    Real free_from = 0;
    for (const auto &[from, to] : covered_) {
      if (from > free_from) add_arc(free_from, from, arc);
      free_from = std::fmax(free_from, to);
    }
    if (free_from < 2 * kPi) add_arc(free_from, 2 * kPi, arc);
    NormalMoments m;
    Real across = 1;    // radius^(a + b)
    for (int degree = 0; degree <= kDegree; degree++, across *= radius)
      for (int a = 0; a <= degree; a++) {
        Real up = across * arc[a][degree - a];
        for (int c = 0; c + degree <= kDegree; c++, up *= z) m.of[a][degree - a][c] = up;
      }
    return m;
  }
  // Finds the covered arcs as angles from 0 to 2 pi, by their beginning. False: the whole circle is covered.
  bool find_covered(Real z, Real radius)
  {
    covered_.clear();
    for (const Cap &cap : caps_) {
      const Real above = cap.height - z * cap.axis.z, reach = radius * cap.tilt();
      if (above >= reach) continue;
      if (above <= -reach) return false;
      const Real half = std::acos(above / reach);
      Real from = std::atan2(cap.axis.y, cap.axis.x) - half;
      if (from < 0) from += 2 * kPi;
      const Real to = from + 2 * half;
      covered_.push_back({from, std::fmin(to, 2 * kPi)});
      if (to > 2 * kPi) covered_.push_back({0, to - 2 * kPi});
    }
    std::sort(covered_.begin(), covered_.end());
    return true;
  }
  static void add_arc(Real from, Real to, Real (&arc)[kDegree + 1][kDegree + 1])
  {
    const auto add = [&](Real angle, Real sign) {
      const Real c = std::cos(angle), s = std::sin(angle);
      arc[0][0] += sign * angle;
      arc[1][0] += sign * s;
      arc[0][1] -= sign * c;
      arc[2][0] += sign * 0.5 * (angle + s * c);
      arc[0][2] += sign * 0.5 * (angle - s * c);
      arc[1][1] += sign * 0.5 * s * s;
      arc[3][0] += sign * (s - s * s * s / 3);
      arc[2][1] -= sign * c * c * c / 3;
      arc[1][2] += sign * s * s * s / 3;
      arc[0][3] += sign * (c * c * c / 3 - c);
    };
    add(to, 1);
    add(from, -1);
  }

  static const GaussLegendre<8> few_;
  static const GaussLegendre<16> many_;
  std::vector<Cap> caps_;
  std::vector<Real> heights_;
  std::vector<std::array<Real, 2>> covered_;
};

const GaussLegendre<8> ExposedPart::few_;
const GaussLegendre<16> ExposedPart::many_;

std::vector<Cap> caps_on(const std::vector<Ball> &balls, std::size_t i)
{
  std::vector<Cap> caps;
  const Real r = balls[i].radius;
  for (std::size_t j = 0; j < balls.size(); j++) {
    const Vec3 to = balls[j].centre - balls[i].centre;
    const Real s = balls[j].radius, apart_sq = norm_sq(to);
    if (j == i || apart_sq >= (r + s) * (r + s)) continue;
    const Real apart = std::sqrt(apart_sq);
    const Real height = ((r - s) * (r + s) / apart + apart) / (2 * r);
    if (height < 1) caps.push_back({(1 / apart) * to, height});
  }
  return caps;
}

// The integrals over the surface that make the union's, about a point near it.
struct SurfaceSums {
  Real volume = 0, first[3] = {}, second[3][3] = {};
  Real component[3][3] = {};    // of x_j n_k

  // `c`: the centre from that point.
  void add(const NormalMoments &m, const Vec3 &c, Real r)
  {
    const Real area = r * r;
    Real along = r * m.at();    // of p.n, where p is the point of the surface
    for (int l = 0; l < 3; l++) along += c[l] * m.at(l);
    volume += area / 3 * along;
    for (int k = 0; k < 3; k++) {
      // Of n_k p.n.
      Real with_k = r * m.at(k);
      for (int l = 0; l < 3; l++) with_k += c[l] * m.at(k, l);
      first[k] += area / 4 * (c[k] * along + r * with_k);
      for (int j = 0; j < 3; j++) {
        component[j][k] += area * (c[j] * m.at(k) + r * m.at(j, k));
        Real with_j = r * m.at(j), with_both = r * m.at(j, k);
        for (int l = 0; l < 3; l++) {
          with_j += c[l] * m.at(j, l);
          with_both += c[l] * m.at(j, k, l);
        }
        second[j][k] +=
            area / 5 *
            (c[j] * c[k] * along + r * (c[j] * with_k + c[k] * with_j) + r * r * with_both);
      }
    }
  }
  Real not_closed() const
  {
    Real most = 0;
    for (int j = 0; j < 3; j++)
      for (int k = 0; k < 3; k++)
        most = std::fmax(most, std::fabs(component[j][k] - (j == k ? volume : 0)));
    return most / volume;
  }
};

}    // namespace

std::size_t remove_covered(std::vector<Ball> &balls)
{
  const auto covers = [&](std::size_t i, std::size_t j) {
    const Real spare = balls[i].radius - balls[j].radius;
    if (!(spare >= 0) || norm_sq(balls[i].centre - balls[j].centre) > spare * spare) return false;
    return spare > 0 || i < j;
  };
  std::vector<Ball> kept;
  for (std::size_t j = 0; j < balls.size(); j++) {
    bool is_covered = false;
    for (std::size_t i = 0; i < balls.size() && !is_covered; i++)
      is_covered = i != j && covers(i, j);
    if (!is_covered) kept.push_back(balls[j]);
  }
  const std::size_t removed = balls.size() - kept.size();
  balls = std::move(kept);
  return removed;
}

SphereUnion union_of(const std::vector<Ball> &balls, Real density)
{
  Vec3 origin = {0, 0, 0};
  for (const Ball &b : balls) origin += (1 / static_cast<Real>(balls.size())) * b.centre;
  SurfaceSums sums;
  Real differences = 0;
  for (std::size_t i = 0; i < balls.size(); i++) {
    Real error = 0;
    sums.add(ExposedPart(caps_on(balls, i)).integrate(error), balls[i].centre - origin,
             balls[i].radius);
    differences += error * balls[i].radius * balls[i].radius *
                   (balls[i].radius + norm(balls[i].centre - origin));
  }
  SphereUnion u;
  u.error = std::fmax(differences / sums.volume, sums.not_closed());
  MassProperties &p = u.properties;
  p.mass = density * sums.volume;
  const Vec3 to_centre = (1 / sums.volume) * Vec3{sums.first[0], sums.first[1], sums.first[2]};
  p.centre = origin + to_centre;
  const auto about_centre = [&](int j, int k) {
    return density * (0.5 * (sums.second[j][k] + sums.second[k][j]) -
                      sums.volume * to_centre[j] * to_centre[k]);
  };
  const Real x2 = about_centre(0, 0), y2 = about_centre(1, 1), z2 = about_centre(2, 2);
  p.inertia = {y2 + z2,
               x2 + z2,
               x2 + y2,
               0 - about_centre(0, 1),
               0 - about_centre(0, 2),
               0 - about_centre(1, 2)};
  return u;
}

Real radius_around(const std::vector<Ball> &balls, const Vec3 &point)
{
  Real radius = 0;
  for (const Ball &b : balls) radius = std::fmax(radius, norm(b.centre - point) + b.radius);
  return radius;
}

}    // namespace lsdcd
