// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What the contact of two grains does with energy in a step; contact_energy.h has the same for a wall. Forces have been computed by
// the law without energy balance. This code computes the pair once more, with the law that says what its force is made of, and
// keeps the parts for the next step. The places of the grains a step ago follow from their velocities.
#pragma once

#include "engine/step/contact_energy.h"
#include "pair/kept_of_pair.h"
#include "pair/pair_kernel.h"

namespace lsdcd {

// Motion and arms of a pair, at the end of a step or at its beginning.
struct PairMotion {
  Vec3 n;
  Vec3 v, omega_i, omega_j;    // v: of i less that of j
  Vec3 slip;                   // of the surfaces, as the law sees it
  Real slip_i, slip_j;         // arms of slip
  Real arm_i, arm_j;           // of the friction

  LSDCD_FN Vec3 omega() const { return omega_i - omega_j; }
};

template <class Law>
LSDCD_FN PairMotion pair_motion(const Law &law, const GrainPair &p, const Vec3 &offset)
{
  const Real distance = norm(offset), overlap = p.radius_i + p.radius_j - distance;
  PairMotion m;
  m.n = (1 / distance) * offset;
  m.v = p.velocity;
  m.omega_i = p.omega_i;
  m.omega_j = p.omega_j;
  Real less = 0;
  if constexpr (Law::kMidpoint)
    if (law.is_at_midpoint()) less = overlap / 2;
  m.slip_i = p.radius_i - less;
  m.slip_j = p.radius_j - less;
  m.arm_i = Law::kWholeArms ? p.radius_i : p.radius_i - overlap / 2;
  m.arm_j = Law::kWholeArms ? p.radius_j : p.radius_j - overlap / 2;
  m.slip = m.v - dot(m.v, m.n) * m.n - cross(m.slip_i * m.omega_i + m.slip_j * m.omega_j, m.n);
  return m;
}

// Adds half of the work that these forces do in a step.
template <class Law>
LSDCD_FN void add_pair_half(const Law &, const PairMotion &m, const KeptForces &by, Real dt,
                            EnergyRows &rows)
{
  const Real half = 0.5 * dt;
  const Vec3 force = (by.elastic + by.damping) * m.n + by.friction;
  Real power = dot(force, m.v);
  if constexpr (Law::kContactTorque) power += dot(by.rolling + by.twisting * m.n, m.omega());
  power -= dot(cross(m.n, by.friction), m.arm_i * m.omega_i + m.arm_j * m.omega_j);
  rows[EnergyRow::work] -= half * power;
  rows[EnergyRow::damping] -= half * by.damping * dot(m.v, m.n);
  rows[EnergyRow::lever_arms] -=
      half * dot(by.friction,
                 cross((m.slip_i - m.arm_i) * m.omega_i + (m.slip_j - m.arm_j) * m.omega_j, m.n));
}

// Adds the second half of what a pair did in the last step, of which it has kept `numbers`. `goes_on`: it still touches; otherwise
// it has parted.
template <class Law>
LSDCD_FN void book_old_pair(const Law &law, const GrainPair &p, const PairNumbers<Real> &numbers,
                            const KeptOfPair &place, bool goes_on, EnergyRows &rows)
{
  const KeptForces old = place.read(numbers);
  rows[EnergyRow::seen] += old.held;
  if (!p.update) return;
  const PairMotion m = pair_motion(law, p, p.offset - p.dt * p.velocity);
  add_pair_half(law, m, old, p.dt, rows);
  const Vec3 rolling = rolling_part(m.omega(), m.n);
  const Real twisting = dot(m.omega(), m.n);
  if (goes_on) {
    rows[EnergyRow::turned_springs] += energy_left(law, old, m.slip, rolling, twisting, p.dt);
    return;
  }
  if constexpr (Law::kBeyondContact && !Law::kReaches) {
    Contact c = {};
    c.radius = p.radius_i * p.radius_j / (p.radius_i + p.radius_j);
    rows[EnergyRow::adhesion] += law.normal_energy(c, c.radius - (c.radius + law.gap(c)));
  }
  book_springs_at_end(law, old, m.n, m.slip, rolling, twisting, p.dt, rows);
  if constexpr (Law::kYields) {
    PairContact c = {};
    c.radius_i = p.radius_i;
    c.radius_j = p.radius_j;
    c.radius = p.radius_i * p.radius_j / (p.radius_i + p.radius_j);
    const Real before = p.radius_i + p.radius_j - norm(p.offset - p.dt * p.velocity);
    rows[EnergyRow::plastic] += law.plastic_loss_at_end(c, read_memory(law, numbers), before);
  }
}

// Adds the energy with which a pair begins that did not touch before. Grains that adhere jump into contact when they touch; grains
// that were put into overlap were in contact a step ago.
template <class Law>
LSDCD_FN void begin_pair(const Law &law, const GrainPair &p, const PairContact &c, EnergyRows &rows)
{
  constexpr Real kOutside = 1e-9;
  const Real before = p.radius_i + p.radius_j - norm(p.offset - p.dt * p.velocity),
             starts = starts_at(law, c);
  if (before > starts + kOutside * c.radius)
    rows[EnergyRow::inserted] -= law.normal_energy(c, before);
  else if constexpr (Law::kBeyondContact)
    rows[EnergyRow::adhesion] -= law.normal_energy(c, starts);
}

// Returns a vector that a pair has kept, turned into the tangent plane of this step in the same way as the law turns its springs.
LSDCD_FN Vec3 turned_as(const SpringPart &spring, const Vec3 &h, const Vec3 &n)
{
  return spring.projected ? h - dot(h, n) * n : turned_into_plane(h, n, 1, 0);
}

// A law that stores its argument and its result, so that evaluate_pair() need not.
template <class Law>
struct HeardLaw : Law {
  PairContact *contact;
  FullForce *force;

