// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The longest timestep with which contacts and springs of a body are stable.
#pragma once

#include "rigid/mobility.h"

namespace lsdcd {

// Rates of a mode.
struct ModeRates {
  Real stiffness = 0;    // of a spring per mass: 1/time^2
  Real damping = 0;      // of a damper per mass: 1/time

  ModeRates &operator+=(const ModeRates &more)
  {
    stiffness += more.stiffness;
    damping += more.damping;
    return *this;
  }
};

// The sum of k J J' over the contacts of a body: J = (n, r x n), the change of a contact's overlap by its coordinates.
// Sums of several processes add up, number by number.
struct ContactSum {
  static constexpr int kNumbers = 21;
  Real number[kNumbers] = {};    // the upper triangle of a matrix of 6 by 6, row by row

  // A contact of stiffness k (or damping) at the place x, along the unit vector n; in the frame of the mesh.
  void add(const Mobility &body, const Vec3 &x, const Vec3 &n, Real k);
  // A spring along (about) a coordinate of the joint: `shift` and `turn` are the velocities at a rate of 1.
  void add(const Vec3 &shift, const Vec3 &turn, Real k);
  ContactSum &operator+=(const ContactSum &more)
  {
    for (int i = 0; i < kNumbers; i++) number[i] += more.number[i];
    return *this;
  }

  // Largest eigenvalue of M^-1 (sum k J J'): the square of the fastest mode's angular frequency, or, of dampers, the
  // fastest rate of decay.
  Real largest(const Mobility &body) const;
};

// Leapfrog is stable below this. The velocity that damping sees lags by a step, which costs a factor: with x = dt sqrt(k)
// and c = 2 z sqrt(k) the step is stable while x^2 + 4 z x < 4. `stiffness` and `damping` are per mass: 1/time^2 and
// 1/time.
Real longest_step(Real stiffness, Real damping);
inline Real longest_step(const ModeRates &rates)
{
  return longest_step(rates.stiffness, rates.damping);
}

}    // namespace lsdcd
