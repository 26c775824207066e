// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Impacts between grains: contacts that begin, and their energy.
// Two grains that strike each other may touch others already. As at a wall (strike.h) a blow is counted once: the speed of an impact is that
// along its normal of the velocities that are left when the contacts of either grain that touch already, and faster impacts of this grain
// in the same step, have stopped. A contact with a partner stops without rebound: from the grain's velocity it takes the part with
// which the two press on each other, times the share that the grain has in it, the reduced mass over its own. A wall moves nothing, and
// the share is 1 there. What is taken from each of the two grains depends on its own contacts alone, so that each may be of another
// process.
#pragma once

#include "base/kept_rows.h"
#include "engine/step/strike.h"
#include "host/host.h"
#include "output/impact_spectrum.h"
#include "pair/pair_job.h"

#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace lsdcd {

// What one of the two grains of a contact that begins knows of the impact. Processes send it to one another.
struct HalfImpact {
  std::int64_t grain, partner;    // names
  std::int32_t types[2];          // of both grains, the lower one first
  Real speed;                     // of approach along the normal
  Real taken;                     // of this speed, by other contacts of the grain
  Real mass;                      // reduced

  std::pair<std::int64_t, std::int64_t> names() const
  {
    return grain < partner ? std::make_pair(grain, partner) : std::make_pair(partner, grain);
  }
};

// The impacts of a step that run_pairs() has run, on one process. The job and its arrays must outlive this object, and its history must have
// all pairs that touch.
class StepImpacts {
 public:
  using Name = std::function<std::int64_t(int)>;    // returns the name of a grain

  StepImpacts(const PairJob &step, Name name);

  // Returns whether contacts begin by an impact in a row of this process.
  bool any() const { return !begun_.empty(); }
  // Returns the contacts of grains from n_own on, as these see them, in rows for the processes that own them. For lists that have a pair of
  // two processes in one of them alone. `n_all`: with copies.
  KeptRows contacts_of_copies(int n_all) const;
  // Returns the halves of impacts of own grains. `from_others`: contacts of own grains that are in lists of other processes; null: there
  // are none. The first `n_here` of them have both halves in the list.
  std::vector<HalfImpact> halves(const KeptRows *from_others, std::size_t &n_here) const;

 private:
  struct ContactOfGrain {
    int grain;
    std::int64_t partner;    // name
    Strike strike;           // its normal is from the partner to the grain
    Real share;
    bool begins;
    bool is_here;    // the partner is a grain of this process
    Real mass;
    std::int32_t types[2];
  };

  ContactOfGrain seen_by(int grain, int other, bool begins) const;
  // Calls act(i, j, begins) for the pairs that touch.
  template <class Act>
  void for_contacts(const Act &act) const;

  const PairJob &step_;
  Name name_;
  std::vector<std::size_t> begun_;    // numbers of pairs in the history, in its order
};

// The spectra of the impacts between grains since the beginning, by the types of the two.
class PairSpectra {
 public:
  using Types = std::pair<int, int>;    // the lower one first

  // Sets which impacts count: those faster than this (length/time), whose m v^2/2 over `velocity_unit` is an energy (see EngineSettings).
  // Returns whether impacts were forgotten, because they counted from another speed on.
  bool set(Real least_speed, Real velocity_unit);
  // Adds impacts of which both halves are among these, or one alone. A half without the other one is of a contact that the two processes of a
  // pair, whose places differ by rounding, see in two steps; it counts in the step of the grain with the lower name.
  void add(std::vector<HalfImpact> &halves);

  const std::map<Types, ImpactSpectrum> &all() const { return all_; }
  // Returns the sum over all processes. Collective.
  PairSpectra summed(Host &host, int n_types) const;
  std::size_t bytes() const;

  // What restart files have: of each pair of types ImpactSpectrum::packed().
  struct Packed {
    int type_i, type_j;
    std::vector<Real> numbers;
  };
  struct Saved {
    Real least_speed = 0;
    std::vector<Packed> spectra;
  };
  Saved saved() const;
  // Throws StateError where a spectrum is not whole.
  void restore(const Saved &saved);

 private:
  Real least_speed_ = 0, velocity_unit_ = 1;
  std::map<Types, ImpactSpectrum> all_;
};

template <class Numbers>
void each_number(Numbers &numbers, PairSpectra::Packed &p)
{
  numbers(p.type_i, p.type_j, p.numbers);
}
template <class Numbers>
void each_number(Numbers &numbers, PairSpectra::Saved &s)
{
  numbers(s.least_speed, s.spectra);
}

}    // namespace lsdcd
