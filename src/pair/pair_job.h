// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The input and output of a step of pairs.
#pragma once

#include "base/strided_view.h"
#include "base/vec3.h"
#include "engine/results/step_results.h"
#include "engine/step/compiled_law.h"
#include "pair/kept_of_pair.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace lsdcd {

// The host's list: rows of neighbours. The bits of a neighbour above `mask` select a factor of the force.
struct PairList {
  int rows;
  const int *grain, *length;    // grain of each row; length[i] and row[i] are of grain i
  const int *const *row;
  int mask, factor_shift;
};

// The numbers of a pair, `step` apart.
template <class T>
struct PairNumbers {
  T *at;
  std::size_t step;

  LSDCD_FN bool operator!() const { return !at; }
  LSDCD_FN T &operator*() const { return *at; }
  LSDCD_FN T &operator[](int k) const { return at[static_cast<std::size_t>(k) * step]; }
  LSDCD_FN PairNumbers &operator+=(int n)
  {
    at += static_cast<std::size_t>(n) * step;
    return *this;
  }
  LSDCD_FN PairNumbers operator++(int)
  {
    const PairNumbers before = *this;
    at += step;
    return before;
  }
};

// What touching pairs keep from step to step, in the order of the host's list. For each pair it has the number of the pair in the list,
// counted over all rows, and `width` numbers as the first grain of the row sees them.
class PairHistory {
 public:
  // Starts to write pairs with `width` numbers each.
  void begin(int width)
  {
    if (width != this->width()) room_ = 0;
    width_ = static_cast<std::size_t>(width);
    size_ = 0;
  }
  // Appends n pairs with these numbers in the list, and returns the first of them. The caller writes what they keep.
  std::size_t append(const std::size_t *keys, int n);

  int width() const { return static_cast<int>(width_); }
  std::size_t size() const { return size_; }
  std::size_t key(std::size_t pair) const { return key_[pair]; }
  // Returns whether the n pairs from `pair` on have these numbers in the list.
  bool has(std::size_t pair, const std::size_t *keys, std::size_t n) const
  {
    return pair + n <= size_ && std::equal(keys, keys + n, key_.get() + pair);
  }
  // Returns the pair with this number in the list, or size() if there is none.
  std::size_t find(std::size_t key) const;
  // Returns the k-th numbers of all pairs, which lie side by side.
  Real *column(int k) { return numbers_.get() + room_ * static_cast<std::size_t>(k); }
  const Real *column(int k) const { return numbers_.get() + room_ * static_cast<std::size_t>(k); }
  PairNumbers<Real> of(std::size_t pair) const { return {numbers_.get() + pair, room_}; }
  static std::size_t bytes_per_pair(int width)
  {
    return sizeof(std::size_t) + static_cast<std::size_t>(width) * sizeof(Real);
  }
  std::size_t bytes() const { return room_ * bytes_per_pair(width()); }

 private:
  void grow(std::size_t n);

  std::size_t width_ = 0, size_ = 0, room_ = 0;
  std::unique_ptr<std::size_t[]> key_;
  std::unique_ptr<Real[]> numbers_;
};

// Force, torques and heat of a pair in a step.
struct PairForce {
  Vec3 normal;            // unit, from j to i
  Real push;              // force along it on i, < 0 if it pulls
  Vec3 friction;          // tangential force on i
  Vec3 contact_torque;    // on i, in addition to the torque of friction; j has its opposite
  Real arm_i, arm_j;      // of the friction
  Real heat;              // power into i
  Real energy;            // elastic, as in ContactForce

  LSDCD_FN Vec3 force() const { return push * normal + friction; }    // on i; j has its opposite
  LSDCD_FN Vec3 torque_i() const { return contact_torque - arm_i * cross(normal, friction); }
  LSDCD_FN Vec3 torque_j() const { return -arm_j * cross(normal, friction) - contact_torque; }
};

// A force with its two grains, for a host that asks for forces one by one.
struct RecordedPair {
  int i, j;
  Vec3 offset, force;    // of i less that of j; force on i
  Real energy;
};

// Two grains, i and j.
struct GrainPair {
  Vec3 offset, velocity;    // of i less those of j
  Vec3 omega_i, omega_j;
  Real distance_sq, radius_i, radius_j, mass_i, mass_j;
  Real mass;                      // reduced
  Real temperature_difference;    // of j less that of i; read only where the law has heat
  Real dt;
  bool update;
};

struct PairLanes;

