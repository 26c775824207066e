// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/check_step.h"

#include "backend/threads.h"
#include "engine/engine.h"
#include "grid/flat_grid.h"
#include "mesh/welded_mesh.h"
#include "tool/shapes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

namespace lsdcd {

namespace {

constexpr int kAlong = 100;                                                   // spheres, in x and y
constexpr Real kRadius = 0.4, kOverlap = 0.01 * kRadius, kStiffness = 1e5;    // spheres are 1 apart
constexpr int kSteps = 20;

// Spheres are on faces, edges and corners of the plane: its triangles have other sides than the lattice.
FlatOf<StepGrid> plane_grid()
{
  TriangleSoup soup;
  soup.source = "plane";
  for (const auto &triangle : plane_shape(kAlong, kAlong, 3.7))
    soup.corners.insert(soup.corners.end(), triangle.begin(), triangle.end());
  StepGridSettings settings;
  settings.cutoff = settings.length = kRadius;
  return FlatOf(build_grid(weld(soup, -1), settings));
}

Real largest_error(const std::vector<Real> &force)
{
  const Real hooke = kStiffness * kOverlap;
  Real largest = 0;
  for (std::size_t k = 0; k < force.size(); k++) {
    const Real error = std::fabs(force[k] - (k % 3 == 2 ? hooke : 0)) / hooke;
    if (std::isnan(error)) return error;
    largest = std::max(largest, error);
  }
  return largest;
}

}    // namespace

CheckedStep check_step(Device device)
{
  const OneThread one_thread;
  const FlatOf<StepGrid> grid = plane_grid();
  constexpr int kSpheres = kAlong * kAlong;
  std::vector<Real> x, zero(3 * kSpheres, 0), force(3 * kSpheres, 0), torque(3 * kSpheres, 0),
      radius(kSpheres, kRadius), mass(kSpheres, 1);
  for (int i = 0; i < kSpheres; i++)
    x.insert(x.end(),
             {i % kAlong + 0.5 - kAlong / 2., i / kAlong + 0.5 - kAlong / 2., kRadius - kOverlap});
  Spheres spheres;
  spheres.n = kSpheres;
  spheres.x = x.data();
  spheres.v = spheres.omega = zero.data();
  spheres.radius = radius.data();
  spheres.mass = mass.data();
  spheres.force = force.data();
  spheres.torque = torque.data();

  EngineSettings settings;
  settings.device = device;
  settings.law() = classic_law(NormalModel::hooke, false);
  settings.law().k_normal = kStiffness;
  const auto engine = make_engine(settings);
  engine->set_grid(grid.view());
  engine->choose(spheres, kRadius / 10);
  double least = 0;
  for (int s = 0; s < kSteps; s++) {
    std::fill(force.begin(), force.end(), 0);
    const auto start = std::chrono::steady_clock::now();
    engine->step(spheres, {});
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    if (s == 0 || time.count() < least) least = time.count();
  }
  engine->read_diagnostics();    // throws where a sphere was left out
  return {engine->backend(), kSpheres, least / kSpheres, largest_error(force)};
}

}    // namespace lsdcd
