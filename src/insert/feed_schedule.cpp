// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "insert/feed_schedule.h"

#include <algorithm>

namespace lsdcd {

namespace {

constexpr Real kRoom = 1e-6;    // of a grain, for rounding of sums

bool reaches(Real amount, Real needed, Real one)
{
  return needed <= amount + kRoom * one;
}

}    // namespace

bool FeedSchedule::is_over(const Drawn &before, Real mass) const
{
  return (settings_.number > 0 && before.number >= settings_.number) ||
         (settings_.mass > 0 && !reaches(settings_.mass, before.mass + mass, mass));
}

bool FeedSchedule::is_due(std::int64_t step, const Drawn &before, Real mass) const
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

std::int64_t FeedSchedule::first_due(std::int64_t now, const Drawn &before, Real mass) const
{
  if (is_over(before, mass)) return kNever;
  std::int64_t step = first_open(now);
  if (settings_.kind == FeedSettings::at_once) return step;
  const Real needed = settings_.kind == FeedSettings::by_mass
                          ? before.mass + mass
                          : static_cast<Real>(before.number) + 1;
  const Real steps = (needed - base_) / (settings_.rate * dt_);
  if (!(steps < 1e15)) return kNever;
  // Up to rounding; two steps before, and then one by one.
  const std::int64_t about = base_step_ + static_cast<std::int64_t>(steps) - 2;
  if (about > step) step = first_open(about - 1);
  while (!is_due(step, before, mass)) step += settings_.every;
  return step;
}

bool FeedSchedule::set_timestep(std::int64_t step, Real dt)
{
  if (dt == dt_) return false;
  base_ = amount(step);
  base_step_ = step;
  dt_ = dt;
  return true;
}

std::vector<Real> FeedSchedule::state() const
{
  return {
      static_cast<Real>(settings_.kind), settings_.rate, base_, static_cast<Real>(base_step_), dt_,
      static_cast<Real>(first_step_)};
}

bool FeedSchedule::restore(const Real *state, std::int64_t step, const Drawn &drawn)
{
  const FeedSettings now = settings_;
  const Real dt = dt_;
  settings_.kind = static_cast<FeedSettings::Kind>(state[0]);
  settings_.rate = state[1];
  base_ = state[2];
  base_step_ = static_cast<std::int64_t>(state[3]);
  dt_ = state[4];
  first_step_ = static_cast<std::int64_t>(state[5]);
  const bool is_new_step = set_timestep(step, dt);
  if (now.kind == settings_.kind && now.rate == settings_.rate) return is_new_step;
  base_ = now.kind == settings_.kind          ? amount(step)
          : now.kind == FeedSettings::by_mass ? drawn.mass
                                              : static_cast<Real>(drawn.number);
  base_step_ = step;
  settings_ = now;
  return true;
}

}    // namespace lsdcd
