// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The corner rule: how overlaps of neighbouring contacts share one force.
#pragma once

#include "contact/contact_set.h"

namespace lsdcd {

// One minus the cosine between two unit normals, without cancellation.
LSDCD_FN Real one_minus_cos(const Vec3 &a, const Vec3 &b)
{
  return Real(0.5) * norm_sq(a - b);
}

// Weights w_i = l_i / d_i where l solves
//   minimise 1/2 l'Gl - d'l  subject to l >= 0,  G_ij = max(0, n_i . n_j),
// with overlaps d_i = radius - distance_i > 0. Right-angled or sharper corners
// give w = 1 exactly, parallel duplicates weights that sum to 1, and everything
// between is continuous. Solved exactly by an active set: a contact enters while
// the gradient d_i - (Gl)_i is positive, and leaves when its l would be negative.
//
// A closest point that lies in the tangent plane of another contact bears nothing: its gradient is
// (s - h) (R - s - h) / s, where s and h are the two distances. Where the two closest points are close,
// rounding hides the sign of s - h. So edges that lie in the plane of a face, and vertices in that of an
// edge or face, to `tolerance` (length), are left out first. Else the rim of a T-junction would turn the
// force by the square root of a rounding error.
template <int kPlaces>
class CornerRule {
 public:
  LSDCD_FN void solve(const ContactSet<kPlaces> &set, Real radius, Real *weight, Real tolerance = 0)
  {
    for (int i = 0; i < set.n; i++) weight[i] = 1;
    if (set.n < 2) return;
    bool apart = true;
    n_ = 0;
    for (int i = 0; i < set.n; i++) {
      if (lies_in_tangent_plane(set, radius, i, tolerance)) {
        weight[i] = 0;
        continue;
      }
      for (int k = 0; k < n_ && apart; k++) apart = dot(set.normal[i], set.normal[used_[k]]) <= 0;
      used_[n_++] = i;
    }
    if (apart) return;
    if (n_ == 2)
      solve_two(set, radius, weight, used_[0], used_[1]);
    else
      solve_many(set, radius, weight);
  }

 private:
  // Does closest point i lie in the tangent plane of a contact on a larger kind of feature?
  LSDCD_FN static bool lies_in_tangent_plane(const ContactSet<kPlaces> &set, Real radius, int i,
                                             Real tolerance)
  {
    const FeatureKind kind = feature_kind(set.feature[i]);
    if (kind == FeatureKind::face) return false;
    for (int k = 0; k < set.n; k++) {
      if (!(feature_kind(set.feature[k]) < kind)) continue;
      const Real rise = set.distance[k] - set.distance[i] * dot(set.normal[i], set.normal[k]);
      if (fabs(rise) <= tolerance && set.distance[i] + set.distance[k] >= radius) return true;
    }
    return false;
  }

  // A share is rounded by the largest overlap's bits, which may be more than a much
  // smaller one has.
  LSDCD_FN static Real at_most_one(Real weight) { return weight > 1 ? Real(1) : weight; }

