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
  std::int64_t number = 0;    // likewise
  int every = 1;              // steps between insertions, at least
};

// What was drawn before a grain.
struct Drawn {
  std::int64_t number = 0;
  Real mass = 0;
};

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
  bool is_over(const Drawn &before, Real mass) const;    // no more such grain will be due
  bool is_due(std::int64_t step, const Drawn &before, Real mass) const;
  // The first step after `now` for insertion, and the first in which the grain is due.
  std::int64_t first_open(std::int64_t now) const;
  std::int64_t first_due(std::int64_t now, const Drawn &before, Real mass) const;

  // From this step on. Is it another one?
  bool set_timestep(std::int64_t step, Real dt);

  // Numbers for a restart file. With another rate or timestep the amount goes on from where it was: is it so?
  std::vector<Real> state() const;
  static constexpr std::size_t kState = 6;
  bool restore(const Real *state, std::int64_t step, const Drawn &drawn);

 private:
  FeedSettings settings_;
  Real base_ = 0, dt_;
  std::int64_t base_step_, first_step_;
};

}    // namespace lsdcd
