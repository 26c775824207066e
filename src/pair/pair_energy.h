// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What the contact of two grains does with energy in a step, as contact_energy.h has it of a wall. Forces have been computed by the
// law without books: this computes the pair once more, with the law that says what its force is made of, and keeps the parts for
// the next step. Where the grains were a step ago follows from their velocities.
#pragma once

#include "engine/step/contact_energy.h"
#include "pair/pair_kernel.h"

namespace lsdcd {

// Motion and arms of a pair, at the end of a step or at its begin.
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
LSDCD_FN void add_pair_half(const PairMotion &m, const KeptForces &by, Real dt, EnergyRows &rows)
{
  const Real half = 0.5 * dt;
  const Vec3 force = (by.elastic + by.damping) * m.n + by.friction;
  const Vec3 contact_torque = by.rolling + by.twisting * m.n, turns = cross(m.n, by.friction);
  rows[EnergyRow::work] -= half * (dot(force, m.v) + dot(contact_torque, m.omega()) -
                                   dot(turns, m.arm_i * m.omega_i + m.arm_j * m.omega_j));
  rows[EnergyRow::damping] -= half * by.damping * dot(m.v, m.n);
  rows[EnergyRow::lever_arms] -=
      half * dot(by.friction,
                 cross((m.slip_i - m.arm_i) * m.omega_i + (m.slip_j - m.arm_j) * m.omega_j, m.n));
}

// A pair keeps KeptForces behind its springs.
template <class From>
LSDCD_FN KeptForces read_kept(const From &numbers, int at)
{
  Real all[kKeptForces];
  for (int k = 0; k < kKeptForces; k++) all[k] = numbers[at + k];
  KeptForces kept;
  memcpy(&kept, all, sizeof kept);
  return kept;
}
template <class To>
LSDCD_FN void write_kept(const KeptForces &kept, const To &numbers, int at)
{
  Real all[kKeptForces];
  memcpy(all, &kept, sizeof kept);
  for (int k = 0; k < kKeptForces; k++) numbers[at + k] = all[k];
}

// Books the second half of what a pair has kept. `goes_on`: it still touches; else it has parted.
template <class Law>
LSDCD_FN void book_old_pair(const Law &law, const GrainPair &p, const KeptForces &old, bool goes_on,
                            EnergyRows &rows)
{
  const PairMotion m = pair_motion(law, p, p.offset - p.dt * p.velocity);
  add_pair_half(m, old, p.dt, rows);
  const Vec3 rolling = rolling_part(m.omega(), m.n);
  const Real twisting = dot(m.omega(), m.n);
  if (goes_on) {
    rows[EnergyRow::turned_springs] += energy_left(old, m.slip, rolling, twisting, p.dt);
    return;
  }
  if constexpr (Law::kBeyondContact) {
    Contact c = {};
    c.radius = p.radius_i * p.radius_j / (p.radius_i + p.radius_j);
    rows[EnergyRow::adhesion] +=
        law.normal_energy(c, c.radius - cutoff_of(c.radius, law.elastic.pull_off));
  }
  book_springs_at_end(old, m.n, m.slip, rolling, twisting, p.dt, rows);
}

// Books what a pair begins with that touched nothing before. Grains that adhere jump into contact where they touch; those that
// were put there were in contact a step ago.
template <class Law>
LSDCD_FN void begin_pair(const Law &law, const GrainPair &p, const PairContact &c, EnergyRows &rows)
{
  constexpr Real kOutside = 1e-9;
  const Real before = p.radius_i + p.radius_j - norm(p.offset - p.dt * p.velocity);
  if (before > kOutside * c.radius)
    rows[EnergyRow::inserted] -= law.normal_energy(c, before);
  else if constexpr (Law::kBeyondContact)
    rows[EnergyRow::adhesion] -= law.normal_energy(c, 0);
}

// Returns a vector that a pair has kept in the plane of this step, as the law turns its springs.
LSDCD_FN Vec3 turned_as(const SpringPart &spring, const Vec3 &h, const Vec3 &n)
{
  return spring.projected ? h - dot(h, n) * n : turned_into_plane(h, n, 1, 0);
}

// A law that remembers what it was asked and what it said, so that evaluate_pair() need not.
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

// Books what a pair does with energy in a step, and writes the forces that it keeps. `old_numbers`, `numbers`: the `width` numbers
// that it had kept and keeps; null: it did not touch.
template <class Law>
LSDCD_FN void book_pair(const Law &law, const GrainPair &p, const PairNumbers<Real> &old_numbers,
                        const PairNumbers<Real> &numbers, int width, EnergyRows &rows)
{
  const int of_law = width - kKeptForces;    // 0: laws keep nothing
  KeptForces old = {};
  if (!!old_numbers) {
    old = read_kept(old_numbers, of_law);
    rows[EnergyRow::seen] += old.held;
    if (p.update) book_old_pair(law, p, old, !!numbers, rows);
  }
  if (!numbers) return;

  const ContactMemory<Law::kExtra> begun =
      read_memory(law, of_law > 0 ? old_numbers : PairNumbers<Real>{nullptr, 0});
  ContactMemory<Law::kExtra> memory = begun;
  PairContact c;
  FullForce f;
  PairForce unused;
  evaluate_pair(HeardLaw<Law>{law, &c, &f}, p, memory, unused);
  const ForceParts parts = law.parts(c, begun, p.update ? memory : begun, f);
  KeptForces now = kept_of(c.normal, f, parts, 1, 0, 0);
  now.held = held_of(law, c, f, 1, now);
  write_kept(now, numbers, of_law);
  rows[EnergyRow::held] += now.held;
  if (!p.update) return;

  add_pair_half(pair_motion(law, p, p.offset), now, p.dt, rows);
  if (!!old_numbers) {
    for (Vec3 *h : {&old.friction, &old.friction_spring})
      *h = turned_as(parts.friction, *h, c.normal);
    for (Vec3 *h : {&old.rolling, &old.rolling_spring}) *h = turned_as(parts.rolling, *h, c.normal);
  } else {
    begin_pair(law, p, c, rows);
  }
  book_springs(c, parts, 1, now, old, rows);
}

}    // namespace lsdcd
