// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The corner rule: how neighbouring contacts of a sphere share their overlap.
#pragma once

#include "contact/contact_set.h"

namespace lsdcd {

// Returns one minus the cosine between two unit normals, without cancellation.
template <class Direction>
LSDCD_FN Real one_minus_cos(const Direction &a, const Direction &b)
{
  return Real(0.5) * norm_sq(a - b);
}

// Returns whether closest point i lies in the tangent plane of contact k, so that it bears nothing.
template <int kMost>
LSDCD_FN bool lies_in_plane(const ContactSet<kMost> &set, Real radius, int i, int k, Real tolerance)
{
  const Real rise = set.distance[k] - set.distance[i] * dot(set.normal[i], set.normal[k]);
  return fabs(rise) <= tolerance && set.distance[i] + set.distance[k] >= radius;
}

// Returns one minus the cover of two contacts, from one minus the cosine of their normals; for a grain that is no sphere, from one
// minus the number that stands for the cosine. Cover is a positive definite function of the angle, because it is a sum of powers of
// the cosine. For parallel normals it is 1. It is less than the cosine by kLess, except at angles below sqrt(2 / kNarrow).
LSDCD_FN Real uncovered(Real one_minus_cosine)
{
  constexpr Real kLess = 1e-6, kNarrow = 100;
  const Real u = one_minus_cosine;
  return u + kLess * (1 - u) * (kNarrow * u / (1 + kNarrow * u));
}

// The quantities that the corner rule needs from a set: how alike two contacts are, above 0 if they share; one minus their cover,
// if they share; and how much a contact fades, which is 0 for spheres.
template <int kMost>
LSDCD_FN Real likeness(const ContactSet<kMost> &set, int a, int b)
{
  return dot(set.normal[a], set.normal[b]);
}
template <int kMost>
LSDCD_FN Real uncovered(const ContactSet<kMost> &set, int a, int b)
{
  return uncovered(one_minus_cos(set.normal[a], set.normal[b]));
}
template <class Set>
inline constexpr bool kFades = false;    // is there a fade_of(set, i)?

// Weights w_i = l_i / d_i where l solves
//   minimise 1/2 l'Gl - d'l + s/2 sum m_i (l_i / d_i - 1 / m_i)^2  subject to l >= 0,
// with overlaps d_i = radius - distance_i > 0 and m_i = sum_j G_ij d_j / d_i, how many times contact i is covered.
// G_ii = 1, and G_ij, the cover of two contacts, is the cosine between their normals, or 0 where that is negative:
// contacts whose normals are at 90 degrees or more have w = 1 exactly. The weights of parallel duplicates sum to 1.
//
// The cover is less than the cosine by up to 1e-6, so that the solution is unique even if normals are linearly dependent. If many
// walls surround a sphere, the problem is not convex without its last term. Therefore s is twice the value that makes it convex,
// and at least kLeast of the largest d_i^2. The problem is then strictly convex and changes continuously with overlaps and normals,
// and so does its solution. If s has its least value, the force of Hooke springs is the gradient of an energy (doc/theory.md).
//
// Solved exactly by an active set: a contact enters while its gradient is positive, and leaves when its l would be
// negative.
//
// A closest point that lies in the tangent plane of another contact bears nothing: its gradient is (a - b) (R - a - b) / a, where a
// and b are the two distances and R is the radius. If the two closest points are close to each other, rounding hides the sign of a
// - b. Therefore edges that lie in the plane of a face, and vertices that lie in that of an edge or face, to `tolerance` (length),
// are left out first. Otherwise the rim of a T-junction would turn the force by the square root of a rounding error.
//
// Set is a ContactSet for spheres. For other grains (contact/grain_rule.h) `distance` is `radius` less the overlap, and the cover
// is given by curvature. A contact that fades has G_ii = 1 + its fade, and m_i = 1 + sum over the others of G_ij d_j / (d_i G_jj).
template <int kMost, class Set = ContactSet<kMost>>
class CornerRule {
 public:
  LSDCD_FN void solve(const Set &set, Real radius, Real *weight, Real tolerance = 0)
  {
    for (int i = 0; i < set.n; i++) weight[i] = alone(set, i);
    if (set.n < 2) return;
    if (set.n == 2) return solve_pair(set, radius, weight, tolerance);
    n_ = 0;
    for (int i = 0; i < set.n; i++) {
      if (lies_in_tangent_plane(set, radius, i, tolerance))
        weight[i] = 0;
      else
        used_[n_++] = i;
    }
    leave_out_apart(set);
    if (n_ == 2)
      solve_two(set, radius, weight, used_[0], used_[1]);
    else if (n_ > 2)
      solve_many(set, radius, weight);
  }

