// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "insert/insertion_state.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <string>

namespace lsdcd {

template <class Numbers>
void each_number(Numbers &numbers, GrainTotals &t)
{
  numbers(t.number, t.mass);
}

template <class Numbers>
void each_number(Numbers &numbers, Refused &r)
{
  numbers(r.no_place, r.grains, r.walls);
}

template <class Numbers>
void each_number(Numbers &numbers, InsertionState::Plan &p)
{
  numbers(p.numbers, p.given);
}

template <class Numbers>
void each_number(Numbers &numbers, InsertionState::Grains &g)
{
  numbers(g.inserted, g.drawn, g.not_drawn, g.next_number, g.wait, g.retry_in, g.owed);
}

namespace {

constexpr const char *kKind = "insertion";

// ---- versions before 0.10.0 -------------------------------------------------------------------

// The first number of development versions after 0.9.0. 0.9.0 has a count, then the second one.
constexpr Real kNamedLists = -2, kFormatOf090 = 19790401;

// Reads what development versions wrote: the number of bytes that follow, then for each list the length of its name, the name, the
// number of its numbers, and these.
std::map<std::string, std::vector<Real>> named_lists(const Real *numbers, std::size_t n)
{
  const auto fail = [] { throw StateError("the data of the insertion end early"); };
  const auto *at = reinterpret_cast<const char *>(numbers + 1);
  std::uint64_t left = sizeof(std::uint64_t);
  const auto take = [&](void *to, std::uint64_t size) {
    if (size > left) fail();
    std::memcpy(to, at, size);
    at += size;
    left -= size;
  };
  std::uint64_t size = 0;
  if (n < 2) fail();
  take(&size, sizeof size);
  if (size > (n - 2) * sizeof(Real)) fail();
  left = size;
  std::map<std::string, std::vector<Real>> all;
  while (left > 0) {
    take(&size, sizeof size);
    if (size > left) fail();
    std::string name(size, ' ');
    take(&name[0], size);
    take(&size, sizeof size);
    if (size > left / sizeof(Real)) fail();
    std::vector<Real> list(size);
    if (size > 0) take(list.data(), size * sizeof(Real));
    all[name] = std::move(list);
  }
  return all;
}

InsertionState from_named_lists(const Real *numbers, std::size_t n)
{
  const auto lists = named_lists(numbers, n);
  InsertionState s;
  const auto read = [&lists](const char *name, auto &...values) {
    const auto list = lists.find(name);
    if (list == lists.end())
      throw StateError("the numbers of '" + std::string(name) +
                       "' are missing in the data of the insertion");
    StateReader in(list->second.data(), list->second.size(),
                   "the list '" + std::string(name) + "' in the data of the insertion");
    in(values...);
  };
  InsertionState::Grains &g = s.grains;
  read("plan", s.plan.given);    // there is one number at least
  s.plan.numbers = lists.at("plan");
  read("given", s.plan.given);
  read("inserted", g.inserted);
  read("drawn", g.drawn, g.next_number);
  read("refused", s.refused);
  read("schedule", s.schedule);
  read("retry", g.wait, g.retry_in);
  read("not drawn", g.not_drawn);
  const auto owed = lists.find("owed");
  if (owed != lists.end()) g.owed.assign(owed->second.begin(), owed->second.end());
  return s;
}

// It knew neither totals nor grains of its plan, and took those of the script. Steps were not counted anew.
InsertionState from_090(const Real *numbers, std::size_t n, std::int64_t step)
{
  StateReader count(numbers, n, "the data of the insertion");
  const std::size_t size = count.take_count();
  StateReader in(count.take_numbers(size), size, "the data of the insertion");
  InsertionState s;
  InsertionState::Grains &g = s.grains;
  FeedState &schedule = s.schedule;
  Real format = 0, kind = 0, rate = 0;
  std::int64_t next_step = 0, base_step = 0, first_step = 0;
  in(format, g.drawn, g.inserted.mass, s.refused, next_step, kind, rate, schedule.base, base_step,
     schedule.dt, first_step);
  schedule.base_before = step - base_step;
  schedule.first_before = step - first_step;
  while (in.left() > 0) {
    g.owed.push_back(in.next<std::int64_t>());
    in.take_numbers(2);    // radius and density
  }
  g.inserted.number = g.drawn.number - static_cast<std::int64_t>(g.owed.size());
  g.next_number = g.drawn.number;
  g.retry_in = next_step - step;
  s.plan_has_ended = next_step == FeedSchedule::kNever;
  s.plan.numbers = {kind, rate};
  s.plan.given = schedule.base + static_cast<Real>(schedule.base_before) * schedule.dt * rate;
  if (s.plan_has_ended)
    s.plan.given = kind == static_cast<Real>(FeedSettings::by_mass)
                       ? g.drawn.mass
                       : static_cast<Real>(g.drawn.number);
  return s;
}

}    // namespace

void Refused::add(const Refused &more)
{
  no_place += more.no_place;
  grains += more.grains;
  walls += more.walls;
}

State InsertionState::blocks() const
{
  State all(kKind);
  all.add("plan", 1, plan);
  all.add("schedule", 1, schedule);
  all.add("grains", 1, grains);
  all.add("refused", 1, refused);
  return all;
}

InsertionState InsertionState::from(const Real *numbers, std::size_t n, std::int64_t step)
{
  if (n > 1 && numbers[0] == kNamedLists) return from_named_lists(numbers, n);
  if (n > 1 && numbers[0] > 0 && numbers[1] == kFormatOf090) return from_090(numbers, n, step);
  const State all(kKind, numbers, n);
  InsertionState s;
  all.read("plan", 1, s.plan);
  all.read("schedule", 1, s.schedule);
  all.read("grains", 1, s.grains);
  all.read("refused", 1, s.refused);
  if (!all.unread().empty())
    throw StateError("the data of the insertion have " + all.unread() +
                     ", which this version does not know");
  if (s.plan.numbers.empty())
    throw StateError("the block 'plan' in the data of the insertion has no numbers of a plan");
  return s;
}

}    // namespace lsdcd
