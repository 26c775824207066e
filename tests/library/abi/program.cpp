// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A C++ program of 0.9.0, whose header is compiled into it. Run beside floor.stl of program.c.
#include "lsdcd.hpp"

#include <cstdio>

int main()
{
  const lsdcd::Mesh floor("floor.stl");
  const lsdcd::Grid grid(floor);
  const std::vector<double> points = {1, 2, 3, 0, 0, -0.5};
  if (floor.arrays().edges.size() != 10 || grid.distances(points) != std::vector<double>{3, 0.5})
    return 1;
  lsdcd::Body body(floor, lsdcd::Mesh(std::vector<double>{0, 0, -1, 1, 0, 1, 0, 1, 1}));
  const double at[3] = {2, 1, 0};
  if (body.collide(at).wall.empty()) return 2;

  lsdcd::Wall wall({"hooke", "1000", "NULL", "0", "NULL", "0", "0", "mesh", "floor.stl"}),
      second({"hooke", "1000", "NULL", "0", "NULL", "0", "0", "mesh", "floor.stl"});
  const double x[3] = {0, 0, 0.4}, v[3] = {}, radius = 0.5, mass = 1;
  double force[3] = {}, torque[3] = {};
  const lsdcd_spheres spheres = {sizeof spheres, 1,     3,      x,       v,       v,      &radius,
                                 &mass,          force, torque, nullptr, nullptr, nullptr};
  wall.step(spheres, {sizeof(lsdcd_wall_step), 1e-3, 0, 0, 0});
  if (wall.totals().contacts != 1 || force[2] < 99 || force[2] > 101) return 3;
  second.restore(wall.save());
  second.step(spheres, {sizeof(lsdcd_wall_step), 1e-3, 0, 0, 0});
  try {
    wall.change({"motion", "no such"});
  } catch (const lsdcd::Error &e) {
    std::printf("C++ too\n");
    return 0;
  }
  return 4;
}
