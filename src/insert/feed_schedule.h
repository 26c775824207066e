// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// When each grain is due.
#pragma once

#include "base/real.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

struct FeedSettings {
  enum Kind { at_once, by_mass, by_number };
  Kind kind = at_once;
  Real rate = 0;              // mass/time or 1/time
  Real mass = 0;              // in all; 0: no limit
  std::int64_t number = 0;    // in all; 0: no limit
  int every = 1;              // steps between insertions, at least
};

struct GrainTotals {
  std::int64_t number = 0;
  Real mass = 0;
};

// For a restart file. Steps are counted from the step of the file, so that they hold where the host counts steps from another number, too.
struct FeedState {
  Real base = 0;    // mass or number that was given by the step of base_before
  std::int64_t base_before = 0, first_before = 0;    // steps
  Real dt = 0;
};
template <class Numbers>
void each_number(Numbers &numbers, FeedState &s)
{
  numbers(s.base, s.base_before, s.dt, s.first_before);
}

// A grain is due when the amount that the rate gives has reached it with all of its mass. So what is drawn
// stays below that amount by less than one grain.
class FeedSchedule {
 public:
  static constexpr std::int64_t kNever = -1;

  // Nothing is due at `step`.
  FeedSchedule(const FeedSettings &settings, std::int64_t step, Real dt) :
      settings_(settings), dt_(dt), base_step_(step), first_step_(step)
  {
  }

  // Mass or number by this step.
  Real amount(std::int64_t step) const
  {
    return base_ + static_cast<Real>(step - base_step_) * dt_ * settings_.rate;
  }
  // `before`: what was drawn before the grain, `mass`: its own.
  bool is_over(const GrainTotals &before, Real mass) const;    // no more such grain will be due
  bool is_due(std::int64_t step, const GrainTotals &before, Real mass) const;
  // The first step after `now` for insertion, and the first in which the grain is due.
  std::int64_t first_open(std::int64_t now) const;
  std::int64_t first_due(std::int64_t now, const GrainTotals &before, Real mass) const;
  // Returns how many grains of this mean mass are due beyond those drawn.
  GrainTotals due_beyond(std::int64_t step, const GrainTotals &drawn, Real mean) const;

  void set_timestep(std::int64_t step, Real dt);    // from this step on

  FeedState state(std::int64_t step) const;
  void restore(const FeedState &state, std::int64_t step);
  // In place of what the state says: this amount is there.
  void continue_from(Real amount, std::int64_t step);

 private:
  FeedSettings settings_;
  Real base_ = 0, dt_;
  std::int64_t base_step_, first_step_;
};

}    // namespace lsdcd
