// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "kernel_probe.h"

#include "mesh/welded_mesh.h"
#include "support/meshes.h"

#include <cstdio>
#include <random>

using namespace lsdcd;

// Callgrind counts what runs in here.
__attribute__((noinline)) int probed_kernel(const GridView &grid, const ProbedLaw &law,
                                            const ForceSettings &settings,
                                            const std::vector<SphereState> &spheres,
                                            std::vector<Spring> &springs)
{
  int contacts = 0;
  for (std::size_t k = 0; k < spheres.size(); k++) {
    SphereSink sink;
    sink.springs = springs.data() + 8 * k;
    contacts += probed_force(grid, law, settings, spheres[k], sink).n_contacts;
  }
  return contacts;
}

int main()
{
  TriangleSoup soup = cylinder_mesh(24, 6, 3, 6);
  const WeldedMesh mesh = weld(soup, -1);
  GridSettings grid_settings;
  grid_settings.cutoff = 0.5;
  const TriangleGrid grid = build_grid(mesh, grid_settings);
  const FlatGrid flat(grid);

  std::mt19937 random(3);
  std::uniform_real_distribution<Real> u(-3.4, 3.4), z(-0.4, 6.4), speed(-1, 1);
  std::vector<SphereState> spheres(2000);
  for (SphereState &s : spheres) {
    s = {};
    s.x = {u(random), u(random), z(random)};
    s.v = {speed(random), speed(random), speed(random)};
    s.omega = {speed(random), speed(random), speed(random)};
    s.radius = 0.5;
    s.mass = 1;
  }
  std::vector<Spring> springs(8 * spheres.size());
  // Numbers of any law: what a contact costs does not depend on them.
  ProbedLaw law;
  Real *numbers = reinterpret_cast<Real *>(&law);
  for (std::size_t k = 0; k < sizeof law / sizeof(Real); k++) numbers[k] = 0.5;
  ForceSettings settings = {};
  settings.dt = 1e-3;
  settings.update = true;
  const int contacts = probed_kernel(flat.view(), law, settings, spheres, springs);
  std::printf("%d contacts\n", contacts);
  return contacts > 0 ? 0 : 1;
}
