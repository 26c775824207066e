// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a saved state has of a mesh. Each part is written by what it is of, and read by it again.
#pragma once

#include "motion/motion.h"
#include "rigid/rigid_body.h"
#include "wall/sums/energy_books.h"
#include "wall/sums/mean_loads.h"
#include "wall/sums/step_totals.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

// The sums of a motion in a saved state.
struct MotionState {
  StepClock clock;
  Pose start;     // that the terms act on
  Pose placed;    // in the last step, without the servo
  Pose last;      // with it
  Servo servo;    // its line, position and velocity
  // The terms that move the mesh or, if `stopped`, that were stopped.
  std::vector<MotionTerm> terms;
  bool stopped = false;
  InputNames inputs;    // of the terms
  // The velocities of a mesh that the program poses, in its last pose.
  Vec3 velocity = {0, 0, 0}, angular = {0, 0, 0};

  bool moves() const { return !terms.empty() && !stopped; }
  bool moves_when_posed() const { return norm_sq(velocity) + norm_sq(angular) > 0; }
  // Returns whether the mesh was where a body or the program had put it: at rest it would be where it began.
  bool was_posed() const { return !moves() && !is_same_place(start, placed); }
};

// What the joint of a body and its stop did in the last step, even if another joint holds the body from the next one on.
struct JointLoad {
  Wrench reaction;
  Real stop_force = 0;
};

// A body in a saved state.
struct BodyState {
  bool present = false;
  MassProperties mass;
  Joint joint;
  RigidState state;
  Wrench load;                        // of the last step, by which the next one begins
  std::vector<JointLoad> of_joint;    // of the last step: one; none: data without it
  bool has_begun =
      true;    // false: it is where it was made, which its first step asks about; not in files
};

// The nodes of a mesh in a saved state, in the order of its vertices.
struct NodeState {
  std::vector<Real> names;    // of the particles of the host that are nodes; empty: it has none
  std::vector<Real>
      places;    // x y z of each (length); empty: no nodes, or a state without their places
  // x y z of each (length/time); empty: 0, and of nodes that a host sets before each step, as are the ones that follow.
  std::vector<Real> velocities;
  Real behind = 0;                            // how long before the places these are of (time)
  std::vector<Real> next, next_velocities;    // that were set for the next step; empty: none were
  std::vector<Real> forces;    // of contacts in the last step, x y z of each; empty: there was none
};

// The surface of a mesh in a saved state.
struct SurfaceState {
  std::vector<Real> vertices;    // x y z of each; empty: the mesh has no such wear
  std::vector<Real> pending;     // four numbers of each: see MeshWear
  std::vector<Real> held;        // of each: 1 where it stays
  Real removed = 0, held_back = 0, carried = 0;    // length^3
};

// What a mesh is known by: its counts, and a number made of all of it.
struct MeshIdentity {
  std::int64_t facets = 0, edges = 0, vertices = 0;
  Real fingerprint = 0;

  bool operator==(const MeshIdentity &other) const
  {
    return facets == other.facets && edges == other.edges && vertices == other.vertices &&
           fingerprint == other.fingerprint;
  }
};

// What acted on a mesh in the last step, by which servos move, and bodies where they are.
struct StepLoad {
  MeshTotals totals;
  CoatLoad coat;    // its contacts, overlap, radius and mass
};

struct LoadState {
  Real time = 0;             // of the average
  std::vector<Real> rows;    // of all processes, as of FeatureRows::packed()
};

struct MeshState {
  MeshIdentity mesh;
  MotionState motion;
  LoadState loads;
  BodyState body;
  NodeState nodes;
  std::vector<Real> coat;              // of BodyCoat::save()
  SurfaceState surface;                // of a mesh that recedes by its wear
  std::vector<MeanLoadState> mean;     // one, or none where there are no means
  std::vector<StepLoad> last;          // one; none: data without it
  std::vector<BookedEnergy> energy;    // one, or none if energy is not recorded
  std::vector<Real> energy_places;     // of all processes, as of FeatureRows::packed()
  std::vector<Real> impacts;    // as of ImpactSpectrum::packed(); none where they are not recorded
};

}    // namespace lsdcd
