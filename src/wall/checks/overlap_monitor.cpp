// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/checks/overlap_monitor.h"

#include "base/input_words.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace lsdcd {

namespace {

const char *const kWrongSide =
    "its centre is past the wall: is the side that side in or out names that of the spheres, "
    "or should it be both?";

const char *const kCameThrough =
    "its centre came to the wall, so it may come out on the other side and be lost: ";

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

void OverlapMonitor::note_of_run(const StepDiagnostics &seen, const SpheresOnCpu &spheres)
{
  if (seen.sharpest > sharpest_.ratio)
    sharpest_ = {seen.sharpest, seen.sharpest_curvature, spheres.tag(seen.sharpest_grain)};
  if (seen.deepest <= of_run_.overlap) return;
  const bool has_tag = spheres.are_there() || seen.deepest > kWorthATag;
  of_run_ = deepest_of(seen, has_tag ? spheres.tag(seen.deepest_sphere) : 0);
}

void OverlapMonitor::note(const StepDiagnostics &seen, const SpheresOnCpu &spheres)
{
  note_of_run(seen, spheres);
  if (seen.deepest <= kLarge) placed_ = 0;
  if (seen.deepest <= kWorse * placed_) {
    placed_ = std::min(placed_, seen.deepest);
    return;
  }
  if (seen.deepest <= std::max(worst_.overlap, warned_from_)) return;
  const std::int64_t tag = spheres.tag(seen.deepest_sphere);
  if (!is_named(tag)) worst_ = deepest_of(seen, tag);
}

// Collective. `overlap`: the largest of all processes, which one of them has.
OverlapMonitor::Deepest OverlapMonitor::deepest_of_all(Deepest mine, Real overlap)
{
  host_.broadcast(&mine, sizeof mine, lowest_rank(host_, mine.overlap == overlap));
  return mine;
}

std::string OverlapMonitor::name(std::uint32_t mesh) const
{
  return "mesh " + std::to_string(mesh + 1) + " '" + wall_.meshes[mesh].name + "'";
}

std::string OverlapMonitor::names(std::uint32_t meshes) const
{
  std::string all;
  for (std::uint32_t mesh = 0; mesh < wall_.meshes.size(); mesh++)
    if (meshes >> mesh & 1) all += (all.empty() ? "" : " and ") + name(mesh);
  return all;
}

bool OverlapMonitor::is_named(std::int64_t tag) const
{
  return std::find(named_.begin(), named_.end(), tag) != named_.end();
}

// Collective: the sphere is on one process, and its radius is needed by the first.
std::string OverlapMonitor::overlap_text(Real overlap, std::int64_t tag,
                                         const SpheresOnCpu &spheres)
{
  Real radius = spheres.all().radius_of(tag);
  host_.max(&radius, 1);
  return number_text(100 * overlap) + " % of its " + length() +
         (radius > 0 && !wall_.shapes ? " " + number_text(radius) : "");
}

// Not of spheres that have been named.
void OverlapMonitor::check_sunk(Real worst, Real timestep_ratio, const SpheresOnCpu &spheres)
{
  if (worst <= warned_from_) return;
  const Deepest seen = deepest_of_all(worst_, worst);
  const bool through = seen.overlap >= kThrough;
  if (through) named_.push_back(seen.tag);
  warned_from_ = named_.size() == kMostNamed ? std::numeric_limits<Real>::infinity()
                 : seen.overlap >= 0.5       ? kThrough
                 : seen.overlap >= 0.25      ? 0.5
                                             : 0.25;
  if (worst_.overlap <= warned_from_ || is_named(worst_.tag)) worst_ = {};
  const std::string overlap = overlap_text(seen.overlap, seen.tag, spheres);
  const std::string comes_again =
      through ? ""
      : warned_from_ < kThrough
          ? "; this warning comes again past " + number_text(100 * warned_from_) + " %"
          : "; this warning comes again where a centre comes to the wall";
  host_.warn(host_.sphere_text(seen.tag) + " sank into the wall by " + overlap + " in step " +
             std::to_string(seen.step) +
             (through ? ", pressed by " + names(seen.meshes) : ", at " + name(seen.mesh)) + ": " +
             (through && seen.overlap <= 1 ? kCameThrough : "") +
             sunk_remedy(seen.overlap, timestep_ratio) + comes_again);
}

void OverlapMonitor::check_sharp()
{
  if (!wall_.shapes || sharp_warned_) return;
  Real most = sharpest_.ratio;
  host_.max(&most, 1);
  if (most <= kSharp) return;
  sharp_warned_ = true;
  Sharpest seen = sharpest_;
  host_.broadcast(&seen, sizeof seen, lowest_rank(host_, seen.ratio == most));
  host_.warn(host_.sphere_text(seen.tag) + " overlaps a fold, an edge or a corner of the wall by " +
             number_text(seen.ratio) +
             " times the radius of curvature that its outline has there (its least one is " +
             number_text(seen.curvature) +
             "): above 1 the force may jump where such a contact begins or ends; use a stiffer "
             "contact (a larger kn), or smaller exponents. This warning is shown once");
}

void OverlapMonitor::end_run(bool brief)
{
  Real most = of_run_.overlap;
  host_.max(&most, 1);
  const Deepest mine = std::exchange(of_run_, {});
  if (brief || most == 0) return;
  const Deepest deepest = deepest_of_all(mine, most);
  host_.log("the deepest overlap of this run is " + number_text(100 * most) + " % of the " +
            length() + (deepest.tag > 0 ? " of " + host_.sphere_text(deepest.tag) : "") + ", at " +
            name(deepest.mesh) + " in step " + std::to_string(deepest.step));
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
  if (is_new)
    note_of_run(seen, spheres);
  else
    note(seen, spheres);
  if (most > kLarge) placed_ = std::max(placed_, most);
  highest_tag_ = std::max(highest_tag_, static_cast<std::int64_t>(highest));
  if (most <= worst_new_) return;
  worst_new_ = kWorse * most;
  host_.broadcast(&tag, sizeof tag, lowest_rank(host_, mine == most));
  const std::string overlap = overlap_text(most, tag, spheres);
  host_.warn(
      host_.sphere_text(tag) + " appeared inside the wall, which it overlaps by " + overlap +
      " in step " + std::to_string(step) + ": " +
      (most > 1 ? kWrongSide : std::string("it will be thrown out; ") + host_.names().put_clear) +
      ". This warning comes again for a larger overlap");
}

}    // namespace lsdcd
