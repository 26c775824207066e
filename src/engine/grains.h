// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The spheres of a step, and of a mesh whose nodes move, as their host has them.
#pragma once

#include "base/quaternion.h"
#include "base/strided_view.h"
#include "base/vec3.h"

namespace lsdcd {

// Arrays of a host that has them in float. Pointers are to the memory of the engine's backend. Units as in Spheres.
struct FloatSpheres {
  StridedView<const float> x, v, omega;
  const float *radius = nullptr, *mass = nullptr;
  StridedView<float> force,
      torque;    // added to; null if the host sums forces in double, in those of Spheres
};

// The shape of a grain that may be no sphere: a superellipsoid (shape/superellipsoid.h) and its orientation.
struct GrainShape {
  Vec3 half = {0, 0, 0};    // half-axes, length; all 0: it is a sphere
  Real n1 = 2, n2 = 2;      // exponents
  Quaternion turn;          // from its axes to the box
  // Moments of inertia about its axes over its own mass, even if Spheres::mass is that of a rigid body; length^2.
  Vec3 inertia_over_mass = {0, 0, 0};

  bool is_sphere() const { return half.x == 0; }
};

// Sphere data of a host code, borrowed for one step; n is the number of owned spheres.
struct Spheres {
  int n = 0;
  StridedView<const Real> x;        // length
  StridedView<const Real> v;        // length/time
  StridedView<const Real> omega;    // 1/time
  const Real *radius = nullptr;     // length
  const Real *mass = nullptr;       // mass that damping sees (a rigid member's body mass)
  const int *mask = nullptr;        // group bits; null: all spheres belong to the group
  int group_bit = 0;
  const int *type = nullptr;            // from 1; read if laws differ by it
  StridedView<Real> force;              // added to
  StridedView<Real> torque;             // added to
  const Real *temperature = nullptr;    // read if the law has heat
  Real *heat_flow = nullptr;            // power; added to if the law has heat
  // Used with HostArrays::in_float, instead of x, v, omega, radius, force and torque, and of mass if that is null.
  const FloatSpheres *in_float = nullptr;
  // Used if laws are for shapes; null: all grains are spheres. The radius of a grain that is no sphere is that of a
  // sphere around it.
  const GrainShape *shapes = nullptr;
};

}    // namespace lsdcd
