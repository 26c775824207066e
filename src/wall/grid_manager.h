// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Builds the grids of a wall's meshes when they are needed: for the first spheres, for larger ones, for another box.
#pragma once

#include "wall/checks/box_checks.h"
#include "wall/coat/body_coats.h"
#include "wall/reports/time_report.h"
#include "wall/spheres/history_exchange.h"
#include "wall/spheres/host_spheres.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <string>

namespace lsdcd {

// Errors are InputError, the same on all processes. All functions that are not const are collective.
class GridManager {
 public:
  // All arguments must outlive this object.
  GridManager(Host &host, const WallSpec &settings, const LawTable &laws,
              std::deque<MeshPart> &meshes, BodyCoats &coats, BoxChecks &checks,
              HistoryExchange &history, TimeReport &times) :
      host_(host),
      settings_(settings), reach_(longest_reach(laws)), meshes_(meshes), coats_(coats),
      checks_(checks), history_(history), times_(times)
  {
  }

  Real cutoff() const
  {
    return meshes_.front().grid.cutoff();
  }    // length; 0: there were no spheres yet
  // Returns the box of the simulation. Its margin is the farthest distance that spheres have gone past a periodic face.
  PeriodicBox box() const;

  // Sets the engine of all steps from now on, and gives it the grids that exist.
  void set_engine(WallEngine &engine);

  // Builds grids, if needed, for spheres of up to this radius (length, 0: there are none) and for coats in the box of this step. Returns
  // whether grids were built.
  bool fit_spheres(Real radius, const SpheresOnCpu &spheres, std::int64_t step);
  // Builds grids, if needed, for the box of this step. Does nothing before there are spheres.
  bool fit_box(std::int64_t step);

  // Makes the grid of a mesh follow its vertices, which have moved. Does nothing before there are spheres.
  void follow_surface(MeshPart &m);

  // Measures how far spheres are past periodic faces, before they are wrapped. If they went farther than the grid was made for, contacts
  // may have been missed: then it warns, and the grid reaches that far from now on.
  void check_wrapping(const Spheres &spheres);

  // Logs how many grids were built for other boxes in this run, and counts from 0 again.
  void end_run();

  // Returns the feature of which `feature` is a periodic image, or `feature` itself if it is no image.
  FeatureCode without_image(int mesh, FeatureCode feature) const;

 private:
  Real cutoff_of_coats() const;
  void put_grid(const MeshPart &m);    // gives it to the engine
  void rebuild(Real cutoff, std::int64_t step);
  void check_rmax(Real radius, const SpheresOnCpu &spheres) const;
  bool fits(const MeshPart &m) const { return m.grid.fits(m.effective_box(box())); }
  ProgressListener progress(const MeshPart &m) const;
  void log_build(const MeshPart &m, Real old_cutoff, std::int64_t step) const;

  Host &host_;
  const WallSpec &settings_;
  const LawReach reach_;    // the longest of the laws
  std::deque<MeshPart> &meshes_;
  BodyCoats &coats_;
  BoxChecks &checks_;
  HistoryExchange &history_;
  TimeReport &times_;
  WallEngine *engine_ = nullptr;
  Real farthest_out_ = 0;    // length that spheres have gone past a periodic face, and more
  bool out_warned_ = false;
  std::int64_t box_rebuilds_ = 0;    // in this run
};

}    // namespace lsdcd
