// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "insert/insertion_state.h"

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
  if (last_id > 0) all.add("last ID", 1, last_id);
  if (last_molecule > 0) all.add("last molecule", 1, last_molecule);
  return all;
}

InsertionState InsertionState::from(const Real *numbers, std::size_t n)
{
  const State all(kKind, numbers, n);
  InsertionState s;
  all.read("plan", 1, s.plan);
  all.read("schedule", 1, s.schedule);
  all.read("grains", 1, s.grains);
  all.read("refused", 1, s.refused);
  all.find("last ID", 1, s.last_id);
  all.find("last molecule", 1, s.last_molecule);
  if (!all.unread().empty())
    throw StateError("the data of the insertion have " + all.unread() +
                     ", which this version does not know");
  if (s.plan.numbers.empty())
    throw StateError("the block 'plan' in the data of the insertion has no numbers of a plan");
  return s;
}

}    // namespace lsdcd
