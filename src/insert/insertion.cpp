// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "insert/insertion.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace lsdcd {

namespace {

constexpr std::int64_t kPlaces = 3;    // part of a key, as in grain_source.cpp

}    // namespace

Insertion::Insertion(const InsertionPlan &plan, std::int64_t step, Real dt) :
    plan_(plan), source_(plan.grains, plan.seed), schedule_(plan.feed, step, dt)
{
  find_next_step(step);
}

// The next grain is due later only where all that is due was drawn.
void Insertion::find_next_step(std::int64_t now)
{
  next_step_ = has_drawn_all() ? schedule_.first_due(now, drawn_, next_grain().mass())
                               : FeedSchedule::kNever;
  if (owed_.empty()) return;
  const std::int64_t retry = schedule_.first_open(std::max(now, retry_step_ - 1));
  next_step_ = next_step_ == FeedSchedule::kNever ? retry : std::min(next_step_, retry);
}

void Insertion::begin_run(std::int64_t step, Real dt)
{
  schedule_.set_timestep(step, dt);
  find_next_step(step);
}

void Insertion::draw_due(std::int64_t step)
{
  late_ = owed_.size();
  first_new_ = next_number_;
  while (owed_.size() < kMostDrawn) {
    const Grain grain = next_grain();
    if (!schedule_.is_due(step, drawn_, grain.mass())) break;
    owed_.push_back(grain);
    next_number_++;
    drawn_.number++;
    drawn_.mass += grain.mass();
  }
}

bool Insertion::has_more(std::int64_t step) const
{
  return owed_.empty() && schedule_.is_due(step, drawn_, next_grain().mass());
}

// Indices of owed(), the largest first.
std::vector<std::size_t> Insertion::by_size() const
{
  std::vector<std::size_t> all(owed_.size());
  std::iota(all.begin(), all.end(), 0);
  std::stable_sort(all.begin(), all.end(), [this](std::size_t a, std::size_t b) {
    return owed_[a].radius > owed_[b].radius;
  });
  return all;
}

// The largest first pack most densely, and leave the small ones where not all have places: hence the second try.
std::vector<Insertion::Placed> Insertion::place(std::int64_t step, InsertionSite &site,
                                                const Packing &packing, Refused &refused) const
{
  Attempt attempt = {packing};
  const bool is_whole = late_ <= kMostPassedOver && place_in_order(by_size(), step, site, attempt);
  if (!is_whole) {
    attempt = {packing};
    place_in_order({}, step, site, attempt);
  }
  refused.add(attempt.refused);
  return attempt.placed;
}

// Tries the grains of owed() in this order, or as they are where it is empty. Returns false, and leaves out those that
// follow, after the grain that is one too many to be passed over.
bool Insertion::place_in_order(const std::vector<std::size_t> &order, std::int64_t step,
                               InsertionSite &site, Attempt &attempt) const
{
  std::size_t passed_over = 0;
  // Of each kind.
  std::vector<Real> too_large(source_.recipe().n_kinds(), std::numeric_limits<Real>::infinity());
  for (std::size_t k = 0; k < owed_.size(); k++) {
    const std::size_t i = order.empty() ? k : order[k];
    const Grain &grain = owed_[i];
    if (grain.radius < too_large[grain.kind]) {
      if (finds_place(i, step, site, attempt)) continue;
      site.check_has_room(grain);
      too_large[grain.kind] = grain.radius;
    }
    if (++passed_over > kMostPassedOver) return false;
  }
  return true;
}

PackedSphere Insertion::packed(const Grain &grain, const Vec3 &at, const Quaternion &turn,
                               Real touch_radius) const
{
  if (!source_.has_kinds()) return {at, grain.radius};
  PackedShape shape;
  if (source_.has_clumps())
    shape.balls = source_.balls(grain, turn);
  else
    shape = {place_grain(source_.shape(grain), at, turn), touch_radius};
  return {at, grain.radius, std::make_shared<const PackedShape>(std::move(shape))};
}

bool Insertion::finds_place(std::size_t i, std::int64_t step, InsertionSite &site,
                            Attempt &attempt) const
{
  const Grain &grain = owed_[i];
  const Real touch = source_.has_kinds() ? site.touch_radius(grain) : 0;
  RandomStream random({plan_.seed, kPlaces, grain.number, step});
  for (int k = 0; k < plan_.attempts; k++) {
    Vec3 at = {0, 0, 0};
    if (!site.draw(random, grain.radius, at)) {
      attempt.refused.no_place++;
      continue;
    }
    const Quaternion turn = source_.has_kinds() ? source_.turn(random) : Quaternion();
    const PackedSphere here = packed(grain, at, turn, touch);
    if (attempt.packing.overlaps(here)) {
      attempt.refused.grains++;
    } else if (!site.is_clear_of_walls(here)) {
      attempt.refused.walls++;
    } else {
      attempt.packing.add(here);
      attempt.placed.push_back({i, at, turn});
      return true;
    }
  }
  return false;
}

