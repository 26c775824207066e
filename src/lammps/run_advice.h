// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// What a run says at its end of its own speed: processes that wait for the busiest, neighbour lists that last too short or too long.
#pragma once

#include "host/host.h"

#include <cstdint>
#include <string>

namespace lsdcd {

// The part of a run for which processes may wait for the busiest before the run says so.
constexpr Real kLongestWait = 1.0 / 3;
// Steps that lists should last, and for which a skin is told where they do not.
constexpr Real kShortList = 5, kLongList = 200, kGoodList = 20;
// A skin of so many diameters of the smallest grain finds hardly more pairs than none, and one of so many too many of them.
constexpr Real kLeastSkin = 0.1, kMostSkin = 1;

// Returns the words on balance, or nothing where processes wait for at most kLongestWait of the run. `busy`: seconds that this process
// computed; `loop`: of the whole run. `balanced`: the run has balance already. Collective.
std::string waiting_advice(Host &host, Real busy, Real loop, bool balanced);

// Neighbour lists of a run in which the host makes new ones as soon as some grain has gone half the skin.
struct ListsOfRun {
  std::int64_t steps = 0;
  std::int64_t made = 0;      // lists, after that of the setup
  std::int64_t forced = 0;    // of these, made for other reasons, such as new grains
  Real skin = 0;              // length
  Real smallest = 0;    // diameter of the smallest grain on this process; infinity: it has none
};

// Returns the words on the skin, or nothing where lists last well, or no skin would serve. Collective.
std::string skin_advice(Host &host, const ListsOfRun &lists);

}    // namespace lsdcd
