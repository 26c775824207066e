// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The impacts of a sphere that has several contacts (strike.h). Only laws with kRecords have these lines, and a step runs them only if
// a contact begins.
#pragma once

#include "engine/step/contact_forces.h"
#include "engine/step/step_job.h"

#include <cstdint>

namespace lsdcd {

// A contact in the frame that all meshes of the sphere share.
struct StruckContact {
  Strike strike;
  Strike before;    // the contact in the last step; only if it has moved since
  Real mass;        // as in Contact
  Real along;       // speed of the centre along the wall; read only if impacts wear
  int place;        // its number among the contacts of the sphere that are stored
  FeatureCode feature;
  std::uint32_t mesh;    // number in the wall
  bool bears;            // false: the corner rule hides it
  bool stays;            // it is on its feature of the last step
  bool has_moved;        // it was on another feature; if neither, it is new
};

// Calls visit(slot, contacts, from) for each mesh that a sphere touches: the sphere's slot among candidate-mesh pairs, its contacts with
// that mesh, and the number of the first of them in the set.
template <class Sphere, class Contacts, class Visit>
LSDCD_FN void for_each_touched_mesh(const Sphere &sphere, const Contacts &set, const Visit &visit)
{
  for (int m = 0, from = 0; m < sphere.n_meshes(); m++) {
    const auto slot = sphere.begin() + m;
    const int to = sphere.contacts_end(slot, set.n);
    if (!Sphere::kSeveral || to > from) visit(slot, set.part(from, to - from), from);
    from = to;
  }
}

// Returns whether no contact of a sphere continues old spring k. `carries`: see is_left_by().
template <class Sphere, class Contacts>
LSDCD_FN bool is_left_by_all(const Sphere &sphere, const Contacts &set, bool carries, int k)
{
  for (int m = 0, from = 0; m < sphere.n_meshes(); m++) {
    const auto slot = sphere.begin() + m;
    const int to = sphere.contacts_end(slot, set.n);
    const auto springs = sphere.state(sphere.mesh(slot).law, slot).springs;
    if (!is_left_by(set.part(from, to - from), carries, old_direction(springs, k), springs, k))
      return false;
    from = to;
  }
  return true;
}

// Calls visit(contact, i) for the i-th contact of a sphere.
template <class Law, class Sphere, class Contacts, class Visit>
LSDCD_FN void for_each_struck(const StepJob &job, const Sphere &sphere, const Contacts &set,
                              const Real *weight, const Visit &visit)
{
  int stored = 0;
  for_each_touched_mesh(sphere, set, [&](auto slot, const Contacts &of_mesh, int from) {
    const auto mesh = sphere.mesh(slot);
    const ForceSettings &settings = mesh.settings;
    auto state = sphere.state(mesh.law, slot);
    add_motion(mesh.law, job, settings.pose, sphere.i, state);
    for (int at = 0; at < of_mesh.n; at++) {
      const Vec3 n = of_mesh.normal[at], closest = of_mesh.foot_of(at, state.x, n);
      const FeatureCode feature = of_mesh.feature[at];
      const Transfer in = contacts_in_step(of_mesh).transfer(mesh.grid, mesh.law, at, state);
      NodeShares nodes = {};
      const Vec3 v =
          velocity_against<Law>(mesh.grid.wall, settings, state, feature, closest, nodes);
      const Real overlap = of_mesh.overlap_of(at, state.radius);
      const auto strike_along = [&](const Vec3 &normal) -> Strike {
        return {settings.pose.turn_to_box(normal), -dot(v, normal), overlap};
      };
      const bool bears = weight[from + at] > 0;
      StruckContact c = {strike_along(n),
                         {},
                         mass_at<Law>(settings, state.mass, closest, n),
                         0,
                         stored,
                         feature,
                         settings.mesh,
                         bears,
                         stays(state.springs, in, feature, settings.mesh),
                         false};
      if (!c.stays && may_have_moved(in)) {
        const Vec3 was = old_direction(state.springs, in.from);
        c.has_moved = is_left_by_all(sphere, set, dot(n, was) > kSameDirection, in.from);
        c.before = strike_along(was);
      }
      if (job.records.oka) {
        Vec3 along = v - dot(v, n) * n;
        if (settings.surface_moves) along -= settings.surface.along(closest, n, settings.back);
        c.along = norm(along);
      }
      visit(c, from + at);
      stored += bears;
    }
  });
}

// Writes the impacts of a sphere to the list of records, and what they wear off to its stored contacts. Of impacts that begin in the same
// step the fastest comes first, so that they depend neither on the numbers of features nor on rounding.
template <class Law, class Sphere, class Contacts>
LSDCD_NOINLINE void record_impacts(const StepJob &job, const Sphere &sphere, const Contacts &set,
                                   const Real *weight, StepContact *stored)
{
  TakenAway taken;    // begins with what touches already, though the corner rule may hide it now
  for_each_struck<Law>(job, sphere, set, weight, [&](const StruckContact &c, int) {
    if (c.stays) taken.take(c.strike);
    if (c.has_moved) taken.take(c.before);
  });
  Real last_speed = kAnyDistance;
  for (int last = -1;;) {
    StruckContact next = {};
    int found = -1;
    for_each_struck<Law>(job, sphere, set, weight, [&](const StruckContact &c, int i) {
      const Real speed = c.strike.speed;
      const bool is_due = speed < last_speed || (speed == last_speed && i > last);
      if (c.stays || !c.bears || !is_due || (found >= 0 && !(speed > next.strike.speed))) return;
      next = c;
      found = i;
    });
    if (found < 0) return;
    if (job.records.impact_speed > 0) {
      EnergyRecord record = {next.feature, next.mesh, 0, 0, 0};
      add_impact(taken, next.strike, next.mass, job.settings.dt, job.records, record);
      job.records.put(record);
    }
    if (job.records.oka)
      stored[next.place].wear_power =
          oka_power(taken, next.strike, next.along, job.mass[sphere.i], 2 * job.radius[sphere.i],
                    job.settings.dt, *job.records.oka);
    taken.take(next.strike);
    last_speed = next.strike.speed;
    last = found;
  }
}

}    // namespace lsdcd
