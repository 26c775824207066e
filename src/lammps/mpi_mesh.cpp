// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/mpi_mesh.h"

#include "lammps/mpi_shared.h"
#include "mesh/io/read_mesh.h"
#include "mesh/measure_mesh.h"
#include "mesh/soup_of.h"

#include <cstdint>

namespace lsdcd {

namespace {

// From the first process to all.
void send_corners(MPI_Comm world, TriangleSoup &soup)
{
  std::uint64_t corners = soup.corners.size();
  MPI_Bcast(&corners, 1, MPI_UINT64_T, 0, world);
  run_collectively(world, true, [&] { soup.corners.resize(corners); });
  broadcast_bytes(soup.corners.data(), corners * sizeof(Vec3), 0, world);
}

bool is_first(MPI_Comm world)
{
  int rank = 0;
  MPI_Comm_rank(world, &rank);
  return rank == 0;
}

}    // namespace

WeldedMesh read_together(MPI_Comm world, const MeshSpec &settings)
{
  TriangleSoup soup;
  soup.source = settings.file;
  run_collectively(world, is_first(world), [&] {
    soup = read_mesh(settings.file).soup;
    settings.placement.apply(soup);
  });
  send_corners(world, soup);
  WeldedMesh mesh;
  run_collectively(world, true, [&] {
    mesh = weld(soup, settings.weld);
    check_has_area(mesh);
  });
  return mesh;
}

WeldedMesh copy_together(MPI_Comm world, const WeldedMesh *mesh)
{
  TriangleSoup soup;
  run_collectively(world, is_first(world), [&] { soup = soup_of(*mesh); });
  send_corners(world, soup);
  WeldedMesh copy;
  run_collectively(world, true, [&] { copy = weld(soup, 0); });
  return copy;
}

}    // namespace lsdcd
