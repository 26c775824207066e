// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Saves the state of a wall, and restores a wall from a saved state.
#pragma once

#include "wall/coat/body_coats.h"
#include "wall/grid_manager.h"
#include "wall/saved/wall_state.h"
#include "wall/sums/energy_books.h"
#include "wall/sums/energy_recorder.h"
#include "wall/sums/load_recorder.h"
#include "wall/sums/mean_loads.h"
#include "wall/sums/step_totals.h"

#include <deque>
#include <memory>
#include <vector>

namespace lsdcd {

// Each part of a wall saves, checks and restores what it keeps. This class decides the order and the meshes, and warns of what is left
// out. HistoryExchange saves the springs of spheres.
class StateKeeper {
 public:
  // The parts that are saved. All of them must outlive the keeper.
  struct Parts {
    std::deque<MeshPart> &meshes;
    BodyCoats &coats;
    GridManager &grids;
    StepTotals &totals;
    MeanLoads &means;
    LoadRecorder &loads;
    EnergyBooks &energy;
    EnergyRecorder &records;
  };

  StateKeeper(Host &host, const WallSpec &wall, const Parts &of) : host_(host), wall_(wall), of_(of)
  {
  }

  // Returns the state after a step that is complete, and whose sums have been made. `time`: that of the spheres. Only the first process
  // gets the loads, which are those of all processes. Collective.
  WallState save(Time time);

  // Throws InputError, the same on all processes, if restore() would put a mesh where it is not allowed.
  void check(const WallState &was) const;
  // Keeps the wall as it was made, so that restore() may be called more than once. This takes as much memory as a state. Collective.
  void keep_made();
  // Takes a state that was checked, the same on all processes, in place of any that was restored before. The first process warns of what
  // does not fit. Collective.
  void restore(const WallState &was, const Step &now);
  // Ends restoring: nothing is restored from now on.
  void end_restoring() { made_.reset(); }

 private:
  // The wall as it was made, before anything was restored to it.
  struct Made {
    WallState state;
    std::vector<RigidMotion> motions;    // as they were made; a saved state may have stopped them
  };

  void go_back(const Step &now);
  bool is_restored(const MeshPart &m, const WallState &was) const;
  void restore_mesh(MeshPart &m, const WallState &all, const Step &now);

  Host &host_;
  const WallSpec &wall_;
  Parts of_;
  bool is_restored_ = false;
  std::unique_ptr<Made> made_;    // null: the wall as made was not kept
};

}    // namespace lsdcd
