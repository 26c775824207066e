// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A body that sinks into a wall: how many pairs of triangles meet at each height. collide WALL.stl BODY.stl
#include <cstdio>
#include <lsdcd.hpp>

int main(int argc, char **argv)
try {
  if (argc < 3) return 2;
  const lsdcd::Mesh wall(argv[1]), mesh(argv[2]);
  lsdcd::Body body(wall, mesh);
  for (double z : {2.0, 1.5, 0.5}) {
    const double position[3] = {0, 0, z};
    std::printf("%zu ", body.collide(position).wall.size());
  }
  std::printf("\n");
} catch (const lsdcd::Error &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
