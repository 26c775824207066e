// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Normal models of contacts that yield: paths of the overlap, and impacts, beside closed forms.
#include "law/submodels/plastic.h"

#include "law/contact_law.h"
#include "law/contact_time.h"
#include "law/smallest_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lsdcd::test_plastic {
namespace {

constexpr Real kMass = 1e-3;

Contact contact_at(Real overlap, Real radius = 1e-3)
{
  Contact c = {};
  c.overlap = overlap;
  c.radius = radius;
  c.mass = kMass;
  return c;
}

// What a path has come to: the force at an overlap, the elastic energy, and what has been lost so far.
struct Point {
  Real overlap, force, first, held, lost;
};

// Follows the points of a path in one step each.
class Path {
 public:
  Path(const PlasticNormal &law, Real radius = 1e-3) : law_(law), radius_(radius) {}

  PlasticNormal &law() { return law_; }
  Real kept(int k) const { return own_[k]; }
  Point go_to(Real overlap)
  {
    const Contact c = contact_at(overlap, radius_);
    Real begun[kPlasticStored] = {own_[0], own_[1]};
    if (!(overlap > 0)) {
      lost_ += law_.loss_at_end(contact_at(0, radius_), begun, overlap_);
      own_[0] = own_[1] = overlap_ = 0;
      return {0, 0, 0, 0, lost_};
    }
    law_.update(c, own_);
    lost_ += law_.loss(c, begun, overlap_, own_);
    overlap_ = overlap;
    return {overlap, law_.force(c, own_), own_[0], law_.energy(c, own_), lost_};
  }