 private:
  // Returns whether closest point i lies in the tangent plane of a contact on a larger kind of feature.
  LSDCD_FN static bool lies_in_tangent_plane(const Set &set, Real radius, int i, Real tolerance)
  {
    const FeatureKind kind = feature_kind(set.feature[i]);
    if (kind == FeatureKind::face) return false;
    for (int k = 0; k < set.n; k++) {
      if (!(feature_kind(set.feature[k]) < kind)) continue;
      if (lies_in_plane(set, radius, i, k, tolerance)) return true;
    }
    return false;
  }

  // Solves for two contacts that are the only ones. They need no arrays, which on a GPU are in slow memory.
  LSDCD_FN static void solve_pair(const Set &set, Real radius, Real *weight, Real tolerance)
  {
    bool bears = true;
    for (int i = 0; i < 2; i++)
      if (lies_in_tangent_plane(set, radius, i, tolerance)) {
        weight[i] = 0;
        bears = false;
      }
    if constexpr (kFades<Set>) {
      if (bears && likeness(set, 0, 1) > 0) solve_two(set, radius, weight, 0, 1);
    } else if (bears &&
               dot(set.normal[0], set.normal[1]) > 0) {    // inlined, it is faster than likeness()
      solve_two(set, radius, weight, 0, 1);
    }
  }

  // Returns G_ii.
  LSDCD_FN static Real diagonal([[maybe_unused]] const Set &set, [[maybe_unused]] int i)
  {
    if constexpr (kFades<Set>)
      return 1 + fade_of(set, i);
    else
      return 1;
  }
  // Returns the weight of a contact that shares with no other one.
  LSDCD_FN static Real alone([[maybe_unused]] const Set &set, [[maybe_unused]] int i)
  {
    if constexpr (kFades<Set>)
      return 1 / diagonal(set, i);
    else
      return 1;
  }

  // Leaves contacts that share with no other one out of the problem; they keep their weight.
  LSDCD_FN void leave_out_apart(const Set &set)
  {
    int n_sharing = 0;
    for (int k = 0; k < n_; k++) {
      shares_[k] = false;
      for (int p = 0; p < k; p++)
        if (likeness(set, used_[k], used_[p]) > 0) shares_[k] = shares_[p] = true;
    }
    for (int k = 0; k < n_; k++)
      if (shares_[k]) used_[n_sharing++] = used_[k];
    n_ = n_sharing;
  }

  // Returns the weight, or 1 if it is larger. Shares are rounded relative to the largest overlap, which may be more than a much
  // smaller overlap has.
  LSDCD_FN static Real at_most_one(Real weight) { return weight > 1 ? Real(1) : weight; }

  // Solves for two contacts without the last term. With it the force would differ by at most sqrt(2 kLeast) of the overlap, and
  // only if the normals are that close to each other.
  LSDCD_FN static void solve_two(const Set &set, Real radius, Real *weight, int a, int b)
  {
    const Real d0 = radius - set.distance[a], d1 = radius - set.distance[b];
    const Real u = uncovered(set, a, b), g = 1 - u;
    if constexpr (kFades<Set>)
      if (fade_of(set, a) > 0 || fade_of(set, b) > 0)
        return solve_fading(d0, d1, g, diagonal(set, a), diagonal(set, b), weight[a], weight[b]);
    // The gradients if only the other contact is active, computed without cancellation.
    const Real g0 = (d0 - d1) + u * d1, g1 = (d1 - d0) + u * d0;
    if (g1 <= 0 && g0 <= 0) {    // parallel and equally deep, to the last bits
      weight[a] = weight[b] = Real(0.5);
    } else if (g1 <= 0) {
      weight[b] = 0;
    } else if (g0 <= 0) {
      weight[a] = 0;
    } else {
      const Real scale = 1 / (u * (1 + g));
      weight[a] = at_most_one(g0 * scale / d0);
      weight[b] = at_most_one(g1 * scale / d1);
    }
  }

