// THE kernel: the wall's force and torque on one sphere.
#pragma once

#include "contact/corner.h"
#include "contact/find_contacts.h"
#include "contact/history.h"
#include "engine/wall_engine.h"
#include "model/contact.h"

namespace lsdcd {

// One sphere's state at the start of the step.
struct SphereState {
  Vec3 x, v, omega;
  Real radius, mass;
  const Spring *springs;    // of the last step
  int n_springs;
};

// What the wall does to it. n_contacts counts the contacts that bear, and the springs;
// it is kOverflow where the contacts did not fit: nothing else is valid then and the
// sphere has to be done again.
struct SphereResult {
  Vec3 force, torque;
  Real energy;
  Real overlap_ratio;     // largest overlap / radius
  Vec3 weighted_point;    // sum of |normal force| * contact point
  Real weight;            // sum of |normal force|
  int n_contacts;
};
constexpr int kOverflow = -1;

struct ForceSettings {
  Real dt;
  bool update;
  bool blend;         // corner rule; false: plain sum
  int side;           // 0 both, +1 outside, -1 inside
  bool with_point;    // fill weighted_point and weight
};

// `springs_out` has room for kPlaces springs; it is written only where the law
// has history.
template <class Law, int kPlaces>
LSDCD_FN SphereResult wall_force(const GridView &grid, const Law &law,
                                 const ForceSettings &settings, const SphereState &s,
                                 Spring *springs_out)
{
  SphereResult out = {};
  ContactSet<kPlaces> set;
  find_contacts(grid, s.x, s.radius, set);
  if (settings.side != 0) keep_side(grid.wall, settings.side * grid.outside, set);
  if (set.overflow) out.n_contacts = kOverflow;
  if (set.overflow || set.n == 0) return out;

  Real weight[kPlaces];
  if (settings.blend && set.n > 1) {
    CornerRule<kPlaces> rule;
    rule.solve(set, s.radius, weight, grid.slack);
  } else {
    for (int i = 0; i < set.n; i++) weight[i] = 1;
  }

  for (int i = 0; i < set.n; i++) {
    const Real overlap = s.radius - set.distance[i], ratio = overlap / s.radius;
    if (ratio > out.overlap_ratio) out.overlap_ratio = ratio;
    // A contact that bears nothing, as the far face of a thin plate, is none. Nor has
    // it a spring yet: cut to the friction limit of its own slight overlap, that would
    // be gone when it takes over the force.
    if (!(weight[i] > 0)) continue;

    const Vec3 n = set.normal[i];
    Contact c;
    c.normal = n;
    c.overlap = overlap;
    c.radius = s.radius;
    c.mass = s.mass;
    c.v_normal = dot(s.v, n);
    c.v_tangent = s.v - c.v_normal * n - s.radius * cross(s.omega, n);
    c.dt = settings.dt;
    c.update = settings.update;

    Vec3 stretch = {0, 0, 0};
    if constexpr (Law::kHistory)
      stretch = inherited_stretch(grid.wall, set, i, s.springs, s.n_springs);
    const ContactForce f = law.evaluate(c, stretch);
    if constexpr (Law::kHistory) springs_out[out.n_contacts] = {stretch, n, set.feature[i], 0};
    out.n_contacts++;

    const Vec3 tangential = weight[i] * f.tangential;
    out.force += (weight[i] * f.normal) * n + tangential;
    out.torque -= s.radius * cross(n, tangential);
    out.energy += weight[i] * f.energy;
    if (settings.with_point) {
      const Real w = weight[i] * fabs(f.normal);
      out.weight += w;
      out.weighted_point += w * (s.x - set.distance[i] * n);
    }
  }
  return out;
}

}    // namespace lsdcd
