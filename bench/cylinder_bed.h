// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Spheres that touch the wall of a closed cylinder, and an engine whose particles live where it
// computes: what the programs share that time or count its steps.
#pragma once

#include "engine/engine.h"
#include "grid/flat_grid.h"
#include "mesh/triangle_soup.h"
#include "support/sphere_arrays.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace lsdcd {

// A closed cylinder along z, radius 50, 0 <= z <= 100, in about so many triangles of about one
// size. Both caps are square grids mapped to a disk, so that no vertex has many triangles.
class EvenCylinder {
 public:
  explicit EvenCylinder(double triangles);
  TriangleSoup mesh() const;
  // Distance of a point inside from the nearest flat side. Length.
  Real depth(Real x, Real y) const;

  int n_round, n_along;
  Real half_angle, apothem;    // of one side: half of its angle, distance from the axis
};

// n spheres of radius 0.35 to 1, mass 1, each of which overlaps a side or a cap by 1 to 5 % of its
// radius; in random order or sorted by cubes of edge 3.
SphereArrays bed_spheres(const EvenCylinder &wall, int n, bool sorted);

class CylinderBed {
 public:
  CylinderBed(const EvenCylinder &wall, const SphereArrays &spheres, const ContactLaw &law,
              Device device);

  void choose();        // the near spheres
  void steps(int n);    // with the near spheres as they are; waits at the end
  std::int64_t contacts() const { return engine_->results().totals().contacts; }
  int n_candidates() const { return engine_->n_candidates(); }
  Real cell() const { return grid_.view().length; }
  double grid_mb() const { return grid_.view().block_bytes / 1e6; }
  double engine_mb() const { return engine_->bytes() / 1e6; }

  std::size_t triangles = 0;
  double build_ms = 0;    // welding and building the grid

 private:
  FlatOf<StepGrid> grid_;
  std::unique_ptr<WallEngine> engine_;
  SphereArraysOn arrays_;
  Spheres spheres_;
};

}    // namespace lsdcd
