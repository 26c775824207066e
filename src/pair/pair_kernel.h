// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Two grains as a contact of the wall's laws, and the loop over pairs.
#pragma once

#include "law/contact.h"
#include "law/submodels/normal.h"
#include "pair/pair_job.h"

#include <algorithm>

namespace lsdcd {

// Does adhesion hold grains beyond contact? `pull_off`: see ContactLaw::pull_off().
LSDCD_FN bool is_held(const GrainPair &p, Real pull_off)
{
  const Real sum = p.radius_i + p.radius_j;
  const Real reach = sum + pull_off * cube_root(p.radius_i * p.radius_j / sum);
  return p.distance_sq < reach * reach;
}

// Do the grains touch, or does adhesion hold them? It holds those that have touched.
template <class Law>
LSDCD_FN bool pair_touches(const Law &law, const GrainPair &p, bool touched)
{
  const Real sum = p.radius_i + p.radius_j;
  if (p.distance_sq < sum * sum) return true;
  if constexpr (Law::kBeyondContact) return touched && is_held(p, law.elastic.pull_off);
  return false;
}

// What the law keeps: the shear displacement, then vectors and scalars that it stores. `from` null: nothing yet.
template <class Law>
LSDCD_FN ContactMemory<Law::kExtra> read_memory(const Law &law, const Real *from)
{
  ContactMemory<Law::kExtra> memory = {};
  if (!from) return memory;
  memory.shear = {from[0], from[1], from[2]};
  if constexpr (Law::kExtra > 0) {
    from += 3;
    for (int k = 0; k < Law::kVectors; k++)
      if (law.stores(k)) {
        memory.put(3 * k, {from[0], from[1], from[2]});
        from += 3;
      }
    for (int k = 0; k < Law::kScalars; k++)
      if (law.stores(Law::kVectors + k)) memory.extra[3 * Law::kVectors + k] = *from++;
  }
  return memory;
}
template <class Law>
LSDCD_FN void write_memory(const Law &law, const ContactMemory<Law::kExtra> &memory, Real *to)
{
  for (int k = 0; k < 3; k++) to[k] = memory.shear[k];
  if constexpr (Law::kExtra > 0) {
    to += 3;
    for (int k = 0; k < Law::kVectors; k++)
      if (law.stores(k))
        for (int j = 0; j < 3; j++) *to++ = memory.extra[3 * k + j];
    for (int k = 0; k < Law::kScalars; k++)
      if (law.stores(Law::kVectors + k)) *to++ = memory.extra[3 * Law::kVectors + k];
  }
}

// Computes a pair that touches. Where the law has history, `old` is what the pair has kept, null if nothing, and `kept` what it
// keeps now.
template <class Law>
LSDCD_FN void evaluate_pair(const Law &law, const GrainPair &p, const Real *old, Real *kept,
                            PairForce &out)
{
  const Real sum = p.radius_i + p.radius_j, distance = sqrt(p.distance_sq);
  const Real per_both = 1 / (distance * sum);    // one division for two
  PairContact c;
  c.normal = (per_both * sum) * p.offset;
  c.overlap = sum - distance;
  c.radius = p.radius_i * p.radius_j * (per_both * distance);
  c.mass = p.mass;
  c.v_normal = dot(p.velocity, c.normal);
  Real less = 0;    // of the arms of slip
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

  ContactMemory<Law::kExtra> memory = {};
  if constexpr (Law::kHistory) memory = read_memory(law, old);
  const auto f = law.evaluate(c, memory);
  if constexpr (Law::kHistory) write_memory(law, memory, kept);

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

// The loop's view of laws that are all compiled from this one; kOne: and that are one law.
template <class Law, bool kOne_>
struct SameLaw {
  static constexpr bool kOne = kOne_;
  static constexpr bool kBeyondContact = Law::kBeyondContact, kHeat = Law::kHeat;
  static constexpr bool kHistory = Law::kHistory;
  const PairJob &job;
  Law only;

  explicit SameLaw(const PairJob &of) : job(of), only(of.laws->law.as<Law>()) {}
  const Law &law(int at) const
  {
    if constexpr (kOne) return only;
    return job.laws[at].law.as<Law>();
  }
  bool touches(int at, const GrainPair &p, bool touched) const
  {
    return pair_touches(law(at), p, touched);
  }
  bool evaluate(int at, const GrainPair &p, bool, const Real *old, Real *kept, PairForce &out) const
  {
    evaluate_pair(law(at), p, old, kept, out);
    return true;
  }
};
// Of laws that differ in their sub-models: a call of a function for each pair.
struct AnyLaw {
  static constexpr bool kBeyondContact = true, kHeat = true, kHistory = true, kOne = false;
  const PairJob &job;

  bool touches(int, const GrainPair &, bool) const { return true; }
  bool evaluate(int at, const GrainPair &p, bool touched, const Real *old, Real *kept,
                PairForce &out) const
  {
    const PairLaw &law = job.laws[at];
    return law.evaluate(law.law, p, touched, old, kept, out);
  }
};

LSDCD_FN void add_to(Real *all, int i, const Vec3 &a)
{
  for (int k = 0; k < 3; k++) all[3 * i + k] += a[k];
}

// Adds the forces of all pairs. What is not asked for is not computed: energies are read only where forces are recorded.
template <class Laws>
void add_pairs(const PairJob &job, const Laws &laws)
{
  const PairList &list = job.list;
  const bool keeps = Laws::kHistory && job.memory;
  const Real *const all_x = job.x, *const all_radius = job.radius;
  Real unkept[3];
  GrainPair p = {};
  p.dt = job.dt;
  p.update = job.update;
  for (int k = 0; k < list.rows; k++) {
    const int i = list.grain[k], n = list.length[i];
    const int *const row = list.row[i];
    const Vec3 x = vec_of(all_x, i);
    const Real radius = all_radius[i];
    p.mass_i = job.mass[i];
    p.omega_i = vec_of(job.omega, i);
    const Vec3 v = vec_of(job.v, i);
    const int *const law_of = job.law_of + job.type[i] * job.n_types;
    Vec3 force = {0, 0, 0}, torque = {0, 0, 0};
    [[maybe_unused]] Real heat = 0;
    std::size_t old = 0, end = 0;
    if (keeps) {
      job.memory->reserve(n);
      if (k < job.old->rows()) {
        old = job.old->first(k);
        end = job.old->first(k + 1);
      }
    }
    for (int place = 0; place < n; place++) {
      const int j = row[place] & list.mask;
      const Vec3 offset = x - vec_of(all_x, j);
      const Real distance_sq = norm_sq(offset), sum = radius + all_radius[j];
      const bool overlaps = distance_sq < sum * sum;
      if (!overlaps && !(Laws::kBeyondContact && old < end)) continue;
      const Real factor = job.factor[row[place] >> list.factor_shift & 3];
      if (factor == 0) continue;
      bool touched = false;
      if (keeps) {
        while (old < end && job.old->place(old) < place) old++;
        touched = old < end && job.old->place(old) == place;
      }
      if (!overlaps && !touched) continue;
      const int law = law_of[job.type[j]];
      p.offset = offset;
      p.distance_sq = distance_sq;
      p.radius_i = radius;
      p.radius_j = all_radius[j];
      if (!overlaps && !laws.touches(law, p, touched)) continue;
      p.velocity = v - vec_of(job.v, j);
      p.omega_j = vec_of(job.omega, j);
      p.mass_j = job.mass[j];
      p.mass = reduced_mass(job, i, j, p.mass_i, p.mass_j);
      if constexpr (Laws::kHeat)
        if (job.heat) p.temperature_difference = job.temperature[j] - job.temperature[i];
      Real *const kept = keeps ? job.memory->append(place) : unkept;
      if constexpr (!Laws::kOne)    // others may keep more
        if (keeps) std::fill_n(kept, job.memory->width(), 0);
      PairForce f;
      if (!laws.evaluate(law, p, touched, touched ? job.old->numbers(old) : nullptr, kept, f)) {
        if (keeps) job.memory->take_back();
        continue;
      }
      Vec3 on_i = f.force(), turns_i = f.torque_i(), turns_j = f.torque_j();
      if (factor != 1) {
        on_i = factor * on_i;
        turns_i = factor * turns_i;
        turns_j = factor * turns_j;
      }
      force += on_i;
      torque += turns_i;
      const bool both = job.both_sides || j < job.n_own;
      if (both) {
        add_to(job.force, j, -on_i);
        add_to(job.torque, j, turns_j);
      }
      if constexpr (Laws::kHeat)
        if (job.heat) {
          heat += f.heat;
          if (both) job.heat[j] -= f.heat;
        }
      if constexpr (!Laws::kOne)
        if (job.record) job.record->push_back({i, j, offset, on_i, factor * f.energy});
    }
    add_to(job.force, i, force);
    add_to(job.torque, i, torque);
    if constexpr (Laws::kHeat)
      if (job.heat) job.heat[i] += heat;
    if (keeps) job.memory->end_row();
  }
}

template <class Law>
[[gnu::flatten]] void run_one_law(const PairJob &job)
{
  add_pairs(job, SameLaw<Law, true>(job));
}
template <class Law>
void run_same_law(const PairJob &job)
{
  if (job.n_laws == 1 && !job.record) return run_one_law<Law>(job);
  add_pairs(job, SameLaw<Law, false>(job));
}

template <class Law>
bool evaluate_one(const LawBytes &bytes, const GrainPair &p, bool touched, const Real *old,
                  Real *kept, PairForce &out)
{
  const Law &law = bytes.as<Law>();
  if (!pair_touches(law, p, touched)) return false;
  evaluate_pair(law, p, old, kept, out);
  return true;
}

}    // namespace lsdcd
