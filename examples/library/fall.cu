// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A DEM on a GPU: grains fill a closed mesh and fall to its floor: fall CLOSED.stl [STEPS]
//
// Grains, their forces and the wall stay on the GPU, in the order of one stream. Grains push each other by a damped
// spring along their normal; the wall has LAMMPS's Hookean law with friction. Lengths are in the unit of the mesh,
// masses in that of a grain, and gravity is 1.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <lsdcd.hpp>
#include <string>
#include <vector>

#include "grains.cuh"

// Places of a lattice that are inside the mesh, clear of it by `gap`.
std::vector<double> inside(const lsdcd::Grid &grid, const std::vector<double> &places, double gap)
{
  const std::size_t n = places.size() / 3;
  std::vector<double> distance(n), found;
  std::vector<int8_t> side(n);
  lsdcd::Query<double> query(places.data(), n);
  query.distance = distance.data();
  query.side = side.data();
  grid.query(query);
  for (std::size_t i = 0; i < n; i++)
    if (side[i] < 0 && distance[i] > gap)
      found.insert(found.end(), &places[3 * i], &places[3 * i] + 3);
  return found;
}

int main(int argc, char **argv)
try {
  const std::string file = argc > 1 ? argv[1] : "closed.stl";
  const int steps = argc > 2 ? std::atoi(argv[2]) : 30000;
  const lsdcd::Mesh mesh(file);
  const lsdcd::Grid grid(mesh);
  const lsdcd::MeshFacts facts = mesh.facts();
  const double diagonal =
      std::hypot(facts.hi[0] - facts.lo[0], facts.hi[1] - facts.lo[1], facts.hi[2] - facts.lo[2]);

  Scene s = {};
  s.radius = 0.01 * diagonal;
  s.mass = 1;
  s.gravity = 1;
  s.stiffness = 2e4 * s.mass / s.radius;    // a hundred layers press a grain by 1/200 of its radius
  const double frequency = std::sqrt(s.stiffness / s.mass);
  s.damping = 0.4 * s.mass * frequency;
  s.dt = 0.1 / frequency;
  std::vector<double> lattice;
  for (double z = facts.lo[2]; z < facts.hi[2]; z += 2.1 * s.radius)
    for (double y = facts.lo[1]; y < facts.hi[1]; y += 2.1 * s.radius)
      for (double x = facts.lo[0]; x < facts.hi[0]; x += 2.1 * s.radius)
        // Rows aside from each other, so that none stands on another.
        lattice.insert(lattice.end(), {x + 0.03 * s.radius * std::sin(7 * z / s.radius), y, z});
  std::vector<double> x = inside(grid, lattice, s.radius);
  s.n = static_cast<int>(x.size() / 3);
  if (s.n == 0) throw std::runtime_error(file + ": no grain has room in it");

  const int n_cells = set_cells(s, facts.lo, facts.hi);
  const std::vector<double> zeros(3 * s.n, 0.);
  const OnGpu<double> places(x), v(zeros), omega(zeros), force(zeros), torque(zeros);
  const OnGpu<double> radius{std::vector<double>(s.n, s.radius)},
      mass{std::vector<double>(s.n, s.mass)};
  const OnGpu<int> head{std::vector<int>(n_cells)}, next{std::vector<int>(s.n)};
  s.x = places.at, s.v = v.at, s.omega = omega.at, s.force = force.at, s.torque = torque.at;
  s.head = head.at, s.next = next.at;

  cudaStream_t stream;
  check(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking));
  lsdcd::WallOptions options;
  options.device = LSDCD_CUDA;
  options.stream = stream;
  lsdcd::Wall wall("hooke/history $kn NULL $gamman NULL 0.5 1  mesh $mesh",
                   {{"kn", s.stiffness}, {"gamman", 0.4 * frequency}, {"mesh", mesh}}, &options);
  lsdcd_spheres spheres = {};
  spheres.size = sizeof spheres;
  spheres.n = s.n;
  spheres.x = s.x, spheres.v = s.v, spheres.omega = s.omega, spheres.force = s.force,
  spheres.torque = s.torque;
  spheres.radius = radius.at, spheres.mass = mass.at;
  lsdcd_wall_step step = {};
  step.size = sizeof step;
  step.dt = s.dt;

  for (int k = 0; k <= steps; k++) {
    if (k > 0) start_kick(s, true, stream);
    start_forces(s, stream);
    step.setup = k == 0;    // the forces with which it begins
    wall.step(spheres, step);
    if (k > 0) start_kick(s, false, stream);
  }
  const lsdcd_wall_totals totals = wall.totals();
  check(cudaMemcpyAsync(x.data(), s.x, x.size() * sizeof(double), cudaMemcpyDeviceToHost, stream));
  check(cudaStreamSynchronize(stream));
  const std::size_t within = inside(grid, x, 0).size() / 3;
  std::printf("%d grains, %zu inside after %d steps; the wall bears %.3f of their weight\n", s.n,
              within, steps, -totals.force[2] / (s.n * s.mass));
  return within == static_cast<std::size_t>(s.n) ? 0 : 1;
} catch (const std::exception &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
