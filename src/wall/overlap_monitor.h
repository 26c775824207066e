// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Warnings of spheres that are deep in the wall: those that sank in, and those that were put there.
#pragma once

#include "engine/wall_engine.h"
#include "host/host.h"
#include "wall/host_spheres.h"

namespace lsdcd {

// Overlaps are fractions of the sphere's radius, > 0 in contact. Past 0.1 they are large. A sphere
// whose centre is past the wall overlaps by more than 1, with side in or out.
class OverlapMonitor {
 public:
  explicit OverlapMonitor(Host &host) : host_(host) {}

  // Notes the deepest sphere of the steps up to `step`. A sphere that was put into the wall has not
  // sunk, until no sphere is deep in the wall or it is deeper than it was put.
  void note(const StepDiagnostics &seen, const SpheresOnCpu &spheres, std::int64_t step);

  // The largest overlap noted on this process; 0: no large one.
  Real worst() const { return worst_; }

  // Warns of the deepest sphere that sank, once. `worst`: the largest worst() of all processes.
  // `timestep_ratio`: the timestep over the longest that resolves a contact; above 1 it is blamed first,
  // since a stiffer contact would ask for a shorter one still. Collective.
  void check_sunk(Real worst, Real timestep_ratio, const SpheresOnCpu &spheres);

  // Warns of the deepest new sphere: one with a higher tag than all spheres had at the last call.
  // Warns again of an overlap that is more than a tenth larger. `seen`: of the step in which spheres
  // may have come. `goes_on`: spheres of the first call are not new but have been simulated before.
  // Collective.
  void check_new(const StepDiagnostics &seen, const SpheresOnCpu &spheres, std::int64_t step,
                 bool goes_on);

 private:
  std::string overlap_text(Real overlap, std::int64_t tag, const SpheresOnCpu &spheres);

  static constexpr Real kLarge = 0.1;
  static constexpr Real kWorse = 1.1;    // times an overlap that was warned of: warned of again

  Host &host_;
  bool sunk_warned_ = false;
  // On this process.
  Real worst_ = 0;
  std::int64_t worst_tag_ = 0, worst_step_ = 0;
  // On all processes.
  std::int64_t highest_tag_ = -1;    // of spheres that are not new; -1: before the first look
  Real worst_new_ = kLarge;          // a new sphere that overlaps by more is warned of
  // The last spheres of which some were put into the wall have tags in (placed_after_,
  // placed_until_]. Their overlap is 0 once no sphere of this process is deep in the wall.
  std::int64_t placed_after_ = 0, placed_until_ = 0;
  Real placed_overlap_ = 0;
};

}    // namespace lsdcd
