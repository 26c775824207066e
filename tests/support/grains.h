// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Spheres of a process, and a box for them, where the program that has the wall is a test.
#pragma once

#include "box/periodic_box.h"
#include "wall/spheres/host_spheres.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

// A box without periodic faces, 100 wide about the origin.
inline PeriodicBox wide_box()
{
  PeriodicBox box;
  box.corner = {-50, -50, -50};
  for (int k = 0; k < 3; k++) box.edge[k] = {0, 0, 0};
  for (int k = 0; k < 3; k++) box.edge[k][k] = 100;
  box.margin = 0.1;
  return box;
}

struct Grains {
  std::vector<Vec3> x, v, omega, force, torque;
  std::vector<Real> radius, mass;
  std::vector<std::int64_t> tags;

  // At rest, of mass 1, with the next tag from 1.
  void add(const Vec3 &at, Real r = 0.5)
  {
    x.push_back(at);
    for (std::vector<Vec3> *rest : {&v, &omega, &force, &torque}) rest->push_back({0, 0, 0});
    radius.push_back(r);
    mass.push_back(1);
    tags.push_back(static_cast<std::int64_t>(x.size()));
  }
  HostSpheres spheres()
  {
    HostSpheres s;
    s.n = static_cast<int>(x.size());
    if (s.n == 0) return s;
    s.x = &x[0].x;
    s.v = &v[0].x;
    s.omega = &omega[0].x;
    s.force = &force[0].x;
    s.torque = &torque[0].x;
    s.radius = radius.data();
    s.mass = mass.data();
    s.tag = tags.data();
    return s;
  }
};

}    // namespace lsdcd
