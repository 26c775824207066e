// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A small pair force between equal spheres, so that beds can rest without LAMMPS.
#pragma once

#include "support/meshes.h"

#include <algorithm>
#include <vector>

namespace lsdcd {

// Spring and dashpot along the line of centres and across it, with friction; one
// spring per pair that touches. The lever arm is half the distance of the centres,
// so that the pair's forces turn nothing between them.
class PairForce {
 public:
  struct Law {
    Real k, gamma, k_tangent, gamma_tangent, mu;
  };
  PairForce(int n, const Law &law) : n_(n), law_(law), shear_(n * n, Vec3{0, 0, 0}), at_(n) {}

  // Adds forces and torques to the scene's; its spheres are all alike.
  void add(Scene &scene, Real dt)
  {
    const Real radius = scene.radius(0), mass = scene.mass(0);
    for (int i = 0; i < n_; i++) at_[i] = scene.x(i);
    const Real reduced = mass / 2;
    for (int i = 0; i < n_; i++)
      for (int j = i + 1; j < n_; j++) {
        const Vec3 d = at_[i] - at_[j];
        Vec3 &h = shear_[i * n_ + j];
        if (norm_sq(d) >= 4 * radius * radius) {
          h = {0, 0, 0};
          continue;
        }
        const Real distance = norm(d), arm = distance / 2;
        const Vec3 n = (1 / distance) * d, rel = scene.v(i) - scene.v(j);
        const Real v_normal = dot(rel, n);
        const Vec3 slip = rel - v_normal * n - arm * cross(scene.omega(i) + scene.omega(j), n);
        const Real f_normal = law_.k * (2 * radius - distance) - reduced * law_.gamma * v_normal;
        h += dt * slip;
        h -= dot(h, n) * n;
        Vec3 f = -law_.k_tangent * h - reduced * law_.gamma_tangent * slip;
        const Real size = norm(f), limit = law_.mu * std::max(f_normal, Real(0));
        if (size > limit) {
          f = (limit / size) * f;
          h = (-1 / law_.k_tangent) * (f + reduced * law_.gamma_tangent * slip);
        }
        f += f_normal * n;
        const Vec3 t = -arm * cross(n, f);
        scene.add_force(i, f, t);
        scene.add_force(j, -f, t);
      }
  }

 private:
  int n_;
  Law law_;
  std::vector<Vec3> shear_, at_;
};

}    // namespace lsdcd
