// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Normal elasticity: the force that an overlap gives, and the size of the contact.
// Each has
//   contact_radius(c)   length
//   force(c, a)         elastic force, > 0 where it pushes
//   energy(c, a)        what is held
//   secant(c, a)        stiffness without adhesion, force over overlap: force/length
//   tangent(c, a)       the same for a little more overlap: the slope of the force
// where a is the contact radius, which a law computes only if something needs it.
#pragma once

#include "base/cube_root.h"
#include "law/contact.h"

#include <cmath>
#include <stdexcept>

namespace lsdcd {

enum class NormalModel : ModelNumber {
  hooke,
  hertz,
  dmt,
  jkr,
  hysteretic,
  hysteretic_size,
  hysteretic_edem,
  eepa,
  lepa,
  thornton
};

// What is true of a model whatever its numbers are.
struct NormalFacts {
  bool is_adhesive;    // can the force pull, though nothing moves?
  // The damping, per square root of mass times secant stiffness, with which nothing rebounds; that of a restitution is a known
  // part of it. 0: no damping returns a restitution at all speeds.
  Real no_rebound;
  bool yields = false;    // does a contact keep how far it has yielded (plastic.h)?
};
inline NormalFacts facts_of(NormalModel model)
{
  switch (model) {
    case NormalModel::hooke:
      return {false, 2};
    case NormalModel::hertz:
      return {false, std::sqrt(Real(5))};
    case NormalModel::dmt:
    case NormalModel::jkr:
      return {true, 0};
    case NormalModel::hysteretic:
    case NormalModel::hysteretic_size:
    case NormalModel::hysteretic_edem:
    case NormalModel::thornton:
      return {false, 0, true};
    case NormalModel::eepa:
      return {true, 2, true};
    case NormalModel::lepa:
      return {true, 0, true};
  }
  throw std::logic_error("facts_of (normal.h) has no case of this normal sub-model");
}

// ---- the classic styles ------------------------------------------------------------------

// Linear spring. k: force/length.
struct HookeNormal {
  static constexpr bool kUsesContactRadius = false;    // does force()?
  Real k;

  LSDCD_FN Real contact_radius(const Contact &c) const { return sqrt(c.overlap * c.radius); }
  LSDCD_FN Real force(const Contact &c, Real) const { return k * c.overlap; }
  LSDCD_FN Real secant(const Contact &, Real) const { return k; }
  LSDCD_FN Real tangent(const Contact &, Real) const { return k; }
  LSDCD_FN Real energy(const Contact &c, Real) const { return 0.5 * k * c.overlap * c.overlap; }
};

// Hertz: F = k a overlap, a = sqrt(R overlap). k: force/length^2, 4/3 of the modulus.
struct HertzNormal {
  static constexpr bool kUsesContactRadius = true;
  Real k;

  LSDCD_FN Real contact_radius(const Contact &c) const { return sqrt(c.overlap * c.radius); }
  LSDCD_FN Real force(const Contact &c, Real a) const { return a * k * c.overlap; }
  LSDCD_FN Real secant(const Contact &, Real a) const { return a * k; }
  LSDCD_FN Real tangent(const Contact &, Real a) const { return a * (1.5 * k); }
  LSDCD_FN Real energy(const Contact &c, Real a) const
  {
    return 0.4 * k * a * c.overlap * c.overlap;
  }
};

// ---- the sub-models of `granular` --------------------------------------------------------
// Each also has limit(c, f, normal), the force that friction is proportional to. f is the elastic force,
// `normal` the force with damping. Adhesion presses the surfaces together even where the forces
// cancel.

// `hooke`, `hertz` and `dmt` share one kernel: the choice is the same for all contacts of a wall. DMT (Derjaguin, Muller and
// Toporov 1975) is Hertz minus a constant pull 4 pi gamma R while the spheres touch.
struct TouchingNormal {
  static constexpr bool kBeyondContact = false;    // does it act past touch?
  static constexpr int kScalars = 0;               // numbers that a contact keeps for it
  NormalModel model;
  Real k;       // force/length (hooke), force/length^2
  Real pull;    // 4 pi gamma, force/length; 0 but for dmt