  LSDCD_FN static void solve_two(const ContactSet<kPlaces> &set, Real radius, Real *weight, int a,
                                 int b)
  {
    const Real d0 = radius - set.distance[a], d1 = radius - set.distance[b];
    const Real u = one_minus_cos(set.normal[a], set.normal[b]), g = 1 - u;
    // The gradients when only the other contact is active, computed without cancellation.
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

  // The active contacts' rows of G are kept as a Cholesky factor, so that adding
  // one costs a forward substitution; leaving is rare and factors afresh.
  LSDCD_FN void solve_many(const ContactSet<kPlaces> &set, Real radius, Real *weight)
  {
    const int n = n_;
    n_active_ = 0;
    for (int k = 0; k < n; k++) {
      l_[used_[k]] = 0;
      refused_[used_[k]] = false;
    }
    // Each round adds one contact. The objective falls strictly, so that no active set
    // occurs twice. The bound is a guard against round-off.
    for (int round = 0; round < 4 * n + 8; round++) {
      int enter = -1;
      Real steepest = 0;
      for (int k = 0; k < n; k++) {
        const int i = used_[k];
        if (is_active(i) || refused_[i]) continue;
        const Real slope = gradient(set, radius, i);
        const Real d = radius - set.distance[i];
        if (slope > kTiny * d && slope > steepest) {
          steepest = slope;
          enter = i;
        }
      }
      if (enter < 0) break;
      bool is_in = push(set, enter);
      while (!is_in && make_room(set, enter)) is_in = push(set, enter);
      if (!is_in) {    // only by round-off: it replaces no other contact
        refused_[enter] = true;
        continue;
      }
      while (!step(set, radius)) {
      }
      for (int k = 0; k < n; k++) refused_[used_[k]] = false;
    }
    for (int k = 0; k < n; k++)
      weight[used_[k]] = at_most_one(l_[used_[k]] / (radius - set.distance[used_[k]]));
  }

  LSDCD_FN Real &at(int row, int column) { return factor_[row * (row + 1) / 2 + column]; }

  LSDCD_FN bool is_active(int i) const
  {
    for (int k = 0; k < n_active_; k++)
      if (active_[k] == i) return true;
    return false;
  }

  LSDCD_FN static Real overlap_cos(const ContactSet<kPlaces> &set, int i, int j)
  {
    if (i == j) return 1;
    if (dot(set.normal[i], set.normal[j]) <= 0) return 0;
    return 1 - one_minus_cos(set.normal[i], set.normal[j]);
  }

  LSDCD_FN Real gradient(const ContactSet<kPlaces> &set, Real radius, int i) const
  {
    Real slope = radius - set.distance[i];
    for (int k = 0; k < n_active_; k++) slope -= overlap_cos(set, i, active_[k]) * l_[active_[k]];
    return slope;
  }

  // Appends a row to the factor; false if G would become singular.
  LSDCD_NOINLINE bool push(const ContactSet<kPlaces> &set, int i)
  {
    const int m = n_active_;
    Real pivot = 1;
    for (int k = 0; k < m; k++) {
      Real sum = overlap_cos(set, i, active_[k]);
      for (int p = 0; p < k; p++) sum -= at(m, p) * at(k, p);
      at(m, k) = sum / at(k, k);
      pivot -= at(m, k) * at(m, k);
    }
    if (!(pivot > kTiny)) return false;
    at(m, m) = sqrt(pivot);
    active_[n_active_++] = i;
    return true;
  }

  // The normal of contact i is a combination of the active ones, to rounding. Its share grows while
  // theirs change so that the sum stays, which lowers the energy, until one of them is 0
  // and leaves. False if none shrinks. Call this right after push(i) has failed.
  LSDCD_FN bool make_room(const ContactSet<kPlaces> &set, int i)
  {
    const int m = n_active_;
    for (int k = m - 1; k >= 0; k--) {    // coefficients, from the row of push()
      target_[k] = at(m, k);
      for (int p = k + 1; p < m; p++) target_[k] -= at(p, k) * target_[p];
      target_[k] /= at(k, k);
    }
    int leaving = -1;
    Real most = 0;
    for (int k = 0; k < m; k++) {
      if (!(target_[k] > kTiny)) continue;
      const Real max_step = l_[active_[k]] / target_[k];
      if (leaving < 0 || max_step < most) {
        most = max_step;
        leaving = k;
      }
    }
    if (leaving < 0) return false;
    l_[i] += most;
    for (int k = 0; k < m; k++) {
      const Real rest = l_[active_[k]] - most * target_[k];
      l_[active_[k]] = rest > 0 ? rest : 0;
    }
    leave(set, leaving);
    return true;
  }

  // Removes the k-th active contact and factors the others again.
  LSDCD_NOINLINE void leave(const ContactSet<kPlaces> &set, int leaving)
  {
    const int m = n_active_;
    int n_kept = 0;
    for (int k = 0; k < m; k++)
      if (k != leaving) kept_[n_kept++] = active_[k];
    l_[active_[leaving]] = 0;
    n_active_ = 0;
    for (int k = 0; k < n_kept; k++)
      if (!push(set, kept_[k])) l_[kept_[k]] = 0;
  }

  // Moves l towards the solution on the active set. If l >= 0 stops it on the way, it drops the
  // contact whose l became 0 and returns false. True: l is the solution.
  LSDCD_FN bool step(const ContactSet<kPlaces> &set, Real radius)
  {
    const int m = n_active_;
    for (int k = 0; k < m; k++) {
      Real sum = radius - set.distance[active_[k]];
      for (int p = 0; p < k; p++) sum -= at(k, p) * target_[p];
      target_[k] = sum / at(k, k);
    }
    for (int k = m - 1; k >= 0; k--) {
      for (int p = k + 1; p < m; p++) target_[k] -= at(p, k) * target_[p];
      target_[k] /= at(k, k);
    }
    int blocking = -1;
    Real part = 1;
    for (int k = 0; k < m; k++) {
      if (target_[k] > 0) continue;
      const Real from = l_[active_[k]];
      const Real max_step = from > 0 ? from / (from - target_[k]) : 0;
      if (max_step < part || blocking < 0) {
        part = max_step;
        blocking = k;
      }
    }
    if (blocking < 0) {
      for (int k = 0; k < m; k++) l_[active_[k]] = target_[k];
      return true;
    }
    for (int k = 0; k < m; k++) {
      Real &l = l_[active_[k]];
      l += part * (target_[k] - l);
    }
    leave(set, blocking);
    return n_active_ == 0;
  }

  // A pivot or a slope below this is round-off. Ignoring such a slope changes the force by at most
  // sqrt(2 kTiny) of the overlap.
  static constexpr Real kTiny = 5e-15;

  int n_ = 0;    // contacts that take part
  int used_[kPlaces];
  int n_active_ = 0;
  int active_[kPlaces], kept_[kPlaces];
  bool refused_[kPlaces];
  Real l_[kPlaces], target_[kPlaces];
  Real factor_[kPlaces * (kPlaces + 1) / 2];    // lower triangle, row by row
};

}    // namespace lsdcd
