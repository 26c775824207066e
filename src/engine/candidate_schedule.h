// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// When the spheres near the wall are chosen.
#pragma once

#include "base/vec3.h"
#include "box/periodic_box.h"
#include "motion/pose.h"

#include <functional>
#include <vector>

namespace lsdcd {

// How far spheres go before the host expires a choice.
struct SphereDrift {
  enum Kind {
    bounded,    // none goes farther than `distance` between two calls of expire()
    watched,    // any distance: the engine looks at all spheres in each step
    unknown    // any distance, and spheres join and leave the group: the engine chooses in each step
  };
  Kind kind = unknown;
  Real distance = 0;    // length; of watched: how far a sphere goes before a new choice
  // Have spheres moved since the host counted their drift from 0? One that has gone `distance` one way may go as far the
  // other way.
  bool has_begun = false;
  // Only of watched: the host has looked in this step, and none has gone farther than `distance` since it counted from 0.
  bool host_has_looked = false;
};

// A mesh that moves, as it is in this step.
struct MovingMesh {
  Pose pose;
  Box bounds;    // length, in the mesh's own frame; around all places where a sphere touches it
};

// The arguments of WallEngine::choose().
struct CandidateUpdate {
  bool is_due = false;
  Real margin = 0;       // length
  bool watch = false;    // has_moved() will be asked
};

class CandidateSchedule {
 public:
  // A choice is due in the next step, whatever has moved.
  void expire() { expired_ = true; }

  // Whether spheres are chosen in this step. `moving`: the meshes that move, always in the same order.
  // `has_moved`: has a sphere gone farther than the last margin? It is asked only where that decides.
  CandidateUpdate next(const SphereDrift &drift, const std::vector<MovingMesh> &moving,
                       const std::function<bool()> &has_moved) const;

  // Spheres were chosen in this step, with the drift that next() was asked with.
  void note_update(const SphereDrift &drift, const std::vector<MovingMesh> &moving);

 private:
  bool any_has_gone(Real farther_than, const std::vector<MovingMesh> &moving) const;

  bool expired_ = true;
  bool chosen_at_zero_ =
      false;    // before spheres had moved since the host counted their drift from 0
  std::vector<Pose> chosen_;    // of the moving meshes, in the step of the last choice
};

}    // namespace lsdcd
