// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The spheres of a host code, in arrays that a test or a benchmark fills: in the host's memory, or where an
// engine computes.
#pragma once

#include "engine/engine.h"
#include "support/device_memory.h"

#include <vector>

namespace lsdcd {

inline Vec3 vector_at(const std::vector<Real> &a, int i)
{
  return {a[3 * i], a[3 * i + 1], a[3 * i + 2]};
}
inline void put_vector(std::vector<Real> &a, int i, const Vec3 &value)
{
  for (int k = 0; k < 3; k++) a[3 * i + k] = value[k];
}

// Vectors lie as x y z x y z.
struct SphereArrays {
  std::vector<Real> x, v, omega, radius, mass, force, torque;
  std::vector<Real> temperature, heat_flow;    // empty where the law has no heat

  SphereArrays() = default;
  // n spheres of one radius and of mass 1, at rest at the origin.
  SphereArrays(int n, Real radius_of_all) :
      x(3 * n), v(3 * n), omega(3 * n), radius(n, radius_of_all), mass(n, 1), force(3 * n),
      torque(3 * n)
  {
  }

  int n() const { return static_cast<int>(radius.size()); }

  int add(const Vec3 &at, Real its_radius, Real its_mass = 1, const Vec3 &velocity = {0, 0, 0},
          const Vec3 &angular = {0, 0, 0})
  {
    const int i = n();
    for (std::vector<Real> *a : {&x, &v, &omega, &force, &torque}) a->resize(3 * (i + 1), 0);
    put_vector(x, i, at);
    put_vector(v, i, velocity);
    put_vector(omega, i, angular);
    radius.push_back(its_radius);
    mass.push_back(its_mass);
    return i;
  }

  void clear_forces()
  {
    force.assign(x.size(), 0);
    torque.assign(x.size(), 0);
  }
  // All along their velocities.
  void move(Real dt)
  {
    for (std::size_t k = 0; k < x.size(); k++) x[k] += dt * v[k];
  }

  // Borrowed until one is added.
  Spheres spheres()
  {
    Spheres s;
    s.n = n();
    s.x = x.data();
    s.v = v.data();
    s.omega = omega.data();
    s.radius = radius.data();
    s.mass = mass.data();
    s.force = force.data();
    s.torque = torque.data();
    if (!temperature.empty()) s.temperature = temperature.data();
    if (!heat_flow.empty()) s.heat_flow = heat_flow.data();
    return s;
  }
};

// The same where an engine computes.
class SphereArraysOn {
 public:
  explicit SphereArraysOn(bool cuda) :
      x_(cuda), v_(cuda), omega_(cuda), radius_(cuda), mass_(cuda), force_(cuda), torque_(cuda),
      temperature_(cuda), heat_flow_(cuda)
  {
  }

  // Copies all but forces, torques and heat flows, which become zero. Borrowed until the next call.
  Spheres put(const SphereArrays &from)
  {
    const std::vector<Real> none(from.x.size(), 0);
    Spheres s;
    s.n = from.n();
    s.x = x_.put(from.x);
    s.v = v_.put(from.v);
    s.omega = omega_.put(from.omega);
    s.radius = radius_.put(from.radius);
    s.mass = mass_.put(from.mass);
    s.force = force_.put(none);
    s.torque = torque_.put(none);
    if (!from.temperature.empty()) s.temperature = temperature_.put(from.temperature);
    if (!from.heat_flow.empty()) s.heat_flow = heat_flow_.put(none.data(), from.heat_flow.size());
    return s;
  }
  void put_x(const std::vector<Real> &x) { x_.put(x); }
  void put_force(const std::vector<Real> &force) { force_.put(force); }
  std::vector<Real> force(int n) const { return force_.get(3 * n); }
  std::vector<Real> torque(int n) const { return torque_.get(3 * n); }

 private:
  DeviceArray<Real> x_, v_, omega_, radius_, mass_, force_, torque_, temperature_, heat_flow_;
};

}    // namespace lsdcd
