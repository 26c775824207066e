// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The deepest overlaps: a line after each run, and warnings of spheres that are deep in the wall, because they sank in or
// were put there.
#pragma once

#include "engine/engine.h"
#include "host/host.h"
#include "wall/spec/wall_spec.h"
#include "wall/spheres/host_spheres.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lsdcd {

// Overlaps are fractions of the sphere's radius, > 0 in contact. Past 0.1 they are large. A sphere
// whose centre is past the wall overlaps by more than 1, with side in or out.
class OverlapMonitor {
 public:
  // Both arguments must outlive this object.
  OverlapMonitor(Host &host, const WallSpec &wall) : host_(host), wall_(wall) {}

  // Notes the deepest sphere since the last look. As long as spheres that were put into the wall are deep in it, only a deeper one counts
  // as sunk. Local.
  void note(const StepDiagnostics &seen, const SpheresOnCpu &spheres);

  // Returns the largest overlap noted on this process that is to be warned of; 0: there is none.
  Real worst() const { return worst_.overlap; }

  // Warns of the deepest sphere that sank: past 0.1, past 0.25 and past 0.5 once each, and then of each sphere whose centre
  // came to the wall, up to ten. `worst`: the largest worst() of all processes. `timestep_ratio`: the timestep over the
  // longest that resolves a contact; above 1 it is blamed first, since a stiffer contact would ask for a shorter one
  // still. Collective.
  void check_sunk(Real worst, Real timestep_ratio, const SpheresOnCpu &spheres);

  // Warns once of a grain that is no sphere and overlaps a fold, an edge or a corner by more than its radius of curvature there.
  // Collective.
  void check_sharp();

  // Logs the deepest overlap noted since the last call, unless `brief`. Collective.
  void end_run(bool brief);

  // Warns of the deepest new sphere: one with a higher tag than all spheres had at the last call.
  // Warns again of an overlap that is more than a tenth larger. `seen`: of the step in which spheres
  // may have come. `goes_on`: spheres of the first call are not new but have been simulated before.
  // Collective.
  void check_new(const StepDiagnostics &seen, const SpheresOnCpu &spheres, std::int64_t step,
                 bool goes_on);

 private:
  struct Deepest {
    Real overlap = 0;
    std::int64_t tag = 0, step = 0;    // tag 0: not looked up
    std::uint32_t mesh = 0, meshes = 0;
  };
  struct Sharpest {
    Real ratio = 0, curvature = 0;    // overlap / radius of curvature there, and the least one
    std::int64_t tag = 0;
  };
  static Deepest deepest_of(const StepDiagnostics &seen, std::int64_t tag)
  {
    return {seen.deepest, tag, seen.deepest_step, static_cast<std::uint32_t>(seen.deepest_mesh),
            seen.deepest_meshes};
  }
  void note_of_run(const StepDiagnostics &seen, const SpheresOnCpu &spheres);
  Deepest deepest_of_all(Deepest mine, Real overlap);
  std::string name(std::uint32_t mesh) const;
  std::string names(std::uint32_t meshes) const;    // a bit for each
  std::string overlap_text(Real overlap, std::int64_t tag, const SpheresOnCpu &spheres);
  bool is_named(std::int64_t tag) const;

  const char *length() const
  {
    return wall_.shapes ? "least half-axis" : "radius";
  }    // of overlaps

  static constexpr Real kLarge = 0.1;
  static constexpr Real kSharp = 1;
  static constexpr Real kWorse = 1.1;    // times an overlap that was warned of: warned of again
  // From this overlap on a centre is so near the wall that it may be on the other side in the next step.
  static constexpr Real kThrough = 0.95;
  static constexpr std::size_t kMostNamed = 10;
  // If tags must be fetched from a GPU, only those of spheres that overlap by more are.
  static constexpr Real kWorthATag = 0.01;

  Host &host_;
  const WallSpec &wall_;
  // On this process.
  Deepest worst_, of_run_;
  Sharpest sharpest_;
  // On all processes.
  Real warned_from_ = kLarge;    // overlaps above it are warned of
  bool sharp_warned_ = false;
  std::vector<std::int64_t> named_;    // tags of spheres whose centres came to the wall
  std::int64_t highest_tag_ = -1;      // of spheres that are not new; -1: before the first look
  Real worst_new_ = kLarge;            // a new sphere that overlaps by more is warned of
  // On this process: the largest overlap of spheres that were put into the wall, until none is deep in it.
  Real placed_ = 0;
};

}    // namespace lsdcd