  // Solves for two contacts of which one fades: g_a and g_b are at least 1, and g is at most 1.
  LSDCD_FN static void solve_fading(Real d_a, Real d_b, Real g, Real g_a, Real g_b, Real &weight_a,
                                    Real &weight_b)
  {
    const Real l_a = g_b * d_a - g * d_b, l_b = g_a * d_b - g * d_a, det = g_a * g_b - g * g;
    if (l_a <= 0) {
      weight_a = 0;
      weight_b = 1 / g_b;
    } else if (l_b <= 0) {
      weight_a = 1 / g_a;
      weight_b = 0;
    } else {
      weight_a = at_most_one(l_a / det / d_a);
      weight_b = at_most_one(l_b / det / d_b);
    }
  }

  // Solves for any number of contacts. The rows of the matrix that belong to active contacts are kept as a Cholesky factor. Adding
  // a contact then costs a forward substitution; removing one is rare, and factors the rows behind it again.
  LSDCD_FN void solve_many(const Set &set, Real radius, Real *weight)
  {
    const int n = n_;
    make_convex(set, radius);
    n_active_ = 0;
    for (int k = 0; k < n; k++) l_[used_[k]] = 0;
    // Each round adds one contact. The objective decreases strictly, so that no active set occurs twice. The bound only guards
    // against round-off.
    for (int round = 0; round < 4 * n + 8; round++) {
      int enter = -1;
      Real steepest = 0;
      for (int k = 0; k < n; k++) {
        const int i = used_[k];
        if (is_active(i)) continue;
        const Real slope = gradient(set, i);
        if (slope > kTiny * pull_[i] && slope > steepest) {
          steepest = slope;
          enter = i;
        }
      }
      if (enter < 0) break;
      push(set, enter);
      while (!step(set)) {
      }
    }
    for (int k = 0; k < n; k++)
      weight[used_[k]] = at_most_one(l_[used_[k]] / (radius - set.distance[used_[k]]));
  }

  // Returns G_ij d_j / G_jj, and d_i for j = i.
  LSDCD_FN static Real covered_by(const Set &set, Real radius, int i, int j)
  {
    const Real part = cover(set, i, j) * (radius - set.distance[j]);
    if constexpr (kFades<Set>)
      return i == j ? part : part / diagonal(set, j);
    else
      return part;
  }

  // Determines s. The matrix scaled to m_i = 1 has the row sums d_i^2, so that s = max d_i^2 is always enough.
  LSDCD_FN void make_convex(const Set &set, Real radius)
  {
    Real deepest = 0;
    for (int k = 0; k < n_; k++) {
      const Real d = radius - set.distance[used_[k]];
      Real covered = 0;
      for (int p = 0; p < n_; p++) covered += covered_by(set, radius, used_[k], used_[p]);
      work_[used_[k]] = covered / d;
      deepest = d > deepest ? d : deepest;
    }
    const Real most = deepest * deepest, least = kLeast * most;
    Real low = least / 2, high = low;
    if (!is_convex(set, radius, low)) {
      high = most;
      // Covers by curvature need no s that is known in advance.
      if constexpr (kFades<Set>)
        for (int round = 0; round < kDoublings && !is_convex(set, radius, high); round++) high *= 2;
      for (int round = 0; round < kHalvings; round++) {
        const Real middle = (low + high) / 2;
        (is_convex(set, radius, middle) ? high : low) = middle;
      }
    }
    add_ridge(set, radius, 2 * high);
  }

  LSDCD_FN void add_ridge(const Set &set, Real radius, Real s)
  {
    for (int k = 0; k < n_; k++) {
      const int i = used_[k];
      const Real d = radius - set.distance[i];
      stiff_[i] = diagonal(set, i) + s * work_[i] / (d * d);
      pull_[i] = d + s / d;
    }
  }

