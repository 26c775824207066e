// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What of a wall goes into a saved state, and what of a saved state goes into a wall.
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

// Each part of a wall saves, checks and restores what it keeps; this says in which order, of which meshes, and what is told of what
// is left out. The springs of spheres are HistoryExchange's.
class StateKeeper {
 public:
  // What is saved. All must outlive the keeper.
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

  // Returns the state after a step that is complete, and whose sums are made; `time`: of the spheres. The loads of all processes are
  // on the first one alone. Collective.
  WallState save(Time time);

  // Throws InputError, the same on all processes, where restore() would put a mesh where it may not be.
  void check(const WallState &was) const;
  // Keeps what the wall was made as, which takes as much memory as a state, so that restore() may be called more than once.
  // Collective.
  void keep_made();
  // Takes a state that was checked, the same on all processes, in place of any that was restored before. The first process warns of what
  // does not fit. Collective.
  void restore(const WallState &was, const Step &now);
  // Nothing is restored from now on.
  void end_restoring() { made_.reset(); }

 private:
  // A wall to which nothing was restored.
  struct Made {
    WallState state;
    std::vector<RigidMotion> motions;    // a saved state may have stopped them
  };

  void go_back(const Step &now);
  bool is_restored(const MeshPart &m, const WallState &was) const;
  void restore_mesh(MeshPart &m, const WallState &all, const Step &now);

  Host &host_;
  const WallSpec &wall_;
  Parts of_;
  bool is_restored_ = false;
  std::unique_ptr<Made> made_;    // null: it was not kept
};

}    // namespace lsdcd
