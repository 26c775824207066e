// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The rule by which contacts of a grain share against its definition in long double, by every set of bearing contacts.
// LSDCD_QUICK: a tenth of the poses.
#include "contact/grain_rule.h"
#include "support/random.h"
#include "support/shape_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace lsdcd::test_grain_rule {
namespace {

struct Pose {
  Superellipsoid shape;
  std::vector<SharingContact> contacts;
  std::vector<std::vector<Real>> pass;    // 0: none

  int n() const { return static_cast<int>(contacts.size()); }
};

// What the contacts do to a grain: on hooke's law of stiffness 1.
struct Outcome {
  LongVec force = {0, 0, 0}, torque = {0, 0, 0};
  Long energy = 0;
};

LongVec scaled(Long f, const LongVec &a)
{
  return {f * a.x, f * a.y, f * a.z};
}

// The formulas of doc/notes/corners.md.
class Reference {
 public:
  explicit Reference(const Pose &pose) : pose_(pose), oracle_(pose.shape), n_(pose.n())
  {
    g_.assign(n_, std::vector<Long>(n_, 0));
    couple_.assign(n_, std::vector<LongVec>(n_, LongVec{0, 0, 0}));
    for (int i = 0; i < n_; i++) {
      Long fade = 0;
      for (int j = 0; j < n_; j++)
        if (j != i) {
          set_cover(i, j);
          if (pose.pass[i][j] > 0) fade = std::max(fade, fade_of(i, j));
        }
      g_[i][i] = 1 + fade;
    }
  }

  // With pivots of 0.1 the least s is taken, and the roundings of covers, 2e-13 for a 5:1:1 where normals are 0.15 apart, are ten times as large in a force.
  bool is_positive() const
  {
    std::vector<std::vector<Long>> a = g_;
    for (int k = 0; k < n_; k++) {
      if (!(a[k][k] > 0.1L)) return false;
      for (int i = k + 1; i < n_; i++)
        for (int j = n_ - 1; j >= k; j--) a[i][j] -= a[i][k] / a[k][k] * a[k][j];
    }
    return true;
  }

  Outcome solve() const
  {
    // The least s there is, where three or more share.
    Long deepest = 0;
    int n_sharing = 0;
    for (int i = 0; i < n_; i++) {
      bool shares = false;
      for (int j = 0; j < n_; j++) shares |= j != i && g_[i][j] > 6e-17L;    // 1 - g is not 1
      n_sharing += shares;
      if (shares) deepest = std::max(deepest, d(i));
    }
    const Long s = n_sharing > 2 ? 1e-12L * deepest * deepest : 0;
    std::vector<Long> best;
    Long lowest = HUGE_VAL;
    for (int set = 1; set < 1 << n_; set++) {
      std::vector<int> in;
      for (int i = 0; i < n_; i++)
        if (set >> i & 1) in.push_back(i);
      const int m = static_cast<int>(in.size());
      std::vector<std::vector<Long>> a(m, std::vector<Long>(m + 1));
      for (int k = 0; k < m; k++) {
        for (int l = 0; l < m; l++) a[k][l] = h(in[k], in[l], s);
        a[k][m] = pull(in[k], s);
      }
      for (int k = 0; k < m; k++)
        for (int i = 0; i < m; i++)
          if (i != k)
            for (int j = m; j >= k; j--) a[i][j] -= a[i][k] / a[k][k] * a[k][j];
      std::vector<Long> l(n_, 0);
      bool bears = true;
      for (int k = 0; k < m; k++) {
        l[in[k]] = a[k][m] / a[k][k];
        bears &= l[in[k]] >= 0;
      }
      if (!bears) continue;
      Long objective = 0;
      for (int i = 0; i < n_; i++) {
        objective -= pull(i, s) * l[i];
        for (int j = 0; j < n_; j++) objective += h(i, j, s) * l[i] * l[j] / 2;
      }
      if (objective < lowest) lowest = objective, best = l;
    }
    return outcome(best);
  }
  Outcome outcome(const std::vector<Long> &l) const
  {
    Outcome o;
    for (int i = 0; i < n_; i++) {
      const LongVec f = scaled(-l[i], n(i));
      o.force += f;
      o.torque += cross(oracle_.point(n(i)), f);
      o.energy += l[i] * d(i);
      for (int j = 0; j < n_; j++) {
        o.energy -= g_[i][j] * l[i] * l[j] / 2;
        if (j < i) o.torque += scaled(l[i] * l[j], couple_[i][j]);
      }
    }
    return o;
  }

 private:
  Long d(int i) const { return pose_.contacts[i].overlap; }
  LongVec n(int i) const
  {
    const LongVec v = vec_cast<Long>(pose_.contacts[i].normal);
    return scaled(1 / length(v), v);
  }
  Long covered(int i) const
  {
    Long m = 1;
    for (int j = 0; j < n_; j++)
      if (j != i) m += g_[i][j] * d(j) / (d(i) * g_[j][j]);
    return m;
  }
  // Of s/2 m (l/d - 1/m)^2.
  Long h(int i, int j, Long s) const
  {
    return g_[i][j] + (i == j ? s * covered(i) / (d(i) * d(i)) : 0);
  }
  Long pull(int i, Long s) const { return d(i) + s / d(i); }

