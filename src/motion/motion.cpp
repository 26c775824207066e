// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "motion/motion.h"

#include "base/quaternion.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

constexpr Real kTwoPi = 6.28318530717958647692;

// Sine and cosine of 2 pi t/period, exact at whole quarters. A timestep is a double, so that its
// products have a relative error of 2^-53: a time within that of a quarter counts as the quarter.
void sine_cosine(Time t, Real period, Real &sine, Real &cosine)
{
  const Time turns = std::fmod(t, Time(period)) / period;    // fmod is exact
  const Time quarters = std::floor(4 * turns + Time(0.5));
  Time rest = turns - quarters / 4;
  constexpr Time kUncertain = 2.3e-16L;
  if (std::fabs(rest) <= kUncertain * std::fabs(t / period)) rest = 0;
  const Real angle = kTwoPi * static_cast<Real>(rest);
  const Real s = rest == 0 ? 0 : std::sin(angle), c = rest == 0 ? 1 : std::cos(angle);
  const int quarter = (static_cast<int>(quarters) + 8) % 4;
  const Real turned[] = {s, c, -s, -c};
  sine = turned[quarter];
  cosine = turned[(quarter + 1) % 4];
}

struct Rotation {
  Vec3 row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

  Vec3 operator()(const Vec3 &a) const { return {dot(row[0], a), dot(row[1], a), dot(row[2], a)}; }
};

Rotation rotation(const Vec3 &k, Real s, Real c)
{
  Rotation r;
  if (s == 0 && c == 1) return r;
  const Real d = 1 - c;
  r.row[0] = {c + d * k.x * k.x, d * k.x * k.y - s * k.z, d * k.x * k.z + s * k.y};
  r.row[1] = {d * k.y * k.x + s * k.z, c + d * k.y * k.y, d * k.y * k.z - s * k.x};
  r.row[2] = {d * k.z * k.x - s * k.y, d * k.z * k.y + s * k.x, c + d * k.z * k.z};
  return r;
}

// An angular velocity and its derivative.
struct Rate {
  Vec3 velocity = {0, 0, 0}, acceleration = {0, 0, 0};
};

// Turns the pose about a point, with an angular velocity.
void turn(Pose &pose, const Vec3 &point, const Rotation &turned, const Rate &spin)
{
  const Vec3 &angular = spin.velocity;
  Vec3 row[3] = {};
  for (int j = 0; j < 3; j++) {    // columns of the product
    const Vec3 column = turned({pose.row[0][j], pose.row[1][j], pose.row[2][j]});
    for (int i = 0; i < 3; i++) row[i][j] = column[i];
  }
  std::copy(row, row + 3, pose.row);
  const Vec3 arm = turned(pose.shift - point), to_arm = cross(angular, arm),
             v = turned(pose.velocity), w = turned(pose.angular);
  pose.shift = turned(pose.shift) + (point - turned(point));
  pose.acceleration = turned(pose.acceleration) + cross(angular, 2 * v + to_arm);
  pose.spin_up = turned(pose.spin_up) + cross(angular, w);
  if (!(spin.acceleration == Vec3{0, 0, 0})) {
    pose.acceleration += cross(spin.acceleration, arm);
    pose.spin_up += spin.acceleration;
  }
  pose.velocity = v + to_arm;
  pose.angular = w + angular;
}

// Turns it about an axis by an angle with sine s and cosine c, at `speed`, which grows by `speeding_up` per time.
void turn(Pose &pose, const Vec3 &point, const Vec3 &axis, Real s, Real c, Real speed,
          Real speeding_up)
{
  turn(pose, point, rotation(axis, s, c), {speed * axis, speeding_up * axis});
}

void turn(Pose &pose, const Vec3 &point, const Vec3 &axis, Real angle, Real speed, Real speeding_up)
{
  turn(pose, point, axis, std::sin(angle), std::cos(angle), speed, speeding_up);
}

// Returns the acceleration for Pose of a velocity whose mean in a step of this length is `mean`.
template <class V>
V from_mean(const V &mean, const V &velocity, Real step)
{
  return (2 / step) * (velocity - mean);
}

void turn(Pose &pose, const MotionTerm &m, Time t, Real step)
{
  const Vec3 axis = unit_vector(m.axis);
  if (m.kind == MotionKind::variable_turn) {
    turn(pose, m.point, axis, m.displacement.x, m.speed.x, m.speeding_up.x);
    return;
  }
  Real s, c;
  sine_cosine(t, m.period, s, c);
  const Real omega = kTwoPi / m.period;
  if (m.kind != MotionKind::riggle) {
    turn(pose, m.point, axis, s, c, omega, 0);
    return;
  }
  const Real speed = m.angle * omega * c;
  Real speeding_up = 0;
  if (step > 0) {
    Real before, unused;
    sine_cosine(t - step, m.period, before, unused);
    speeding_up = from_mean(m.angle * (s - before) / step, speed, step);
  }
  turn(pose, m.point, axis, m.angle * s, speed, speeding_up);
}

