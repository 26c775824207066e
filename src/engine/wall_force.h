// THE kernel: the wall's force and torque on one sphere.
#pragma once

#include "contact/history.h"
#include "engine/touch.h"
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
  Real uncertain;         // overlap of the deepest contact that may be missing; 0: certified
  int n_contacts;
};
constexpr int kOverflow = -1;

struct ForceSettings {
  SearchSettings search;
  Real dt;
  bool update;
  bool with_point;    // fill weighted_point and weight
};

// `springs_out` has room for kPlaces springs; it is written only where the law
// has history. Numbers are of type Law::Number inside the law, Real outside.
template <class Law, int kPlaces>
LSDCD_FN SphereResult wall_force(const GridView &grid, const Law &law,
                                 const ForceSettings &settings, const SphereState &s,
                                 Spring *springs_out)
{
  using T = typename Law::Number;
  SphereResult out = {};
  Touch<kPlaces> touching;
  if (grid.in_floats)
    touch<BrickGeometry>(grid, settings.search, s.x, s.radius, touching);
  else
    touch<WallGeometry>(grid, settings.search, s.x, s.radius, touching);
  const ContactSet<kPlaces> &set = touching.set;
  if (set.overflow) out.n_contacts = kOverflow;
  if (touching.exact_within < s.radius) out.uncertain = s.radius - touching.exact_within;
  if (set.overflow || set.n == 0) return out;

  for (int i = 0; i < set.n; i++) {
    const Real weight = touching.weight[i];
    const Real overlap = s.radius - set.distance[i], ratio = overlap / s.radius;
    if (ratio > out.overlap_ratio) out.overlap_ratio = ratio;
    // A contact that bears nothing, as the far face of a thin plate, is none. Nor has
    // it a spring yet: cut to the friction limit of its own slight overlap, that would
    // be gone when it takes over the force.
    if (!(weight > 0)) continue;

    const Vec3 n = set.normal[i];
    const Real v_normal = dot(s.v, n);
    Contact<T> c;
    c.normal = vec_cast<T>(n);
    c.overlap = static_cast<T>(overlap);
    c.radius = static_cast<T>(s.radius);
    c.mass = static_cast<T>(s.mass);
    c.v_normal = static_cast<T>(v_normal);
    c.v_tangent = vec_cast<T>(s.v - v_normal * n - s.radius * cross(s.omega, n));
    c.dt = static_cast<T>(settings.dt);
    c.update = settings.update;

    Vec3Of<T> stretch = {0, 0, 0};
    if constexpr (Law::kHistory)
      stretch = vec_cast<T>(inherited_stretch(grid.wall, set, i, s.springs, s.n_springs));
    const ContactForce<T> f = law.evaluate(c, stretch);
    if constexpr (Law::kHistory)
      springs_out[out.n_contacts] = {vec_cast<Real>(stretch), n, set.feature[i], 0};
    out.n_contacts++;

    const Vec3 tangential = weight * vec_cast<Real>(f.tangential);
    out.force += (weight * f.normal) * n + tangential;
    out.torque -= s.radius * cross(n, tangential);
    out.energy += weight * f.energy;
    if (settings.with_point) {
      const Real w = weight * fabs(f.normal);
      out.weight += w;
      out.weighted_point += w * (s.x - set.distance[i] * n);
    }
  }
  return out;
}

}    // namespace lsdcd
