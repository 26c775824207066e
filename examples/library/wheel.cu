// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A robot's loop: a wheel drives over a bed of grains on a GPU: wheel WHEEL.stl [GRAINS [STEPS]]
//
// The host moves the wheel, as a robot's program would: in every step it reads what the grains push, moves the wheel, and gives
// the wall its pose. Grains, their forces and the wall stay on the GPU. SI units; the wheel turns about y.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <lsdcd.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "grains.cuh"

// Returns the corners of the triangles of a box without a lid.
std::vector<double> tray(double x, double y, double z)
{
  const double corner[8][3] = {{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0},
                               {0, 0, z}, {x, 0, z}, {x, y, z}, {0, y, z}};
  std::vector<double> out;
  for (const auto &side :
       {std::array<int, 4>{0, 1, 2, 3}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}})
    for (const int k : {0, 1, 2, 0, 2, 3})
      out.insert(out.end(), corner[side[k]], corner[side[k]] + 3);
  return out;
}

int main(int argc, char **argv)
try {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);    // a line at once, even into a file
  const std::string file = argc > 1 ? argv[1] : "wheel.stl";
  const int wanted = argc > 2 ? std::atoi(argv[2]) : 1000000,
            steps = argc > 3 ? std::atoi(argv[3]) : 20000;
  constexpr double kGravity = 9.81, kWheelMass = 12, kTurning = 4, kWheelRadius = 0.15;

  Scene s = {};
  s.radius = 0.0025;
  s.mass = 2500 * 4 / 3. * 3.14159265358979 * std::pow(s.radius, 3);
  s.stiffness = 2000;
  const double frequency = std::sqrt(s.stiffness / s.mass);
  s.damping = 0.4 * s.mass * frequency;
  s.friction = 0.5;
  s.gravity = kGravity;
  s.dt = 0.12 / frequency;
  // The bed is three times as long as wide, and a third as deep as wide.
  const double gap = 2.02 * s.radius;
  const int deep = std::max(4, static_cast<int>(std::cbrt(wanted / 27.))), wide = 3 * deep,
            along = wanted / (wide * deep);
  if (along < 1 || steps < 1)
    throw std::runtime_error("wheel: give at least 48 grains and one step");
  const double size[3] = {(along + 1) * gap, (wide + 1) * gap, (deep + 1) * gap + 3 * kWheelRadius},
               lo[3] = {0, 0, 0};
  std::vector<double> x;
  for (int i = 0; i < along; i++)
    for (int j = 0; j < wide; j++)
      for (int k = 0; k < deep; k++)
        x.insert(x.end(), {(i + 1 + 0.03 * std::sin(7. * k)) * gap,
                           (j + 1 + 0.03 * std::cos(5. * k)) * gap, (k + 0.6) * gap});
  s.n = static_cast<int>(x.size() / 3);

  const int n_cells = set_cells(s, lo, size);
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
  const lsdcd::Mesh of_wheel(file);
  lsdcd::Wall wall(
      "hooke/history $kn NULL $gamman NULL 0.5 1  mesh $tray  mesh $wheel motion caller",
      {{"kn", s.stiffness},
       {"gamman", 0.4 * frequency},
       {"tray", lsdcd::Mesh(tray(size[0], size[1], size[2]))},
       {"wheel", of_wheel}},
      &options);
  const int wheel = wall.mesh("wheel");
  lsdcd_spheres spheres = {};
  spheres.size = sizeof spheres;
  spheres.n = s.n;
  spheres.x = s.x, spheres.v = s.v, spheres.omega = s.omega, spheres.force = s.force,
  spheres.torque = s.torque;
  spheres.radius = radius.at, spheres.mass = mass.at;
  lsdcd_wall_step step = {};
  step.size = sizeof step;
  step.dt = s.dt;

  // The wheel stands over the bed, across its middle.
  const lsdcd::MeshFacts facts = of_wheel.facts();
  lsdcd::Pose pose;
  pose.position = {0.25 * size[0], 0.5 * (size[1] - facts.lo[1] - facts.hi[1]),
                   deep * gap + 1.02 * kWheelRadius};
  pose.angular_velocity = {0, kTurning, 0};
  double angle = 0;
  wall.set_pose(wheel, pose);

  cudaEvent_t at[3];
  for (cudaEvent_t &event : at) check(cudaEventCreate(&event));
  double of_grains = 0, of_wall = 0, of_host = 0;
  using Clock = std::chrono::steady_clock;
  const int first = steps / 5;    // from here on times count
  Clock::time_point began;
  for (int k = 0; k <= steps; k++) {
    if (k == first) {
      check(cudaStreamSynchronize(stream));
      began = Clock::now();
      of_grains = of_wall = of_host = 0;
    }
    check(cudaEventRecord(at[0], stream));
    if (k > 0) start_kick(s, true, stream);
    start_forces(s, stream);
    check(cudaEventRecord(at[1], stream));
    step.setup = k == 0;
    wall.step(spheres, step);
    check(cudaEventRecord(at[2], stream));
    if (k > 0) start_kick(s, false, stream);
    const lsdcd_wall_totals push =
        wall.totals(wheel, {pose.position[0], pose.position[1], pose.position[2]});
    const Clock::time_point told = Clock::now();
    // The robot: its motor turns the wheel at a constant speed, and an axle carries it along and up.
    pose.velocity[0] += s.dt * push.force[0] / kWheelMass;
    pose.velocity[2] += s.dt * (push.force[2] / kWheelMass - kGravity);
    for (const int d : {0, 2}) pose.position[d] += s.dt * pose.velocity[d];
    angle += s.dt * kTurning;
    pose.quaternion = {std::cos(angle / 2), 0, std::sin(angle / 2), 0};
    wall.set_pose(wheel, pose);
    of_host += std::chrono::duration<double>(Clock::now() - told).count();
    float ms[2];
    check(cudaEventSynchronize(at[2]));
    for (int e = 0; e < 2; e++) check(cudaEventElapsedTime(ms + e, at[e], at[e + 1]));
    of_grains += 1e-3 * ms[0];
    of_wall += 1e-3 * ms[1];
    if (k % std::max(1, steps / 10) == 0)
      std::printf("t %.4f s: wheel at x %.4f z %.4f m, bears %.1f N\n", k * s.dt, pose.position[0],
                  pose.position[2], push.force[2]);
  }
  check(cudaStreamSynchronize(stream));
  const int n = steps - first + 1;
  const double each = std::chrono::duration<double>(Clock::now() - began).count() / n;
  std::printf("%d grains, %g s a step in %.4g ms: real time / %.3g; grains %.4g, wall %.4g, robot "
              "%.4g ms, the rest waits\n",
              s.n, s.dt, 1e3 * each, each / s.dt, 1e3 * of_grains / n, 1e3 * of_wall / n,
              1e3 * of_host / n);
  return std::isfinite(pose.position[2]) ? 0 : 1;
} catch (const std::exception &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
