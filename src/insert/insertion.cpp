// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "insert/insertion.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

constexpr std::int64_t kPlaces = 3;    // part of a key, as in grain_source.cpp
constexpr Real kSmaller = 0.9;    // a grain below that part of a radius may fit where that did not
constexpr Real kFormat = 19790401;    // of the state
constexpr std::size_t kHeader = 8;    // numbers of the state before those of the schedule

bool comes_before(const Grain &a, const Grain &b)
{
  return a.radius != b.radius ? a.radius > b.radius : a.number < b.number;
}

}    // namespace

void Refused::add(const Refused &more)
{
  no_place += more.no_place;
  grains += more.grains;
  walls += more.walls;
}

Insertion::Insertion(const InsertionPlan &plan, std::int64_t step, Real dt) :
    plan_(plan), source_(plan.grains, plan.seed), schedule_(plan.feed, step, dt)
{
  find_next_step(step);
}

void Insertion::find_next_step(std::int64_t now)
{
  next_step_ = owed_.empty() ? schedule_.first_due(now, drawn_, source_.grain(drawn_.number).mass())
                             : schedule_.first_open(now + kRetry - 1);
}

void Insertion::begin_run(std::int64_t step, Real dt)
{
  const bool was_changed = schedule_.set_timestep(step, dt);
  if ((next_step_ != FeedSchedule::kNever && next_step_ <= step) || (was_changed && owed_.empty()))
    find_next_step(step);
}

void Insertion::draw_due(std::int64_t step)
{
  const std::size_t before = owed_.size();
  while (true) {
    const Grain grain = source_.grain(drawn_.number);
    if (!schedule_.is_due(step, drawn_, grain.mass())) break;
    owed_.push_back(grain);
    drawn_.number++;
    drawn_.mass += grain.mass();
  }
  std::sort(owed_.begin() + before, owed_.end(), comes_before);
  std::inplace_merge(owed_.begin(), owed_.begin() + before, owed_.end(), comes_before);
}

std::vector<Insertion::Placed> Insertion::place(std::int64_t step, InsertionSite &site,
                                                Packing &packing, Refused &refused) const
{
  std::vector<Placed> placed;
  Real too_large = HUGE_VAL;
  for (std::size_t i = 0; i < owed_.size(); i++) {
    const Grain &grain = owed_[i];
    if (grain.radius > kSmaller * too_large) continue;
    RandomStream random({plan_.seed, kPlaces, grain.number, step});
    bool found = false;
    for (int k = 0; k < plan_.attempts && !found; k++) {
      PackedSphere sphere = {{0, 0, 0}, grain.radius};
      if (!site.draw(random, grain.radius, sphere.at)) {
        refused.no_place++;
      } else if (packing.overlaps(sphere)) {
        refused.grains++;
      } else if (!site.is_clear_of_walls(sphere)) {
        refused.walls++;
      } else {
        found = true;
        packing.add(sphere);
        placed.push_back({i, sphere.at});
      }
    }
    if (!found) too_large = grain.radius;
  }
  return placed;
}

void Insertion::accept(std::int64_t step, const std::vector<Placed> &placed, const Refused &refused)
{
  std::vector<bool> has_place(owed_.size(), false);
  for (const Placed &one : placed) {
    has_place[one.index] = true;
    inserted_mass_ += owed_[one.index].mass();
  }
  std::vector<Grain> rest;
  for (std::size_t i = 0; i < owed_.size(); i++)
    if (!has_place[i]) rest.push_back(owed_[i]);
  owed_.swap(rest);
  refused_.add(refused);
  find_next_step(step);
}

Real Insertion::owed_mass() const
{
  Real sum = 0;
  for (const Grain &grain : owed_) sum += grain.mass();
  return sum;
}

std::vector<Real> Insertion::state() const
{
  std::vector<Real> state = {kFormat,
                             static_cast<Real>(drawn_.number),
                             drawn_.mass,
                             inserted_mass_,
                             static_cast<Real>(refused_.no_place),
                             static_cast<Real>(refused_.grains),
                             static_cast<Real>(refused_.walls),
                             static_cast<Real>(next_step_)};
  const std::vector<Real> schedule = schedule_.state();
  state.insert(state.end(), schedule.begin(), schedule.end());
  for (const Grain &grain : owed_)
    for (const Real x : {static_cast<Real>(grain.number), grain.radius, grain.density})
      state.push_back(x);
  return state;
}

bool Insertion::restore(const std::vector<Real> &state, std::int64_t step)
{
  const std::size_t fixed = kHeader + FeedSchedule::kState;
  if (state.size() < fixed || state[0] != kFormat) return false;
  drawn_ = {static_cast<std::int64_t>(state[1]), state[2]};
  inserted_mass_ = state[3];
  refused_ = {static_cast<std::int64_t>(state[4]), static_cast<std::int64_t>(state[5]),
              static_cast<std::int64_t>(state[6])};
  next_step_ = static_cast<std::int64_t>(state[7]);
  const bool was_changed = schedule_.restore(&state[kHeader], step, drawn_);
  owed_.clear();
  for (std::size_t i = fixed; i + 2 < state.size(); i += 3)
    owed_.push_back({static_cast<std::int64_t>(state[i]), state[i + 1], state[i + 2]});
  if (was_changed) find_next_step(step);
  return true;
}

}    // namespace lsdcd
