// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Energy that a bouncing and a rolling sphere gain or lose at a wall that should conserve it.
#pragma once

#include "engine/engine.h"
#include "mesh/welded_mesh.h"
#include "study/sphere_sample.h"

#include <vector>

namespace lsdcd {

// Starts of spheres: beside a random point of a face, on the side that `normal` points
// to. Every setting that is tried has the same starts.
struct DriftStarts {
  std::vector<Vec3> point, normal, along;    // along: unit, in the face
  Real radius;
  StepGrid wall;    // complete; shows which spheres went through

  int n() const { return static_cast<int>(point.size()); }
};

// Up to n starts at which a sphere at rest on the face touches nothing else (`grid` is
// asked); faces are chosen by area, sides by chance. `memory_budget`: bytes of `wall`, which is coarser where
// that is needed; 0: as build_grid() has it.
DriftStarts drift_starts(const WeldedMesh &mesh, const GridView &grid, Real radius, int n,
                         Random &random, std::size_t memory_budget = 0);

// Units: radius R, mass 1, a pull g along -normal that stays the same for a sphere; a linear
// spring of stiffness 1000 g / R, no damping; steps of 0.001 sqrt(R/g). Both return the
// median over the spheres of |energy gained or lost| / the energy of the motion: of kinetic
// energy, springs and the pull's potential, so that sliding or falling off a wall costs
// nothing. A sphere that the pull has taken two radii past its start is off the wall and counts
// with what it had until then; one whose centre came within half a radius of the wall has gone
// through it and counts 1.

// Dropped by 0.2 R, without friction, moving along the face at 0.3 sqrt(R g), for ten
// bounces: 13.7 sqrt(R/g). Energy of the motion: that of the fall.
Real bounce_drift(const ViewOf<StepGrid> &grid, EngineSettings engine, const DriftStarts &starts);

// Resting on the face and rolling at 0.5 sqrt(R g), with a tangential spring that never
// slips, for 10 sqrt(R/g), five radii. Energy of the motion: of going and turning.
Real roll_drift(const ViewOf<StepGrid> &grid, EngineSettings engine, const DriftStarts &starts);

}    // namespace lsdcd