  void set_cover(int i, int j)
  {
    const LongVec a = n(i), b = n(j), sum = a + b;
    const Long c = dot(a, b);
    if (!(c > 0)) return;
    const Long size = length(sum), apart = length(a - b);
    const LongVec middle = scaled(1 / size, sum);
    const Long radius = (oracle_.support(a) + oracle_.support(b) - size * oracle_.support(middle)) *
                        (2 + size) / (apart * apart);
    const Long rho = pose_.shape.rho, x = std::max(Long(0), radius - rho) * apart;
    const Long half = std::min({pose_.shape.half.x, pose_.shape.half.y, pose_.shape.half.z});
    const Long g = c * std::exp(-x * x / (2 * half * half)), u = 1 - g;
    g_[i][j] = 1 - (u + 1e-6L * (1 - u) * 100 * u / (1 + 100 * u));
    if (x > 0)
      couple_[i][j] = scaled(-g * x / (half * half) * (2 + size) / apart,
                             cross(oracle_.point(a), a) + cross(oracle_.point(b), b) -
                                 cross(oracle_.point(middle), sum));
  }
  Long fade_of(int i, int j) const
  {
    const Long b = pose_.pass[i][j], own = std::sqrt(d(i) - b), other = std::sqrt(d(j) - b),
               f = own / (own + other), more = 0.2L / f - 1, share = b / d(i);
    return f < 0.2L ? 0.3L * more * more * share * share : 0;
  }

  const Pose &pose_;
  const ShapeOracle oracle_;
  const int n_;
  std::vector<std::vector<Long>> g_;
  std::vector<std::vector<LongVec>> couple_;
};

// Normals around a direction; every second pose has passes, as in a funnel: one height between all, and a higher one between two.
Pose random_pose(Random &random, const std::vector<Superellipsoid> &shapes, int n)
{
  Pose pose;
  pose.shape = shapes[static_cast<std::size_t>(uniform(random, 0, Real(shapes.size())))];
  const Vec3 axis = random_unit(random);
  const Real width = uniform(random, 0.4, 1.5);
  const bool has_passes = uniform(random, 0, 1) < 0.5;
  while (pose.n() < n) {
    SharingContact c;
    c.normal = unit(axis + width * random_unit(random));
    bool is_apart = true;
    for (const SharingContact &other : pose.contacts)
      is_apart &= norm(other.normal - c.normal) > 0.15;
    if (!is_apart) continue;
    c.feature = feature_code(FeatureKind::face, static_cast<std::uint32_t>(pose.n()));
    c.point = support(pose.shape, c.normal).point;
    c.overlap = uniform(random, 0.1, 1) * pose.shape.rho;
    pose.contacts.push_back(c);
  }
  pose.pass.assign(n, std::vector<Real>(n, 0));
  Real least = HUGE_VAL;
  for (const SharingContact &c : pose.contacts) least = std::fmin(least, c.overlap);
  const Real low = uniform(random, 0, 1) * least;
  for (int i = 0; i < n && has_passes; i++)
    for (int j = 0; j < n; j++)
      if (i != j) pose.pass[i][j] = low;
  if (has_passes) {
    const Real most = std::fmin(pose.contacts[0].overlap, pose.contacts[1].overlap);
    pose.pass[0][1] = pose.pass[1][0] = low + uniform(random, 0, 0.999) * (most - low);
  }
  return pose;
}

}    // namespace

TEST(grain_rule, has_forces_torques_and_energies_of_all_sets_of_bearing_contacts)
{
  Random random(1);
  std::vector<Superellipsoid> shapes = {make_superellipsoid({1, 1, 1}, 2, 2),
                                        make_superellipsoid({1, 1, 5}, 2, 2)};
  for (int i = 0; i < 20; i++)
    shapes.push_back(make_superellipsoid(uniform(random, {0.3, 0.3, 0.3}, {1.5, 1.5, 1.5}), 2, 2));
  for (const Real n1 : {3., 8.})
    for (const Real n2 : {2., 4.}) shapes.push_back(make_superellipsoid({0.6, 0.8, 1}, n1, n2));
  GrainRule rule;
  const int most = std::getenv("LSDCD_QUICK") ? 1000 : 10000;
  int n_poses = 0, n_fading = 0;
  Long worst = 0, worst_energy = 0;
  while (n_poses < most) {
    const int n = 2 + n_poses % 5;
    const Pose pose = random_pose(random, shapes, n);
    const Reference reference(pose);
    if (!reference.is_positive()) continue;
    n_poses++;
    rule.begin(pose.shape, pose.contacts);
    bool fades = false;
    for (int i = 0; i < n; i++)
      for (int j = 0; j < n; j++)
        if (pose.pass[i][j] > 0) {
          rule.add_pass(i, j, pose.pass[i][j]);
          fades |=
              fade_beside(pose.contacts[i].overlap, pose.contacts[j].overlap, pose.pass[i][j]) > 0;
        }
    n_fading += fades;
    std::vector<Real> weight(n);
    rule.solve(0, weight.data());
    Outcome ours;
    Long deepest = 0;
    for (int i = 0; i < n; i++) {
      const SharingContact &c = pose.contacts[i];
      const Real l = weight[i] * c.overlap;
      deepest = std::max(deepest, Long(c.overlap));
      ours.force += vec_cast<Long>(-l * c.normal);
      ours.torque += vec_cast<Long>(cross(c.point, -l * c.normal));
      ours.energy += Long(l) * c.overlap / 2;    // that of the law by weight
      for (int j = 0; j < i; j++)
        ours.torque += vec_cast<Long>(l * weight[j] * pose.contacts[j].overlap * rule.couple(i, j));
    }
    const Outcome expected = reference.solve();
    const Long size = pose.shape.farthest;
    worst = std::max({worst, length(ours.force - expected.force) / deepest,
                      length(ours.torque - expected.torque) / (deepest * size)});
    worst_energy =
        std::max(worst_energy, std::fabs(ours.energy - expected.energy) / (deepest * deepest));
  }
  EXPECT_LE(worst, 2e-12L);
  EXPECT_LE(worst_energy, 1e-11L);    // half of s times how often a contact is covered
  EXPECT_GT(n_fading, most / 10);
}

}    // namespace lsdcd::test_grain_rule