// Turns the pose about the point of a table's motion and moves it on, as all terms do.
void follow_table(Pose &pose, const MotionTerm &m, Time t, Real step)
{
  const TablePlace place = m.table->at(t);
  TablePlace mean;    // its velocities are the means of the step
  if (step > 0) mean = m.table->mean_before(place, t, step);
  if (m.table->turns_about_axis()) {
    turn(pose, m.point, unit_vector(m.axis), place.angle, place.speed,
         step > 0 ? from_mean(mean.speed, place.speed, step) : 0);
  } else if (m.table->turns()) {
    Rotation turned;
    rows_of(place.turn, turned.row);
    turn(pose, m.point, turned,
         {place.angular, step > 0 ? from_mean(mean.angular, place.angular, step) : Vec3{0, 0, 0}});
  }
  pose.shift += place.shift;
  pose.velocity += place.velocity;
  if (step > 0) pose.acceleration += from_mean(mean.velocity, place.velocity, step);
}

// The displacement of a term and its derivative.
void shift_of(const MotionTerm &m, Time t, Vec3 &shift, Vec3 &velocity)
{
  Real s, c;
  const Real omega = m.period > 0 ? kTwoPi / m.period : 0;
  switch (m.kind) {
    case MotionKind::wiggle:
      sine_cosine(t, m.period, s, c);
      shift = s * m.amplitude;
      velocity = omega * c * m.amplitude;
      return;
    case MotionKind::cosine:
      sine_cosine(t, m.period, s, c);
      shift = m.amplitude - c * m.amplitude;
      velocity = omega * s * m.amplitude;
      return;
    case MotionKind::variable:
      shift = m.displacement;
      velocity = m.speed;
      return;
    default:
      for (int d = 0; d < 3; d++) shift[d] = static_cast<Real>(m.velocity[d] * t);
      velocity = m.velocity;
  }
}

// Moves the pose on by the displacement of a term.
void shift(Pose &pose, const MotionTerm &m, Time t, Real step)
{
  Vec3 shift, velocity;
  shift_of(m, t, shift, velocity);
  pose.shift += shift;
  pose.velocity += velocity;
  if (m.kind == MotionKind::variable) pose.acceleration += m.speeding_up;
  if (m.kind == MotionKind::wiggle && step > 0) {
    Vec3 before, unused;
    shift_of(m, t - step, before, unused);
    pose.acceleration += from_mean((1 / step) * (shift - before), velocity, step);
  }
}

}    // namespace

Vec3 unit_vector(const Vec3 &a)
{
  const Real largest = std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
  const Vec3 scaled = {a.x / largest, a.y / largest, a.z / largest};
  const Real length = norm(scaled);
  return {scaled.x / length, scaled.y / length, scaled.z / length};
}

void RigidMotion::begin_from(const Pose &pose)
{
  start_ = pose.still();
  start_.placed = !is_same_place(pose, Pose());
}

void RigidMotion::stop()
{
  if (!terms_.empty()) stopped_ = terms_;
  terms_.clear();
}

// Each term maps x to R (x - point) + point + shift; R is 1 where it does not turn.
Pose RigidMotion::terms_at(Time t, Real step) const
{
  if (is_posed_) return posed_;
  Pose pose = start_;
  if (moves()) pose.placed = true;
  for (const MotionTerm &m : terms_) {
    if (m.kind == MotionKind::table) {
      follow_table(pose, m, t, step);
      continue;
    }
    if (m.turns()) turn(pose, m, t, step);
    shift(pose, m, t, step);
  }
  return pose;
}

Pose RigidMotion::pose_at(Time t, Real step) const
{
  Pose pose = terms_at(t, step);
  const Servo &s = servo_;
  if (!s.present) return pose;
  pose.placed = true;
  if (s.turns) {
    turn(pose, s.point, s.axis, s.position, s.velocity, 0);
  } else {
    pose.shift += s.position * s.axis;
    pose.velocity += s.velocity * s.axis;
  }
  return pose;
}

Real RigidMotion::longest_period() const
{
  Real longest = 0;
  for (const MotionTerm &m : terms_) {
    longest = std::max(longest, m.period);
    if (m.table) longest = std::max(longest, m.table->end());
  }
  return longest;
}

