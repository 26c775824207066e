// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/run_advice.h"

#include "base/number_words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lsdcd {

namespace {

// Returns a length with two digits: no more of a skin matter.
std::string length_text(Real value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

// Returns a whole number, or one with a digit behind the point below 10.
std::string rounded(Real value)
{
  return number_text(value < 10 ? std::round(10 * value) / 10 : std::round(value));
}

}    // namespace

std::string waiting_advice(Host &host, Real busy, Real loop, bool balanced)
{
  if (host.processes() == 1) return "";
  Real sums[2] = {busy, loop}, most = busy;
  host.sum_and_max(sums, 2, &most, 1);
  const Real mean = sums[0] / host.processes(), whole = sums[1] / host.processes();
  if (!(whole > 0 && most - mean > kLongestWait * whole)) return "";
  return "processes waited for the busiest one for " + rounded(100 * (most - mean) / whole) +
         " % of this run: " +
         (balanced
              ? "let fix balance act more often, along more axes or by 'weight neigh 0.8'"
              : "write 'fix even all balance 1000 1.05 shift xyz 20 1.02 weight neigh 0.8' before "
                "'run'");
}

std::string skin_advice(Host &host, const ListsOfRun &lists)
{
  Real smallest = -lists.smallest;
  host.max(&smallest, 1);
  smallest = -smallest;
  if (!std::isfinite(smallest) || !(lists.skin > 0)) return "";
  const auto steps = static_cast<Real>(lists.steps);
  const std::int64_t by_way = lists.made - lists.forced;
  const auto words = [&](const std::string &how, Real skin) {
    return "neighbor lists lasted " + how + " steps: a skin of " + length_text(skin) +
           " would serve in place of " + number_text(lists.skin) + ", write 'neighbor " +
           length_text(skin) + " bin' (or multi)";
  };
  if (by_way > 0 && steps < kShortList * static_cast<Real>(by_way)) {
    const Real lasted = steps / static_cast<Real>(by_way);
    const Real skin = std::min(lists.skin * kGoodList / lasted, kMostSkin * smallest);
    return skin > lists.skin ? words("only " + rounded(lasted), skin) : "";
  }
  const Real lasted = steps / static_cast<Real>(lists.made + 1);
  if (!(lasted > kLongList)) return "";
  const Real skin = std::max(lists.skin * kGoodList / lasted, kLeastSkin * smallest);
  return skin < lists.skin ? words(rounded(lasted) + (lists.made == 0 ? " and more" : ""), skin)
                           : "";
}

}    // namespace lsdcd
