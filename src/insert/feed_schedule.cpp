// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "insert/feed_schedule.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

constexpr Real kRoom = 1e-6;    // of a grain, for rounding of sums

bool reaches(Real amount, Real needed, Real one)
{
  return needed <= amount + kRoom * one;
}

}    // namespace

bool FeedSchedule::is_over(const GrainTotals &before, Real mass) const
{
  return (settings_.number > 0 && before.number >= settings_.number) ||
         (settings_.mass > 0 && !reaches(settings_.mass, before.mass + mass, mass));
}

bool FeedSchedule::is_due(std::int64_t step, const GrainTotals &before, Real mass) const
{
  if (is_over(before, mass)) return false;
  if (settings_.kind == FeedSettings::by_mass)
    return reaches(amount(step), before.mass + mass, mass);
  if (settings_.kind == FeedSettings::by_number)
    return reaches(amount(step), static_cast<Real>(before.number) + 1, 1);
  return true;
}

std::int64_t FeedSchedule::first_open(std::int64_t now) const
{
  const std::int64_t every = settings_.every, since = now - first_step_;
  return first_step_ + (since / every + 1) * every;
}

std::int64_t FeedSchedule::first_due(std::int64_t now, const GrainTotals &before, Real mass) const
{
  if (is_over(before, mass)) return kNever;
  std::int64_t step = first_open(now);
  if (settings_.kind == FeedSettings::at_once) return step;
  const Real needed = settings_.kind == FeedSettings::by_mass
                          ? before.mass + mass
                          : static_cast<Real>(before.number) + 1;
  const Real steps = (needed - base_) / (settings_.rate * dt_);
  if (!(steps < 1e15)) return kNever;
  // Rounding may be off by a step: begin two steps before, and go on one by one.
  const std::int64_t about = base_step_ + static_cast<std::int64_t>(steps) - 2;
  if (about > step) step = first_open(about - 1);
  while (!is_due(step, before, mass)) step += settings_.every;
  return step;
}

GrainTotals FeedSchedule::due_beyond(std::int64_t step, const GrainTotals &drawn, Real mean) const
{
  constexpr Real kMost = 1e15;
  const auto before = static_cast<Real>(drawn.number);
  Real number = settings_.number > 0 ? static_cast<Real>(settings_.number) - before : kMost;
  if (settings_.mass > 0) number = std::min(number, (settings_.mass - drawn.mass) / mean);
  if (settings_.kind == FeedSettings::by_number) number = std::min(number, amount(step) - before);
  if (settings_.kind == FeedSettings::by_mass)
    number = std::min(number, (amount(step) - drawn.mass) / mean);
  const Real whole = std::floor(std::min(std::max(number + kRoom, Real(0)), kMost));
  return {static_cast<std::int64_t>(whole), whole * mean};
}

void FeedSchedule::set_timestep(std::int64_t step, Real dt)
{
  if (dt == dt_) return;
  continue_from(amount(step), step);
  dt_ = dt;
}

FeedState FeedSchedule::state(std::int64_t step) const
{
  return {base_, step - base_step_, step - first_step_, dt_};
}

void FeedSchedule::restore(const FeedState &state, std::int64_t step)
{
  const Real dt = dt_;
  base_ = state.base;
  base_step_ = step - state.base_before;
  dt_ = state.dt;
  first_step_ = step - state.first_before;
  set_timestep(step, dt);
}

void FeedSchedule::continue_from(Real amount, std::int64_t step)
{
  base_ = amount;
  base_step_ = step;
}

}    // namespace lsdcd
