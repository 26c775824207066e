// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The same for points in a GPU's memory, on a stream: distance WALL.stl
#include <cstdio>
#include <cuda_runtime.h>
#include <lsdcd.hpp>

int main(int argc, char **argv)
try {
  const lsdcd::Grid grid(lsdcd::Mesh(argc > 1 ? argv[1] : "wall.stl"), 1.0);
  double *points, *distance;    // managed, so that the host fills and prints them
  cudaMallocManaged(&points, 6 * sizeof(double));
  cudaMallocManaged(&distance, 2 * sizeof(double));
  for (int k = 0; k < 6; k++) points[k] = k < 3 ? 0 : k < 5 ? 0.5 : 1.25;
  lsdcd::Stream stream(grid);
  lsdcd::Query<double> query(points, 2);
  query.distance = distance;
  stream.query(query);
  cudaDeviceSynchronize();
  std::printf("%.17g %.17g\n", distance[0], distance[1]);
} catch (const lsdcd::Error &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