  LSDCD_FN bool is_convex(const Set &set, Real radius, Real s)
  {
    add_ridge(set, radius, s);
    n_active_ = 0;
    for (int k = 0; k < n_; k++)
      if (!push(set, used_[k])) return false;
    return true;
  }

  LSDCD_FN Real &at(int row, int column) { return factor_[row * (row + 1) / 2 + column]; }

  LSDCD_FN bool is_active(int i) const
  {
    for (int k = 0; k < n_active_; k++)
      if (active_[k] == i) return true;
    return false;
  }

  LSDCD_FN static Real cover(const Set &set, int i, int j)
  {
    if (i == j) return 1;
    if (likeness(set, i, j) <= 0) return 0;
    return 1 - uncovered(set, i, j);
  }

  LSDCD_FN Real gradient(const Set &set, int i) const
  {
    Real slope = pull_[i];
    for (int k = 0; k < n_active_; k++) slope -= cover(set, i, active_[k]) * l_[active_[k]];
    return slope;
  }

  // Appends a row to the factor. Returns false if the matrix is not positive definite.
  LSDCD_NOINLINE bool push(const Set &set, int i)
  {
    const int m = n_active_;
    Real pivot = stiff_[i];
    for (int k = 0; k < m; k++) {
      Real sum = cover(set, i, active_[k]);
      for (int p = 0; p < k; p++) sum -= at(m, p) * at(k, p);
      at(m, k) = sum / at(k, k);
      pivot -= at(m, k) * at(m, k);
    }
    const Real round_off = kTiny * stiff_[i];
    const bool positive = pivot > round_off;
    at(m, m) = sqrt(positive ? pivot : round_off);
    active_[n_active_++] = i;
    return positive;
  }

  // Removes the k-th active contact and factors those behind it again.
  LSDCD_NOINLINE void leave(const Set &set, int leaving)
  {
    const int m = n_active_;
    l_[active_[leaving]] = 0;
    n_active_ = leaving;
    for (int k = leaving + 1; k < m; k++) push(set, active_[k]);
  }

  // Moves l towards the solution on the active set. If the condition l >= 0 stops it on the way, it drops the contact whose l has
  // become 0 and returns false. Returns true if l is the solution.
  LSDCD_FN bool step(const Set &set)
  {
    const int m = n_active_;
    for (int k = 0; k < m; k++) {
      Real sum = pull_[active_[k]];
      for (int p = 0; p < k; p++) sum -= at(k, p) * work_[p];
      work_[k] = sum / at(k, k);
    }
    for (int k = m - 1; k >= 0; k--) {
      for (int p = k + 1; p < m; p++) work_[k] -= at(p, k) * work_[p];
      work_[k] /= at(k, k);
    }
    int blocking = -1;
    Real part = 1;
    for (int k = 0; k < m; k++) {
      if (work_[k] > 0) continue;
      const Real from = l_[active_[k]];
      const Real max_step = from > 0 ? from / (from - work_[k]) : 0;
      if (max_step < part || blocking < 0) {
        part = max_step;
        blocking = k;
      }
    }
    if (blocking < 0) {
      for (int k = 0; k < m; k++) l_[active_[k]] = work_[k];
      return true;
    }
    for (int k = 0; k < m; k++) {
      Real &l = l_[active_[k]];
      l += part * (work_[k] - l);
    }
    leave(set, blocking);
    return n_active_ == 0;
  }

  // A pivot or a slope below this is regarded as round-off.
  static constexpr Real kTiny = 5e-15;
  // The least s, as a part of the largest d^2. Pivots are then at least half of it, far above round-off.
  static constexpr Real kLeast = 1e-12;
  static constexpr int kHalvings = 40, kDoublings = 20;

  int n_ = 0;    // contacts that share with others
  int used_[kMost];
  int n_active_ = 0;
  int active_[kMost];
  bool shares_[kMost];
  Real stiff_[kMost], pull_[kMost];    // diagonal and right side of the problem
  Real l_[kMost];
  Real work_[kMost];                        // m, until s is known; then the l that is the target
  Real factor_[kMost * (kMost + 1) / 2];    // lower triangle, row by row
};

}    // namespace lsdcd
