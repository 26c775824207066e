// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Computes two grains as a contact of the wall's laws.
#pragma once

#include "law/contact.h"
#include "law/submodels/normal.h"
#include "pair/pair_job.h"

namespace lsdcd {

// Returns whether grains are within the reach of a law that acts beyond contact. `touched`: they are in contact since an earlier step.
LSDCD_FN bool is_within(const GrainPair &p, const LawReach &reach, bool touched)
{
  if (!(reach.of == LawReach::Of::near || (touched && reach.acts()))) return false;
  const Real sum = p.radius_i + p.radius_j;
  const Real far =
      sum + reach.at(p.radius_i * p.radius_j / sum,
                     reach.per_size > 0 ? size_of_both(p.radius_i, p.radius_j) : Real(0));
  return p.distance_sq < far * far;
}

// Returns the reach of a law that acts beyond contact.
template <class Law>
LSDCD_FN LawReach reach_of(const Law &law)
{
  if constexpr (Law::kReaches)
    return law.cohesion.reach();
  else
    return {LawReach::Of::held, 0, law.elastic.pull_off, 0, 0};
}

// Returns whether the grains touch, or the law acts on them across a gap.
template <class Law>
LSDCD_FN bool pair_touches(const Law &law, const GrainPair &p, bool touched)
{
  const Real sum = p.radius_i + p.radius_j;
  if (p.distance_sq < sum * sum) return true;
  if constexpr (Law::kBeyondContact) return is_within(p, reach_of(law), touched);
  return false;
}

// Copies the memory of a law: the shear displacement, then the vectors and scalars that it stores. `from` null: there is
// nothing yet. From and To: pointers to numbers, or types that act like one.
template <class Law, class From>
LSDCD_FN ContactMemory<Law::kExtra> read_memory(const Law &law, From from)
{
  ContactMemory<Law::kExtra> memory = {};
  if (!from) return memory;
  memory.shear = {from[0], from[1], from[2]};
  if constexpr (Law::kExtra > 0) {
    from += 3;
    read_extra(law, from, memory);
  }
  return memory;
}
template <class Law, class To>
LSDCD_FN void write_memory(const Law &law, const ContactMemory<Law::kExtra> &memory, To to)
{
  for (int k = 0; k < 3; k++) to[k] = memory.shear[k];
  if constexpr (Law::kExtra > 0) {
    to += 3;
    write_extra(law, memory, to);
  }
}

// Returns which numbers of its memory a pair keeps: bit k is for the k-th number; the shear displacement comes first, then
// `extra`.
template <class Law>
unsigned stored_numbers(const Law &law)
{
  unsigned stored = 7;
  if constexpr (Law::kExtra > 0) {
    for (int k = 0; k < Law::kVectors; k++)
      if (law.stores(k)) stored |= 7u << (3 + 3 * k);
    for (int k = 0; k < Law::kScalars; k++)
      if (law.stores(Law::kVectors + k)) stored |= 1u << (3 + 3 * Law::kVectors + k);
  }
  return stored;
}

// Computes a pair that touches, and what it keeps.
template <class Law>
LSDCD_FN void evaluate_pair(const Law &law, const GrainPair &p, ContactMemory<Law::kExtra> &memory,
                            PairForce &out)
{
  const Real sum = p.radius_i + p.radius_j, distance = sqrt(p.distance_sq);
  const Real per_both = 1 / (distance * sum);    // one division instead of two
  PairContact c;
  c.normal = (per_both * sum) * p.offset;
  c.overlap = sum - distance;
  c.radius = p.radius_i * p.radius_j * (per_both * distance);
  c.mass = p.mass;
  c.v_normal = dot(p.velocity, c.normal);
  Real less = 0;    // reduction of the arms of slip
  if constexpr (Law::kMidpoint)
    if (law.is_at_midpoint()) less = c.overlap / 2;
  c.v_tangent = p.velocity - c.v_normal * c.normal -
                cross((p.radius_i - less) * p.omega_i + (p.radius_j - less) * p.omega_j, c.normal);
  if constexpr (Law::kContactTorque) c.omega = p.omega_i - p.omega_j;
  if constexpr (Law::kHeat) c.temperature_difference = p.temperature_difference;
  c.dt = p.dt;
  c.update = p.update;
  c.radius_i = p.radius_i;
  c.radius_j = p.radius_j;
  c.mass_i = p.mass_i;
  c.mass_j = p.mass_j;

  const auto f = law.evaluate(c, memory);

  out.normal = c.normal;
  out.push = f.normal;
  out.friction = f.tangential;
  out.arm_i = Law::kWholeArms ? p.radius_i : p.radius_i - c.overlap / 2;
  out.arm_j = Law::kWholeArms ? p.radius_j : p.radius_j - c.overlap / 2;
  out.energy = f.energy;
  out.contact_torque = {0, 0, 0};
  out.heat = 0;
  if constexpr (Law::kContactTorque) out.contact_torque = f.contact_torque;
  if constexpr (Law::kHeat)
    if (law.has_heat()) out.heat = f.heat;
}

// Computes a pair that touches from stored numbers. If the law has history, `old` is what the pair has kept, or null if nothing, and `kept`
// is what it keeps now.
template <class Law, class From, class To>
LSDCD_FN void evaluate_pair(const Law &law, const GrainPair &p, From old, To kept, PairForce &out)
{
  ContactMemory<Law::kExtra> memory = {};
  if constexpr (Law::kHistory) memory = read_memory(law, old);
  evaluate_pair(law, p, memory, out);
  if constexpr (Law::kHistory) write_memory(law, memory, kept);
}

}    // namespace lsdcd