  // Returns whether force() reads `a` or Contact::radius.
  LSDCD_FN bool uses_contact_radius() const { return model != NormalModel::hooke; }
  LSDCD_FN Real contact_radius(const Contact &c) const { return sqrt(c.overlap * c.radius); }
  LSDCD_FN Real force(const Contact &c, Real a) const
  {
    if (!uses_contact_radius()) return k * c.overlap;
    return a * k * c.overlap - pull * c.radius;
  }
  LSDCD_FN Real secant(const Contact &, Real a) const { return uses_contact_radius() ? a * k : k; }
  LSDCD_FN Real tangent(const Contact &, Real a) const
  {
    return uses_contact_radius() ? a * (1.5 * k) : k;
  }
  LSDCD_FN Real limit(const Contact &c, Real f, Real normal) const
  {
    return fabs(model == NormalModel::dmt ? f + 2 * pull * c.radius : normal);
  }
  LSDCD_FN Real energy(const Contact &c, Real a) const
  {
    if (!uses_contact_radius()) return 0.5 * k * c.overlap * c.overlap;
    return 0.4 * k * a * c.overlap * c.overlap - pull * c.radius * c.overlap;
  }
};

// `jkr` (Johnson, Kendall and Roberts 1971). The contact radius solves
//   overlap = a^2/R - 2 sqrt(pi gamma a/E),
// and the force is 4 E a^3/(3 R) - 4 sqrt(pi gamma E a^3). A contact that has touched holds until
// the pull is greatest, 3 pi gamma R, at an overlap of -(3 pi^2 gamma^2 R/(16 E^2))^(1/3).
struct JkrNormal {
  static constexpr bool kBeyondContact = true;
  static constexpr int kScalars = 0;
  Real modulus, surface_energy;
  Real root;        // sqrt(pi gamma E)
  Real size;        // (4 pi gamma/E)^(1/3): a = size R^(2/3) y^2 with y = 1 at overlap 0
  Real pull_off;    // for a radius of 1; length^(2/3)

  JkrNormal(Real modulus_, Real surface_energy_) :
      modulus(modulus_), surface_energy(surface_energy_)
  {
    const Real ratio = surface_energy / modulus;
    root = sqrt(kPi * surface_energy * modulus);
    size = cube_root(4 * kPi * ratio);
    pull_off = cube_root(3 * kPi * kPi * ratio * ratio / 16);
  }

  LSDCD_FN bool uses_contact_radius() const { return true; }

  // With a = s y^2, s = size R^(2/3), the overlap is y^4 - y in units of s^2/R. Newton's
  // method from above: the left side is convex and rises for y > 4^(-1/3) = 0.63, and
  // contacts hold down to y = (3/4)^(1/3) = 0.91.
  LSDCD_FN Real contact_radius(const Contact &c) const
  {
    const Real cube = cube_root(c.radius), s = size * cube * cube;
    const Real unit = s * s / c.radius;
    if (!(unit > 0)) return sqrt(c.overlap > 0 ? c.overlap * c.radius : 0);
    const Real q = c.overlap / unit;
    // Two upper bounds: one is close for small q, the other for large q.
    Real y = 1;
    if (q > 0) {
      const Real small = 1 + q / 3, large = 1 + sqrt(sqrt(q));
      y = small < large ? small : large;
    }
    for (int k = 0; k < 6; k++) {
      const Real cubed = y * y * y;
      y -= (y * cubed - y - q) / (4 * cubed - 1);
    }
    return s * y * y;
  }
  LSDCD_FN Real force(const Contact &c, Real a) const
  {
    return Real(4) / 3 * modulus * a * a * a / c.radius - 4 * root * a * sqrt(a);
  }
  LSDCD_FN Real secant(const Contact &, Real a) const { return Real(4) / 3 * modulus * a; }
  LSDCD_FN Real tangent(const Contact &, Real a) const
  {
    return a * (1.5 * (Real(4) / 3 * modulus));
  }
  LSDCD_FN Real limit(const Contact &c, Real f, Real) const
  {
    return fabs(f + 6 * kPi * surface_energy * c.radius);
  }
  // Returns the elastic energy minus that of the surfaces in contact.
  LSDCD_FN Real energy(const Contact &c, Real a) const
  {
    const Real cubed = a * a * a, per_radius = 1 / c.radius;
    return Real(8) / 15 * modulus * cubed * a * a * per_radius * per_radius -
           Real(8) / 3 * root * cubed * sqrt(a) * per_radius + 2 * kPi * surface_energy * a * a;
  }
};

}    // namespace lsdcd