// The law of a pair of types, compiled.
struct PairLaw {
  LawBytes law;
  LawReach reach;    // see ContactLaw::reach()
  bool has_heat;
  unsigned stored;    // see stored_numbers() (pair_kernel.h)
  // Computes one pair: see evaluate_pair() (pair_kernel.h). Returns false if it does not touch; then nothing is changed.
  bool (*evaluate)(const LawBytes &, const GrainPair &, bool touched, const Real *old, Real *kept,
                   PairForce &);
  // Computes n pairs in lanes (evaluate_lanes.h), one by one.
  void (*evaluate_lanes)(const LawBytes &, PairLanes &, int n, Real dt, bool update);
  // Computes n pairs in vectors, in steps in which springs move. prepare() must have been called for these lanes. Null: there is no such
  // loop.
  void (*evaluate_wide)(const LawBytes &, PairLanes &, int n, Real dt);
  void (*prepare)(const LawBytes &, PairLanes &);
  std::uint64_t
      choices;    // what prepare() writes: equal for laws with the same prepare() and options
  // The law that records energy, and the function for a pair that touches now or did a step ago (pair_energy.h). Null: pairs do not keep
  // their forces.
  LawBytes booked;
  void (*book)(const LawBytes &, const GrainPair &, const PairNumbers<Real> &old,
               const PairNumbers<Real> &now, const KeptOfPair &, EnergyRows &);
};

struct PairJob {
  // Grains: three numbers each, except one for radius, mass and type. Grains from n_own on are copies of others.
  const Real *x, *v, *omega, *radius, *mass;
  const int *type;    // grains with the bits `frozen` do not move; null: none is frozen
  const int *mask;    // those of `frozen` do not move; null: none is frozen
  int frozen = 0;
  Real *force, *torque;                 // added to
  const Real *temperature = nullptr;    // read if laws have heat
  Real *heat = nullptr;
  int n_own;
  bool both_sides;    // add to copies, too

  PairList list;
  const Real *factor;    // four factors

  // The law of types t and u is laws[law_of[t * n_types + u]]. Types are counted from 1; n_types is one more than their number.
  const PairLaw *laws;
  int n_laws;
  const int *law_of;
  int n_types;

  const PairHistory *old = nullptr;    // of the last step; null: laws keep nothing
  PairHistory *history = nullptr;
  Real dt;
  bool update;    // false: springs act but do not move (setup)

  // Null: energy is not recorded. Otherwise laws have `book`, and pairs keep for it what `kept` says. The energy
  // of pairs is added to it; for a pair with a copy only half of it, unless both_sides.
  EnergyRows *energy = nullptr;
  KeptOfPair kept;
  std::vector<RecordedPair> *record = nullptr;    // null: forces are not asked for one by one
};

LSDCD_FN Vec3 vec_of(const Real *all, int i)
{
  return {all[3 * i], all[3 * i + 1], all[3 * i + 2]};
}
LSDCD_FN Vec3 vec_of(const StridedView<const Real> &all, int i)
{
  return all[i];
}

// Returns whether neither grain moves. Such pairs do not act, because it is chance which of them are in a list. Job: with `mask` and
// `frozen` as in PairJob.
template <class Job>
LSDCD_FN bool are_frozen(const Job &job, int i, int j)
{
  return job.mask && (job.mask[i] & job.mask[j] & job.frozen);
}

// Returns the reduced mass of two grains. If one of them does not move, it is the mass of the other. Job: with `mask` and `frozen` as in
// PairJob.
template <class Job>
LSDCD_FN Real reduced_mass(const Job &job, int i, int j, Real mass_i, Real mass_j)
{
  if (job.mask) {
    if (job.mask[j] & job.frozen) return mass_i;
    if (job.mask[i] & job.frozen) return mass_j;
  }
  return mass_i * mass_j / (mass_i + mass_j);
}

// Returns grains i and j of a PairJob, or of a PairInput.
template <class Job>
LSDCD_FN GrainPair grain_pair(const Job &job, int i, int j, bool update)
{
  GrainPair p = {};
  p.offset = vec_of(job.x, i) - vec_of(job.x, j);
  p.distance_sq = norm_sq(p.offset);
  p.radius_i = job.radius[i];
  p.radius_j = job.radius[j];
  p.velocity = vec_of(job.v, i) - vec_of(job.v, j);
  p.omega_i = vec_of(job.omega, i);
  p.omega_j = vec_of(job.omega, j);
  p.mass_i = job.mass[i];
  p.mass_j = job.mass[j];
  p.mass = reduced_mass(job, i, j, p.mass_i, p.mass_j);
  if (job.heat) p.temperature_difference = job.temperature[j] - job.temperature[i];
  p.dt = job.dt;
  p.update = update;
  return p;
}

}    // namespace lsdcd
