// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Results of a step: of one sphere, and of all candidate spheres in columns.
#pragma once

#include "base/strided_view.h"
#include "base/vec3.h"
#include "engine/results/step_results.h"

namespace lsdcd {

// The result of one sphere, in the frame of a mesh until to_box(). force, torque: those of the wall on the sphere. n_contacts: the
// number of contacts that bear, and of springs.
struct alignas(16) SphereResult {
  Vec3 force, torque;
  Real energy;
  Real overlap_ratio;     // largest overlap / radius
  Vec3 weighted_point;    // sum of |normal force| * contact point
  Real weight;            // sum of |normal force|
  int n_contacts;
  int pad;    // keeps the struct free of indeterminate bytes
};

struct ResultColumns {
  int *n_contacts = nullptr;          // of each candidate; if it is 0, the others are not valid
  StridedView<Real> force, moment;    // moment: of force and torque about the origin
  Column<Real> energy, overlap_ratio;
  StridedView<Real> weighted_point;    // these two only if they are asked for
  Column<Real> weight;
  StridedView<Real> torque;    // only if forces are added later

  // Returns how many numbers a result has.
  static constexpr std::size_t reals(bool with_point, bool with_torque)
  {
    return 8 + (with_point ? 4 : 0) + (with_torque ? 3 : 0);
  }

  // Returns columns of `room` results in one array.
  static ResultColumns of(Real *at, std::size_t room, bool with_point, bool with_torque,
                          int *n_contacts)
  {
    const auto next = static_cast<std::ptrdiff_t>(room);
    ResultColumns c;
    c.n_contacts = n_contacts;
    c.force = {at, 1, next};
    c.moment = {at + 3 * next, 1, next};
    c.energy = {at + 6 * next};
    c.overlap_ratio = {at + 7 * next};
    if (with_torque) c.torque = {at + 8 * next, 1, next};
    if (!with_point) return c;
    at += (with_torque ? 11 : 8) * next;
    c.weighted_point = {at, 1, next};
    c.weight = {at + 3 * next};
    return c;
  }

  // Returns the results from number k on.
  ResultColumns from(std::size_t k) const
  {
    ResultColumns c = *this;
    c.n_contacts += k;
    c.force.at += k;
    c.moment.at += k;
    c.energy.at += k;
    c.overlap_ratio.at += k;
    if (c.torque.at) c.torque.at += k;
    if (!c.weight.at) return c;
    c.weighted_point.at += k;
    c.weight.at += k;
    return c;
  }

  LSDCD_FN void put(std::size_t at, const SphereResult &r, const Vec3 &about_origin) const
  {
    n_contacts[at] = r.n_contacts;
    force.put(at, r.force);
    moment.put(at, about_origin);
    energy[at] = r.energy;
    overlap_ratio[at] = r.overlap_ratio;
    if (torque.at) torque.put(at, r.torque);
    if (!weight.at) return;
    weighted_point.put(at, r.weighted_point);
    weight[at] = r.weight;
  }

  // Returns result number `at`; its torque is the moment.
  LSDCD_FN SphereResult get(std::size_t at) const
  {
    SphereResult r = {};
    r.n_contacts = n_contacts[at];
    r.force = force[at];
    r.torque = moment[at];
    r.energy = energy[at];
    r.overlap_ratio = overlap_ratio[at];
    if (!weight.at) return r;
    r.weighted_point = weighted_point[at];
    r.weight = weight[at];
    return r;
  }
};

// Sums have three levels: 32 candidates form a block, 32 blocks a group, and the groups are summed last.
constexpr int kTotalsBlock = 32;

}    // namespace lsdcd