bool RigidMotion::keeps(const Vec3 &direction) const
{
  if (is_posed_) return false;    // nobody knows where it goes
  // Axes are unit vectors: parallel and perpendicular hold to this rounding.
  constexpr Real kRounding = 1e-12;
  const auto crosses = [&](const Vec3 &v) {
    return std::fabs(dot(v, direction)) > kRounding * norm(v);
  };
  if (norm(start_.turn_to_box(direction) - direction) > kRounding || crosses(start_.shift))
    return false;
  if (servo_.present &&
      (servo_.turns ? norm(cross(servo_.axis, direction)) > kRounding : crosses(servo_.axis)))
    return false;
  for (const MotionTerm &m : terms_) {
    if (m.turns() && norm(cross(unit_vector(m.axis), direction)) > kRounding) return false;
    if (crosses(m.velocity) || crosses(m.amplitude)) return false;
    for (int d = 0; m.kind == MotionKind::variable && d < 3; d++)
      if ((m.input[d] != kNoInput || m.input[3 + d] != kNoInput) && direction[d] != 0) return false;
    if (!m.table) continue;
    if (!m.table->keeps(direction, kRounding)) return false;
    if (m.table->turns_about_axis() && norm(cross(unit_vector(m.axis), direction)) > kRounding)
      return false;
  }
  return true;
}

namespace {

bool are_same(int a, const InputNames &inputs_of_a, int b, const InputNames &inputs_of_b)
{
  if (a == kNoInput || b == kNoInput) return a == b;
  return inputs_of_a[static_cast<std::size_t>(a)] == inputs_of_b[static_cast<std::size_t>(b)];
}

// By their rows where both were read.
bool have_same_table(const MotionTerm &a, const MotionTerm &b)
{
  if (a.table && b.table) return a.table->rows() == b.table->rows();
  return !a.table == !b.table && a.table_file == b.table_file && a.table_options == b.table_options;
}

}    // namespace

bool are_same(const std::vector<MotionTerm> &a, const InputNames &inputs_of_a,
              const std::vector<MotionTerm> &b, const InputNames &inputs_of_b)
{
  const auto same = [&](const MotionTerm &one, const MotionTerm &other) {
    for (int k = 0; k < 6; k++)
      if (!are_same(one.input[k], inputs_of_a, other.input[k], inputs_of_b)) return false;
    return one.kind == other.kind && one.velocity == other.velocity &&
           one.amplitude == other.amplitude && one.point == other.point &&
           unit_vector(one.axis) == unit_vector(other.axis) && one.period == other.period &&
           one.angle == other.angle && have_same_table(one, other);
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

bool are_same(const Servo &a, const InputNames &inputs_of_a, const Servo &b,
              const InputNames &inputs_of_b)
{
  if (!a.present || !b.present) return a.present == b.present;
  return a.has_line_of(b) && are_same(a.target_input, inputs_of_a, b.target_input, inputs_of_b) &&
         (a.target_input != kNoInput || a.target == b.target) && a.max_gain == b.max_gain &&
         a.max_speed == b.max_speed && a.lo == b.lo && a.hi == b.hi;
}

// A rigid motion moves a point by an affine function of it, whose size is largest at a corner.
Real farthest_between(const Pose &a, const Pose &b, const Box &box)
{
  Real most = 0;
  for_corners(box, [&](const Vec3 &x) { most = std::max(most, norm(b.to_box(x) - a.to_box(x))); });
  return most;
}

Pose between(const Pose &a, const Pose &b, Real share)
{
  const auto turn = [&](int i, int j) { return dot(b.row[i], a.row[j]); };    // from a to b
  const Vec3 axis =
      0.5 * Vec3{turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1)};
  const Real sine = norm(axis),
             angle = std::atan2(sine, (turn(0, 0) + turn(1, 1) + turn(2, 2) - 1) / 2);
  Pose pose = a.still();
  pose.placed = a.placed || b.placed;
  pose.shift += share * (b.shift - a.shift);
  if (!(sine > 0)) return pose;
  Vec3 part[3];
  rows_of(rotation_about(1 / sine * axis, share * angle), part);
  for (int i = 0; i < 3; i++)
    pose.row[i] = part[i].x * a.row[0] + part[i].y * a.row[1] + part[i].z * a.row[2];
  return pose;
}

Real fastest_in(const Pose &pose, const Box &box)
{
  Real most = 0;
  for_corners(box, [&](const Vec3 &x) { most = std::max(most, norm(pose.velocity_in_mesh(x))); });
  return most;
}

Box placed_bounds(const Pose &pose, const Box &box)
{
  Box around = {pose.to_box(box.lo), pose.to_box(box.lo)};
  for_corners(box, [&](const Vec3 &x) { extend(around, pose.to_box(x)); });
  return around;
}

Box swept_bounds(const Pose &a, const Pose &b, const Box &box)
{
  Box around = placed_bounds(a, box);
  for_corners(box, [&](const Vec3 &x) { extend(around, b.to_box(x)); });
  return around;
}

}    // namespace lsdcd
