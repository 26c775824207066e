// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distances of a few points from a mesh, and on which side they are: distance WALL.stl
#include <cstdio>
#include <lsdcd.hpp>

int main(int argc, char **argv)
try {
  const lsdcd::Grid grid(lsdcd::Mesh(argc > 1 ? argv[1] : "wall.stl"), 1.0);
  const std::vector<double> points = {0, 0, 0, 0.5, 0.5, 1.25};
  const std::vector<double> distance = grid.distances(points);
  std::printf("%.17g %.17g\n", distance[0], distance[1]);
} catch (const lsdcd::Error &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
