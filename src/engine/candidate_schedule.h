// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Decides when to search for the candidates, the spheres near the wall.
#pragma once

#include "base/vec3.h"
#include "box/periodic_box.h"
#include "motion/pose.h"

#include <functional>
#include <vector>

namespace lsdcd {

// How far spheres may move before the host expires the last candidate search.
struct SphereDrift {
  enum Kind {
    bounded,    // none moves farther than `distance` between two calls of expire()
    watched,    // any distance: the engine checks all spheres in each step
    unknown     // any distance, and spheres join and leave the group: each step has a search
  };
  Kind kind = unknown;
  Real distance = 0;    // length; if watched: how far a sphere moves before a new search
  // Have spheres moved since the host set their drift to 0? A sphere that has moved `distance` in one direction may move
  // as far in the other.
  bool has_begun = false;
  // Only if watched: the host has checked in this step that no sphere has moved farther than `distance` since it set the
  // drift to 0.
  bool host_has_looked = false;
};

// A mesh that moves, with its pose in this step.
struct MovingMesh {
  Pose pose;
  Box bounds;    // length, in the mesh's own frame; around all places where a sphere touches it
};

// The arguments of WallEngine::choose(), which searches for candidates.
struct CandidateUpdate {
  bool is_due = false;
  Real margin = 0;       // length
  bool watch = false;    // will has_moved() be asked?
};

class CandidateSchedule {
 public:
  // Makes a candidate search due in the next step, whatever has moved.
  void expire() { expired_ = true; }

  // Returns whether a candidate search is due in this step, and with which margin. `moving`: the meshes that move, always
  // in the same order. `has_moved`: has a sphere moved farther than the last margin? It is called only if the answer
  // decides.
  CandidateUpdate next(const SphereDrift &drift, const std::vector<MovingMesh> &moving,
                       const std::function<bool()> &has_moved) const;

  // Notes that there was a search in this step, with the drift that next() was given.
  void note_update(const SphereDrift &drift, const std::vector<MovingMesh> &moving);

 private:
  bool any_has_gone(Real farther_than, const std::vector<MovingMesh> &moving) const;

  bool expired_ = true;
  bool chosen_at_zero_ = false;    // before spheres had moved since the host set their drift to 0
  std::vector<Pose> chosen_;       // of the moving meshes, in the step of the last search
};

}    // namespace lsdcd
