// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/mpi_mesh.h"

#include "lammps/mpi_shared.h"
#include "mesh/io/read_mesh.h"
#include "mesh/measure_mesh.h"

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

WeldedMesh read_together(MPI_Comm world, const MeshSettings &settings)
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
  run_collectively(world, is_first(world), [&] {
    const auto add = [&](int a, int b, int c) {
      for (const int v : {a, b, c}) soup.corners.push_back(mesh->vertices[v]);
    };
    for (const auto &f : mesh->faces) add(f[0], f[1], f[2]);
    // Edges and points without a face, of triangles without area.
    for (std::size_t e = 0; e < mesh->edges.size(); e++)
      if (mesh->edge_first[e] == mesh->edge_first[e + 1])
        add(mesh->edges[e][0], mesh->edges[e][1], mesh->edges[e][1]);
    for (std::size_t v = 0; v < mesh->vertices.size(); v++)
      if (mesh->vertex_first[v] == mesh->vertex_first[v + 1]) {
        const int point = static_cast<int>(v);
        add(point, point, point);
      }
  });
  send_corners(world, soup);
  WeldedMesh copy;
  run_collectively(world, true, [&] { copy = weld(soup, 0); });
  return copy;
}

}    // namespace lsdcd