  LSDCD_FN FullForce evaluate(const PairContact &c, ContactMemory<Law::kExtra> &memory) const
  {
    *contact = c;
    return *force = Law::evaluate(c, memory);
  }
};

// Adds the first half of what a touching pair does in this step, and its springs, and writes the forces that it keeps. make_pair() returns
// the pair, and is called twice, so that a GPU, which has few registers, need not keep the pair. What make_pair() reads is in a cache by
// then.
template <class Law, class MakePair>
LSDCD_FN void book_new_pair(const Law &law, const MakePair &make_pair,
                            const PairNumbers<Real> &old_numbers, const PairNumbers<Real> &numbers,
                            const KeptOfPair &place, EnergyRows &rows)
{
  // Laws that keep nothing have no numbers before these.
  const ContactMemory<Law::kExtra> begun =
      read_memory(law, place.first > 0 ? old_numbers : PairNumbers<Real>{nullptr, 0});
  ContactMemory<Law::kExtra> memory = begun;
  PairContact c;
  FullForce f;
  PairForce unused;
  evaluate_pair(HeardLaw<Law>{law, &c, &f}, make_pair(), memory, unused);
  if (!c.update) memory = begun;
  const ForceParts parts = law.parts(c, begun, memory, f);
  KeptForces old = {};
  if (!!old_numbers) {
    old = place.read(old_numbers);
    const auto turn = [&](const SpringPart &spring, Vec3 &h) {
      h = turned_as(spring, h, c.normal);
    };
    turn(parts.friction, old.friction);
    turn(parts.friction, old.friction_spring);
    if constexpr (Law::kContactTorque) {
      turn(parts.rolling, old.rolling);
      turn(parts.rolling, old.rolling_spring);
    }
  }
  KeptForces now = kept_of(law, c.normal, f, parts, slaves_spring(c, parts, old), 1, 0, 0);
  now.held = held_of(law, c, f, memory, 1, now);
  place.write(now, numbers);
  rows[EnergyRow::held] += now.held;
  if (!c.update) return;

  const GrainPair p = make_pair();
  add_pair_half(law, pair_motion(law, p, p.offset), now, p.dt, rows);
  if (!old_numbers) begin_pair(law, p, c, rows);
  book_springs(law, c, parts, 1, now, old, rows);
  if constexpr (Law::kYields) rows[EnergyRow::plastic] += law.plastic_loss(c, begun, memory);
}

// Returns whether pairs with this law add to a row.
template <class Law>
LSDCD_FN constexpr bool books_row(EnergyRow row)
{
  if (row == EnergyRow::drive || row == EnergyRow::wear) return false;
  if (row == EnergyRow::plastic) return Law::kYields;
  if (row == EnergyRow::rolling || row == EnergyRow::twisting) return Law::kContactTorque;
  return row != EnergyRow::adhesion || Law::kBeyondContact;
}

}    // namespace lsdcd
