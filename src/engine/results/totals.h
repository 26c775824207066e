// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// From the results of single spheres to sums, the same way on every backend.
#pragma once

#include "engine/results/sphere_result.h"
#include "engine/wall_engine.h"

namespace lsdcd {

// Sums are made in blocks of so many spheres, over so many of these blocks, and over what that
// leaves, each in order: the same bits whatever the number of threads, of which a GPU needs many.
constexpr int kTotalsBlock = 32;

// Adds the overlap / radius > 0 that a sphere may have missed.
LSDCD_FN void add_uncertain(WallTotals &t, Real uncertain)
{
  t.uncertified++;
  t.largest_uncertain = fmax(t.largest_uncertain, uncertain);
}

// Adds the result of sphere i, which touches; `moment` is that of its force and torque
// about the origin.
LSDCD_FN void add_result(WallTotals &t, const SphereResult &r, const Vec3 &moment, int i)
{
  t.energy += r.energy;
  t.force -= r.force;
  t.torque -= moment;
  t.contacts += r.n_contacts;
  if (r.overlap_ratio > t.largest_overlap_ratio) {
    t.largest_overlap_ratio = r.overlap_ratio;
    t.largest_overlap_sphere = i;
  }
}

LSDCD_FN void add_block(WallTotals &sum, const WallTotals &t)
{
  sum.energy += t.energy;
  sum.force += t.force;
  sum.torque += t.torque;
  sum.contacts += t.contacts;
  sum.uncertified += t.uncertified;
  sum.largest_uncertain = fmax(sum.largest_uncertain, t.largest_uncertain);
  if (t.largest_overlap_ratio > sum.largest_overlap_ratio) {
    sum.largest_overlap_ratio = t.largest_overlap_ratio;
    sum.largest_overlap_sphere = t.largest_overlap_sphere;
  }
}

// The columns of `contacts`. Contacts that exert no force still have a place: that of the
// sphere.
LSDCD_FN SphereOutput output_of(const SphereResult &r, const Vec3 &x, Real radius)
{
  return {Real(r.n_contacts), r.force, r.weight > 0 ? (1 / r.weight) * r.weighted_point : x,
          radius};
}

}    // namespace lsdcd