 private:
  PlasticNormal law_;
  Real radius_, own_[kPlasticStored] = {}, overlap_ = 0, lost_ = 0;
};

// The tables have seven digits, and forces six behind the point; what is below 1e-16 of the greatest is rounding.
void expect_point(const Point &found, const Point &wanted)
{
  const auto near = [&](Real a, Real b, const char *what) {
    EXPECT_NEAR(a, b, 1e-6 * std::fabs(b) + 1e-16) << what << " at " << wanted.overlap;
  };
  EXPECT_NEAR(found.force, wanted.force, 1e-6 * std::fabs(wanted.force) + 5e-7) << wanted.overlap;
  near(found.first, wanted.first, "kept");
  near(found.held, wanted.held, "held");
  near(found.lost, wanted.lost, "lost");
}

// `time`: until nothing pushes any more.
struct Impact {
  Real restitution, deepest, time, lost, remainder;
};

// A sphere that meets a wall with this speed, by velocity Verlet. The books are those of the product: half of each force's work in the
// step before and after. `phase`: the part of a step by which the sphere is away first.
Impact impact(const PlasticNormal &law, Real speed, Real radius, Real mass, int steps_of_unloading,
              Real phase = 0)
{
  Contact c = contact_at(0.01 * radius, radius);
  const Real dt = kPi * std::sqrt(mass / law.tangent(c, 0)) / steps_of_unloading;
  Real own[kPlasticStored] = {}, overlap = -phase * dt * speed, v = speed, force = 0, lost = 0,
       passed = 0;
  Impact out = {};
  for (;;) {
    const Real half = v - 0.5 * dt * force / mass, before = overlap;
    overlap += dt * half;
    passed += dt;
    Real begun[kPlasticStored] = {own[0], own[1]};
    if (!(overlap > 0) && v > 0) continue;    // it comes
    if (!(overlap > 0)) {
      lost += law.loss_at_end(contact_at(0, radius), begun, before);
      v = half;
      break;
    }
    c = contact_at(overlap, radius);
    law.update(c, own);
    lost += law.loss(c, begun, before, own);
    force = law.force(c, own);
    if (force > 0) out.time = passed;
    v = half - 0.5 * dt * force / mass;
    out.deepest = std::max(out.deepest, overlap);
    if (passed > 1e4 * dt * steps_of_unloading) {    // it sticks
      v = 0;
      break;
    }
  }
  out.restitution = -v / speed;
  out.lost = lost;
  out.remainder = 1 - out.restitution * out.restitution - lost / (0.5 * mass * speed * speed);
  return out;
}

PlasticNormal hysteretic(Real k1, Real e)
{
  return {NormalModel::hysteretic, {k1, e}};
}
PlasticNormal lepa(Real k1, Real kp, Real kc, Real elastic_from, Real radius)
{
  return {NormalModel::lepa, {k1, kp, kc, elastic_from * (kp - k1) / kp / (2 * radius)}};
}

TEST(plastic, hysteretic_follows_its_path)
{
  Path path(hysteretic(1e5, 0.5));
  for (const Point &wanted :
       {Point{1e-4, 10, 7.5e-5, 1.25e-4, 3.75e-4}, Point{8e-5, 2, 7.5e-5, 5e-6, 3.75e-4},
        Point{9e-5, 6, 7.5e-5, 4.5e-5, 3.75e-4}, Point{5e-5, 0, 5e-5, 0, 3.75e-4},
        Point{7e-5, 7, 5.25e-5, 6.125e-5, 3.920833333e-4},
        Point{1.2e-4, 12, 9e-5, 1.8e-4, 7.483333333e-4}, Point{0, 0, 0, 0, 7.483333333e-4}})
    expect_point(path.go_to(wanted.overlap), wanted);
}
TEST(plastic, hysteretic_by_size_takes_its_stiffness_from_the_radius)
{
  const Real radius = 2e-3;
  for (const auto &[model, factor] : {std::pair<NormalModel, Real>{NormalModel::hysteretic_size, 2},
                                      {NormalModel::hysteretic_edem, 5}}) {
    Path by_size({model, {factor * 2.5e7, 0.5}}, radius),
        by_stiffness(hysteretic(factor * 2.5e7 * radius, 0.5));
    for (const Real d : {1e-4, 8e-5, 9e-5, 5e-5, 1.2e-4})
      EXPECT_EQ(by_size.go_to(d).force, by_stiffness.go_to(d).force);
  }
}
TEST(plastic, hysteretic_returns_its_restitution_at_every_speed)
{
  for (const Real e : {0.9, 0.7, 0.5, 0.3, 0.1})
    for (const Real speed : {0.01, 0.1, 1.0, 3.0, 10.0}) {
      const Impact found = impact(hysteretic(1e5, e), speed, 1e-3, kMass, 2000);
      EXPECT_NEAR(found.restitution, e, 1e-5 * e) << e << " at " << speed;
      EXPECT_NEAR(found.deepest, speed * std::sqrt(kMass / 1e5), 1e-5 * found.deepest);
      EXPECT_NEAR(found.time, kPi / 2 * std::sqrt(kMass / 1e5) * (1 + e), 3e-3 * found.time);
      EXPECT_NEAR(found.lost, (1 - e * e) * 0.5 * kMass * speed * speed, 1e-5 * found.lost);
    }
}
// The greatest of 50 phases of the first step is 7.8e-5 and 4.9e-6 at e 0.3, 5.7e-4 and 1.9e-5 at 0.9.
TEST(plastic, closes_the_books_of_hysteretic_by_the_square_of_the_step)
{
  for (const Real e : {0.3, 0.9}) {
    const auto largest = [e](int steps) {
      Real most = 0;
      for (int k = 0; k < 50; k++)
        most = std::max(
            most,
            std::fabs(impact(hysteretic(1e5, e), 1, 1e-3, kMass, steps, k / Real(50)).remainder));
      return most;
    };
    EXPECT_LT(largest(50), e < 0.5 ? 8e-5 : 6e-4) << e;
    EXPECT_LT(largest(200), e < 0.5 ? 5e-6 : 2e-5) << e;
  }
}
TEST(plastic, hysteretic_with_e_1_is_the_linear_spring)
{
  Path path(hysteretic(1e5, 1));
  for (const Real d : {1e-4, 8e-5, 9e-5, 1e-6}) {
    const Point found = path.go_to(d);
    EXPECT_EQ(found.force, 1e5 * d);
    EXPECT_EQ(found.lost, 0);
  }
}

// Follows a path with a pull of 1.5 N where the adhesive branch begins: the surface energy of each yield is that which gives it.
void follow_eepa(Path path, const std::vector<Point> &points, const std::vector<Real> &slopes)
{
  const Real n = path.law().numbers[3], share = 1 - path.law().numbers[0] / path.law().numbers[1];
  std::size_t yields = 0;
  for (const Point &wanted : points) {
    const Real plastic = std::pow(share, 1 / n) * wanted.overlap;
    path.law().numbers[2] = 1.5 / (1.5 * kPi * std::sqrt(plastic * (2e-3 - plastic)));
    const Real before = path.kept(1);
    expect_point(path.go_to(wanted.overlap), wanted);
    if (wanted.overlap > 0 && path.kept(1) != before) {
      ASSERT_LT(yields, slopes.size());
      EXPECT_NEAR(path.kept(1), slopes[yields], 1e-6 * slopes[yields]);
      yields++;
    }
  }
  EXPECT_EQ(yields, slopes.size());
}
Real to_n(Real plastic)
{
  return plastic * std::sqrt(plastic);
}
TEST(plastic, eepa_follows_its_path_with_n_1)
{
  follow_eepa(Path({NormalModel::eepa, {1e5, 4e5, 0, 1, 1, 0}}),
              {{1e-4, 10, 7.5e-5, 1.25e-4, 3.75e-4},
               {8e-5, 2, 7.5e-5, 5e-6, 3.75e-4},
               {5e-5, -1.0526315789, 5.2631578947e-5, 1.3850415512e-6, 4.03549169e-4},
               {6e-5, 2.9473684211, 5.2631578947e-5, 1.0858725762e-5, 4.03549169e-4},
               {2e-5, -0.42105263158, 2.1052631579e-5, 2.2160664820e-7, 4.26817867e-4},
               {1.5e-4, 15, 1.125e-4, 2.8125e-4, 1.241020e-3},
               {0, 0, 0, 0, 1.325395e-3}},
              {2.1052631579e4, 1.3793103448e4});
}
TEST(plastic, eepa_follows_its_path_with_n_1_5)
{
  follow_eepa(Path({NormalModel::eepa, {1e7, 4e7, 0, 1.5, 1.5, 0}}),
              {{1e-4, 10, to_n(8.2548181e-5), 8.586726e-5, 3.141327e-4},
               {8e-5, -1.378330, to_n(8.2548181e-5), 1.760706e-6, 3.141327e-4},
               {5e-5, -0.744323, to_n(5.173935e-5), 6.491620e-7, 3.485482e-4},
               {6e-5, 3.703862, to_n(5.173935e-5), 1.510955e-5, 3.485482e-4},
               {2e-5, -0.188300, to_n(2.069574e-5), 6.569058e-8, 3.625117e-4},
               {1.5e-4, 18.371173, to_n(1.2382227e-4), 2.366223e-4, 1.218273e-3},
               {0, 0, 0, 0, 1.292908e-3}},
              {2.105263158e6, 1.119121e6});
}
TEST(plastic, eepa_follows_its_path_with_chi_3_5)
{
  Path path({NormalModel::eepa, {1e7, 4e7, 0, 1.5, 3.5, 0}});
  const std::vector<std::vector<Real>> wanted = {{1e-4, 10, 8.254818e-5, 3.141327e-4},
                                                 {8e-5, -1.378330, 8.254818e-5, 3.141327e-4},
                                                 {5e-5, -0.292407, 5.068686e-5, 3.394615e-4},
                                                 {6e-5, 4.155777, 5.068686e-5, 3.394615e-4},
                                                 {2e-5, -0.011836, 2.004409e-5, 3.427581e-4},
                                                 {1.5e-4, 18.371173, 1.238223e-4, 1.199280e-3},
                                                 {0, 0, 0, 1.241497e-3}};
  for (const std::vector<Real> &w : wanted) {
    const Real plastic = std::pow(0.75, 1 / 1.5) * w[0];
    path.law().numbers[2] = 1 / (kPi * std::sqrt(plastic * (2e-3 - plastic)));
    const Point found = path.go_to(w[0]);
    EXPECT_NEAR(found.force, w[1], 1e-6 * std::fabs(w[1]) + 5e-7)
        << w[0];    // six digits behind the point
    EXPECT_NEAR(std::pow(found.first, 1 / 1.5), w[2], 1e-6 * w[2]) << w[0];
    EXPECT_NEAR(found.lost, w[3], 1e-6 * w[3]) << w[0];
  }
}
TEST(plastic, eepa_without_adhesion_returns_the_same_restitution_at_every_speed)
{
  for (const Real n : {1.0, 1.5})
    for (const Real ratio : {2.0, 4.0}) {
      const Real k1 = n == 1 ? 1e5 : 1e7, s = std::pow(1 - 1 / ratio, 1 / n);
      const Real e_sq = ratio * (1 - std::pow(s, n + 1) - (n + 1) * std::pow(s, n) * (1 - s));
      for (const Real speed : {0.1, 1.0, 5.0})
        EXPECT_NEAR(
            impact({NormalModel::eepa, {k1, ratio * k1, 0, n, n, 0}}, speed, 1e-3, kMass, 4000)
                .restitution,
            std::sqrt(e_sq), 1e-5)
            << n << " " << ratio << " " << speed;
    }
}
TEST(plastic, lepa_follows_its_path)
{
  Path path(lepa(1e5, 5e5, 1e5, 2.5e-4, 1e-3));
  for (const Point &wanted :
       {Point{1e-4, 10, 1e-4, 1.923077e-4, 3.076923e-4},
        Point{6e-5, -0.4, 1e-4, 3.0769231e-7, 3.076923e-4},
        Point{2e-5, -2, 6.0990195e-5, 1.012226e-5, 4.143222e-4},
        Point{3e-5, -0.024157, 6.0990195e-5, 1.476723e-9, 4.143222e-4},
        Point{1e-5, -1, 4.070714e-5, 3.027891e-6, 4.364166e-4},
        Point{1.5e-4, 15, 1.5e-4, 3.308824e-4, 1.197855e-3}, Point{0, 0, 0, 0, 1.631010e-3}})
    expect_point(path.go_to(wanted.overlap), wanted);
}
TEST(plastic, lepa_returns_the_restitution_of_its_closed_form)
{
  const Real k1 = 1e5, kp = 5e5, from = 2.5e-4;
  for (const Real kc : {0.0, 5e4, 1e5, 3e5})
    for (const Real speed : {0.2, 0.5, 1.0, 2.0}) {
      const Real deepest = speed * std::sqrt(kMass / k1);
      if (deepest > from) continue;
      const Real k2 = k1 + (kp - k1) * deepest / from;
      const Real e_sq = 1 - (k2 - k1) * (k1 + kc) / (k1 * (k2 + kc));
      if (e_sq <= 0.01) continue;
      EXPECT_NEAR(impact(lepa(k1, kp, kc, from, 1e-3), speed, 1e-3, kMass, 4000).restitution,
                  std::sqrt(e_sq), 2e-5)
          << kc << " " << speed;
    }
}
// Thornton 1997, equation 52.
TEST(plastic, thornton_returns_the_restitution_of_its_closed_form)
{
  const Real modulus = 1e11, radius = 5e-3, py = 3e9;
  const Real mass = 4 * kPi / 3 * radius * radius * radius * 7800;
  const Real yields = std::pow(kPi / (2 * modulus), 2) *
                      std::sqrt(8 * kPi * radius * radius * radius / (15 * mass)) *
                      std::pow(py, 2.5);
  EXPECT_NEAR(yields, 0.8710, 5e-5);
  for (const Real speed : {2.0, 5.0, 10.0}) {
    const Real q = yields / speed, rest = 1 - q * q / 6;
    const Real e = std::sqrt(6 * std::sqrt(Real(3)) / 5) * std::sqrt(rest) *
                   std::pow(q / (q + 2 * std::sqrt(1.2 - q * q / 5)), 0.25);
    const Impact found = impact({NormalModel::thornton, {modulus, py}}, speed, radius, mass, 4000);
    EXPECT_NEAR(found.restitution, e, 1e-5) << speed;
    EXPECT_NEAR(found.remainder, 0, 1e-6) << speed;
  }
  EXPECT_NEAR(impact({NormalModel::thornton, {modulus, py}}, 0.5, radius, mass, 4000).restitution,
              1, 1e-6);
}

// The stiffness of unloading, not that of loading, bounds the timestep.
TEST(plastic, has_the_contact_time_of_unloading)
{
  ContactLaw law = granular_law(NormalModel::hysteretic);
  law.damping = DampingModel::none;
  law.plastic[0] = 1e5;
  law.plastic[1] = 0.3;
  EXPECT_NEAR(contact_time(law, kMass, 1e-3, 1), 0.3 * kPi * std::sqrt(kMass / 1e5), 1e-12);
}
// What was moved once stays: a setup, which asks again for the force at the same overlap, gets the same one.
TEST(plastic, does_not_move_twice_at_one_overlap)
{
  for (const PlasticNormal &law :
       {hysteretic(1e5, 0.5), PlasticNormal{NormalModel::eepa, {1e7, 4e7, 100, 1.5, 3.5, -0.1}},
        lepa(1e5, 5e5, 1e5, 2.5e-4, 1e-3), PlasticNormal{NormalModel::thornton, {1e11, 3e9}}}) {
    Path path(law);
    for (const Real d : {1e-4, 8e-5, 5e-5, 6e-5, 2e-5, 1.5e-4}) {
      const Point once = path.go_to(d), twice = path.go_to(d);
      EXPECT_NEAR(twice.force, once.force, 1e-12 * std::fabs(once.force) + 1e-13);
      EXPECT_NEAR(twice.lost, once.lost, 1e-12 * once.lost);
    }
  }
}

}    // namespace
}    // namespace lsdcd::test_plastic