void Insertion::accept(std::int64_t step, const std::vector<Placed> &placed, const Refused &refused)
{
  std::vector<bool> has_place(owed_.size(), false);
  bool late_came = false;
  for (const Placed &one : placed) {
    const Grain &grain = owed_[one.index];
    has_place[one.index] = true;
    inserted_mass_ += grain.mass();
    late_came = late_came || grain.number < first_new_;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < owed_.size(); i++)
    if (!has_place[i]) owed_[kept++] = owed_[i];
  owed_.resize(kept);
  refused_.add(refused);
  wait_ = late_ > 0 && !late_came ? std::min<std::int64_t>(2 * wait_, kLongestWait) : 1;
  retry_step_ = step + wait_;
  not_drawn_ = schedule_.is_due(step, drawn_, next_grain().mass())
                   ? schedule_.due_beyond(step, drawn_, source_.recipe().mean_mass())
                   : GrainTotals();
  find_next_step(step);
}

GrainTotals Insertion::late() const
{
  GrainTotals all = not_drawn_;
  all.number += static_cast<std::int64_t>(owed_.size());
  for (const Grain &grain : owed_) all.mass += grain.mass();
  return all;
}

bool Insertion::is_past_total() const
{
  const FeedSettings &feed = plan_.feed;
  return (feed.number > 0 && inserted() > feed.number) ||
         (feed.mass > 0 && inserted_mass_ > feed.mass * (1 + 1e-9));
}

// A plan that has ended has given what was drawn.
Real Insertion::amount_given(std::int64_t step) const
{
  if (!schedule_.is_over(drawn_, next_grain().mass())) return schedule_.amount(step);
  return plan_.feed.kind == FeedSettings::by_mass ? drawn_.mass : static_cast<Real>(drawn_.number);
}

std::vector<Real> Insertion::numbers_of_plan() const
{
  const FeedSettings &feed = plan_.feed;
  std::vector<Real> all = {static_cast<Real>(feed.kind), feed.rate, feed.mass,
                           static_cast<Real>(feed.number)};
  const std::vector<Real> grains = source_.numbers();
  all.insert(all.end(), grains.begin(), grains.end());
  return all;
}

State Insertion::state(std::int64_t step) const
{
  InsertionState s;
  s.plan = {numbers_of_plan(), amount_given(step)};
  s.schedule = schedule_.state(step);
  s.grains = {{inserted(), inserted_mass_}, drawn_, not_drawn_, next_number_, wait_,
              retry_step_ - step,           {}};
  for (const Grain &grain : owed_) s.grains.owed.push_back(grain.number);
  s.refused = refused_;
  s.last_id = last_id_;
  s.last_molecule = last_molecule_;
  return s.blocks();
}

bool Insertion::restore(const Real *numbers, std::size_t n, std::int64_t step)
{
  const InsertionState s = InsertionState::from(numbers, n);
  const InsertionState::Grains &g = s.grains;
  const std::vector<Real> plan = numbers_of_plan(), &former = s.plan.numbers;
  const bool is_same = former == plan;
  schedule_.restore(s.schedule, step);
  refused_ = s.refused;
  last_id_ = s.last_id;
  last_molecule_ = s.last_molecule;
  inserted_mass_ = g.inserted.mass;
  next_number_ = g.next_number;
  owed_.clear();
  if (is_same) {
    drawn_ = g.drawn;
    not_drawn_ = g.not_drawn;
    wait_ = g.wait;
    retry_step_ = step + g.retry_in;
    for (const std::int64_t number : g.owed) owed_.push_back(source_.grain(number));
  } else {
    // Grains without a place are drawn again.
    drawn_ = g.inserted;
    not_drawn_ = {};
    const FeedSettings::Kind kind = plan_.feed.kind;
    schedule_.continue_from(former[0] == static_cast<Real>(kind) ? s.plan.given
                            : kind == FeedSettings::by_mass      ? drawn_.mass
                                                                 : static_cast<Real>(drawn_.number),
                            step);
  }
  find_next_step(step);
  return is_same;
}

}    // namespace lsdcd
