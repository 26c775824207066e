/* SPDX-FileCopyrightText: 2026 LSDCD contributors */
/* SPDX-License-Identifier: BSD-3-Clause */

/* A program as it was written for the first frozen header: distances of points from a mesh. */
#include "lsdcd.h"
#include <stdio.h>

int main(int argc, char **argv)
{
  double points[6] = {0, 0, 0, 0.5, 0.5, 1.25}, distance[2];
  lsdcd_mesh *mesh = NULL;
  lsdcd_grid *grid = NULL;
  lsdcd_grid_options options = {.size = sizeof options, .cutoff = 1};
  lsdcd_query query = {.size = sizeof query, .n = 2, .points = points, .distance = distance};
  int bad = lsdcd_mesh_read(argc > 1 ? argv[1] : "wall.stl", -1, &mesh) ||
            lsdcd_grid_build(mesh, &options, &grid) || lsdcd_query_host(grid, &query);
  if (bad) fprintf(stderr, "%s\n", lsdcd_last_error());
  if (!bad) printf("%.17g %.17g\n", distance[0], distance[1]);
  lsdcd_grid_free(grid);
  lsdcd_mesh_free(mesh);
  return bad;
}
