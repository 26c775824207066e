// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A sphere lies between a floor and a lid, which have laws of their own. The program moves the lid, and asks for the force and torque
// on it. The same in Python: doc/library.md.
#include <algorithm>
#include <cstdio>
#include <lsdcd.hpp>
#include <vector>

// A square of two triangles at a height z, from -1 to 1 along x and y.
lsdcd::Mesh square(double z)
{
  return {std::vector<double>{-1, -1, z, 1, -1, z, 1, 1, z, -1, 1, z}, {0, 1, 2, 0, 2, 3}};
}

int main()
{
  lsdcd::Wall wall(
      "hooke/history 1e4 5e3 20 NULL 0.5 1  mesh $floor "    // kn kt gamman gammat xmu dampflag
      "mesh $lid  motion caller  law hooke/history 2e4 5e3 20 NULL 0.1 1",
      {{"floor", square(0)}, {"lid", square(1)}});
  const int lid = wall.mesh("lid");

  // A sphere of radius 0.5 and mass 1, between the two.
  const std::vector<double> x = {0, 0, 0.5}, v(3), omega(3), radius = {0.5}, mass = {1};
  std::vector<double> force(3), torque(3);
  lsdcd_spheres spheres = {};
  spheres.size = sizeof spheres;
  spheres.n = 1;
  spheres.x = x.data();
  spheres.v = v.data();
  spheres.omega = omega.data();
  spheres.radius = radius.data();
  spheres.mass = mass.data();
  spheres.force = force.data();
  spheres.torque = torque.data();
  lsdcd_wall_step step = {};
  step.size = sizeof step;
  step.dt = 1e-3;

  for (int k = 1; k <= 10; k++) {    // the lid comes down at a speed of 1
    lsdcd::Pose pose;
    pose.position = {0, 0, -k * step.dt};
    pose.velocity = {0, 0, -1};
    wall.set_pose(lid, pose);
    std::fill(force.begin(), force.end(), 0);
    wall.step(spheres, step);
  }
  const lsdcd_wall_totals on_lid = wall.totals(lid, {0, 1, 0});    // the torque is about (0, 1, 0)
  std::printf("on the sphere %g, on the lid %g, about x %g\n", force[2], on_lid.force[2],
              on_lid.torque[0]);
}
