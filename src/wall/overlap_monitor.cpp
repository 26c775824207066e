// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/overlap_monitor.h"

#include "base/input_words.h"

#include <algorithm>

namespace lsdcd {

namespace {

const char *const kWrongSide =
    "its centre is past the wall: is the side that side in or out names that of the spheres, "
    "or should it be both?";

std::string sunk_remedy(Real overlap, Real timestep_ratio)
{
  if (timestep_ratio > 1)
    return "the timestep is " + number_text(timestep_ratio) +
           " times the longest that resolves a contact: use a shorter one first. A stiffer contact "
           "would need an even shorter one";
  return overlap > 1 ? kWrongSide
                     : "the contact is too soft for this load or speed: use a stiffer contact (a "
                       "larger kn), which needs a shorter timestep, or lower the speeds";
}

}    // namespace

void OverlapMonitor::note(const StepDiagnostics &seen, const SpheresOnCpu &spheres,
                          std::int64_t step)
{
  if (seen.deepest <= kLarge) placed_overlap_ = 0;
  if (sunk_warned_ || seen.deepest <= std::max(worst_, kLarge)) return;
  const std::int64_t tag = spheres.tag(seen.deepest_sphere);
  if (tag > placed_after_ && tag <= placed_until_ && seen.deepest <= kWorse * placed_overlap_) {
    placed_overlap_ = std::min(placed_overlap_, seen.deepest);
    return;
  }
  worst_ = seen.deepest;
  worst_step_ = step;
  worst_tag_ = tag;
}

// Collective: the sphere is on one process, and its radius is needed by the first.
std::string OverlapMonitor::overlap_text(Real overlap, std::int64_t tag,
                                         const SpheresOnCpu &spheres)
{
  Real radius = spheres.all().radius_of(tag);
  host_.max(&radius, 1);
  return number_text(100 * overlap) + " % of its radius" +
         (radius > 0 ? " " + number_text(radius) : "");
}

void OverlapMonitor::check_sunk(Real worst, Real timestep_ratio, const SpheresOnCpu &spheres)
{
  if (sunk_warned_ || worst <= kLarge) return;
  sunk_warned_ = true;
  Real most = worst_;
  host_.max(&most, 1);
  const int rank = lowest_rank(host_, worst_ == most);
  std::int64_t which[2] = {worst_tag_, worst_step_};
  host_.broadcast(which, sizeof which, rank);
  const std::string overlap = overlap_text(most, which[0], spheres);
  host_.warn(host_.names().sphere + (" " + std::to_string(which[0])) + " sank into the wall by " +
             overlap + " by step " + std::to_string(which[1]) + ": " +
             sunk_remedy(most, timestep_ratio) + "; this warning is shown once");
}

// New spheres have tags above the highest tag that there was.
void OverlapMonitor::check_new(const StepDiagnostics &seen, const SpheresOnCpu &spheres,
                               std::int64_t step, bool goes_on)
{
  std::int64_t tag = seen.deepest > kLarge ? spheres.tag(seen.deepest_sphere) : 0;
  const bool is_new = tag > highest_tag_ && !(highest_tag_ < 0 && goes_on);
  const Real mine = is_new ? seen.deepest : 0;
  // Tags are exact below 2^53. Larger ones could take a new sphere for an old one.
  Real numbers[2] = {mine, static_cast<Real>(spheres.highest_tag())};
  host_.max(numbers, 2);
  const Real most = numbers[0], highest = numbers[1];
  if (!is_new) note(seen, spheres, step);
  if (most > kLarge) {
    if (placed_overlap_ == 0) placed_after_ = highest_tag_;
    placed_until_ = static_cast<std::int64_t>(highest);
    placed_overlap_ = std::max(placed_overlap_, most);
  }
  highest_tag_ = std::max(highest_tag_, static_cast<std::int64_t>(highest));
  if (most <= worst_new_) return;
  worst_new_ = kWorse * most;
  host_.broadcast(&tag, sizeof tag, lowest_rank(host_, mine == most));
  const std::string overlap = overlap_text(most, tag, spheres);
  host_.warn(host_.names().sphere + (" " + std::to_string(tag)) +
             " appeared inside the wall, which it overlaps by " + overlap + " in step " +
             std::to_string(step) + ": " +
             (most > 1 ? kWrongSide : "it will be thrown out; " + host_.remedy(Remedy::put_clear)) +
             ". This warning comes again for a larger overlap");
}

}    // namespace lsdcd
